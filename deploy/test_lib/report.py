"""What a run of the suite leaves behind: out/test/report.json, in the shape of the benchmarks' files."""

import json
import sys
from dataclasses import dataclass
from pathlib import Path

from results import Tally

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common_lib"))
import machine  # noqa: E402

LONGEST = 20


@dataclass
class Ran:
    """A phase that is over."""
    tally: Tally
    seconds: float
    cpu_s: float = 0  # of all its processes, and of what ran beside it


def whole(phases: dict[str, Ran]) -> Tally:
    return Tally([case for phase in phases.values() for case in phase.tally.cases])


def long_cases(phases: dict[str, Ran]) -> list[str]:
    """The longest cases, each with its time and its phase."""
    timed = [(case.seconds, case.name, phase) for phase, ran in phases.items() for case in ran.tally.cases if case.seconds > 0]
    timed.sort(key=lambda entry: (-entry[0], *entry[1:]))
    return [f"{seconds:.1f} s  {name}  ({phase})" for seconds, name, phase in timed[:LONGEST]]


def write_report(path: Path, root: Path, phases: dict[str, Ran]) -> None:
    total = whole(phases)
    seconds = round(sum(phase.seconds for phase in phases.values()), 1)
    metrics: dict[str, float] = {"seconds": seconds}
    metrics |= {outcome: total.count(outcome) for outcome in ("passed", "failed", "skipped")}
    metrics |= {"left_out": total.count("left out"), "too_late": total.count("too late")}
    metrics |= {f"phase_s.{name}": round(phase.seconds, 1) for name, phase in phases.items()}
    metrics |= {f"cpu_s.{name}": round(phase.cpu_s, 1) for name, phase in phases.items()}
    path.write_text(json.dumps({
        "name": "test", "commit": machine.commit(root), "cpu": machine.cpu(), "cores": machine.cores(), "simd": machine.simd(),
        "seconds": seconds, "metrics": metrics, "notes": long_cases(phases)}, indent=1, ensure_ascii=False) + "\n")
