"""Random small scenes that a user could have written, and mutations of scenes."""

# Values that programs stumble over.
NASTY = ["0", "-1", "1e308", "-1e308", "1e-308", "1e16", "4294967295", "4294967296", "1e9", "1/0",
         "0/0", "nan", "inf", "", "1e400", "x", "t", "1/t", "0/t", "1/x", "sqrt(-1)", "log(t)",
         "if(t > 0.01, 1/0, 1)", "1e300*1e300", "0.5", "1, 2", "1; 2; 3", "a" * 5000, "(" * 200,
         "\u00e9\u4e16", "true", "none", "9" * 400, "-0", "1e-16", "pi", "rho", "--1", "2^31"]
WORDS = ["set", "subsection", "end", "include", "#", "\\", "=", ";", ","]


class Scene:
    """A scene file as nested dictionaries; `text` writes it."""

    def __init__(self):
        self.tree = {}

    def put(self, path, value):
        """Sets an entry, `Section/Name/Entry`."""
        *sections, entry = path.split("/")
        node = self.tree
        for section in sections:
            node = node.setdefault(section, {})
        node[entry] = value

    def text(self):
        """The scene file."""
        return "\n".join(lines_of(self.tree, "")) + "\n"


def lines_of(tree, indent):
    """The lines of a section."""
    for name, value in tree.items():
        if isinstance(value, dict):
            yield f"{indent}subsection {name}"
            yield from lines_of(value, indent + "  ")
            yield indent + "end"
        else:
            yield f"{indent}set {name} = {value}"


def generate(random):
    """A scene: one or two bodies, a law, supports, loads, a scheme."""
    scene = Scene()
    dim = 3 if random.random() < 0.15 else 2
    scene.put("Dimension", dim)
    low = [random.choice([0, 0, -1, 10]) for _ in range(dim)]
    size = [random.choice([0.5, 1, 2]) for _ in range(dim)]
    cells = [random.randint(1, 4 if dim == 3 else 7) for _ in range(dim)]
    scene.put("Grid/Origin", ", ".join(map(str, low)))
    scene.put("Grid/Extent", ", ".join(map(str, size)))
    scene.put("Grid/Cells", ", ".join(map(str, cells)))
    wet = random.random() < 0.3
    put_material(scene, random, wet)
    if wet:
        scene.put("Pore fluid/Density", 1000)
        scene.put("Pore fluid/Bulk modulus", random.choice(["2.2e9", "1e6"]))
        scene.put("Pore fluid/Hydraulic conductivity", random.choice(["1e-3", "1e-9"]))
        if random.random() < 0.3:
            scene.put("Pore fluid/Pressure space", "coarse")
    put_bodies(scene, random, dim, low, size)
    put_conditions(scene, random, dim, wet)
    put_loads(scene, random, dim)
    put_numerics(scene, random, wet)
    return scene.text()


def put_material(scene, random, wet):
    """A law with values of its own size."""
    name = "Materials/m/"
    scene.put(name + "Density", random.choice(["1000", "2000", "1e-3"]))
    model = random.choice(["hencky"] * 4 + ["von_mises", "tresca", "drucker_prager",
                                            "mohr_coulomb", "improved_hencky"])
    scene.put(name + "Model", model)
    scene.put(name + "Young's modulus", random.choice(["1e6", "1e9", "1e3"]))
    scene.put(name + "Poisson's ratio", random.choice(["0.3", "0", "0.49", "-0.5"]))
    if model == "von_mises":
        scene.put(name + "Yield radius rho_y", random.choice(["1e4", "1e2", "1e3 + 100*y"]))
    elif model == "tresca":
        scene.put(name + "Undrained strength", random.choice(["1e4", "1e3 + 100*y"]))
    elif model in ("drucker_prager", "mohr_coulomb"):
        scene.put(name + "Cohesion", random.choice(["0", "1e3"]))
        scene.put(name + "Friction angle", random.choice(["30", "10"]))
        scene.put(name + "Dilation angle", random.choice(["0", "5"]))
    if wet or model == "improved_hencky":
        scene.put(name + "Initial porosity", random.choice(["0.4", "0.9"]))
    if random.random() < 0.2:
        scene.put(name + "Volume change", "cell mean")


