#!/usr/bin/env python3
"""Holds the sizes and habits of CONTRIBUTING.md against the tree: lengths of functions and files, headers, paths, unfinished work."""

import ast
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from functions import functions
from source_tree import CPP_SUFFIXES, HEADER_SUFFIXES, Fault, cpp_files, files, line_of, read, run, without_comments

CEILING = {"function-length": 70, "header-length": 350, "source-length": 600}
CPP_TOPS = ("server", "proto", "client-sdk", "tests")
TEXT_SUFFIXES = {".cpp", ".hpp", ".h", ".idl", ".py", ".sh", ".cmake", ".txt", ".md", ".json", ".xml", ".x3d", ".toml",
                 ".service", ".conf", ".yml", ""}

# Written in halves where the rule would otherwise find itself.
_MACHINE_PATH = re.compile(r"(?<![\w.}$/-])/(?:work|root|home)(?=/|\b)(?!-)")
_TEMPORARY_PATH = re.compile(r"(?<![\w.}$/-])/" + r"tmp\b")
_UNFINISHED = re.compile(r"\b(?:TO" + r"DO|FIX" + r"ME|XX" + r"X|HA" + r"CK)\b")
_SLEEP = re.compile(r"(?<!void )\b(?:sleep_" + r"for|sleep_until|usleep|nanosleep|sleep)\s*\(")
_PYTHON_SLEEP = re.compile(r"\btime\.sleep\(")
_MAY_SLEEP = re.compile(r"(?://|#) sleeps: \w")  # behind the call, with the reason: a look now and then, a pace, time as the subject
_MUTEX = re.compile(r"\bstd::(?:\w*mutex|lock_guard|unique_lock|scoped_lock|shared_lock|condition_variable\w*)\b")
_USING_NAMESPACE = re.compile(r"^\s*using\s+namespace\b", re.MULTILINE)


@dataclass
class Allowance:
    rule: str
    place: str
    ceiling: int
    line: int
    used: bool = False


class Ceilings:
    """The numbers of CEILING, raised for the places of exceptions.txt."""

    def __init__(self, text: str):
        self.entries: list[Allowance] = []
        self.faults: list[Fault] = []
        for number, line in enumerate(text.splitlines(), 1):
            fields = [field.strip() for field in line.split("|")]
            if not line.strip() or line.startswith("#"):
                continue
            if len(fields) != 4 or fields[0] not in CEILING or not fields[2].isdigit() or not fields[3]:
                self.faults.append(Fault("exceptions", "tests/architecture/exceptions.txt", number,
                                         "write: rule | path[:function] | ceiling | reason"))
                continue
            self.entries.append(Allowance(fields[0], fields[1], int(fields[2]), number))

    def fault(self, rule: str, path: Path, line: int, lines: int, function: str = "") -> Fault | None:
        if lines <= CEILING[rule]:
            return None
        place = f"{path}:{function}" if function else str(path)
        for entry in self.entries:
            if entry.rule == rule and entry.place == place:
                entry.used = True
                if lines <= entry.ceiling:
                    return None
        what = f"{function} takes" if function else "the file has"
        return Fault(rule, str(path), line, f"{what} {lines} lines, the ceiling is {CEILING[rule]}: split it by subject")

    def unused(self) -> list[Fault]:
        return [Fault("exceptions", "tests/architecture/exceptions.txt", entry.line, f"nothing needs '{entry.place}' any more")
                for entry in self.entries if not entry.used]


def _python_functions(source: str):
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.name, node.lineno, node.end_lineno - node.lineno + 1


def _is_python(path: Path, text: str) -> bool:
    return path.suffix == ".py" or (path.suffix == "" and text.startswith("#!") and "python" in text.split("\n", 1)[0])


def length_faults(root: Path, ceilings: Ceilings) -> list[Fault]:
    faults: list[Fault | None] = []
    for path in files(root):
        if path.suffix not in CPP_SUFFIXES | {".py", ".sh", ""}:
            continue
        if path.name in ("LICENSE",) or "corpus" in path.parts:
            continue
        text = read(root / path)
        rule = "header-length" if path.suffix in HEADER_SUFFIXES else "source-length"
        faults.append(ceilings.fault(rule, path, 1, text.count("\n")))
        if path.suffix in CPP_SUFFIXES:
            found = [(f.name, f.first_line, f.lines) for f in functions(text)]
        else:
            found = list(_python_functions(text)) if _is_python(path, text) else []
        faults += [ceilings.fault("function-length", path, line, lines, name) for name, line, lines in found]
    return [fault for fault in faults if fault]


