"""What the exhibits' worlds cost: a tick of each with one hand, loading from cached parts, the models' sizes, and how many worlds one
core holds."""

import re
from pathlib import Path

from peers import LOOP_PRIORITY, Measured, Missing, own
from plots import lines, number, ranges
from text import grid

PROGRAM_LIMIT_S = 1500  # before the program counts as hung; the first time, parts are fitted for minutes
COUNTS = 3  # of worlds that are tried in the time given for a part: a third of it each
AIM_MEDIAN_US, AIM_P999_US = 150, 500  # of an exhibit's tick
AIMS = {
    "tick_us.*.median": (("under", AIM_MEDIAN_US),),
    "tick_us.*.p999": (("under", AIM_P999_US),),
    "load_s.*": (("under", 1),),
    "model_mb.*": (("under", 8),),
    "models_mb": (("under", 60),),
    "worlds_per_core": (("at least", 6),),
    "force_later_us.third.p99": (("at most", 100),),
    "against.cpu_ratio.*": (("at most", 0.8),),
    "against.cpu_ratio_sum": (("at most", 0.4),),
    "against.worlds_ratio": (("at least", 2.5),),
    "state_hash.stable": (("at least", 1),),
}
TICK_US = 1000
PHASES = {"find_contacts": "contacts us", "run_agents": "agents us", "run_machines": "machines us", "step_dynamics": "dynamics us"}
_MESH = re.compile(r'"([^"]+\.(?:glb|gltf|obj|stl|ply))(?:#[^"]*)?"')


def _meshes(scenario: Path) -> set[Path]:
    return {(scenario.parent / uri).resolve() for uri in _MESH.findall(scenario.read_text())}


def _megabytes(files: set[Path]) -> float:
    return sum(file.stat().st_size for file in files if file.is_file()) / 1e6


def _exhibits(metrics: dict[str, float]) -> list[str]:
    """The dearest first."""
    names = [name.split(".")[1] for name in metrics if name.startswith("tick_us.") and name.endswith(".median")]
    return sorted(names, key=lambda name: -metrics[f"tick_us.{name}.median"])


def measure(context) -> tuple[Measured, list[str]]:
    scenarios = sorted(context.root.glob("scenarios/*/*.x3d"))
    print(f"  bench_worlds, {len(scenarios)} scenarios ...", flush=True)
    try:
        result = own(context.bin, "bench_worlds", [*map(str, scenarios), "--seconds", str(context.seconds / COUNTS), "--priority", str(LOOP_PRIORITY)],
                     PROGRAM_LIMIT_S)
    except Missing as reason:
        return Measured(), [f"worlds: {reason}"]
    add_models(result, scenarios)
    return result, []


def add_models(result: Measured, scenarios: list[Path]) -> None:
    """The sizes of the mesh files, by scenario and of all together; a file that two scenarios share counts once there."""
    meshes = {file.stem: _meshes(file) for file in scenarios}
    result.metrics["models_mb"] = _megabytes(set().union(*meshes.values()))
    result.metrics |= {f"model_mb.{name}": _megabytes(files) for name, files in meshes.items()}


def against(now: dict[str, float], before: dict[str, float]) -> dict[str, float]:
    """Now over before: the processor time of each exhibit's mean tick, of all together, and the worlds that a core holds."""
    both = [name for name in _exhibits(now) if f"tick_us.{name}.mean" in before]
    ticks = [(now[f"tick_us.{name}.mean"], before[f"tick_us.{name}.mean"]) for name in both]
    ratios = {f"against.cpu_ratio.{name}": ours / theirs for name, (ours, theirs) in zip(both, ticks, strict=True)}
    if ticks:
        ratios["against.cpu_ratio_sum"] = sum(ours for ours, _ in ticks) / sum(theirs for _, theirs in ticks)
    if before.get("worlds_per_core"):
        ratios["against.worlds_ratio"] = now["worlds_per_core"] / before["worlds_per_core"]
    return ratios


def _counts(metrics: dict[str, float]) -> list[int]:
    return sorted(int(name.split(".")[1]) for name in metrics if name.startswith("worlds_over_pct."))


def table(name: str, metrics: dict[str, float]) -> str:
    """A row for each exhibit, the dearest first; then the worlds of one core."""
    rows = [["", "tick us", "p99", "p99.9", "floor p99.9", "max", "of 1 ms %", *PHASES.values(), "load s", "model MB"]]
    for exhibit in _exhibits(metrics):
        shown = [f"tick_us.{exhibit}.median", f"tick_us.{exhibit}.p99", f"tick_us.{exhibit}.p999", f"tick_floor_us.{exhibit}.p999", f"tick_us.{exhibit}.max",
                 f"budget_pct.{exhibit}.median", *(f"phase_us.{exhibit}.{phase}" for phase in PHASES), f"load_s.{exhibit}", f"model_mb.{exhibit}"]
        rows.append([exhibit, *(number(metrics[metric]) if metric in metrics else "-" for metric in shown)])
    text = [f"\n{name}", *grid(rows),
            "  floor: of each tick the faster of two replays, so what the work takes; phases: means; CPU time, "
            "but loading by the wall clock"]
    counts = _counts(metrics)
    if counts:
        text += ["", *grid([["worlds stepped in each millisecond", *map(str, counts)],
                            ["median, us", *(number(metrics[f"worlds_tick_us.{count}.median"]) for count in counts)],
                            ["ticks over 1 ms, %", *(number(metrics[f"worlds_over_pct.{count}"]) for count in counts)]])]
        text.append(f"  one core holds {metrics['worlds_per_core']:.0f} worlds with under 0.1 % of ticks over 1 ms; computed from the mean "
                    f"tick: {metrics['worlds_per_core.computed']:.1f}\n  the dearest exhibits first, each in another part of its visit; a wake-up's cold caches count here, "
                    "and not above")
    if "models_mb" in metrics:
        text.append(f"  all models {number(metrics['models_mb'])} MB; a visit played again ends in the same state: "
                    f"{'yes' if metrics.get('state_hash.stable') == 1 else 'NO'}")
    return "\n".join(text)


def plot(result: Measured, out: Path, machine: str) -> list[Path]:
    made, metrics = [], result.metrics
    rows = [(name, *(metrics[f"tick_us.{name}.{q}"] for q in ("median", "p99", "p999"))) for name in _exhibits(metrics)]
    if rows:
        made.append(out / "worlds-tick.svg")
        ranges(made[-1], "A tick of each exhibit's world, with one hand at work", f"median, p99 and p99.9 of CPU time; lines: the aims, and a whole tick. {machine}", rows,
               "µs", [(AIM_MEDIAN_US, "median"), (AIM_P999_US, "p99.9"), (TICK_US, "a tick")])
    series = {label: result.curves[f"worlds.{q}"] for label, q in (("median", "median"), ("p99", "p99"), ("p99.9", "p999")) if f"worlds.{q}" in result.curves}
    if series and len(series["median"]) > 1:
        made.append(out / "worlds-per-core.svg")
        last = series["median"][-1][0]
        lines(made[-1], "Worlds of mixed exhibits on one core", f"CPU time of all their ticks, in each millisecond. {machine}",
              {**series, "1 ms": [[1, TICK_US], [last, TICK_US]]}, "worlds", "µs",
              [(count, count, "") for count, _ in series["median"]])
    return made
