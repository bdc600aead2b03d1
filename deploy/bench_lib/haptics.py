"""Force on a hand: how stiff a wall may be, what a delay does to a press, what is felt when a contact resumes, how smooth facets feel. All
of it on a simulated stylus and a simulated clock: the figures do not depend on the machine, but for what the force of a grasp costs."""

import operator
from pathlib import Path

from peers import Measured, Missing, own
from plots import lines, number

PROGRAM_LIMIT_S = 400
# Figure: what it is to be.
AIMS = {
    "fig16.jump_ratio": (("at most", 0.1),),
    "fig16.deviation_ratio": (("at most", 0.5),),
    "fig16.shipped.jump_ratio": (("at most", 0.1),),
    "fig16.shipped.deviation_ratio": (("at most", 0.5),),
    "force_us.grasp.median": (("at most", 20),),
    "wall.k_ratio": (("at least", 0.9), ("at most", 1.1)),
    "wall.limit_cycle_ratio": (("at most", 1),),
    "resume.swing_n": (("at most", 0.3),),
    "delay20.local.energy_mj.max": (("at most", 1),),
    "delay50.local.energy_mj.max": (("at most", 1),),
    "delay20.local.peak_ratio": (("at most", 1.1),),
    "delay20.local.force_share.min": (("at least", 0.8),),
    "delay50.local.force_share.min": (("at least", 0.5),),
    "delay20.local.held.energy_mj.max": (("at most", 1),),
    "delay50.local.held.energy_mj.max": (("at most", 1),),
    "delay20.local.held.force_share.min": (("at least", 0.8),),
    "delay50.local.held.force_share.min": (("at least", 0.8),),
    "delay20.local.carried.force_share": (("at least", 0.95), ("at most", 1.05)),
    "delay50.local.carried.force_share": (("at least", 0.95), ("at most", 1.05)),
    "groove4.delay20.local.distance_ratio": (("at least", 0.98), ("at most", 1.02)),
    "groove4.delay20.local.flank_ratio": (("at least", 0.9), ("at most", 1.1)),
    "click.delay20.local.length_ratio": (("at least", 0.9), ("at most", 1.1)),
    "fault.zero_ms.max": (("at most", 45),),
    "force.over_limit": (("at most", 0),),
    "force.over_slew": (("at most", 0),),
    "force.over_ramp": (("at most", 0),),
    "deadband.energy_mj.max": (("at most", 1),),
    "deadband.saved_bytes": (("at least", 0.5),),
    "deadband.fault.zero_ms.max": (("at most", 45),),
    "deadband.force.over_limit": (("at most", 0),),
    "deadband.force.over_slew": (("at most", 0),),
    "deadband.force.over_ramp": (("at most", 0),),
}
_HOLDS = {"at least": operator.ge, "at most": operator.le}


def missed(metrics: dict[str, float]) -> list[str]:
    return [f"missed: {name} is {number(metrics[name])}, the aim is {word} {number(limit)}"
            for name, aims in AIMS.items() if name in metrics for word, limit in aims if not _HOLDS[word](metrics[name], limit)]


def measure(context) -> tuple[Measured, list[str]]:
    try:
        result = own(context.bin, "bench_haptics", [], PROGRAM_LIMIT_S)
        touch = own(context.bin, "bench_touch", [], PROGRAM_LIMIT_S)
    except Missing as reason:
        return Measured(), [f"haptics: {reason}"]
    result.metrics |= touch.metrics
    result.curves |= touch.curves
    result.notes += touch.notes + missed(result.metrics)
    return result, []


def plot(result: Measured, out: Path, machine: str) -> list[Path]:
    plays = ("stroke", "press", "slide", "crank")
    plots = (("wall", "How stiff a wall may be", "largest stable stiffness of a simulated stylus without friction; theory: b / (T / 2 + t)",
              {"theory": "wall.theory", "measured": "wall.measured"}, "delay, ms", "N/m", True),
             ("deadband-saved", "What a deadband saves", "messages left out, both directions together",
              {play: f"deadband.saved.{play}" for play in plays}, "the deadband's share", "of all messages", False),
             ("deadband-error", "What a deadband costs",
              "difference of the force to the same play without; 99 % of the milliseconds are below",
              {play: f"deadband.error.{play}" for play in plays[1:]}, "the deadband's share", "N", True))
    made = []
    for name, title, what, curves, x, y, logarithmic in plots:
        series = {label: result.curves.get(curve) for label, curve in curves.items()}
        if not all(series.values()):
            continue
        made.append(out / f"haptics-{name}.svg")
        lines(made[-1], title, what, series, x, y, logarithmic=logarithmic)
    return made
