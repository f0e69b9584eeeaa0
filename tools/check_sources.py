#!/usr/bin/env python3
"""Checks the order of the rooms and the conventions that a compiler does not check; prints every breach and exits with 1.

  - a file in src/<room> includes nothing from a room to its right; laws and joints do not see each other;
  - a file in src/<room>/<folder> includes nothing from a folder of that room to its right;
  - nothing in src/ includes the program, tests or benchmarks; a public header includes public headers only;
  - outside src/start only start/start.h of that room is included;
  - every reference to a System is const: functions that change a system return another;
  - no file has more than 500 lines, no function more than 100;
  - no vague names in files and types; no notes to self;
  - every file that states the program's version states that of CMakeLists.txt;
  - no constant or type has the same name in two headers: the linker would use one's value or code for both.
"""
import pathlib
import re
import sys

ROOMS = "base simd space model linalg laws joints system kinematics integrators mobility dynamics start bearings run batch check studies live results io report sweeps".split()
# The folders of a room, in order of dependence; files in the room itself are open to all of them.
FOLDERS_OF = {
    "base": "text tables expression".split(),
    "check": ["modes"],
    "integrators": "radau absolute dense relative general ideal".split(),
    "io": "schema reading toml".split(),
    "laws": "friction contact bearings flexures".split(),
    "results": "plots studies".split(),
    "run": "record errors limits".split(),
    "start": ["relative"],
    "sweeps": "storage".split(),
}
MAX_IN_FOLDER = 25
# The leftmost room that may use a public header; headers not listed count as model.
PUBLIC_HEADERS = {
    "complaint.h": "base",
    "expression.h": "base",
    "model.h": "model",
    "trajectory.h": "integrators",
    "bearings.h": "bearings",
    "simulate.h": "start",
    "live.h": "live",
    "check.h": "mobility",
    "solvers.h": "studies",
    "sweep.h": "batch",
}
OUTER = {"cli", "studio", "tests", "bench", "paper", "examples"}
FOLDERS = ["include", "src", "cli", "studio/kernel", "studio/server", "studio/src", "studio/tests", "tests", "bench", "paper", "examples", "tools", "cmake"]
SUFFIXES = {".h", ".cpp", ".py", ".sh", ".cmake", ".ts", ".tsx"}
MAX_FILE, MAX_FUNCTION = 500, 100
VAGUE = {"manager", "handler", "util", "utils", "helper", "helpers", "misc", "data2", "tmp"}
NOTE = re.compile(r"\b(" + "TO" + "DO|FIX" + "ME|XX" + r"X)\b")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
# Where the version is stated; a version that is asked for may omit the parts that do not break compatibility.
VERSIONED = {
    "CMakeLists.txt": re.compile(r"^project\(Pintle VERSION ([\d.]+)"),
    "CITATION.cff": re.compile(r"^version: ([\d.]+)"),
    "studio/package.json": re.compile(r'^  "version": "([\d.]+)"'),
    "examples/outside/CMakeLists.txt": re.compile(r"^find_package\(Pintle ([\d.]+)"),
}
START_DOOR = "start/start.h"
CHANGEABLE_SYSTEM = re.compile(r"(?<!const )\b(?:System|SpatialSystem|BasicSystem<\w+>)\s*&")
TYPE = re.compile(r"^\s*(?:class|struct|enum class|enum|namespace)\s+(\w+)")
SHARED_NAME = re.compile(
    r"^inline\s+(?:constexpr|const)\b[^=({]*?\b(?P<constant>k[A-Z]\w*)\s*[={(;\[]|^(?:struct|class|enum class)\s+(?P<type>\w+)\s*(?:final\s*)?(?::[^:].*)?\{"
)
NAMESPACE = re.compile(r"^namespace\s+([\w:]*)\s*\{")
FUNCTION = re.compile(r"^(?!namespace|class|struct|enum|union|extern|template|#|//|})\S.*\)[^;=]*\{$")


def words(name):
    """The words of a file's or a type's name, in lower case."""
    return {word.lower() for word in re.findall(r"[A-Z]?[a-z0-9]+|[A-Z]+", name)}


def room_may_include(room, target):
    """Why `room` may not include `target`, or an empty string."""
    head, _, rest = target.partition("/")
    if head == "pintle":
        leftmost = PUBLIC_HEADERS.get(rest, "model")
        return "" if ROOMS.index(room) >= ROOMS.index(leftmost) else f"{target} is for {leftmost} and rooms on its right"
    if head in OUTER:
        return f"{target} is outside the library"
    if head not in ROOMS:
        return f"{target} names no room: write \"room/file.h\" or \"pintle/file.h\""
    if ROOMS.index(head) > ROOMS.index(room):
        return f"{target} is on the right of {room}"
    if {room, head} == {"laws", "joints"}:
        return "laws and joints do not see each other"
    return ""


