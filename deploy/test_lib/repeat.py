"""The same tests many times, each time in another order and with other random cases: what fails now and then is found."""

import random
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from programs import Program, run_program
from results import Case, Tally

RARE = 20  # tests that are slow, draw or share the network run once in this many rounds of the others


def rounds_of(labels: frozenset[str], rounds: int) -> int:
    return -(-rounds // RARE) if labels & {"slow", "gl", "alone"} else rounds


def seeds(first: int, count: int) -> list[int]:
    """One for each round, as GoogleTest takes them: 1 to 99999."""
    draw = random.Random(first)
    return [draw.randint(1, 99_999) for _ in range(count)]


def _once(program: Program, seed: int, log: Path, environment: dict[str, str]) -> Tally:
    flags = ("--gtest_shuffle", f"--gtest_random_seed={seed}")
    own = log.with_name(f"{log.stem}-seed-{seed}.log")
    tally = run_program(program, own, {**environment, "RC_PARAMS": f"seed={seed}"}, flags)
    for case in tally.failed:
        case.detail += f"\nto see it again: RC_PARAMS=seed={seed} {program.path} {' '.join(flags)}"
    if not tally.failed:
        for file in log.parent.glob(f"{own.stem}-{program.name}.*"):
            file.unlink()
    return tally


def worst(tallies: list[Tally]) -> Tally:
    """Each test once: its first failure if it had one, and the longest time that it took."""
    cases: dict[str, Case] = {}
    for tally in tallies:
        for case in tally.cases:
            known = cases.setdefault(case.name, case)
            longest = max(known.seconds, case.seconds)
            if case.outcome == "failed" and known.outcome != "failed":
                cases[case.name] = known = case
            known.seconds = longest
    return Tally(list(cases.values()))


def run_rounds(programs: list[Program], rounds: int, first_seed: int, log: Path, environment: dict[str, str], at_once: int) -> Tally:
    """Programs without the label 'alone' beside each other."""
    plan = [(program, seed) for program in programs for seed in seeds(first_seed, rounds_of(program.labels, rounds))]
    beside = [entry for entry in plan if "alone" not in entry[0].labels]
    with ThreadPoolExecutor(max_workers=at_once) as pool:
        tallies = list(pool.map(lambda entry: _once(*entry, log, environment), beside))
    tallies += [_once(program, seed, log, environment) for program, seed in plan if "alone" in program.labels]
    return worst(tallies)


def named(programs: list[Program], pattern: str) -> list[Program]:
    return [program for program in programs if re.search(pattern, program.name)]
