"""The test suite's phases, one after another. Run by deploy/test; see there."""

import argparse
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import processes
from report import Ran, long_cases, whole, write_report
from results import Case, Tally, read_junit, write_junit

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "out/test"
JOBS = str(os.cpu_count() or 2)
FUZZ_SECONDS = 10
FUZZ_INPUT_S = 10  # on one input, before it counts as a hang; a mesh is cut, fitted and mapped, under the sanitizers
SLOW_INPUT_S = {"mesh": 90}

TIDY = [sys.executable, "-B", "tests/architecture/tidy.py"]

# A sanitizer says all it knows and stops the program; and it makes everything slower, so that tests wait longer.
SANITIZER_ENV = {
    "ASAN_OPTIONS": "abort_on_error=1",
    "UBSAN_OPTIONS": "print_stacktrace=1:abort_on_error=1",
    "TSAN_OPTIONS": "halt_on_error=1:second_deadlock_stack=1",
    "MECHANE_PATIENCE": "4",
}

# Under the address sanitizer a tick takes longer than its millisecond, so a visit played in real time would test the machine only; the
# others fit, and sample, a thousand times what their neighbours fit and sample too, or need a limit on the address space. A display that draws
# ends with two blocks of 56 bytes that the graphics driver has kept, and has unloaded itself by then, so that no suppression can name it.
TOO_SLOW_SANITIZED = ("Visit.test_(two|five|without|a_whole|a_click)", "Visits.test_an_answer", "Assets.test_(a_|another|the_|without)", "Exhibits.test_", "Kiosk.test_", "Touch.test_", "Faults.test_a_(killed_visitor|full_disk)", "ArchimedesScrew.TenThousand",
                      "SameInputsGiveTheSameBits", "AllocatesNothingAndRepeats", "SeamsAreNotSampled", "Staves/Barrel",
                      "AFingerEntersABarrel", "WhateverItReturnsBounds", "AFileThatEatsMemory", "unit_geometry.Decompose", "ThinParts",
                      "AgainstBulletsBoxes", "PaperMap.(Smoothing|OnTheTwo)", "Fit.test_(a_fine_mesh|a_full_disk|a_mesh_becomes|faults_that_can|two_meshes)",
                      "SameInputSameBits", "AStackOfThree", "AHeapOfAll", "AGearIsOneBrick", "ATrainOfThem", "^exhibits", "Film.test_",
                      "PlacePictures.look_as", "PlantedFault")
# What has threads of its own.
THREADED = ("unit_realtime", "unit_record", "unit_visits", "unit_transport", "unit_client", "unit_content", "unit_collision", "unit_collision_build", "unit_world")


@dataclass
class Phase:
    title: str  # what stands before a comma names it in logs and in the report
    run: Callable[[Path], Tally]  # gets its log, returns its cases
    preset: str  # the build that it makes or needs
    beside: Callable[[], processes.Beside] | None = None  # what is begun with it, and ended with it

    @property
    def name(self) -> str:
        return self.title.split(",")[0].replace(" ", "-")


def _build_commands(preset: str, targets: tuple[str, ...]) -> tuple[list[str], list[str]]:
    chosen = ["--target", *targets] if targets else []
    return ["cmake", "--preset", preset], ["cmake", "--build", f"build/{preset}", "-j", JOBS, *chosen]


def build(preset: str, *targets: str) -> Phase:
    def run(log: Path) -> Tally:
        name = f"build {preset}"
        configure, make = _build_commands(preset, targets)
        if processes.run(configure, log, limit_s=300) or processes.run(make, log, limit_s=3600):
            return Tally([Case(name, "failed", tail(log))])
        return Tally([Case(name, "passed")])

    return Phase(f"build {preset}", run, preset)


def begin(*commands: list[str]) -> Callable[[], processes.Beside]:
    """Commands for the time that a phase leaves to others, one after another, as far as they come. The phases whose work it is find done
    what was done, and take up the rest."""
    return lambda: processes.Beside(["sh", "-c", " && ".join(map(shlex.join, commands))], OUT / "beside.log")


