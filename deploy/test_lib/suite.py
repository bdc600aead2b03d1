"""The test suite's phases, one after another. Run by deploy/test; see there."""

import argparse
import math
import os
import random
import resource
import shlex
import shutil
import signal
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import processes
from programs import Program, chosen, known_to_ctest, run_program
from repeat import RARE, named, run_rounds
from report import Ran, long_cases, whole, write_report
from results import Case, Tally, read_junit, tail, write_junit
from text import clock

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "out/test"
JOBS = os.cpu_count() or 2
FUZZ_SECONDS = 6
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


@dataclass
class Phase:
    title: str  # what stands before a comma names it in logs and in the report
    run: Callable[[Path], Tally]  # gets its log, returns its cases
    preset: str  # the build that it makes or needs
    ahead: str = ""  # for a shell: does its work, as far as it comes, beside the tests before it; `run` takes up the rest
    until: float = math.inf  # begins no later (of time.monotonic()), and its `run` does no more than this allows

    @property
    def name(self) -> str:
        return self.title.split(",")[0].replace(" ", "-")


def _build_commands(preset: str, targets: tuple[str, ...], settings: tuple[str, ...] = ()) -> tuple[list[str], list[str]]:
    only = ["--target", *targets] if targets else []
    return ["cmake", "--preset", preset, *settings], ["cmake", "--build", f"build/{preset}", "-j", str(JOBS), *only]


def build(preset: str, *targets: str, settings: tuple[str, ...] = (), until: float = math.inf) -> Phase:
    def run(log: Path) -> Tally:
        name = f"build {preset}"
        configure, make = _build_commands(preset, targets, settings)
        status = (processes.run(configure, log, limit_s=300)
                  or processes.run(make, log, limit_s=min(3600.0, until - time.monotonic())))
        if not status:
            return Tally([Case(name, "passed")])
        was_ended = status == processes.PAST_LIMIT and time.monotonic() >= until
        return Tally([Case(name, "too late" if was_ended else "failed", tail(log))])

    configure, make = map(shlex.join, _build_commands(preset, targets, settings))
    return Phase(f"build {preset}", run, preset, f"{{ test -f build/{preset}/build.ninja || {configure}; }} && {make}", until)


def begin_ahead(phases: list[Phase]) -> processes.Beside | None:
    """What can be done ahead of these phases, one after another, on the processor time that tests leave."""
    commands = [phase.ahead for phase in phases if phase.ahead]
    return processes.Beside(["sh", "-c", " && ".join(commands)], OUT / "beside.log") if commands else None


def _run_ctest(preset: str, log: Path, jobs: int, only: tuple[str, ...] = (), leave_out: str = "", named: str = "",
               times: int = 1) -> Tally:
    junit = log.with_suffix(".xml")
    junit.unlink(missing_ok=True)
    command = ["ctest", "--test-dir", f"build/{preset}", "-j", str(jobs), "--output-on-failure", "--no-tests=error", "--output-junit", str(junit)]
    command += [word for label in only for word in ("-L", label)]
    command += ["-LE", leave_out] if leave_out else []
    command += ["-R", named] if named else []
    command += ["--repeat", f"until-fail:{times}"] if times > 1 else []
    if environment_of(preset):
        command = [*without_real_time(), *command]
    status = processes.run(command, log, limit_s=2400 * times, env=environment_of(preset))
    tally = read_junit(junit)
    if status and not tally.failed:
        tally.cases.append(Case(f"ctest {preset}", "failed", tail(log)))
    return tally


def environment_of(preset: str) -> dict[str, str]:
    return SANITIZER_ENV if preset in ("asan-ubsan", "tsan") else {}


def without_real_time() -> list[str]:
    """Before a command: refuses real-time priority to all that it starts. A sanitized loop needs more than its millisecond; with that
    priority, two of them would keep two cores for themselves, and what they talk to would starve."""
    drop = ["setpriv", "--bounding-set=-sys_nice", "--inh-caps=-sys_nice"] if os.geteuid() == 0 else []
    return ["prlimit", "--rtprio=0", *drop]


def end_to_end(preset: str, at_once: int, *only: str, until: float = math.inf) -> Phase:
    """Tests of the programs with all of these labels. Those that draw count twice, some run alone: see tests/integration/CMakeLists.txt."""
    def run(log: Path) -> Tally:
        return _run_ctest(preset, log, at_once, only=("integration", *only))

    return Phase(f"test {preset} end-to-end", run, preset, until=until)


