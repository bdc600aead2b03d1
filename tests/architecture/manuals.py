#!/usr/bin/env python3
"""Holds the manuals against the tree: their sizes; every link, anchor and path leads somewhere; each script of deploy/ has its line."""

import re
import sys
import unicodedata
from dataclasses import dataclass
from pathlib import Path

from source_tree import Fault, files, read, run

README_LINES = 150
MANUAL_LINES = 200
COLUMNS = 140
# Made by a command; a log; and the page that describes all of the house: these may be longer.
GENERATED = {"scenarios/REFERENCE.md"}
HISTORY = {"CHANGELOG.md"}
NOT_NOW = re.compile(r"CHANGELOG\.md|deploy/decisions/.*")  # what was so at the time
MADE = {"scenarios/catalogue.db"}
LONGER = {"ARCHITECTURE.md"} | GENERATED | HISTORY

_FENCE = re.compile(r"^\s*```")
_LINK = re.compile(r"\[[^\[\]]*\]\(([^()\s]+(?:\([^()\s]*\)[^()\s]*)?)\)")
_HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$")
_PATH = re.compile(r"(?:server|client-sdk|proto|scenarios|tests|deploy)/[\w./-]+")
_CODE = re.compile(r"(`+)(.+?)\1")


@dataclass(frozen=True)
class Line:
    number: int
    text: str
    code: bool


def lines_of(text: str) -> list[Line]:
    """The lines of a page, each with its number and whether it is in a code block; the fences themselves are left out."""
    found, code = [], False
    for number, line in enumerate(text.splitlines(), 1):
        if _FENCE.match(line):
            code = not code
        else:
            found.append(Line(number, line, code))
    return found


def anchor(heading: str) -> str:
    """The anchor that a heading gets on the usual hosts: small letters, no punctuation, hyphens for spaces."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
    kept = (c for c in plain if c in " -_" or unicodedata.category(c)[0] in "LNM")
    return "".join(kept).replace(" ", "-")


def anchors(text: str) -> set[str]:
    found: dict[str, int] = {}
    for line in lines_of(text):
        match = None if line.code else _HEADING.match(line.text)
        if match:
            name = anchor(match[1])
            found[name] = found.get(name, -1) + 1
            if found[name]:
                found[f"{name}-{found[name]}"] = 0
    return set(found)


def pages(root: Path) -> list[Path]:
    return [path for path in files(root) if path.suffix == ".md" and "corpus" not in path.parts]


def size_faults(path: Path, text: str) -> list[Fault]:
    faults = []
    limit = README_LINES if str(path) == "README.md" else MANUAL_LINES
    if str(path) not in LONGER and text.count("\n") > limit:
        faults.append(Fault("manual-length", str(path), limit + 1,
                            f"{text.count(chr(10))} lines, at most {limit}: move a subject to a page of its own"))
    if str(path) not in GENERATED | HISTORY:
        faults += [Fault("manual-width", str(path), number, f"{len(line)} columns, at most {COLUMNS}")
                   for number, line in enumerate(text.splitlines(), 1) if len(line) > COLUMNS]
    return faults


def link_fault(root: Path, path: Path, target: str) -> str | None:
    if re.match(r"[a-z]+:", target):  # elsewhere: a test asks no network
        return None
    name, _, fragment = target.partition("#")
    there = root / path.parent / name if name else root / path
    if not there.exists() or root.resolve() not in [there.resolve(), *there.resolve().parents]:
        return f"'{target}' leads to no file of this repository"
    if fragment and (there.suffix != ".md" or fragment not in anchors(read(there))):
        return f"'{target}': no heading has this anchor"
    return None


def link_faults(root: Path, path: Path, text: str) -> list[Fault]:
    faults = []
    for line in lines_of(text):
        for match in [] if line.code else _LINK.finditer(_CODE.sub(lambda m: " " * len(m[0]) if "](" in m[0] else m[0], line.text)):
            wrong = link_fault(root, path, match[1])
            if wrong:
                faults.append(Fault("link", str(path), line.number, wrong))
    return faults


def path_faults(root: Path, path: Path, text: str) -> list[Fault]:
    """What stands as code and looks like a path of the repository is one."""
    return [Fault("path", str(path), line.number, f"there is no {match[2]}")
            for line in lines_of(text) if not line.code
            for match in _CODE.finditer(line.text)
            if _PATH.fullmatch(match[2]) and match[2] not in MADE and not (root / match[2]).exists()]


def script_faults(root: Path) -> list[Fault]:
    """Every script that people call has its line in deploy/README.md."""
    manual = root / "deploy/README.md"
    text = read(manual) if manual.exists() else ""
    return [Fault("manual-script", "deploy/README.md", 1, f"deploy/{path.name} is not in the table of commands")
            for path in files(root) if path.parent == Path("deploy") and path.suffix == "" and f"`deploy/{path.name}" not in text]


def check(root: Path) -> list[Fault]:
    faults = script_faults(root)
    for path in pages(root):
        text = read(root / path)
        faults += size_faults(path, text) + link_faults(root, path, text)
        faults += [] if NOT_NOW.fullmatch(str(path)) else path_faults(root, path, text)
    return faults


if __name__ == "__main__":
    sys.exit(run("manuals", __doc__, check))
