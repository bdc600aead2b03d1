"""Runs the programs that measure, ours and those of others, and reads what they say. Each returns plain numbers in microseconds."""

import json
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common_lib"))  # for all modules of this folder: each imports this one first
from running import stop  # noqa: E402

LOOP_PRIORITY = 80  # of the server's loops and of what measures beside them


class Missing(Exception):
    """Something that a benchmark needs is not there. Said aloud; never replaced by a number."""


@dataclass
class Measured:
    metrics: dict[str, float] = field(default_factory=dict)
    curves: dict[str, list[list[float]]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def _run(command: list[str], limit_s: float, env: dict[str, str] | None = None) -> str:
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit_s, env={**os.environ, **(env or {})},
                              stdin=subprocess.DEVNULL)
    except FileNotFoundError:
        raise Missing(f"{command[0]} is not here") from None
    except subprocess.TimeoutExpired:
        raise Missing(f"{command[0]} did not end within {limit_s:.0f} s") from None
    if done.returncode:
        raise Missing(f"{' '.join(command)} ended with {done.returncode}: {(done.stderr or done.stdout).strip()[-400:]}")
    return done.stdout


def own(folder: Path, name: str, arguments: list[str], seconds: float, env: dict[str, str] | None = None) -> Measured:
    """One of our benchmark programs (tests/benchmark): prints a JSON object."""
    program = folder / name
    if not program.exists():
        raise Missing(f"{name} missing in {folder}: it was not built")
    said = json.loads(_run([str(program), *arguments], seconds + 120, env))
    return Measured(said["metrics"], said["curves"], said["notes"])


def _from_histogram(counts: dict[int, int], name: str) -> Measured:
    """Quantiles of a histogram of whole microseconds."""
    total = sum(counts.values())
    ranked = sorted(counts.items())

    def quantile(share: float) -> float:
        wanted, seen = max(1, -(-share * total // 1)), 0
        for us, count in ranked:
            seen += count
            if seen >= wanted:
                return float(us)
        return float(ranked[-1][0])

    shares = {"median": 0.5, "p99": 0.99, "p999": 0.999, "max": 1.0}
    metrics = {f"{name}.{word}": quantile(share) for word, share in shares.items()}
    beyond = [0.999, 0.99, 0.9, 0.75, 0.5, 0.3, 0.2, 0.1, 0.05, 0.03, 0.02, 0.01, 0.005, 0.003, 0.002, 0.001, 0.0001]
    return Measured({**metrics, f"{name}.count": float(total)}, {name: [[b, quantile(1 - b)] for b in beyond if b * total >= 1]})


def cyclictest(seconds: float, priority: int, cpu: int) -> Measured:
    """rt-tests' wake-up latency at 1 kHz, with the same priority, processor and locked memory as our loop."""
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder) / "cyclictest.json"
        _run(["cyclictest", "--quiet", "--mlockall", f"--priority={priority}", "--interval=1000", f"--affinity={cpu}", "--threads=1",
              f"--duration={max(1, round(seconds))}", "--histogram=100000", f"--json={result}"], seconds + 60)
        thread = json.loads(result.read_text())["thread"]["0"]
    counts = {int(us): count for us, count in thread["histogram"].items()}
    if not counts:
        raise Missing("cyclictest reported no wake-ups")
    measured = _from_histogram(counts, "wake_us.cyclictest")
    measured.metrics["wake_us.cyclictest.max"] = float(thread["max"])  # beyond the histogram's end, too
    return measured


_PING = re.compile(r"size \d+ mean [\d.]+us min [\d.]+us 50% ([\d.]+)us 90% [\d.]+us 99% ([\d.]+)us max ([\d.]+)us cnt (\d+)")


def ddsperf(seconds: float, priority: int, size: int, domain: int, env: dict[str, str]) -> Measured:
    """Cyclone's own round trip, best effort, a thousand a second, `size` bytes both ways. It prints quantiles of each second; we
    take the median of them, and say so."""
    with_priority = ["chrt", "--fifo", str(priority)] if priority else []
    common = ["ddsperf", "-u", "-i", str(domain)]
    pong = subprocess.Popen([*with_priority, *common, "-D", str(int(seconds) + 30), "pong"], stdin=subprocess.DEVNULL,
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, **env})
    try:
        # The first second holds the discovery of the two processes.
        said = _run([*with_priority, *common, "-D", str(int(seconds) + 1), "ping", "1kHz", "size", str(size)], seconds + 60, env)
    finally:
        stop(pong)
    seconds_of = [[float(value) for value in match.groups()] for match in _PING.finditer(said)][1:]
    if not seconds_of:
        raise Missing(f"ddsperf ping had no answer: {said.strip()[-300:]}")
    return Measured({"ddsperf_us.median": median([s[0] for s in seconds_of]), "ddsperf_us.p99": median([s[1] for s in seconds_of]),
                     "ddsperf_us.max": max(s[2] for s in seconds_of), "ddsperf_us.count": sum(s[3] for s in seconds_of)})


def over_rounds(rounds: list[Measured]) -> Measured:
    """One result of several rounds: the median of each number, the largest of each maximum, the sum of each count."""
    merged = Measured()
    for name in rounds[0].metrics:
        values = [measured.metrics[name] for measured in rounds]
        merged.metrics[name] = max(values) if name.endswith(".max") else sum(values) if name.endswith(".count") else median(values)
    for name, curve in rounds[0].curves.items():
        merged.curves[name] = [[point[0], median([measured.curves[name][i][1] for measured in rounds])]
                               for i, point in enumerate(curve)]
    merged.notes = list(dict.fromkeys(note for measured in rounds for note in measured.notes))
    return merged
