# SPDX-License-Identifier: BSD-3-Clause
"""Which room of the source tree may include what; see violations().

    python3 Testing/Structure/structure.py [TREE]

prints what breaks the rules in TREE (default: the tree that this file stands in) and exits with 1, or 0
where nothing does.
"""

import os
import re
import sys

# Rooms, and the rooms whose headers each may include besides its own. Examples use installed headers.
ROOMS = {
    "Filters/Core": (),
    "Filters/Capture": ("Filters/Core",),
    "Filters/Modeling": ("Filters/Core", "Filters/Capture"),
    "Filters/OffScreen": (),
    "Wrapping": ("Filters/Core", "Filters/Capture", "Filters/Modeling", "Filters/OffScreen"),
    "Examples": ("Filters/Modeling", "Filters/OffScreen", "Wrapping"),
}

# What stands outside the tree: a kind, and how its headers are named.
KINDS = (
    ("files", re.compile(r"<(filesystem|fstream)>")),
    ("the C++ library", re.compile(r"<[a-z0-9_]+>")),
    ("Eigen", re.compile(r"[<\"](unsupported/)?Eigen/")),
    ("Qhull", re.compile(r"[<\"]libqhull")),
    ("OpenCV", re.compile(r"[<\"]opencv")),
    ("VTK", re.compile(r"[<\"](vtk\w*\.h|vtk\w+/)")),
    ("OSMesa", re.compile(r"[<\"]GL/osmesa\.h")),
    ("the program's libraries", re.compile(r"[<\"]CLI/")),
    ("nlohmann-json", re.compile(r"[<\"]nlohmann/")),
    ("the camera files' libraries", re.compile(r"<(pugixml\.hpp|yaml-cpp/\w+\.h|zlib\.h)>")),
    ("the system", re.compile(r"<(sys/)?[a-z]+\.h>")),
)

# Kinds that each room may include; what is of no kind may be included nowhere.
ALLOWED = {
    "Filters/Core": {"the C++ library", "Eigen", "Qhull"},
    "Filters/Capture": {"the C++ library", "files", "Eigen", "OpenCV", "nlohmann-json", "the camera files' libraries"},
    "Filters/Modeling": {"the C++ library", "files", "Eigen", "VTK"},
    "Filters/OffScreen": {"the C++ library", "VTK", "OSMesa", "the system"},
    "Wrapping": {"the C++ library", "files", "VTK", "the program's libraries", "nlohmann-json", "the system"},
    "Examples": {"the C++ library", "files", "VTK", "the system"},
}

# Files that may include a kind more than their room.
ALSO_ALLOWED = {"Filters/Core/LargePages.cxx": {"the system"}}  # advice about memory, which the C++ library cannot give

SOURCES = (".h", ".hpp", ".cxx", ".cpp", ".c", ".in")
INCLUDE = re.compile(r"^\s*#\s*include\s*([<\"][^>\"]+[>\"])")
GENERATED = {  # by VTK's module system: the export macros
    "vtkSilhouetteFiltersModelingModule.h": "Filters/Modeling",
    "vtkSilhouetteOffScreenModule.h": "Filters/OffScreen",
}
PIXEL_LOOKUP = re.compile(r"(\.|->)object\s*(\[|\.data\b|\.at\b)|(\.|->)tiles\b")
IN_PUBLIC_HEADER = ((re.compile(r"\btemplate\s*<"), "a template"),
                    (re.compile(r"\bEigen::"), "Eigen"),
                    (re.compile(r"\bcv::"), "OpenCV"))
COMMENT_OR_STRING = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"", re.DOTALL)


