"""Reads the .pvd, .pvtu and .vtu files of a run with nothing but numpy.

Arrays may be written as ascii, base64 or raw appended data, compressed with
zlib or not: all that VTK's XML format for unstructured grids offers, but for
other compressors.
"""
import base64
import re
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path

import numpy as np

TYPES = {"Float32": "f4", "Float64": "f8", "Int8": "i1", "UInt8": "u1", "Int16": "i2",
         "UInt16": "u2", "Int32": "i4", "UInt32": "u4", "Int64": "i8", "UInt64": "u8"}
APPENDED = re.compile(rb"<AppendedData\b[^>]*>\s*_")


class BadFile(Exception):
    """A file that is not what it should be; says which and why."""


def read_pvd(path):
    """The output times of a series: a list of (time, file)."""
    path = Path(path)
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise BadFile(f"{path}: {error}") from error
    return [(float(entry.get("timestep")), path.parent / entry.get("file"))
            for entry in root.iter("DataSet")]


class Points:
    """The material points at one time: `position` and `fields`, by name.

    Each field is an array with one row per point; `components` has the names
    of its columns (a number if the file gives none).
    """

    def __init__(self):
        self.position = np.empty((0, 3))
        self.fields = {}
        self.components = {}

    def names(self):
        """All that `values` understands: fields, their components, and the length of vectors."""
        names = []
        for name, labels in self.components.items():
            if len(labels) in (1, 3):
                names.append(name)
            if len(labels) > 1:
                names += [f"{name}_{label}" for label in labels]
        return names

    def values(self, name):
        """One number per point: a scalar, a component `field_xx`, or the length of a vector."""
        if name in self.fields:
            values = self.fields[name]
            if values.shape[1] == 1:
                return values[:, 0]
            if values.shape[1] == 3:
                return np.linalg.norm(values, axis=1)
        for field, labels in self.components.items():
            for column, label in enumerate(labels):
                if name == f"{field}_{label}":
                    return self.fields[field][:, column]
        raise KeyError(name)

    def subset(self, mask):
        """Those of the points for which `mask` is true."""
        result = Points()
        result.position = self.position[mask]
        result.fields = {name: values[mask] for name, values in self.fields.items()}
        result.components = self.components
        return result

    def append(self, other):
        """Adds the points of another piece."""
        if not self.fields:
            self.__dict__.update(other.__dict__)
            return
        self.position = np.concatenate([self.position, other.position])
        for name, values in self.fields.items():
            self.fields[name] = np.concatenate([values, other.fields[name]])


def read_points(path):
    """The points of a .vtu file, or of all pieces of a .pvtu file."""
    path = Path(path)
    try:
        data = path.read_bytes()
        if path.suffix != ".pvtu":
            return read_piece(data)
        points = Points()
        for piece in ElementTree.fromstring(data).iter("Piece"):
            points.append(read_points(path.parent / piece.get("Source")))
        return points
    except (OSError, ElementTree.ParseError, zlib.error, ValueError, KeyError) as error:
        raise BadFile(f"{path}: {error}") from error


def read_surfaces(path):
    """The facets in a .vtu file: their corners, an array over facets, corners, x y z, and fields by
    name with one row per facet."""
    path = Path(path)
    try:
        root, decode = parse(path.read_bytes())
        piece = root.find("UnstructuredGrid/Piece")
        cells = {array.get("Name"): decode(array)[:, 0] for array in piece.iterfind("Cells/*")}
        fields = {array.get("Name"): decode(array) for array in piece.iterfind("CellData/*")}
        n_facets = len(cells["offsets"])
        place = decode(piece.find("Points/DataArray"))
        corners = place[cells["connectivity"]].reshape(n_facets, -1 if n_facets else 2, 3)
        return corners, fields
    except (OSError, ElementTree.ParseError, zlib.error, ValueError, KeyError) as error:
        raise BadFile(f"{path}: {error}") from error


def parse(data):
    """The elements of the text of a .vtu file, and what decodes their arrays."""
    # Raw appended bytes are no XML: take them out before parsing.
    appended = b""
    begin = APPENDED.search(data)
    if begin:
        end = data.rindex(b"</AppendedData>")
        appended = data[begin.end():end]
        data = data[:begin.end()] + data[end:]
    root = ElementTree.fromstring(data)
    compressor = root.get("compressor", "")
    if compressor not in ("", "vtkZLibDataCompressor"):
        raise ValueError(f"compressed by {compressor}, which is not understood here")
    raw = root.find("AppendedData") is None or root.find("AppendedData").get("encoding") == "raw"
    return root, Decoder(order="<" if root.get("byte_order") == "LittleEndian" else ">",
                         header=TYPES[root.get("header_type", "UInt32")],
                         compressed=bool(compressor), appended=appended, raw=raw)


def read_piece(data):
    """The points of the text of a .vtu file."""
    root, decode = parse(data)
    points = Points()
    for piece in root.iter("Piece"):
        part = Points()
        part.position = decode(piece.find("Points/DataArray"))
        for array in piece.iterfind("PointData/DataArray"):
            name = array.get("Name")
            part.fields[name] = decode(array)
            n_components = part.fields[name].shape[1]
            part.components[name] = [array.get(f"ComponentName{i}", str(i))
                                     for i in range(n_components)]
        points.append(part)
    return points


class Decoder:
    """Turns a DataArray element into an array of one row per tuple."""

    def __init__(self, order, header, compressed, appended, raw):
        self.order = order
        self.header = np.dtype(order + header)
        self.compressed = compressed
        self.appended = appended
        self.raw = raw

    def __call__(self, element):
        kind = np.dtype(self.order + TYPES[element.get("type")])
        form = element.get("format", "ascii")
        if form == "ascii":
            values = np.array((element.text or "").split(), dtype=kind)
        elif form == "appended":
            data = self.appended[int(element.get("offset")):]
            values = np.frombuffer(self.unpack(data, self.raw), kind)
        else:
            values = np.frombuffer(self.unpack((element.text or "").strip().encode(), False), kind)
        return values.reshape(-1, int(element.get("NumberOfComponents", 1)))

    def unpack(self, data, raw):
        """The bytes of one array, whose header stands at the beginning of `data`."""
        size = self.header.itemsize
        if not self.compressed:
            n_bytes = int(self.numbers(data, 1, raw)[0])
            if raw:
                return data[size:size + n_bytes]
            # without compression header and values are one base64 text
            return decode_base64(data, size + n_bytes)[size:]
        n_blocks = int(self.numbers(data, 1, raw)[0])
        n_header = 3 + n_blocks
        lengths = self.numbers(data, n_header, raw)[3:]
        if raw:
            data = data[n_header * size:]
        else:
            data = decode_base64(data[base64_length(n_header * size):], int(lengths.sum()))
        blocks, begin = [], 0
        for length in map(int, lengths):
            blocks.append(zlib.decompress(data[begin:begin + length]))
            begin += length
        return b"".join(blocks)

    def numbers(self, data, count, raw):
        """The first `count` numbers of a header."""
        n_bytes = count * self.header.itemsize
        return np.frombuffer(data[:n_bytes] if raw else decode_base64(data, n_bytes), self.header)


def base64_length(n_bytes):
    """How many characters base64 takes for so many bytes."""
    return 4 * ((n_bytes + 2) // 3)


def decode_base64(text, n_bytes):
    """The first `n_bytes` bytes of what stands in base64."""
    return base64.b64decode(text[:base64_length(n_bytes)])[:n_bytes]