def put_bodies(scene, random, dim, low, size):
    """One body somewhere in the grid, or two side by side."""
    n_bodies = random.choice([1, 1, 1, 2])
    basis = random.choice(["gimp", "linear", "linear", "quadratic"] if n_bodies == 1
                          else ["gimp", "linear"])
    for body in range(n_bodies):
        name = f"Bodies/b{body}/"
        begin = [l + s * random.uniform(0, 0.3) for l, s in zip(low, size)]
        end = [l + s * random.uniform(0.6, 1) for l, s in zip(low, size)]
        if n_bodies == 2:
            begin[0], end[0] = (low[0] + size[0] * part for part in
                                ((0, 0.45) if body == 0 else (0.5, 1)))
        corners = [", ".join(f"{x:.6g}" for x in corner) for corner in (begin, end)]
        geometry = f"box({corners[0]}; {corners[1]})"
        if random.random() < 0.2:
            middle = ", ".join(f"{(a + b) / 2:.6g}" for a, b in zip(begin, end))
            geometry += f" - ball({middle}; {0.2 * min(size):.6g})"
        scene.put(name + "Geometry", geometry)
        scene.put(name + "Material", "m")
        scene.put(name + "Points per cell", random.choice([1, 2, 2, 3]))
        scene.put(name + "Basis", basis)
        if random.random() < 0.4:
            scene.put(name + "Initial velocity", "; ".join(
                random.choice(["0", "1", "-y", "0.1*x", "x*y"]) for _ in range(dim)))
    if n_bodies == 2 and random.random() < 0.3:
        scene.put("Contact/c/First", "b0")
        scene.put("Contact/c/Second", "b1")


def put_conditions(scene, random, dim, wet):
    """Supports on some sides."""
    sides = ["left", "right", "bottom", "top", "back", "front"][:2 * dim]
    for number in range(random.choice([0, 1, 1, 2])):
        name = f"Node conditions/c{number}/"
        scene.put(name + "Side", random.choice(sides))
        for direction in "xyz"[:dim]:
            scene.put(name + "Component " + direction, random.choice(
                ["fixed", "fixed", "free", "displacement(0.01*t)", "velocity(-0.1)",
                 "displacement(0.1*sin(10*t))"]))
        scene.put(name + "Reaction", random.choice(["true", "false"]))
        if wet and random.random() < 0.5:
            scene.put(name + "Pore pressure", random.choice(["0", "100*t"]))


def put_loads(scene, random, dim):
    """Gravity, tractions and a point load."""
    zeros = ["0"] * (dim - 1)
    if random.random() < 0.5:
        scene.put("Body force/Acceleration",
                  "; ".join(["0", random.choice(["-9.81", "-9.81*t"]), "0"][:dim]))
    if random.random() < 0.4:
        scene.put("Tractions/l/Body", "b0")
        scene.put("Tractions/l/Side", random.choice(["top", "right", "bottom"]))
        scene.put("Tractions/l/Traction",
                  "; ".join(zeros + [random.choice(["-1e3", "1e3*t", "1/t", "0/t", "1e6*t"])]))
    if random.random() < 0.2:
        scene.put("Point loads/p/Body", "b0")
        scene.put("Point loads/p/Place", ", ".join(["0.5"] * dim))
        scene.put("Point loads/p/Force", "; ".join(zeros + [random.choice(["1", "10*t"])]))


