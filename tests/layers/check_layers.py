#!/usr/bin/env python3
"""Fails when a source breaks the table of modules, when a library module prints or exits, or when a public
header includes a private one.

    check_layers.py ROOT

Each module may include itself and what MAY_INCLUDE lists; third-party headers are free, but for those of
tests, reports and the command line. A library module throws and returns; only the program prints and exits.
The public headers are those that PUBLIC_HEADERS of the modules' CMakeLists.txt list; all others are private,
for sources of the tree.
"""

import pathlib
import re
import sys

LIBRARY = ("core", "morse", "persistence", "mscomplex")
MAY_INCLUDE = {
    "core": {"core"},
    "morse": {"core", "persistence", "morse"},
    "persistence": {"core", "persistence"},
    "mscomplex": {"core", "persistence", "mscomplex"},
    "tools": {*LIBRARY, "tools"},
    "python": {*LIBRARY, "tools", "python"},
}
# The rooms of tools, from the lowest floor up.
FLOORS = (
    ("study", "formats", "results", "drawing", "color"),
    ("molecule",),
    ("report",),
    ("export", "html"),
    ("plot", "render"),
    ("batch", "reproduce"),
    ("commands",),
    ("manual", "main.cpp"),
)
# The rooms of python, and which rooms of tools each may include: what `import morsel` loads stays light. Each
# may include itself and binding.
PYTHON_ROOMS = {
    "binding": {"study"},
    "library": {"study"},
    "documents": {"study", "formats", "results", "report", "export", "html"},
    "molecule": {"study", "molecule"},
}
FLOOR_OF = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
MAY_PRINT = ("commands", "manual", "main.cpp", "batch")  # batch: its children between fork and exec
# What a study does without, so that Python and a browser can be built on it.
NOT_IN_STUDY = ("nlohmann/", "openssl/", "zlib.h", "png.h", "cairo", "ft2build", "embree3/",
                "openvdb/", "CLI/")
NAMES_OPTION = re.compile(r'(?<![\w-])--[a-z]')  # of the command line, in a text
NOT_IN_LIBRARY = ("catch2/", "phat/", "CLI/", "nlohmann/", "openssl/", "vtk", "iostream")
# Of these, what single sources may include all the same: the reader of glTF compiles tinygltf, which is made
# of nlohmann/json.
EXCEPTIONS = {name: ("nlohmann/json.hpp",)
              for name in ("core/io/gltf_document.h", "core/io/gltf_document.cpp", "core/io/gltf_reader.cpp")}
NOT_IN_HEADERS = ("nanoflann", "CGAL/", "Spectra/", "gemmi/", "openvdb/", "embree3/", "cairo", "png.h",
                  "ft2build")  # included by sources only: users of the installed library do not need these
NOT_IN_TOOLS = ("catch2/", "phat/", "vtk")
PRINTS_OR_EXITS = re.compile(
    r"(?<![\w.])(?:cout|cerr|clog|stdout|stderr|STDOUT_FILENO|STDERR_FILENO)\b"
    r"|(?<![\w.>])(?:printf|vprintf|puts|putchar|perror|exit|_exit|_Exit|quick_exit|abort|terminate)\s*\(")

TOKEN = re.compile(
    r'R"(?P<tag>[^()\\\s]{0,16})\(.*?\)(?P=tag)"'
    r'|"(?:\\.|[^"\\\n])*"'
    r"|(?<!\w)'(?:\\.|[^'\\\n])+'"
    r"|//[^\n]*|/\*.*?\*/", re.DOTALL)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"]', re.MULTILINE)
LINKS = re.compile(r"\bmorsel(?:::|_)(core|morse|persistence|mscomplex|tools|test_support)\b")


LINKS_ROOM = re.compile(r"\bmorsel(?:::|_)(%s)\b" % "|".join(room for room in FLOOR_OF if "." not in room))


# morsel_add_module(NAME [WITHIN FOLDER] [PROGRAM] PUBLIC_HEADERS …
MODULE = re.compile(r"\bmorsel_add_module\s*\(([^)]*)\)")
KEYWORD = re.compile(r"[A-Z_]+")


def without(text, drops):
    """`text` with the comments and literals that begin with one of `drops` emptied, line breaks kept."""
    def blank(match):
        token = match.group()
        return re.sub(r"[^\n]", " ", token) if token.startswith(drops) else token
    return TOKEN.sub(blank, text)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def may_use(room, other):
    """Whether a room of tools may include another one, or be linked with it."""
    return other == room or FLOOR_OF[other] < FLOOR_OF[room]