def header_faults(root: Path) -> list[Fault]:
    faults = []
    for path in cpp_files(root, *CPP_TOPS):
        if path.suffix not in HEADER_SUFFIXES:
            continue
        text = without_comments(read(root / path))
        if not re.search(r"^#pragma once$", text, re.MULTILINE):
            faults.append(Fault("pragma-once", str(path), 1, "start the header with '#pragma once'"))
        for match in _USING_NAMESPACE.finditer(text):
            faults.append(Fault("using-namespace", str(path), line_of(text, match.end()),
                                "a header must not open a namespace for those who include it"))
    return faults


def _matches(rule: str, pattern: re.Pattern, path: Path, text: str, advice: str) -> list[Fault]:
    return [Fault(rule, str(path), line_of(text, match.start()), f"'{match.group(0).strip()}': {advice}")
            for match in pattern.finditer(text)]


def text_faults(root: Path) -> list[Fault]:
    faults = []
    for path in files(root):
        if path.suffix not in TEXT_SUFFIXES or "corpus" in path.parts:
            continue
        text = read(root / path)
        if text and not text.endswith("\n"):
            faults.append(Fault("last-newline", str(path), text.count("\n") + 1, "end the file with a newline"))
        faults += _matches("machine-path", _MACHINE_PATH, path, text, "a path of one machine; take it from a flag or the environment")
        if path.parts[0] != "tests":
            faults += _matches("machine-path", _TEMPORARY_PATH, path, text, "ask the system for its folder of temporary files")
        faults += _matches("unfinished", _UNFINISHED, path, text, "finish it, or say plainly what is not there")
        if path.suffix in CPP_SUFFIXES and path.parts[:2] == ("client-sdk", "pointer"):
            faults += _matches("pointer-mutex", _MUTEX, path, without_comments(text, strings=True),
                               "drawing would hold up the hand; let a ring or a mailbox of realtime carry it")
        faults += _sleep_faults(path, text)
    return faults


def _sleep_faults(path: Path, text: str) -> list[Fault]:
    if path.parts[0] == "tests" and path.suffix in CPP_SUFFIXES:
        pattern, code = _SLEEP, without_comments(text, strings=True)
    elif path.parts[:2] == ("tests", "integration") and path.suffix == ".py" and path.name != "harness.py":
        pattern, code = _PYTHON_SLEEP, text
    else:
        return []
    lines = text.splitlines()
    found = _matches("sleep", pattern, path, code, "a test waits for what it wants to see, with a deadline; a fake clock turns time. "
                     "Where it must sleep, a comment behind it says why: 'sleeps: the pace'")
    return [fault for fault in found if not _MAY_SLEEP.search(lines[fault.line - 1])]


def folder_faults(root: Path) -> list[Fault]:
    faults = []
    cpp = cpp_files(root, *CPP_TOPS)
    rooms = {Path(*path.parts[:2]) for path in cpp if path.parts[0] in ("server", "client-sdk") and len(path.parts) > 2}
    tests = {Path(*path.parent.parts[:3]) for path in cpp if path.parts[0] == "tests" and path.name.endswith("_test.cpp")}
    for folder in sorted(rooms | tests):
        if not (root / folder / "CMakeLists.txt").exists():
            faults.append(Fault("folder-cmake", str(folder), 1, "no CMakeLists.txt: nothing builds this folder"))
    return faults


def fuzz_faults(root: Path) -> list[Fault]:
    """A fuzzer without a seed starts from nothing, and its test would run over nothing."""
    return [Fault("fuzz-corpus", str(path), 1, "no seed in tests/fuzz/corpus/" + path.name.removesuffix("_fuzz.cpp"))
            for path in cpp_files(root, "tests") if path.name.endswith("_fuzz.cpp")
            and not any(file.is_file() for file in (root / "tests/fuzz/corpus" / path.name.removesuffix("_fuzz.cpp")).glob("*"))]


def check(root: Path) -> list[Fault]:
    listed = root / "tests/architecture/exceptions.txt"
    ceilings = Ceilings(read(listed) if listed.exists() else "")
    found = length_faults(root, ceilings) + header_faults(root) + text_faults(root) + folder_faults(root) + fuzz_faults(root)
    return found + ceilings.faults + ceilings.unused()


if __name__ == "__main__":
    sys.exit(run("ceilings", __doc__, check))