def put_numerics(scene, random, wet):
    """Scheme, steps and solvers."""
    schemes = (["quasi-static", "newmark", "trapezoidal", "midpoint"] if wet else
               ["clc-midpoint", "clc-midpoint", "quasi-static", "clc-quasi-static", "midpoint",
                "trapezoidal", "newmark", "generalised-alpha"])
    scene.put("Time/Scheme", random.choice(schemes))
    scene.put("Time/End", random.choice(["0.05", "0.1"]))
    scene.put("Time/Step", random.choice(["0.01", "0.02", "0.03", "5 cfl"] if not wet
                                         else ["0.01", "0.02"]))
    scene.put("Time/Smallest step factor", random.choice(["1/4", "1/64"]))
    if random.random() < 0.2:
        scene.put("Time/Largest step factor", 4)
        scene.put("Output/Points interval", 0.013)
    if random.random() < 0.2:
        scene.put("Equilibrium/Steps", 2)
    if random.random() < 0.3:
        scene.put("Stabilisation/Method", random.choice(["none", "ghost"]))
    if random.random() < 0.2:
        scene.put("Mapping/Velocity", "pic")
    if random.random() < 0.3:
        scene.put("Linear solver/Method", random.choice(["direct", "banded", "krylov-ilu"]))
    if random.random() < 0.3:
        scene.put("Probes/p/Face", random.choice(["top", "left"]))


def mutate(random, text, other):
    """The scene with one to three changes of the kind that people and programs make."""
    for _ in range(random.choice([1, 1, 2, 3])):
        lines = text.split("\n")
        text = random.choice(MUTATIONS)(random, lines, other.split("\n"))
    return text


def nasty_value(random, lines, _):
    """The value of an entry becomes one that programs stumble over."""
    entries = [i for i, line in enumerate(lines) if line.strip().startswith("set ")]
    if entries:
        chosen = random.choice(entries)
        name = lines[chosen].split("=")[0]
        lines[chosen] = f"{name}= {random.choice(NASTY)}"
    return "\n".join(lines)


def nasty_number(random, lines, _):
    """One number within a value changes."""
    entries = [i for i, line in enumerate(lines) if "=" in line and any(map(str.isdigit, line))]
    if entries:
        chosen = random.choice(entries)
        digits = [i for i, letter in enumerate(lines[chosen]) if letter.isdigit()]
        at = random.choice(digits)
        lines[chosen] = lines[chosen][:at] + random.choice(NASTY)[:20] + lines[chosen][at + 1:]
    return "\n".join(lines)


def drop_line(random, lines, _):
    """A line is lost."""
    del lines[random.randrange(len(lines))]
    return "\n".join(lines)


def double_line(random, lines, _):
    """A line stands twice."""
    at = random.randrange(len(lines))
    return "\n".join(lines[:at] + [lines[at]] + lines[at:])


def move_line(random, lines, _):
    """A line stands elsewhere."""
    line = lines.pop(random.randrange(len(lines)))
    lines.insert(random.randrange(len(lines) + 1), line)
    return "\n".join(lines)


def foreign_line(random, lines, other):
    """A line of another scene comes in."""
    lines.insert(random.randrange(len(lines) + 1), random.choice(other))
    return "\n".join(lines)


def flip_letter(random, lines, _):
    """A letter changes, is lost or comes in."""
    text = "\n".join(lines)
    at = random.randrange(max(len(text), 1))
    letter = random.choice(["", "a", "=", "\x00", "\xff", "(", ")", ";", "\n", "\t", "1"])
    return text[:at] + letter + text[at + random.choice([0, 1]):]


def cut(random, lines, _):
    """The file ends too early."""
    text = "\n".join(lines)
    return text[:random.randrange(max(len(text), 1))]


def swap_values(random, lines, _):
    """Two entries have each other's values."""
    entries = [i for i, line in enumerate(lines) if line.strip().startswith("set ")
               and "=" in line]
    if len(entries) > 1:
        a, b = random.sample(entries, 2)
        (name_a, value_a), (name_b, value_b) = (lines[i].split("=", 1) for i in (a, b))
        lines[a], lines[b] = name_a + "=" + value_b, name_b + "=" + value_a
    return "\n".join(lines)


def misspell(random, lines, _):
    """A keyword or a name gets another word."""
    at = random.randrange(len(lines))
    words = lines[at].split(" ")
    words[random.randrange(len(words))] = random.choice(WORDS)
    lines[at] = " ".join(words)
    return "\n".join(lines)


MUTATIONS = [nasty_value, nasty_value, nasty_value, nasty_number, drop_line, double_line,
             move_line, foreign_line, flip_letter, cut, swap_values, misspell]