def programs(preset: str, only: str = "", leave_out: str = "none", others: bool = False, until: float = math.inf) -> Phase:
    """The GoogleTest programs with the label `only` and without `leave_out`, and the other tests that need no network where asked for."""
    def run(log: Path) -> Tally:
        found = chosen(known_to_ctest(ROOT / "build" / preset), only, leave_out)
        if not found:
            return Tally([Case(f"programs {preset}", "failed", "no test was chosen")])
        environment = environment_of(preset)

        def run_all(some: list[Program]) -> Tally:
            tally = Tally()
            for program in some:
                if time.monotonic() < until:
                    tally.add(run_program(program, log, environment))
                else:
                    tally.cases.append(Case(f"{preset}.{program.name}", "too late"))
            return tally

        alone = [program for program in found if "alone" in program.labels]
        tally = Tally()
        with ThreadPoolExecutor(max_workers=JOBS) as pool:
            # One after another: the first fits the exhibits' parts, which the rest find in the cache.
            running = [pool.submit(run_all, [program for program in found if program.locks])]
            if others:
                running.append(pool.submit(_run_ctest, preset, log, 1, only=("in-process",), leave_out=f"program|{leave_out}"))
            running += [pool.submit(run_all, [program]) for program in found if program not in alone and not program.locks]
            for future in running:
                tally.add(future.result())
        tally.add(run_all(alone))
        return tally

    return Phase(f"test {preset} in-process", run, preset, until=until)


def repeated_programs(preset: str, rounds: int, seed: int, only: str) -> Phase:
    """Twice as many at a time as there are cores: a test that needs a core for itself is found too."""
    def run(log: Path) -> Tally:
        found = named(chosen(known_to_ctest(ROOT / "build" / preset)), only)
        if not found:
            return Tally([Case(f"programs {preset}", "failed", f"no test program's name matches '{only}'")])
        return run_rounds(found, rounds, seed, log, environment_of(preset), at_once=2 * JOBS)

    return Phase(f"test {preset} in-process, {rounds} times from seed {seed}", run, preset)


def repeated_end_to_end(preset: str, rounds: int, only: str) -> Phase:
    def run(log: Path) -> Tally:
        return _run_ctest(preset, log, 2 * JOBS, only=("integration",), named=only, times=rounds)

    return Phase(f"test {preset} end-to-end, {rounds} times", run, preset)


