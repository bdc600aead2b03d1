"""Runs GoogleTest programs, each once and whole: what its tests share is made once, and a process is started once."""

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

import processes
from results import Case, Tally, read_junit, tail

PROGRAM_LIMIT_S = 900


@dataclass(frozen=True)
class Program:
    path: str
    labels: frozenset[str]
    tests: int
    locks: bool  # waits for others with a lock, as CTest would (RESOURCE_LOCK)
    environment: tuple[tuple[str, str], ...]

    @property
    def name(self) -> str:
        return Path(self.path).name.removeprefix("test_")


def from_ctest(listing: dict) -> list[Program]:
    """The programs that CTest's list of tests (--show-only=json-v1) names, which knows each test of theirs by itself."""
    counts: dict[str, int] = {}
    properties: dict[str, dict] = {}
    for test in listing["tests"]:
        command = test.get("command", [])
        if len(command) > 1 and command[1].startswith("--gtest_filter="):
            counts[command[0]] = counts.get(command[0], 0) + 1
            properties[command[0]] = {p["name"]: p["value"] for p in test["properties"]}
    found = []
    for path, stated in properties.items():
        labels = frozenset(word for label in stated.get("LABELS", []) for word in label.split("."))
        environment = tuple(tuple(variable.split("=", 1)) for variable in stated.get("ENVIRONMENT", []))
        found.append(Program(path, labels, counts[path], "RESOURCE_LOCK" in stated, environment))
    return found


def known_to_ctest(build: Path) -> list[Program]:
    shown = subprocess.run(["ctest", "--test-dir", str(build), "--show-only=json-v1"], capture_output=True, check=True)
    return from_ctest(json.loads(shown.stdout))


def chosen(programs: list[Program], only: str = "", leave_out: str = "") -> list[Program]:
    """Those with the label `only` (all without one) and without the label `leave_out`, what takes long first."""
    kept = [p for p in programs if (not only or only in p.labels) and leave_out not in p.labels]
    return sorted(kept, key=lambda p: ("slow" not in p.labels, -p.tests, p.path))


def run_program(program: Program, log: Path, environment: dict[str, str], flags: tuple[str, ...] = ()) -> Tally:
    """`log` names the phase; the program's own log and JUnit file lie beside it."""
    own_log, junit = (log.with_name(f"{log.stem}-{program.name}.{end}") for end in ("log", "xml"))
    own_log.unlink(missing_ok=True)
    junit.unlink(missing_ok=True)
    status = processes.run([program.path, f"--gtest_output=xml:{junit}", *flags], own_log, limit_s=PROGRAM_LIMIT_S,
                           env={**dict(program.environment), **environment})
    if not junit.exists():  # it died, or was ended; its last lines say in which test
        return Tally([Case(program.name, "failed", tail(own_log))])
    tally = read_junit(junit)
    for case in tally.cases:
        case.name = f"{program.name}.{case.name}"
    if len(tally.cases) != program.tests:
        tally.cases.append(Case(program.name, "failed", f"it ran {len(tally.cases)} tests; CTest knows {program.tests}: build it again"))
    if status and not tally.failed:
        tally.cases.append(Case(program.name, "failed", tail(own_log)))
    return tally
