"""Force on a hand: how stiff a wall may be, what a delay does to a press, what is felt when a contact resumes, how smooth facets feel. All
of it on a simulated stylus and a simulated clock: the figures do not depend on the machine, but for what the force of a grasp costs."""

from pathlib import Path

from peers import Measured, Missing, own
from plots import lines

PROGRAM_LIMIT_S = 400
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


def measure(context) -> tuple[Measured, list[str]]:
    try:
        result = own(context.bin, "bench_haptics", [], PROGRAM_LIMIT_S)
        touch = own(context.bin, "bench_touch", [], PROGRAM_LIMIT_S)
    except Missing as reason:
        return Measured(), [f"haptics: {reason}"]
    result.metrics |= touch.metrics
    result.curves |= touch.curves
    result.notes += touch.notes
    return result, []


def plot(result: Measured, out: Path, machine: str) -> list[Path]:
    plays = ("stroke", "press", "slide", "crank")
    one_ms = {play: result.metrics.get(f"deadband0.local.{play}.one_ms_error_n.p99") for play in plays[1:]}
    plots = (("wall", "How stiff a wall may be, when forces act late",
              "the largest stable stiffness of a simulated stylus without friction; theory: b / (T / 2 + t), b = 0.5 N s/m, T = 1 ms",
              {"theory": "wall.theory", "measured": "wall.measured"}, "t, ms: the delay of the whole loop, there and back",
              "N/m, logarithmic", {"points": ("measured",)}),
             ("deadband-saved", "What a deadband saves", "messages left out, both directions together",
              {play: f"deadband.saved.{play}" for play in plays}, "the deadband's share", "of all messages",
              {"logarithmic": False, "dashed": ("press",), "limit": (0.75, "0.75 is the most: one message each 4 ms")}),
             ("deadband-error", "What a deadband costs, beside what a network costs",
              "force against the same play without one, 99 % of the milliseconds are below; dashed: what 1 ms more delay does",
              {play: f"deadband.error.{play}" for play in plays[1:]}, "the deadband's share", "N, logarithmic",
              {"beside": {play: error_n for play, error_n in one_ms.items() if error_n}}))
    made = []
    for name, title, what, curves, x, y, style in plots:
        series = {label: result.curves.get(curve) for label, curve in curves.items()}
        if not all(series.values()):
            continue
        made.append(out / f"haptics-{name}.svg")
        lines(made[-1], title, what, series, x, y, **style)
    return made