def repeat_phases(rounds: int, seed: int, only: str) -> list[Phase]:
    if only.startswith("integration."):
        return [build("release"), repeated_end_to_end("release", -(-rounds // RARE), only)]
    planned = [build("release", settings=("-DMECHANE_EVERY_TEST=ON",)), repeated_programs("release", rounds, seed, only)]
    if not only:
        planned.append(repeated_end_to_end("release", -(-rounds // RARE), only))
    return planned


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


def fuzz(until: float) -> Phase:
    def run(log: Path) -> Tally:
        programs = sorted(program for program in (ROOT / "build/asan-ubsan/bin").glob("fuzz_*") if program.is_file())
        with ThreadPoolExecutor(max_workers=JOBS) as pool:
            tally = Tally(list(pool.map(_fuzz_one, programs)))
        if not programs:
            tally.cases.append(Case("fuzz", "failed", "no fuzzer was built"))
        write_junit(log.with_suffix(".xml"), "fuzz", tally)
        return tally

    return Phase(f"fuzz, {FUZZ_SECONDS} s each", run, "asan-ubsan", until=until)


def tidy(until: float) -> Phase:
    def run(log: Path) -> Tally:
        junit = log.with_suffix(".xml")
        junit.unlink(missing_ok=True)
        processes.run([*TIDY, "--junit", str(junit), "--seconds", str(max(0.0, until - time.monotonic()))], log, limit_s=3600)
        return read_junit(junit)

    return Phase("clang-tidy", run, "asan-ubsan", shlex.join(TIDY), until)


def phases(quick: bool, until: float = math.inf) -> list[Phase]:
    """The release build and its tests always run to their end."""
    if quick:
        return [build("quick", "in_process_tests"), programs("quick", only="in-process", leave_out="slow", others=True)]
    return [
        build("release"), programs("release", others=True),
        end_to_end("release", JOBS + 1),  # these tests wait much, but each has loops of 1 kHz
        build("asan-ubsan", until=until), programs("asan-ubsan", leave_out="not-address", until=until),
        # A sanitized server needs a core, and its client another.
        end_to_end("asan-ubsan", max(1, JOBS // 2), "address", until=until),
        fuzz(until),
        build("tsan", "threaded_tests", until=until), programs("tsan", only="threads", until=until),
        tidy(until),
    ]


def run_phase(phase: Phase, log: Path, beside: processes.Beside | None) -> Tally:
    log.unlink(missing_ok=True)
    log.touch()
    tally = phase.run(log)
    left = processes.end_leftovers(spared=beside.pid if beside else 0)
    if left:
        tally.cases.append(Case(f"{phase.title} ends its processes", "failed", "left running: " + ", ".join(sorted(set(left)))))
    return tally


def report(ran: Ran, log: Path) -> None:
    tally = ran.tally
    others = "".join(f", {tally.count(outcome)} {outcome}" for outcome in ("skipped", "left out", "too late") if tally.count(outcome))
    print(f"      {tally.count('passed')} passed, {len(tally.failed)} failed{others}, in {clock(ran.seconds)}, "
          f"{clock(ran.cpu_s)} of processor time", flush=True)
    for case in tally.failed:
        print(f"\n  FAILED  {case.name}   (whole log: {log.relative_to(ROOT)})")
        for line in case.detail.splitlines()[-25:]:
            print(f"    {line}")
    if tally.failed:
        print()


def _cpu_s() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run_phases(planned: list[Phase], done: dict[str, Ran]) -> None:
    """One after another; what each found goes into `done`, so that a run that is interrupted can still be reported."""
    broken: set[str] = set()  # builds that are not there: their tests cannot run
    beside: processes.Beside | None = None  # goes on from test to test: what it has half done is lost when it ends
    started = time.monotonic()
    for number, phase in enumerate(planned, 1):
        print(f"[{number}/{len(planned)}  {clock(time.monotonic() - started)}] {phase.title}", flush=True)
        late = time.monotonic() >= phase.until
        if late:
            done[phase.name] = Ran(Tally([Case(phase.title, "too late")]), 0)
        if late or phase.preset in broken:
            print("      not run: " + ("the time is up" if late else "its build is not there"), flush=True)
            continue
        fills = phase.title.startswith(("test", "fuzz"))
        if beside and not fills:
            beside.end()
            beside = None
        elif fills and not beside:
            beside = begin_ahead(planned[number:])
        begun, cpu_s = time.monotonic(), _cpu_s()
        log = OUT / f"{number}-{phase.name}.log"
        tally = run_phase(phase, log, beside)
        done[phase.name] = Ran(tally, time.monotonic() - begun, _cpu_s() - cpu_s)
        if phase.title.startswith("build") and tally.count("passed") < len(tally.cases):
            broken.add(phase.preset)
        report(done[phase.name], log)


def main() -> int:
    parser = argparse.ArgumentParser(prog="deploy/test")
    parser.add_argument("--quick", action="store_true", help="one build, the tests that need no network, style")
    parser.add_argument("--within", type=float, default=math.inf, metavar="MINUTES",
                        help="of a full run: after these the sanitizers, fuzzers and clang-tidy begin with no more")
    parser.add_argument("--repeat", type=int, metavar="N", help=f"in-process tests N times, end-to-end and slow ones N / {RARE} times")
    parser.add_argument("--seed", type=int, default=random.randrange(1_000_000), help="of --repeat")
    parser.add_argument("--only", default="", metavar="REGEX", help="of --repeat: programs by name (unit_record), or integration.NAME")
    options = parser.parse_args()
    if options.repeat is None:
        planned = phases(options.quick, time.monotonic() + 60 * options.within)
    else:
        planned = repeat_phases(options.repeat, options.seed, options.only)

    os.chdir(ROOT)
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    processes.adopt_orphans()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))

    done: dict[str, Ran] = {}
    try:
        run_phases(planned, done)
    finally:
        processes.end_leftovers(grace_s=0)
        write_report(OUT / "report.json", ROOT, done)
    print("the longest cases:", *long_cases(done), sep="\n  ")
    if late := [name for name, ran in done.items() if ran.tally.count("too late")]:
        print(f"THE TIME WAS UP for all or a part of {', '.join(late)}: that is not tested. Run deploy/test without --within.")
    total = whole(done)
    for name in sorted({case.name for case in total.failed}):
        print(f"failed: {name}")
    print(f"{total.count('passed')} passed, {len(total.failed)} failed")
    return 1 if total.failed else 0


if __name__ == "__main__":
    sys.exit(main())
