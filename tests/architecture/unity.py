#!/usr/bin/env python3
"""Each folder's sources are compiled as one by some presets, and by eights by others: a name of an anonymous namespace belongs to its whole
folder. Two sources that each define it compile here and clash there, half an hour into the suite; this finds them in a second."""

import re
import sys
from collections import defaultdict
from pathlib import Path

from includes import FOLDERS
from source_tree import HEADER_SUFFIXES, Fault, cpp_files, line_of, read, run, without_comments

PROGRAMS = {("tests", "fuzz"), ("tests", "benchmark")}  # each source, or a few, a program
TOPS = ("server", "proto", "client-sdk", "tests")

# clang-format leaves what stands in a namespace at the line's start.
_ANONYMOUS = re.compile(r"^namespace \{$(.*?)^\}  // namespace$|^namespace \{$(.*)", re.MULTILINE | re.DOTALL)
_TYPE = re.compile(r"^(?:struct|class|union|enum class|enum) (\w+)\b[^;{(]*\{", re.MULTILINE)
_VALUE = re.compile(r"^(?:inline |static |constexpr |const )+[^=({;]*?(?<![<\w:])(\w+)(?:\[\w*\])?(?: =|\{|;)", re.MULTILINE)
_LOCAL = re.compile(r"^ +(?:static )?constexpr [^=({;]*?(?<![<\w:])(k[A-Z]\w*)(?:\[\w*\])?(?: =|\{|;)", re.MULTILINE)
_FUNCTION = re.compile(r"^(?!using |struct |class |enum |namespace )[\w\[:][^;={}]*?(?<![\w:~])(\w+)\(([^;{}]*?)\)(?: const)?(?: noexcept)? \{",
                       re.MULTILINE)


def _types(parameters: str) -> str:
    """The types of a parameter list: names and defaults taken away. Two functions with different ones are overloads, which may meet."""
    depth, words, parts = 0, "", []
    for character in parameters + ",":
        depth += (character in "<({[") - (character in ">)}]")
        if character == "," and depth == 0:
            parts.append(words)
            words = ""
        else:
            words += character
    types = [re.sub(r"(?<=[\s&*])\w+\s*$", "", part.split("=")[0].strip()).strip() for part in parts]
    return ", ".join(" ".join(part.split()) for part in types)


def defined(text: str) -> list[tuple[str, int]]:
    """What a source's anonymous namespaces define, and where."""
    found = []
    plain = without_comments(text, strings=True)
    for space in _ANONYMOUS.finditer(text):  # its end is told by its comment
        start = space.start() + len("namespace {")
        inner = plain[start:space.end()]
        for pattern in (_TYPE, _VALUE):
            found += [(match.group(1), line_of(plain, start + match.start())) for match in pattern.finditer(inner)]
        found += [(f"{match.group(1)}({_types(match.group(2))})", line_of(plain, start + match.start()))
                  for match in _FUNCTION.finditer(inner)]
    return found


def shadowing(text: str) -> list[tuple[str, int]]:
    """The constants within its functions: where a source before it has one of that name outside, they hide it, which is a warning."""
    plain = without_comments(text, strings=True)
    return [(match.group(1), line_of(plain, match.start())) for match in _LOCAL.finditer(plain)]


def _home(path: Path) -> Path:
    """What is compiled together: a folder; a room with its folders; and of the drivers all but the module of each."""
    room, drivers = Path(*path.parts[:2]), Path("client-sdk/drivers")
    if str(room) in FOLDERS or room == Path("client-sdk/draw"):
        return room
    return drivers if path.is_relative_to(drivers) and path.name != "driver.cpp" else path.parent


def check(root: Path) -> list[Fault]:
    homes: dict[tuple[Path, str], list[tuple[Path, int]]] = defaultdict(list)
    hidden: list[tuple[Path, str, int]] = []
    for path in cpp_files(root, *TOPS):
        text = read(root / path)
        if path.suffix in HEADER_SUFFIXES:
            plain = without_comments(text, strings=True)
            names = [(match.group(1), line_of(plain, match.start())) for match in _TYPE.finditer(plain)]
        elif path.parts[:2] in PROGRAMS or re.search(r"^int main\(", text, re.MULTILINE):
            continue
        else:
            names = defined(text)
            hidden += [(path, name, line) for name, line in shadowing(text)]
        for name, line in names:
            homes[_home(path), name].append((path, line))
    faults = []
    for (_, name), places in sorted(homes.items()):
        # Headers name the types of a namespace each; a clash needs an anonymous one.
        sources = [place for place in places if place[0].suffix not in HEADER_SUFFIXES]
        if sources and len({path for path, _ in places}) > 1:
            path, line = sources[-1]
            others = ", ".join(sorted({str(other) for other, _ in places if other != path}))
            faults.append(Fault("unity-name", str(path), line, f"'{name}' is also defined in {others}: give it a name of its own"))
    for path, name, line in hidden:
        sources = [other for other, _ in homes.get((_home(path), name), []) if other < path and other.suffix not in HEADER_SUFFIXES]
        if sources:
            faults.append(Fault("unity-name", str(path), line, f"'{name}' hides the one of {sources[0]}: give it a name of its own"))
    return faults


if __name__ == "__main__":
    sys.exit(run("unity", __doc__, check))
