#!/usr/bin/env python3
"""Runs clang-tidy-14 over our sources, as a build's compile_commands.json compiles them.

Most of its time goes into third-party headers, so a build that compiles each room's sources as one (the sanitizers' do) is looked
through several times faster. A room that was clean is not looked at again until one of its files, a header of ours that they read, its
command or the configuration changes: .cache/tidy/ remembers by content.
"""

import argparse
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
import time
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
    name = f"tidy.{_subject(source, build)}"
    if remembered.exists():
        return Case(name, "passed")
    command = [*COMMAND, "-p", str(build), *_checks_of(_subject(source, build)), str(ROOT / source)]
    begun = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, cwd=ROOT)
    seconds = time.monotonic() - begun
    if done.returncode == 0:
        remembered.touch()
        print(f"clean  {name}  {seconds:.1f} s", flush=True)
        return Case(name, "passed", seconds=seconds)
    print(f"FAULTS {name}\n{done.stdout}{done.stderr}", flush=True)
    return Case(name, "failed", done.stdout or done.stderr, seconds)


def _checks_of(subject: Path) -> list[str]:
    """A source made in the build folder does not find tests/.clang-tidy above it."""
    if subject.parts[0] != "tests" or subject.suffix == ".cpp":
        return []
    checks = re.search(r"^Checks: >\n((?:  .*\n?)+)", _content(ROOT / "tests/.clang-tidy").decode(), re.MULTILINE)
    return ["--checks=" + "".join(checks[1].split())]


def _subject(source: Path, build: Path) -> Path:
    """What a person knows a source by: itself, or for all sources of a target in one, the target."""
    return source.relative_to(build).parents[1] if source.is_relative_to(build) else source


def _entries(build: Path) -> list[dict]:
    """One command for each source of ours, or for all of a target in one, that still exists; the longest first."""
    commands = json.loads((build / "compile_commands.json").read_text())
    chosen = {}
    for entry in commands:
        path = Path(entry["file"]).resolve()
        if not path.is_relative_to(ROOT) or not path.is_file():
            continue
        inside = path.relative_to(ROOT)
        ours = inside.suffix == ".cpp" and inside.parts[0] in ("server", "proto", "client-sdk", "tests")
        if ours or path.name.startswith("unity_") and path.suffix == ".cxx":
            chosen.setdefault(path, entry)
    size = {path: sum(part.stat().st_size for part in _closure(path, ())) for path in chosen}
    return [chosen[path] for path in sorted(chosen, key=lambda path: (-size[path], path))]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=Path, default=Path("build/asan-ubsan"), help="a configured and built folder")
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
