#!/usr/bin/env python3
"""Runs clang-tidy-14 over our sources, as a build's compile_commands.json compiles them.

A source that was clean is not looked at again until it, a header of ours that it reads, its command or the configuration changes:
.cache/tidy/ remembers by content.
"""

import argparse
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CLEAN = ROOT / ".cache/tidy"
TIDY = "clang-tidy-14"
# GCC's warnings are errors already; a second compiler's opinion is not asked.
COMMAND = [TIDY, "--quiet", "--extra-arg=-w", "--extra-arg=-Wno-unknown-warning-option"]

sys.path.insert(0, str(ROOT / "deploy/test_lib"))
from results import Case, Tally, write_junit  # noqa: E402

_INCLUDE = re.compile(rb'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)


@cache
def _content(path: Path) -> bytes:
    return path.read_bytes()


@cache
def _includes(path: Path, folders: tuple[Path, ...]) -> tuple[Path, ...]:
    """The headers of ours, or made by our build, that a file names. Those of the system change with their packages."""
    found = []
    for name in _INCLUDE.findall(_content(path)):
        for folder in (path.parent, *folders):
            header = folder / name.decode()
            if header.is_file():
                found.append(header.resolve())
                break
    return tuple(found)


def _closure(source: Path, folders: tuple[Path, ...]) -> list[Path]:
    seen = {source}
    todo = [source]
    while todo:
        for header in _includes(todo.pop(), folders):
            if header not in seen:
                seen.add(header)
                todo.append(header)
    return sorted(seen)


def _own_folders(command: str, directory: Path) -> tuple[Path, ...]:
    words = shlex.split(command)
    named = [word[2:] for word in words if word.startswith("-I") and len(word) > 2]
    named += [after for word, after in zip(words, words[1:]) if word == "-isystem"]
    folders = [(directory / name).resolve() for name in named]
    return tuple(folder for folder in folders if folder.is_relative_to(ROOT))


def _key(entry: dict, configuration: bytes) -> str:
    source, directory = Path(entry["file"]).resolve(), Path(entry["directory"])
    digest = hashlib.sha256(configuration + entry["command"].encode())
    for path in _closure(source, _own_folders(entry["command"], directory)):
        digest.update(str(path.relative_to(ROOT)).encode() + b"\0" + _content(path) + b"\0")
    return digest.hexdigest()


def _check(entry: dict, build: Path, configuration: bytes) -> Case:
    source = Path(entry["file"]).resolve().relative_to(ROOT)
    remembered = CLEAN / _key(entry, configuration)
    name = f"tidy.{source}"
    if remembered.exists():
        return Case(name, "passed")
    done = subprocess.run([*COMMAND, "-p", str(build), str(ROOT / source)], capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, cwd=ROOT)
    if done.returncode == 0:
        remembered.touch()
        print(f"clean  {source}", flush=True)
        return Case(name, "passed")
    print(f"FAULTS {source}\n{done.stdout}{done.stderr}", flush=True)
    return Case(name, "failed", done.stdout or done.stderr)


def _entries(build: Path) -> list[dict]:
    """One command for each source of ours that still exists, the biggest first."""
    commands = json.loads((build / "compile_commands.json").read_text())
    chosen = {}
    for entry in commands:
        path = Path(entry["file"]).resolve()
        ours = path.is_relative_to(ROOT) and path.relative_to(ROOT).parts[0] in ("server", "proto", "client-sdk", "tests")
        if ours and path.suffix == ".cpp" and path.is_file():
            chosen.setdefault(path, entry)
    return [chosen[path] for path in sorted(chosen, key=lambda path: -path.stat().st_size)]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=Path, default=Path("build/release"), help="a configured and built folder")
    parser.add_argument("--junit", type=Path, help="where to write the results")
    parser.add_argument("only", nargs="*", help="sources whose path contains one of these")
    arguments = parser.parse_args()

    CLEAN.mkdir(parents=True, exist_ok=True)
    version = subprocess.run([TIDY, "--version"], capture_output=True, check=True).stdout
    configuration = version + " ".join(COMMAND).encode() + _content(ROOT / ".clang-tidy") + _content(ROOT / "tests/.clang-tidy")
    entries = [entry for entry in _entries(arguments.build)
               if not arguments.only or any(word in entry["file"] for word in arguments.only)]
    with ThreadPoolExecutor(max_workers=int(os.environ.get("MECHANE_JOBS") or os.cpu_count() or 2)) as pool:
        tally = Tally(list(pool.map(lambda entry: _check(entry, arguments.build, configuration), entries)))
    if not entries:
        tally.cases.append(Case("tidy", "failed", f"{arguments.build}/compile_commands.json names no source of ours"))
    if arguments.junit:
        write_junit(arguments.junit, "tidy", tally)
    print(f"tidy: {len(entries)} sources, {len(tally.failed)} with faults")
    return 1 if tally.failed else 0


if __name__ == "__main__":
    sys.exit(main())