def ctest(preset: str, what: str, only: str = "", leave_out: str = "", named: str = "", unnamed: str = "",
          beside: Callable[[], processes.Beside] | None = None) -> Phase:
    """Runs the tests of a build. Those without DDS run side by side, the others alone (see tests/CMakeLists.txt)."""
    def run(log: Path) -> Tally:
        junit = log.with_suffix(".xml")
        junit.unlink(missing_ok=True)
        command = ["ctest", "--test-dir", f"build/{preset}", "-j", JOBS, "--output-on-failure", "--no-tests=error",
                   "--output-junit", str(junit)]
        command += ["-L", only] if only else []
        command += ["-LE", leave_out] if leave_out else []
        command += ["-R", named] if named else []
        command += ["-E", unnamed] if unnamed else []
        status = processes.run(command, log, limit_s=2400, env=SANITIZER_ENV if preset in ("asan-ubsan", "tsan") else {})
        tally = read_junit(junit)
        if status and not tally.failed:
            tally.cases.append(Case(f"ctest {preset}", "failed", tail(log)))
        return tally

    return Phase(f"test {preset} {what}", run, preset, beside)


def _gtest_programs(preset: str, log: Path) -> dict[str, list[dict]]:
    """The in-process tests that CTest knows, by their GoogleTest program."""
    shown = log.with_suffix(".json")
    with open(shown, "w") as file:
        subprocess.run(["ctest", "--test-dir", f"build/{preset}", "-L", "in-process", "--show-only=json-v1"], stdout=file, check=True)
    programs: dict[str, list[dict]] = {}
    for test in json.loads(shown.read_text())["tests"]:
        command = test.get("command", [])
        if len(command) > 1 and command[1].startswith("--gtest_filter="):
            programs.setdefault(command[0], []).append(test)
    return programs


def _run_program(program: str, tests: list[dict], log: Path) -> Tally:
    name = Path(program).name.removeprefix("test_")
    own_log, junit, flags = (log.with_name(f"{log.stem}-{name}.{end}") for end in ("log", "xml", "flags"))
    own_log.unlink(missing_ok=True)
    junit.unlink(missing_ok=True)
    filters = [test["command"][1].removeprefix("--gtest_filter=") for test in tests]
    flags.write_text("--gtest_filter=" + ":".join(filters) + "\n")
    stated = {p["name"]: p["value"] for p in tests[0]["properties"]}
    environment = SANITIZER_ENV | dict(variable.split("=", 1) for variable in stated.get("ENVIRONMENT", []))
    status = processes.run([program, f"--gtest_flagfile={flags}", f"--gtest_output=xml:{junit}"], own_log, limit_s=900, env=environment)
    tally = read_junit(junit)
    for case in tally.cases:
        case.name = f"{name}.{case.name}"
    if status and not tally.failed:
        tally.cases.append(Case(name, "failed", tail(own_log)))
    return tally


def programs(preset: str, named: str = "", unnamed: str = "") -> Phase:
    """Runs the in-process tests of a sanitized build, each program once and whole: what its tests share is made once, and making it is
    what takes the time there."""
    def run(log: Path) -> Tally:
        chosen = {}
        for program, tests in _gtest_programs(preset, log).items():
            kept = [t for t in tests if re.search(named, t["name"]) and not (unnamed and re.search(unnamed, t["name"]))]
            if kept:
                chosen[program] = kept
        tally = Tally() if chosen else Tally([Case(f"programs {preset}", "failed", "no test was chosen")])
        with ThreadPoolExecutor(max_workers=int(JOBS)) as pool:
            by_length = sorted(chosen, key=lambda program: -len(chosen[program]))
            for some in pool.map(lambda program: _run_program(program, chosen[program], log), by_length):
                tally.add(some)
        return tally

    return Phase(f"test {preset} programs", run, preset)


def _fuzz_one(program: Path) -> Case:
    name = program.name.removeprefix("fuzz_")
    found = ROOT / ".cache/fuzz" / name  # what earlier runs found interesting starts the next one
    found.mkdir(parents=True, exist_ok=True)
    log = OUT / f"fuzz-{name}.log"
    log.unlink(missing_ok=True)
    begun = time.monotonic()
    status = processes.run(
        [str(program), f"-max_total_time={FUZZ_SECONDS}", f"-timeout={SLOW_INPUT_S.get(name, FUZZ_INPUT_S)}", "-rss_limit_mb=3000", "-print_final_stats=1",
         f"-artifact_prefix={OUT}/fuzz-{name}-", str(found), str(ROOT / "tests/fuzz/corpus" / name)],
        log, limit_s=FUZZ_SECONDS + (400 if name in SLOW_INPUT_S else 120), env=SANITIZER_ENV)
    return Case(f"fuzz.{name}", "failed" if status else "passed", tail(log) if status else "", time.monotonic() - begun)