def check_source(module, text, is_header, own_header=None, room=None, excepted=()):
    """Yields (line, complaint) for one header or source of `module`, and of the `room` within tools;
    `own_header` is the header of its name; `excepted` are the includes that the source has by
    EXCEPTIONS."""
    code = without(text, ("//", "/*", "R"))
    foreign = NOT_IN_TOOLS if module in ("tools", "python") else NOT_IN_LIBRARY
    for match in INCLUDE.finditer(code):
        quote, path = match.groups()
        line = line_of(code, match.start())
        parts = path.split("/")
        if parts[0] == "morsel":
            if len(parts) < 3 or parts[1] not in MAY_INCLUDE[module]:
                yield line, f'{module} may not include "{path}"'
            elif module == "python":
                allowed = {"binding", room} if parts[1] == "python" else PYTHON_ROOMS[room]
                if parts[1] in ("python", "tools") and parts[2] not in allowed:
                    yield line, f'{room} may not include "{path}"'
            elif room is not None and parts[1] == "tools":
                if parts[2] not in FLOOR_OF:
                    yield line, f'"{path}": no floor of tools has the room {parts[2]}'
                elif not may_use(room, parts[2]):
                    yield line, f'{room} may not include "{path}", which is not on a lower floor'
        elif room == "study" and path.startswith(NOT_IN_STUDY):
            yield line, f"{room} may not include <{path}>"
        elif quote == '"':
            yield line, f'"{path}": the headers of the project are included as "morsel/MODULE/…"'
        elif path.startswith(foreign) and path not in excepted:
            yield line, f"{module} may not include <{path}>"
        elif is_header and path.startswith(NOT_IN_HEADERS):
            yield line, f"a header may not include <{path}>, which users of the library need not have"
    if is_header and not re.search(r"^#pragma once$", code, re.MULTILINE):
        yield 1, "a header begins with #pragma once"
    if own_header is not None:
        first = INCLUDE.search(code)
        if first is None or first.group(2) != own_header:
            yield line_of(code, first.start()) if first else 1, f'the first include is to be "{own_header}"'
    if room == "study":
        for match in TOKEN.finditer(code):
            if match.group().startswith('"') and NAMES_OPTION.search(match.group()):
                yield line_of(code, match.start()), "study knows no options of the command line"
    if module in LIBRARY or (room is not None and room not in MAY_PRINT):
        for match in PRINTS_OR_EXITS.finditer(without(text, ("//", "/*", "R", '"', "'"))):
            said = match.group().strip("( ")
            yield line_of(text, match.start()), f'{room or module} may not print nor exit: "{said}"'


def check_cmake(module, text, room=None):
    """Yields (line, complaint) for one CMakeLists.txt of `module`: it may be linked with what it may
    include."""
    code = re.sub(r"#[^\n]*", "", text)
    if room in FLOOR_OF:
        for match in LINKS_ROOM.finditer(code):
            if not may_use(room, match.group(1)):
                yield line_of(code, match.start()), f"{room} may not be linked with {match.group()}"
    for match in LINKS.finditer(code):
        if match.group(1) not in MAY_INCLUDE[module]:
            yield line_of(code, match.start()), f"{module} may not be linked with {match.group()}"


def public_headers(text):
    """Yields (line, header) for the public headers that a CMakeLists.txt lists."""
    code = re.sub(r"#[^\n]*", lambda comment: " " * len(comment.group()), text)
    for module in MODULE.finditer(code):
        listed = False
        for word in re.finditer(r"\S+", module.group(1)):
            if KEYWORD.fullmatch(word.group()):
                listed = word.group() == "PUBLIC_HEADERS"
            elif listed:
                yield line_of(code, module.start(1) + word.start()), word.group()


def check_public_headers(root):
    """Yields the complaints about the lists of public headers: each header exists, is listed once, and
    includes public headers only."""
    public, texts = set(), {}
    for listing in sorted(root.rglob("CMakeLists.txt")):
        if listing.relative_to(root).parts[0] not in MAY_INCLUDE:
            continue
        for line, name in public_headers(listing.read_text(encoding="utf-8")):
            where = f"{listing.relative_to(root)}:{line}"
            header = listing.parent / name
            if header in public:
                yield f"{where}: {name} is listed twice"
            elif not header.is_file():
                yield f"{where}: there is no header {name}"
            else:
                texts[header] = without(header.read_text(encoding="utf-8"), ("//", "/*", "R"))
            public.add(header)
    for header, code in texts.items():
        for match in INCLUDE.finditer(code):
            path = match.group(2)
            if path.startswith("morsel/") and root / path.removeprefix("morsel/") not in public:
                where = f"{header.relative_to(root)}:{line_of(code, match.start())}"
                yield f'{where}: a public header may not include "{path}", which is private'


def check(root):
    """The complaints about the tree at `root`, as "file:line: text", and the number of files that were
    read."""
    complaints, files = [], 0
    for module in MAY_INCLUDE:
        for path in sorted((root / module).rglob("*")):
            room = path.relative_to(root / module).parts[0] if module in ("tools", "python") else None
            if module == "python":
                if room not in PYTHON_ROOMS:
                    continue
            elif room is not None and room not in FLOOR_OF:
                if path.suffix in (".h", ".cpp"):
                    complaints.append(f"{path.relative_to(root)}:1: no floor of tools has the room {room}")
                room = None
            if path.suffix in (".h", ".hpp", ".cpp", ".inl"):
                header = path.with_suffix(".h")
                is_header = path.suffix != ".cpp"
                own = f"morsel/{header.relative_to(root)}" if not is_header and header.exists() else None
                excepted = EXCEPTIONS.get(str(path.relative_to(root)), ())
                found = check_source(module, path.read_text(encoding="utf-8"), is_header, own, room, excepted)
            elif path.name == "CMakeLists.txt":
                found = check_cmake(module, path.read_text(encoding="utf-8"), room)
            else:
                continue
            files += 1
            complaints += [f"{path.relative_to(root)}:{line}: {text}" for line, text in found]
    complaints += check_public_headers(root)
    return complaints, files


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    complaints, files = check(pathlib.Path(sys.argv[1]))
    for complaint in complaints:
        print(complaint)
    if files < len(LIBRARY):
        sys.exit(f"only {files} files were found in {sys.argv[1]}")
    print(f"{files} files, {len(complaints)} complaints")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
