"""What the architecture checks share: the files of a tree, C++ text without comments and strings, and the way a fault is told."""

import argparse
import os
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

CPP_SUFFIXES = {".cpp", ".hpp", ".h"}
HEADER_SUFFIXES = {".hpp", ".h"}
NOT_OURS = {"build", "out", ".git", ".cache", "node_modules", "__pycache__"}


@dataclass(frozen=True)
class Fault:
    """One broken rule: where, which rule, and what to do."""

    rule: str
    path: str
    line: int
    text: str

    def __str__(self):
        return f"{self.path}:{self.line}: [{self.rule}] {self.text}"


def files(root: Path) -> list[Path]:
    """Every file that belongs to the project, relative to `root`: what git tracks or would track, or all where there is no git."""
    if (root / ".git").exists():
        listed = subprocess.run(
            ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            check=True, capture_output=True).stdout.decode()
        found = [Path(name) for name in listed.split("\0") if name]
        return sorted({path for path in found if (root / path).is_file()})
    found = []
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if name not in NOT_OURS]
        found += [Path(folder, name).relative_to(root) for name in names]
    return sorted(found)


def cpp_files(root: Path, *tops: str) -> list[Path]:
    return [path for path in files(root) if path.suffix in CPP_SUFFIXES and path.parts[0] in tops]


def read(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace")


_TOKENS = re.compile(
    r'//[^\n]*'
    r'|/\*.*?\*/'
    r'|R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)"'
    r'|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'",
    re.DOTALL)


def without_comments(text: str, strings: bool = False) -> str:
    """Blanks comments, and strings too where asked. Line numbers stay."""
    def blank(match: re.Match) -> str:
        token = match.group(0)
        if token.startswith(("//", "/*")) or strings:
            return re.sub(r"[^\n]", " ", token)
        return token
    return _TOKENS.sub(blank, text)


def run(name: str, summary: str, check) -> int:
    """A check as a program: every fault on a line, then their number; exit status 1 where there is one."""
    parser = argparse.ArgumentParser(description=summary)
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[2])
    faults = check(parser.parse_args().root)
    for fault in faults:
        print(fault)
    print(f"{name}: {len(faults)} faults")
    return 1 if faults else 0


def line_of(text: str, offset: int) -> int:
    return text.count("\n", 0, offset) + 1
