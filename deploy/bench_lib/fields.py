"""Distance fields (decision 37) against the dense grid of 16 bits: nine seeds, shipped models, many objects, what exact normals cost."""

from pathlib import Path

from collision import OPEN, PROGRAM_LIMIT_S
from peers import Measured, Missing, own
from plots import lines, number
from text import grid

METHODS = ("field", "field_lists", "brick", "brick_lists")
SEEDS = range(1, 10)
SEED_SLACK = 1.3  # by how much other seeds may miss what is asked of seed 1
ERRORS_PCT = (0.15, 0.2, 0.3, 0.45, 0.6, 0.9)  # that the builder is given, for the frontier of bytes against normals
FRONTIER_BYTES = 150_000
ASKED = {"ratio.brick": ("at least", 1.65), "ratio.brick_p99": ("at least", 1.65), "ratio.brick_lists": ("at least", 1.1),
         "bytes": ("at most", 120_000), "depth_error_pct.p99": ("at most", 0.1), "missed": ("at most", 0), "false": ("at most", 0)}
AIMS = {
    **{f"seed.*.{name}": ((word, limit * SEED_SLACK if word == "at most" else limit / SEED_SLACK),)
       for name, (word, limit) in ASKED.items()},
    **{f"seed.1.{name}": (bound,) for name, bound in ASKED.items()},  # the later of two patterns counts
    "models.time_ratio.max": (("at most", 1),),
    "models.bytes_ratio.max": (("at most", 0.2),),
    "bytes.inner_screw": (("at most", 300_000),),
    "normal_deg.p99": (("at most", 5),),
}
SEED_COLUMNS = {"x brick": "ratio.brick", "by p99": "ratio.brick_p99", "x brick lists": "ratio.brick_lists",
                "without lists": "ratio.stateless", "KB": "bytes", "error p99 %": "depth_error_pct.p99",
                "normal p99 deg": "normal_deg.p99", "missed": "missed", "false": "false"}
MODEL_COLUMNS = {"parts": "parts", "build s": "build_s", "KB": "bytes.field", "brick KB": "bytes.brick",
                 "err p99 %": "depth_error_pct.field.p99", "err p99 mm": "depth_error_mm.field.p99", "missed": "missed.field",
                 "false": "false.field", "step us": "step_us.field.median", "brick us": "step_us.brick.median"}
# Of each error that the builder was given.
FRONTIER = {"KB": ("bytes", "bytes.field"), "normal p99 deg": ("normal_deg", "normal_deg.field.p99"),
            "error p99 %": ("depth_error_pct", "depth_error_pct.field.p99"), "step us": ("step_us", "step_us.field_lists.median")}


def _asked(context, methods: tuple[str, ...], *arguments: str) -> dict[str, float]:
    return own(context.bin, "bench_collision", ["--methods", ",".join(methods), "--cold-steps", "0", *arguments], PROGRAM_LIMIT_S).metrics


def _seed(context, seed: int) -> dict[str, float]:
    said = _asked(context, METHODS, "--seed", str(seed), *(["--crowds"] if seed == 1 else []))
    found = {"ratio.brick": said["ratio_field_lists.brick"], "ratio.brick_p99": said["ratio_field_lists.brick_p99"],
             "ratio.brick_lists": said["ratio_field_lists.brick_lists"], "ratio.stateless": said["ratio_field.brick"],
             "bytes": said["bytes.field"], "depth_error_pct.p99": said["depth_error_pct.field.p99"],
             "normal_deg.p99": said["normal_deg.field.p99"],
             "missed": said["missed.field"], "false": said["false.field"]}
    return {**{f"seed.{seed}.{name}": value for name, value in found.items()},
            **{name: value for name, value in said.items() if name.startswith("objects_us.")}}


def _frontier(context) -> dict[str, float]:
    found = {}
    for error in ERRORS_PCT:
        said = _asked(context, ("field", "field_lists"), "--error", str(error))
        for name, metric in FRONTIER.values():
            found[f"frontier.{error:g}.{name}"] = said[metric]
    small = [found[f"frontier.{error:g}.normal_deg"] for error in ERRORS_PCT
             if found[f"frontier.{error:g}.bytes"] <= FRONTIER_BYTES]
    return {**found, **({"normal_deg.p99": min(small)} if small else {})}


def _models(context) -> Measured:
    files = sorted(context.root.glob("scenarios/models/*.glb"))
    beside = (context.root / "../shared/meshes").resolve()
    files += sorted(file for kind in ("obj", "stl", "ply") for file in beside.glob(f"*.{kind}") if file.stem not in OPEN)
    return own(context.bin, "bench_models", ["--fields", *map(str, files)], PROGRAM_LIMIT_S)


def measure(context) -> tuple[Measured, list[str]]:
    result, missing = Measured(), []
    seeds = [context.seed] if context.seed else SEEDS
    parts = [(f"seed {seed}", lambda seed=seed: Measured(_seed(context, seed), {}, [])) for seed in seeds]
    parts += [("frontier", lambda: Measured(_frontier(context), {}, [])), ("models", lambda: _models(context))]
    for name, part in parts:
        print(f"  {name} ...", flush=True)
        try:
            found = part()
        except Missing as reason:
            missing.append(f"{name}: {reason}")
            continue
        result = Measured({**result.metrics, **found.metrics}, {**result.curves, **found.curves}, result.notes + found.notes)
    return result, missing


def _rows(metrics: dict[str, float], start: str, columns: dict[str, str]) -> list[str]:
    """A row for each thing whose metrics are START.THING.COLUMN."""
    things = list(dict.fromkeys(name[len(start) + 1:-len(end) - 1] for end in columns.values() for name in metrics
                                if name.startswith(start + ".") and name.endswith("." + end)))

    def shown(thing: str, column: str) -> str:
        value = metrics.get(f"{start}.{thing}.{column}")
        return "-" if value is None else number(value / 1000 if column.startswith("bytes") else value)

    rows = [[thing, *(shown(thing, column) for column in columns.values())] for thing in things]
    return ["", *grid([[start, *columns], *rows])] if rows else []


def table(name: str, metrics: dict[str, float]) -> str:
    crowds = [[metric.split(".")[1], number(value)] for metric, value in metrics.items() if metric.startswith("objects_us.")]
    return "\n".join([f"\n{name}", *_rows(metrics, "seed", SEED_COLUMNS),
                      *_rows(metrics, "frontier", {head: column for head, (column, _) in FRONTIER.items()}),
                      "", *grid([["objects", "step us"], *crowds]), *_rows(metrics, "model", MODEL_COLUMNS)])


def plot(result: Measured, out: Path, machine: str) -> list[Path]:
    points = [[result.metrics[f"frontier.{error:g}.bytes"] / 1000, result.metrics[f"frontier.{error:g}.normal_deg"]]
              for error in reversed(ERRORS_PCT) if f"frontier.{error:g}.bytes" in result.metrics]
    if not points:
        return []
    file = out / "fields-normals.svg"
    lines(file, "What exact normals cost", f"five objects, each point another error that the builder was given. {machine}",
          {"fields": points}, "KB", "degrees, p99")
    return [file]