def violations(tree):
    """What breaks the rules in `tree`, a list of "FILE:LINE: what is wrong".

    - Includes point one way: Core <- Capture <- Modeling <- Wrapping <- Examples; OffScreen stands by itself.
    - Core knows neither VTK nor OpenCV nor files; only Capture knows OpenCV.
    - Headers that are installed show types of VTK and of the C++ library only, and no templates.
    - A silhouette's pixels are looked up in PreparedViews alone.
    """
    files = {room: _sources(tree, room) for room in ROOMS}
    found = []
    for room, paths in files.items():
        public = _public_headers(tree, room)
        for path in paths:
            with open(os.path.join(tree, path), encoding="utf-8") as file:
                text = file.read()
            found += _wrong_includes(room, path, text, files)
            found += _stray_lookups(path, text)
            if os.path.basename(path) in public:
                found += _wrong_in_public_header(room, path, text, public, files)
    return found


def _sources(tree, room):
    """Paths of a room's C and C++ files, relative to the tree."""
    paths = []
    for folder, _, names in os.walk(os.path.join(tree, room)):
        paths += [os.path.relpath(os.path.join(folder, name), tree) for name in names
                  if name.endswith(SOURCES)]
    return sorted(path.replace(os.sep, "/") for path in paths)


def _public_headers(tree, room):
    """Names of the headers that a VTK module installs: those of the classes in its CMakeLists.txt."""
    lists = os.path.join(tree, room, "CMakeLists.txt")
    if not os.path.exists(os.path.join(tree, room, "vtk.module")):
        return set()
    with open(lists, encoding="utf-8") as file:
        text = file.read()
    classes = re.search(r"\bset\(classes\s([^)]*)\)", text) or re.search(r"\bCLASSES\s((?:\s*vtk\w+)+)", text)
    return {name + ".h" for name in classes.group(1).split()}


def _line(text, offset):
    return text.count("\n", 0, offset) + 1


def _includes(text):
    """Pairs of line number and what is included, with its quotes or brackets."""
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1)


def _owner(included, room, files):
    """The room that has the included header, the including one first; None where no room has."""
    name = os.path.basename(included[1:-1])
    if name in GENERATED:
        return GENERATED[name]
    owners = [each for each, paths in files.items()
              if any(os.path.basename(path) in (name, name + ".in") for path in paths)]
    if included.startswith("<") and not name.startswith("vtk"):
        return None
    return room if room in owners else owners[0] if owners else None


def _wrong_includes(room, path, text, files):
    found = []
    for number, included in _includes(text):
        owner = _owner(included, room, files)
        if owner:
            if owner != room and owner not in ROOMS[room]:
                found.append(f"{path}:{number}: {room} includes {included} of {owner}")
            continue
        kind = next((kind for kind, pattern in KINDS if pattern.match(included)), None)
        if kind is None:
            found.append(f"{path}:{number}: {included} is neither ours nor known to these rules")
        elif kind not in ALLOWED[room] | ALSO_ALLOWED.get(path, set()):
            found.append(f"{path}:{number}: {room} includes {included} ({kind})")
    return found


def _code(text):
    """The text with comments and strings blanked, lines kept."""
    return COMMENT_OR_STRING.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def _stray_lookups(path, text):
    if os.path.basename(path).startswith("PreparedViews."):
        return []
    return [f"{path}:{_line(text, match.start())}: a pixel is looked up outside PreparedViews"
            for match in PIXEL_LOOKUP.finditer(_code(text))]


def _wrong_in_public_header(room, path, text, public, files):
    found = []
    for number, included in _includes(text):
        name = included[1:-1]
        theirs = _owner(included, room, files) is None and re.fullmatch(r"vtk\w+\.h|[a-z0-9_]+", name)
        if not (theirs or name in public or name in GENERATED):
            found.append(f"{path}:{number}: an installed header includes {included}")
    code = _code(text)
    for pattern, what in IN_PUBLIC_HEADER:
        found += [f"{path}:{_line(text, match.start())}: an installed header shows {what}"
                  for match in pattern.finditer(code)]
    return found


def main(arguments):
    here = os.path.dirname(os.path.abspath(__file__))
    found = violations(arguments[0] if arguments else os.path.join(here, os.pardir, os.pardir))
    print("\n".join(found) if found else "No include points the wrong way.")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
