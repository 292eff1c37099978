"""Reads parameters.prm of a run: the grid, the names of bodies, prescribed motions, loads."""
import ast
import math
import operator

import numpy as np

OPERATIONS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
              ast.Div: operator.truediv, ast.Pow: operator.pow, ast.USub: operator.neg,
              ast.UAdd: operator.pos, ast.Lt: operator.lt, ast.Gt: operator.gt,
              ast.LtE: operator.le, ast.GtE: operator.ge, ast.Eq: operator.eq,
              ast.NotEq: operator.ne}
FUNCTIONS = {"sin": math.sin, "cos": math.cos, "tan": math.tan, "exp": math.exp, "ln": math.log,
             "log": math.log, "sqrt": math.sqrt, "abs": abs, "min": min, "max": max,
             "floor": math.floor, "ceil": math.ceil, "pow": pow, "tanh": math.tanh,
             "erf": math.erf, "erfc": math.erfc, "rint": round, "mod": math.fmod,
             "if_": lambda condition, a, b: a if condition else b}


class Unknown(Exception):
    """An expression that is not understood here."""


def evaluate(text, names):
    """The value of an expression of a scene."""
    text = text.replace("^", "**").replace("&&", " and ").replace("||", " or ")
    text = text.replace("if(", "if_(")
    try:
        return value_of(ast.parse(text.strip(), mode="eval").body, names)
    except (SyntaxError, KeyError, ValueError, ZeroDivisionError, OverflowError,
            TypeError) as error:
        raise Unknown(f"{text}: {error}") from error


def value_of(node, names):
    """The value of a part of an expression."""
    if isinstance(node, ast.Constant):
        return float(node.value)
    if isinstance(node, ast.Name):
        return math.pi if node.id == "pi" else names[node.id]
    if isinstance(node, ast.BinOp):
        return OPERATIONS[type(node.op)](value_of(node.left, names), value_of(node.right, names))
    if isinstance(node, ast.UnaryOp):
        return OPERATIONS[type(node.op)](value_of(node.operand, names))
    if isinstance(node, ast.Compare) and len(node.ops) == 1:
        return OPERATIONS[type(node.ops[0])](value_of(node.left, names),
                                             value_of(node.comparators[0], names))
    if isinstance(node, ast.BoolOp):
        values = [value_of(part, names) for part in node.values]
        return all(values) if isinstance(node.op, ast.And) else any(values)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return FUNCTIONS[node.func.id](*(value_of(part, names) for part in node.args))
    raise Unknown(ast.dump(node))


class SceneFile:
    """The entries of a parameters.prm, `Section/Name/Entry` to text; empty if there is no file."""

    def __init__(self, path):
        self.entries, self.constants = {}, {}
        if path.exists():
            self.read(path.read_text("utf-8"))

    def read(self, text):
        """Reads a file as kedge writes it: one entry per line."""
        section = []
        for line in text.replace("\\\n", " ").splitlines():
            word, _, rest = line.strip().partition(" ")
            if word == "subsection":
                section.append(rest.strip())
            elif word == "end":
                section.pop()
            elif word == "set":
                name, _, value = rest.partition("=")
                self.entries["/".join([*section, name.strip()])] = value.strip()
        texts = {name.partition("/")[2]: value for name, value in self.entries.items()
                 if name.startswith("Constants/")}
        for _ in texts: # each may use the others, in any order
            for name, value in texts.items():
                try:
                    self.constants[name] = evaluate(value, self.constants)
                except Unknown:
                    continue

    def names(self, section):
        """The user's names within a section, in order."""
        names = [name.split("/")[1] for name in self.entries
                 if name.startswith(section + "/") and name.count("/") == 2]
        return list(dict.fromkeys(names))

    def get(self, name, default=""):
        """The text of an entry."""
        return self.entries.get(name, default)

    def numbers(self, name):
        """The numbers of an entry; None if they are not understood."""
        try:
            return [evaluate(part, self.constants)
                    for part in self.get(name).replace(";", ",").split(",")]
        except Unknown:
            return None

    def history(self, expression, times):
        """An expression of t at the given times; None if it is not understood."""
        try:
            return np.array([evaluate(expression, {**self.constants, "t": float(time)})
                             for time in times])
        except Unknown:
            return None

    def grid(self):
        """Origin and cell size per direction, or None."""
        origin, extent, cells = (self.numbers(f"Grid/{name}")
                                 for name in ("Origin", "Extent", "Cells"))
        if not origin or not extent or not cells or len(extent) != len(cells):
            return None
        return np.array(origin), np.array(extent) / np.array(cells)

    def is_saturated(self):
        """Whether there is pore water."""
        return bool(self.get("Pore fluid/Density"))

    def title(self):
        """What the scene shows."""
        return self.get("Title")
