"""Holds the rules of the house: architecture.py ROOT

- the include arrows between the rooms, and no include cycles;
- no file over 500 lines, no function over 60, no class over 20 data members;
- no absolute path of somebody's home;
- header guards named after the file; no build or work marks left behind;
- every scene in prm/ is run by a test or a benchmark.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

# What each room may include besides itself and base. Parameter headers are
# the exception: scene collects them from everywhere.
MAY_INCLUDE = {
    "base": set(),
    "materials": set(),
    "solvers": set(),
    "time_integration": set(),
    "grid": set(),
    # closed surfaces of triangles, which know no body, no grid
    "geometry": set(),
    # the inside of a closed surface is one of the shapes of a body
    "points": {"grid", "geometry"},
    "basis": {"grid", "points"},
    # pointwise laws: they know a material and a committed state, no grid
    "stress": {"materials"},
}
# bodies that move as one on the grid: their points, nodes and constraints
MAY_INCLUDE["fields"] = {"basis", "geometry", "grid", "points", "materials", "stress"}
# what a step solves, and what a part of it must say of itself
MAY_INCLUDE["equations"] = MAY_INCLUDE["fields"] | {"fields", "solvers", "time_integration"}
# between points and nodes; the consistent mass must be solved for
MAY_INCLUDE["transfer"] = MAY_INCLUDE["equations"] | {"equations"}
# surfaces of bodies, which a term of theirs lets follow
MAY_INCLUDE["surfaces"] = MAY_INCLUDE["equations"] | {"equations"}
# terms; they know each other only where one stands on the other
MAY_INCLUDE["solid"] = MAY_INCLUDE["transfer"] | {"transfer", "surfaces"}
# the skeleton of a soil is a solid
MAY_INCLUDE["porous"] = MAY_INCLUDE["solid"] | {"solid"}
# forces on rigid bodies share their columns with those on others
MAY_INCLUDE["rigid"] = MAY_INCLUDE["solid"] | {"solid"}
MAY_INCLUDE["contact"] = MAY_INCLUDE["rigid"] | {"rigid"}
# scene sees nothing of the rooms but their parameters
MAY_INCLUDE["scene"] = set()
MAY_INCLUDE["io"] = MAY_INCLUDE["porous"] | {"scene", "porous", "rigid", "contact"}
MAY_INCLUDE["simulation"] = set(MAY_INCLUDE) | {"io", "scene"}
# binds what main.cc uses, too
MAY_INCLUDE["python"] = {"simulation", "io", "scene"}

PARAMETER_HEADERS = re.compile(r"kedge/[a-z_]+/(parameters|loads|geometry)\.h$")
LONGEST_FILE = 500
LONGEST_FUNCTION = 60
MOST_MEMBERS = 20
CODE = {".cc", ".h", ".py", ".cmake", ".sh", ".prm", ".in"}
HOME = re.compile(r"/(home|Users|root|work|tmp/[a-z])\b")


def tracked_files(root):
    """The files of the repository: what git tracks or would; all if there is no git."""
    listed = None
    if shutil.which("git"):
        listed = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard", "-z"],
                                capture_output=True, text=True, check=False)
    if listed and listed.returncode == 0 and listed.stdout:
        files = [root / name for name in listed.stdout.split("\0") if name]
    else:
        files = [path for path in root.rglob("*")
                 if not re.match(r"(build|output|\.git/)", path.relative_to(root).as_posix())
                 and "__pycache__" not in path.parts]
    return [path for path in files if path.is_file()]


def includes(path):
    """The kedge headers a file includes."""
    text = path.read_text(encoding="utf-8")
    return re.findall(r'^\s*#\s*include\s*[<"](kedge/[^>"]+)[>"]', text, re.MULTILINE)


def room_of(name):
    """The room of a header named kedge/room/file.h, or of a path below source/."""
    parts = name.split("/")
    return parts[1] if len(parts) > 2 else None


def arrow_faults(root, files):
    """Includes that go against the arrows."""
    for path in files:
        name = path.relative_to(root).as_posix()
        match = re.match(r"(?:include/kedge|source)/([a-z_]+)/.*\.(?:h|cc)$", name)
        if not match:
            continue
        room = match.group(1)
        if room not in MAY_INCLUDE:
            yield f"{name}: the room {room} is not in the plan of tests/architecture.py"
            continue
        for header in includes(path):
            other = room_of(header)
            if other in (room, "base", None) or other in MAY_INCLUDE[room]:
                continue
            if room in ("scene", "io") and PARAMETER_HEADERS.search(header):
                continue
            yield f"{name} includes {header}: {room} may not know {other}"


def cycle_faults(root, files):
    """Headers that include themselves through others."""
    graph = {}
    for path in files:
        name = path.relative_to(root).as_posix()
        if name.startswith("include/") and name.endswith(".h"):
            graph[name[len("include/"):]] = includes(path)
    state = {}

    def visit(header, trail):
        state[header] = "open"
        for other in graph[header]:
            if state.get(other) == "open":
                yield "include cycle: " + " -> ".join([*trail, header, other])
            elif other in graph and other not in state:
                yield from visit(other, [*trail, header])
        state[header] = "done"

    for header in graph:
        if header not in state:
            yield from visit(header, [])


def text_faults(root, files):
    """Files that are too long, or say where they were written; wrong header guards."""
    for path in files:
        name = path.relative_to(root).as_posix()
        if path.suffix not in CODE and path.name not in ("kedge", "check", "CMakeLists.txt"):
            continue
        lines = path.read_text(encoding="utf-8").splitlines()
        if len(lines) > LONGEST_FILE:
            yield f"{name}: {len(lines)} lines, at most {LONGEST_FILE}"
        for number, line in enumerate(lines, 1):
            if HOME.search(line) and name != "tests/architecture.py":
                yield f"{name}:{number}: an absolute path of one machine: {line.strip()}"
            if path.suffix in (".h", ".cc") and re.search(r"\b(TODO|FIXME|XXX)\b", line):
                yield f"{name}:{number}: unfinished: {line.strip()}"
        if name.startswith("include/kedge/") and path.suffix == ".h":
            guard = "_".join(Path(name).with_suffix("").parts[1:])
            if f"#ifndef {guard}_h" not in lines:
                yield f"{name}: the header guard must be {guard}_h"


def blocks(text):
    """
    The blocks of braces in code, outer ones after inner ones: what stands before each since the
    statement before, where it opens and closes; and the text without comments and directives.
    """
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group(0))
    text = re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', blank, text,
                  flags=re.DOTALL)
    text = re.sub(r"^[ \t]*#(?:[^\n\\]|\\.|\\\n)*", blank, text, flags=re.MULTILINE)
    stack, found, begin = [], [], 0
    for position in (match.start() for match in re.finditer(r"[{};]", text)):
        if text[position] == "{":
            stack.append((begin, position))
        elif text[position] == "}" and stack:
            first, opening = stack.pop()
            found.append((" ".join(text[first:opening].split()), opening, position))
        begin = position + 1
    return found, text


SCOPE = re.compile(r"(?:(?:public|private|protected) ?: ?)*(?:template ?<.*> ?)?(?:inline )?"
                   r"(namespace|class|struct|union|enum|extern)\b(?!.*\) ?(?:const)?$)")


def data_members(inside):
    """How many data members a class with this between its braces has."""
    before = None
    while before != inside:
        before, inside = inside, re.sub(r"\{[^{}]*\}", "@", inside)
    number = 0
    for statement in re.split(r";|@(?!\s*;)", inside):
        statement = re.sub(r"(?:public|private|protected)\s*:|@", "", statement).split("=")[0]
        before = None
        while before != statement:
            before, statement = statement, re.sub(r"<[^<>]*>", "", statement)
        if statement.strip() and "(" not in statement and not re.match(
                r"\s*(?:using|friend|static|typedef|template|class|struct|enum)\b", statement):
            number += statement.count(",") + 1
    return number


def shape_faults(root, files):
    """Functions that are too long, and classes of too many members."""
    for path in files:
        name = path.relative_to(root).as_posix()
        if not re.match(r"(?:include|source)/.*\.(?:h|cc)$", name):
            continue
        found, text = blocks(path.read_text(encoding="utf-8"))
        scopes = [block for block in found if SCOPE.match(block[0])]
        for head, opening, closing in found:
            line = text.count("\n", 0, opening)
            scope = SCOPE.match(head)
            if scope and scope.group(1) == "class":
                number = data_members(text[opening + 1:closing])
                if number > MOST_MEMBERS:
                    yield (f"{name}:{line}: a class of {number} data members, "
                           f"at most {MOST_MEMBERS}: {head}")
            around = [block for block in found if block[1] < opening and block[2] > closing]
            if not scope and "(" in head and all(block in scopes for block in around):
                length = text.count("\n", opening, closing) - 1
                if length > LONGEST_FUNCTION:
                    yield (f"{name}:{line}: a function of {length} lines, "
                           f"at most {LONGEST_FUNCTION}: {head}")


def scene_faults(root, files):
    """Scenes that nothing runs."""
    users = [path for path in files
             if path.relative_to(root).parts[0] in ("tests", "benchmarks")
             and path.suffix in (".cmake", ".txt", ".py", ".sh")]
    text = "\n".join(path.read_text(encoding="utf-8") for path in users)
    for path in files:
        name = path.relative_to(root).as_posix()
        if name.startswith("prm/") and name.endswith(".prm") and path.name not in text:
            yield f"{name}: no test and no benchmark runs it"


def main():
    """Prints every fault; ends with 1 if there is one."""
    root = Path(sys.argv[1]).resolve()
    files = tracked_files(root)
    faults = []
    for check in (arrow_faults, cycle_faults, text_faults, shape_faults, scene_faults):
        faults += check(root, files)
    print(*faults, sep="\n")
    print(f"{len(files)} files, {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
