"""What is computed: the entries of a scene file."""
import json
import os

from . import _core


def _allowed():
    """What is allowed of each entry, by section and name; read once."""
    if not hasattr(_allowed, "table"):
        sections = json.loads(_core.parameters())["sections"]
        _allowed.table = {(section["name"], entry["name"]): entry["allowed"]
                          for section in sections for entry in section["entries"]}
    return _allowed.table


def _text(section, name, value):
    """A value as it stands in a scene file; parts of a list are separated as the entry wants."""
    if isinstance(value, bool) or type(value).__name__ == "bool_":
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"): # of numpy
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        allowed = _allowed().get((section[0] if section else "", name), "")
        by_semicolon = "separated by ;" in allowed or allowed.startswith("expressions of")
        return ("; " if by_semicolon else ", ").join(_text(section, name, part) for part in value)
    if isinstance(value, (int, float)):
        return repr(value)
    raise TypeError(f"{'/'.join([*section, name])}: a {type(value).__name__} is no value of a "
                    "scene; give a number, a text, True or False, or a list of them")


def _flatten(content, path, entries, sections):
    """Entries and sections of nested dictionaries."""
    for name, value in content.items():
        if isinstance(value, dict):
            sections.append([*path, name])
            _flatten(value, [*path, name], entries, sections)
        else:
            entries.append((path, name, _text(path, name, value)))


class Scene:
    """A scene, or the path of a single material point, as a scene file describes it.

        Scene({"Dimension": 2, "Grid": {"Extent": [4, 2], "Cells": [40, 20]}, ...}, name="beam")
        Scene.read("beam.prm")

    Sections are dictionaries, entries numbers, texts, True, False or lists of them. Nothing is
    checked before the scene is used; then all errors come at once. print(scene) shows the
    scene file.
    """

    def __init__(self, content, name="scene"):
        entries, sections = [], []
        _flatten(content, [], entries, sections)
        self._core = _core.Scene.of_entries(name, entries, sections)

    @classmethod
    def read(cls, file_name):
        """The scene of a file."""
        scene = cls.__new__(cls)
        with open(file_name, encoding="utf-8", errors="surrogateescape") as file:
            text = file.read()
        scene._core = _core.Scene.of_text(text, os.fspath(file_name))
        return scene

    def copy(self):
        """Another scene with the same entries."""
        scene = Scene.__new__(Scene)
        scene._core = self._core.copy()
        return scene

    @property
    def name(self):
        """That of the file without folder and ending; the output folder is called so."""
        return self._core.name

    @staticmethod
    def _split(full_name):
        *section, name = full_name.split("/")
        return section, name

    def __setitem__(self, full_name, value):
        """scene["Materials/rubber/Density"] = 900"""
        section, name = self._split(full_name)
        self._core.set(section, name, _text(section, name, value))

    def __getitem__(self, full_name):
        """The text of an entry that has been set; KeyError for others."""
        section, name = self._split(full_name)
        for path, entry, value in self._core.entries():
            if path == section and entry == name:
                return value
        raise KeyError(full_name)

    def __contains__(self, full_name):
        section, name = self._split(full_name)
        return any(path == section and entry == name for path, entry, _ in self._core.entries())

    def update(self, settings):
        """Several entries at once: {"Constants/h": 0.1, ...}. Returns the scene."""
        for name, value in settings.items():
            self[name] = value
        return self

    def validate(self):
        """Builds the scene and returns what `kedge --validate` prints; runs no step."""
        return _core.validate(self._core)

    def __str__(self):
        return self._core.text()

    def __repr__(self):
        return f"<kedge.Scene '{self.name}' of {len(self._core.entries())} entries>"
