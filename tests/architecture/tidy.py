#!/usr/bin/env python3
"""Runs clang-tidy-14 over our sources, as a build's compile_commands.json compiles them.

Most of its time goes into third-party headers, so a build that compiles each room's sources as one (the sanitizers' do) is looked
through several times faster, and several rooms together once more so: what belongs to one room lies in that room's namespace. A room that was clean is not looked at again until one of its files, a header of ours that they read, its
command or the configuration changes: the user's cache remembers by content, so that another clone profits as from the compiler's.
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
CLEAN = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "mechane/tidy"
PACKAGES = Path("/var/lib/dpkg/status")
TIDY = "clang-tidy-14"
GROUP = 8  # rooms at most that are looked through together
# GCC's warnings are errors already; a second compiler's opinion is not asked. The static analyser looks at no source that another one
# includes, as all are here: see deploy/decisions/021-the-suites-time.md.
COMMAND = [TIDY, "--quiet", "--extra-arg=-w", "--extra-arg=-Wno-unknown-warning-option"]

sys.path.insert(0, str(ROOT / "deploy/test_lib"))
from results import Case, Tally, write_junit  # noqa: E402

_PROGRAM = re.compile(rb"^int main\(|LLVMFuzzerTestOneInput\(", re.MULTILINE)
_INCLUDE = re.compile(rb'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)


@cache
def _content(path: Path) -> bytes:
    return path.read_bytes()


@cache
def _includes(path: Path, folders: tuple[Path, ...]) -> tuple[Path, ...]:
    """The headers of ours, or made by our build, that a file names. Those of the system change with their packages (PACKAGES)."""
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
    digest = hashlib.sha256(configuration + entry["command"].replace(str(ROOT), ".").encode())
    for path in _closure(source, _own_folders(entry["command"], directory)):
        text = _content(path).replace(str(ROOT).encode(), b".")  # a source that names others does so by their whole paths
        digest.update(str(path.relative_to(ROOT)).encode() + b"\0" + text + b"\0")
    return digest.hexdigest()


def _name(entry: dict, build: Path) -> str:
    return f"tidy.{_subject(Path(entry['file']).resolve().relative_to(ROOT), build)}"


def _is_clean(entry: dict, configuration: bytes) -> bool:
    return (CLEAN / _key(entry, configuration)).exists()


def _remember(entry: dict, configuration: bytes) -> None:
    (CLEAN / _key(entry, configuration)).touch()


def _look_through(source: Path, commands: Path, subject: Path) -> subprocess.CompletedProcess:
    command = [*COMMAND, "-p", str(commands), *_checks_of(subject), str(source)]
    return subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, cwd=ROOT)


def _check(entry: dict, build: Path, configuration: bytes) -> Case:
    name = _name(entry, build)
    begun = time.monotonic()
    source = Path(entry["file"]).resolve()
    done = _look_through(source, build, _subject(source.relative_to(ROOT), build))
    seconds = time.monotonic() - begun
    if done.returncode == 0:
        _remember(entry, configuration)
        print(f"clean  {name}  {seconds:.1f} s", flush=True)
        return Case(name, "passed", seconds=seconds)
    print(f"FAULTS {name}\n{done.stdout}{done.stderr}", flush=True)
    return Case(name, "failed", done.stdout or done.stderr, seconds)


def _flags(entry: dict) -> tuple[list[str], tuple[str, ...]]:
    """What a command says of folders and macros, which sources looked through together may add up; and what must be the same for all."""
    words = iter(shlex.split(entry["command"])[1:])
    added, same = [], []
    for word in words:
        if word in ("-o", "-c", "-MT", "-MF", "-Xclang"):  # -Xclang: a precompiled header
            next(words)
        elif word == "-isystem":
            added += [word, next(words)]
        elif word.startswith(("-I", "-D")):
            added.append(word)
        elif not word.startswith(("-W", "-O", "-g", "-fPI", "-fpch", "-MD", "-fsanitize=fuzzer")):
            same.append(word)
    return added, tuple(same)


def _groups(entries: list[dict], build: Path, jobs: int) -> list[list[dict]]:
    """Rooms that can be one source: what is not a program, with the same checks and options. Each as long as the others, for all jobs."""
    alike: dict[tuple, list[dict]] = {}
    for entry in entries:
        source = Path(entry["file"]).resolve()
        subject = _subject(source.relative_to(ROOT), build)
        alone = str(source) if any(_PROGRAM.search(_content(path)) for path in _closure(source, ()) if path.suffix == ".cpp") else ""
        alike.setdefault((alone, *_checks_of(subject), _flags(entry)[1]), []).append(entry)
    groups = []
    for some in alike.values():
        count = -(-len(some) // GROUP)
        count = min(len(some), -(-count // jobs) * jobs)
        groups += [some[i::count] for i in range(count)]
    return sorted(groups, key=len, reverse=True)


def _check_together(number: int, entries: list[dict], build: Path, configuration: bytes) -> list[Case]:
    """What is found in several rooms together is looked for again in each: their names may only clash."""
    if len(entries) > 1:
        folder = build / f"tidy/group-{number}"
        folder.mkdir(parents=True, exist_ok=True)
        source = folder / "rooms.cxx"
        source.write_text("".join(f'#include "{Path(entry["file"]).resolve()}"\n' for entry in entries))
        added = [word for entry in entries for word in _flags(entry)[0]]
        flags = [*_flags(entries[0])[1], *_without_repeats(added), "-c", str(source)]
        commands = [{"directory": entries[0]["directory"], "file": str(source), "command": shlex.join(["clang++", *flags])}]
        (folder / "compile_commands.json").write_text(json.dumps(commands))
        begun = time.monotonic()
        done = _look_through(source, folder, _subject(Path(entries[0]["file"]).resolve().relative_to(ROOT), build))
        seconds = time.monotonic() - begun
        if done.returncode == 0:
            for entry in entries:
                _remember(entry, configuration)
            names = [_name(entry, build) for entry in entries]
            print(f"clean  {', '.join(names)}  {seconds:.1f} s", flush=True)
            return [Case(name, "passed", seconds=seconds / len(names)) for name in names]
        print(f"not clean together: {', '.join(_name(entry, build) for entry in entries)}\n{done.stdout}{done.stderr}", flush=True)
    return [_check(entry, build, configuration) for entry in entries]


def _check_in_time(until: float, number: int, entries: list[dict], build: Path, configuration: bytes) -> list[Case]:
    if time.monotonic() < until:
        return _check_together(number, entries, build, configuration)
    return [Case(_name(entry, build), "too late") for entry in entries]


def _without_repeats(words: list[str]) -> list[str]:
    """-isystem and its folder stay together."""
    pairs = [f"{word}\0{after}" if word == "-isystem" else word
             for word, before, after in zip(words, ["", *words], [*words[1:], ""]) if before != "-isystem"]
    return [word for pair in dict.fromkeys(pairs) for word in pair.split("\0")]


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
    parser.add_argument("--seconds", type=float, default=float("inf"), help="after these it begins with no more sources, and leaves them out")
    parser.add_argument("only", nargs="*", help="sources whose path contains one of these")
    arguments = parser.parse_args()
    until = time.monotonic() + arguments.seconds

    CLEAN.mkdir(parents=True, exist_ok=True)
    version = subprocess.run([TIDY, "--version"], capture_output=True, check=True).stdout
    configuration = version + " ".join(COMMAND).encode() + _content(ROOT / ".clang-tidy") + _content(ROOT / "tests/.clang-tidy")
    configuration += _content(PACKAGES) if PACKAGES.exists() else b""
    entries = [entry for entry in _entries(arguments.build)
               if not arguments.only or any(word in entry["file"] for word in arguments.only)]
    clean = [entry for entry in entries if _is_clean(entry, configuration)]
    tally = Tally([Case(_name(entry, arguments.build), "passed") for entry in clean])
    jobs = int(os.environ.get("MECHANE_JOBS") or os.cpu_count() or 2)
    groups = _groups([entry for entry in entries if entry not in clean], arguments.build, jobs)
    with ThreadPoolExecutor(max_workers=jobs) as pool:
        for cases in pool.map(lambda group: _check_in_time(until, *group, arguments.build, configuration), enumerate(groups)):
            tally.cases += cases
    if not entries:
        tally.cases.append(Case("tidy", "failed", f"{arguments.build}/compile_commands.json names no source of ours"))
    if arguments.junit:
        write_junit(arguments.junit, "tidy", tally)
    too_late = tally.count("too late")
    print(f"tidy: {len(entries)} sources, {len(tally.failed)} with faults" + (f", {too_late} too late" if too_late else ""))
    return 1 if tally.failed else 0


if __name__ == "__main__":
    sys.exit(main())