def folder_may_include(path, target):
    """Why a file may not include `target` from its own room, or an empty string."""
    own, other = path.parts[2:-1], pathlib.PurePath(target).parts[1:-1]
    order = FOLDERS_OF.get(path.parts[1], [])
    known = len(own) == 1 and len(other) == 1 and own[0] in order and other[0] in order
    if known and not path.stem.endswith("_test") and order.index(other[0]) > order.index(own[0]):
        return f"{target} is on the right of {path.parts[1]}/{own[0]}"
    return ""


def include_breach(path, target):
    parts = path.parts
    if target.startswith("start/") and target != START_DOOR and parts[:2] != ("src", "start"):
        return f"{target} is behind the door of its room: include {START_DOOR}"
    if parts[0] == "include" and not target.startswith("pintle/"):
        return f"a public header includes the internal {target}"
    if parts[0] == "src" and len(parts) > 2:
        return room_may_include(parts[1], target) or (folder_may_include(path, target) if target.startswith(parts[1] + "/") else "")
    return ""


def crowds(root):
    """(path, line, message) of every folder of a room that is not in FOLDERS_OF or has too many sources directly in it."""
    for room in ROOMS:
        for folder in sorted(path for path in [root / "src" / room, *(root / "src" / room).rglob("*")] if path.is_dir()):
            path = folder.relative_to(root)
            sources = [file for file in folder.iterdir() if file.suffix in {".h", ".cpp"}]
            if len(sources) > MAX_IN_FOLDER:
                yield path, 1, f"{len(sources)} sources side by side (at most {MAX_IN_FOLDER})"
            if len(path.parts) == 3 and sources and path.parts[2] not in FOLDERS_OF.get(room, []):
                yield path, 1, "a folder without a place in the order of FOLDERS_OF"


def function_breaches(lines):
    """(line, message) of every function that begins and ends in the first column and is too long."""
    start = None
    for number, line in enumerate(lines, 1):
        if start is None and FUNCTION.match(line):
            start = number
        elif start is not None and line.startswith("}"):
            if number - start + 1 > MAX_FUNCTION:
                yield start, f"a function of {number - start + 1} lines (at most {MAX_FUNCTION})"
            start = None


def breaches(root, path):
    lines = (root / path).read_text(encoding="utf-8").splitlines()
    if len(lines) > MAX_FILE:
        yield 1, f"{len(lines)} lines (at most {MAX_FILE})"
    for word in sorted(words(path.stem) & VAGUE):
        yield 1, f"the file's name says '{word}': name what it does"
    if path.suffix in {".h", ".cpp"}:
        yield from function_breaches(lines)
    for number, line in enumerate(lines, 1):
        if NOTE.search(line):
            yield number, "a note to self: do it, or leave it out"
        if path.suffix not in {".h", ".cpp"}:
            continue
        if include := INCLUDE.match(line):
            if breach := include_breach(path, include[1]):
                yield number, breach
        if CHANGEABLE_SYSTEM.search(line.split("//")[0]):
            yield number, "a reference to a System that is not const: take it by value and return another"
        if (named := TYPE.match(line)) and (vague := words(named[1]) & VAGUE):
            yield number, f"the name {named[1]} says '{', '.join(sorted(vague))}': name what it is"


def twin_names(headers):
    """(path, line, message) of every constant and type that is also in another header; `headers` are (path, lines)."""
    first = {}
    for path, lines in headers:
        space = ""
        for number, line in enumerate(lines, 1):
            if opened := NAMESPACE.match(line):
                space = opened[1]
            if not (found := SHARED_NAME.match(line)):
                continue
            name = f"{space}::{found['constant'] or found['type']}"
            place = first.setdefault(name, (path, number))
            if place[0] != path:
                yield path, number, f"{place[0]}:{place[1]} has {name} too: the linker would mix the two"


def other_versions(root):
    """(path, line, message) of every version that differs from the program's."""
    version = None
    for path, pattern in VERSIONED.items():
        stated = [(number, found[1]) for number, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), 1) if (found := pattern.match(line))]
        if not stated:
            yield path, 1, "the version is missing"
        for number, here in stated:
            version = version or here
            if version != here and not version.startswith(here + "."):
                yield path, number, f"version {here}, but the program's is {version}"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    count, files, headers = 0, 0, []
    for folder in FOLDERS:
        for file in sorted((root / folder).rglob("*")):
            path = file.relative_to(root)
            if not file.is_file() or file.suffix not in SUFFIXES:
                continue
            files += 1
            for line, message in breaches(root, path):
                print(f"{path}:{line}: {message}")
                count += 1
            if file.suffix == ".h":
                headers.append((path, file.read_text(encoding="utf-8").splitlines()))
    for path, line, message in [*twin_names(headers), *crowds(root), *other_versions(root)]:
        print(f"{path}:{line}: {message}")
        count += 1
    print(f"check_sources: {files} files, {count} breach{'' if count == 1 else 'es'}")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