def fuzz() -> Phase:
    def run(log: Path) -> Tally:
        programs = sorted(program for program in (ROOT / "build/asan-ubsan/bin").glob("fuzz_*") if program.is_file())
        with ThreadPoolExecutor(max_workers=int(JOBS)) as pool:
            tally = Tally(list(pool.map(_fuzz_one, programs)))
        if not programs:
            tally.cases.append(Case("fuzz", "failed", "no fuzzer was built"))
        write_junit(log.with_suffix(".xml"), "fuzz", tally)
        return tally

    return Phase(f"fuzz, {FUZZ_SECONDS} s each", run, "asan-ubsan")


def tidy() -> Phase:
    def run(log: Path) -> Tally:
        junit = log.with_suffix(".xml")
        junit.unlink(missing_ok=True)
        processes.run([*TIDY, "--junit", str(junit)], log, limit_s=3600)
        return read_junit(junit)

    return Phase("clang-tidy", run, "asan-ubsan")


def tail(log: Path, lines: int = 30) -> str:
    return "\n".join(log.read_text(errors="replace").splitlines()[-lines:])


def phases(quick: bool) -> list[Phase]:
    if quick:
        return [build("quick", "in_process_tests"), ctest("quick", "in-process", only="in-process", leave_out="slow")]
    too_slow = "|".join(TOO_SLOW_SANITIZED)
    return [
        build("release"), ctest("release", "in-process", only="in-process"),
        ctest("release", "end-to-end", leave_out="in-process", beside=begin(*_build_commands("asan-ubsan", ()), TIDY)),
        build("asan-ubsan"), programs("asan-ubsan", unnamed=too_slow),
        ctest("asan-ubsan", "end-to-end", leave_out="architecture|in-process", unnamed=too_slow), fuzz(),
        build("tsan", *(f"test_{program}" for program in THREADED)),
        programs("tsan", named=f"^({'|'.join(THREADED)})[.]", unnamed="AFileThatEatsMemory"),
        tidy(),
    ]


def clock(seconds: float) -> str:
    return f"{int(seconds) // 60}:{int(seconds) % 60:02}"


def run_phase(phase: Phase, log: Path) -> Tally:
    log.unlink(missing_ok=True)
    log.touch()
    beside = phase.beside() if phase.beside else None
    try:
        tally = phase.run(log)
    finally:
        if beside:
            beside.end()
    left = processes.end_leftovers()
    if left:
        tally.cases.append(Case(f"{phase.title} ends its processes", "failed", "left running: " + ", ".join(sorted(set(left)))))
    return tally


def report(tally: Tally, log: Path, seconds: float) -> None:
    skipped = f", {tally.count('skipped')} skipped" if tally.count("skipped") else ""
    print(f"      {tally.count('passed')} passed, {len(tally.failed)} failed{skipped}, in {clock(seconds)}", flush=True)
    for case in tally.failed:
        print(f"\n  FAILED  {case.name}   (whole log: {log.relative_to(ROOT)})")
        for line in case.detail.splitlines()[-25:]:
            print(f"    {line}")
    if tally.failed:
        print()


def run_phases(chosen: list[Phase], done: dict[str, Ran]) -> None:
    """One after another; what each found goes into `done`, so that a run that is interrupted can still be reported."""
    broken: set[str] = set()  # builds that failed: their tests cannot run
    started = time.monotonic()
    for number, phase in enumerate(chosen, 1):
        print(f"[{number}/{len(chosen)}  {clock(time.monotonic() - started)}] {phase.title}", flush=True)
        if phase.preset in broken:
            print("      not run: its build failed", flush=True)
            continue
        begun = time.monotonic()
        log = OUT / f"{number}-{phase.name}.log"
        tally = run_phase(phase, log)
        done[phase.name] = Ran(tally, time.monotonic() - begun)
        if phase.title.startswith("build") and tally.failed:
            broken.add(phase.preset)
        report(tally, log, done[phase.name].seconds)


def main() -> int:
    parser = argparse.ArgumentParser(prog="deploy/test")
    parser.add_argument("--quick", action="store_true", help="one build, the tests that need no network, style")
    options = parser.parse_args()

    os.chdir(ROOT)
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    processes.adopt_orphans()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))

    done: dict[str, Ran] = {}
    try:
        run_phases(phases(options.quick), done)
    finally:
        processes.end_leftovers(grace_s=0)
        write_report(OUT / "report.json", ROOT, done)
    print("the longest cases:", *long_cases(done), sep="\n  ")
    total = whole(done)
    for name in sorted({case.name for case in total.failed}):
        print(f"failed: {name}")
    print(f"{total.count('passed')} passed, {len(total.failed)} failed")
    return 1 if total.failed else 0


if __name__ == "__main__":
    sys.exit(main())
