"""An earlier revision beside this one: its checkout, both measured in turn, and the ratios of their figures."""

import math
import subprocess
from pathlib import Path

from peers import Measured

MEDIAN = ".median"


class NoRevision(Exception):
    """The revision cannot be checked out."""


def _git(root: Path, *arguments: str) -> str:
    done = subprocess.run(["git", "-C", str(root), *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        raise NoRevision(done.stderr.strip() or f"git {arguments[0]} ended with {done.returncode}")
    return done.stdout.strip()


def checkout(root: Path, revision: str) -> Path:
    """Its files, as a worktree of their own; `git worktree remove` takes it away again."""
    commit = _git(root, "rev-parse", "--verify", "--short", f"{revision}^{{commit}}")
    tree = root / "build/against" / commit
    if not tree.exists():
        _git(root, "worktree", "add", "--detach", str(tree), commit)
    return tree


def medians(now: dict[str, float], before: dict[str, float]) -> dict[str, float]:
    """For benchmarks that do not say themselves what to compare: now over before, of each median that both have."""
    return {f"against.{name}": now[name] / before[name] for name in now if name.endswith(MEDIAN) and before.get(name)}


def measure(benchmark, context, before) -> tuple[Measured, list[str]]:
    """Before, now, now, before: what changes steadily on the machine falls on both. A ratio is the geometric mean of the two pairs'."""
    compare = getattr(benchmark, "against", medians)
    pairs, missing, results = [], [], []
    for order in ((before, context), (context, before)):
        measured = {}
        for one in order:
            measured[one.root], gone = benchmark.measure(one)
            missing += [f"{one.root.name}: {reason}" for reason in gone]
        results.append(measured[context.root])
        pairs.append(compare(measured[context.root].metrics, measured[before.root].metrics))
    result = results[0]
    result.metrics |= {name: math.sqrt(pairs[0][name] * pairs[1][name]) for name in pairs[0] if name in pairs[1]}
    return result, missing
