"""Contact queries: the product's maps against the libraries that a user would take instead, on one scene and in one run."""

import math
from pathlib import Path

from peers import Measured, Missing, own
from plots import bars, heat_map, lines, number
from text import grid

PROGRAM_LIMIT_S = 1200  # before the program counts as hung; it takes some minutes
OURS = "sqmap"
AIMS = {
    f"bytes.{OURS}": (("at most", 120_000),),
    f"depth_error_pct.{OURS}.p99": (("at most", 0.3),),
    f"missed.{OURS}": (("at most", 0),),
    "ratio.fcl_contacts": (("at least", 50),),
    "ratio.bt_sdf": (("at least", 8),),
    "ratio.openvdb": (("at least", 8),),
    "ratio.brick": (("at least", 1.65),),
    "ratio.brick_p99": (("at least", 1.65),),
    "ratio.brick_lists": (("at least", 1.1),),
    "build_s": (("at most", 30),),
    "build_s.exhibits": (("at most", 40),),
    "build_s.scan.100000": (("at most", 10),),
    "build_s.scan.1000000": (("at most", 60),),
    "ratio_wall.gimpact": (("at least", 1),),
    "ratio_wall.hulls": (("at least", 1),),
    "wall.ours.overlap_mm.p99": (("at most", 1),),
    "open.missed_pct": (("at most", 0.1),),
    "open.false_pct": (("at most", 0.1),),
    "open.depth_error_pct.p99": (("at most", 0.3),),
    "fit.recovered_pct.noise0": (("at least", 97),),
    "fit.recovered_pct.noise1": (("at least", 95),),
    "fit.recovered_pct.noise3": (("at least", 90),),
    "fit.ms.median": (("under", 20),),
}
# How each method goes by in tables and plots; what is not here goes by its own name.
NAMES = {OURS: "Mechane", "brick": "int16 brick, SIMD", "brick_lists": "int16 brick, near-lists", "brick_scalar": "int16 brick, scalar",
          "openvdb": "OpenVDB", "bt_sdf": "Bullet SDF",
         "embree": "Embree, exact", "paper": "the paper's search", "paper_along": "the same, depth along the normal", "fcl_contacts": "FCL contacts", "fcl_yesno": "FCL yes/no",
         "fcl_gjk": "FCL GJK, convex parts", "sqmap_avx512": "Mechane, AVX-512", "sqmap_avx2": "Mechane, AVX2",
         "sqmap_portable": "Mechane, no vectors", "sqmap_nobrick": "Mechane, no bricks", "sqmap_boxes": "Mechane, boxes",
         "ours": "Mechane", "gimpact": "Bullet, meshes (GImpact)", "hulls": "Bullet, convex hulls",
         "field": "Mechane, fields", "field_lists": "Mechane, fields, near-lists",
         "field_avx2": "Mechane, fields, AVX2", "field_portable": "Mechane, fields, no vectors"}
# What thread, staves and valves ask of maps; all models would take most of an hour (build/release/bin/bench_models measures any file).
SHIPPED = ("archimedes-screw", "ktesibios-pump")
# Of the meshes beside the repository: those that are open, judged against brute force.
OPEN = ("alligator", "beetle-alt", "woody")
MODEL_GRASP_METHODS = ("sqmap", "brick", "fcl_contacts")
WALL = ("ours", "gimpact", "hulls")  # bodies on bodies
MESH_METHODS = ("fcl_contacts", "fcl_yesno", "fcl_gjk")  # contacts of meshes, not depths of points: listed apart
IDLE_US = 2  # a step of FCL's below this met no sphere
BIN_STEPS = 10  # of the grasp's curve: the mean of so many steps is one point


def _methods(metrics: dict[str, float]) -> list[str]:
    """Everything that was timed, ours first, mesh methods last."""
    found = [name.split(".")[1] for name in metrics if name.startswith("step_us.") and name.endswith(".count")]
    return sorted(found, key=lambda name: (name in MESH_METHODS, not name.startswith((OURS, "field")), metrics[f"step_us.{name}.median"]))


def _objects(metrics: dict[str, float]) -> list[str]:
    start, end = f"step_us.{OURS}.", ".median"
    return [name[len(start):-len(end)] for name in metrics if name.startswith(start) and name.endswith(end) and name != start[:-1] + end]


def measure(context) -> tuple[Measured, list[str]]:
    """Queries, and the fit where its program was built."""
    result, missing = Measured(), []
    seed = [] if context.seed is None else ["--seed", str(context.seed)]
    shipped = [str(context.root / f"scenarios/models/{name}.glb") for name in SHIPPED]
    # Meshes from elsewhere that may lie beside the repository; most people have none.
    found = sorted(str(file) for kind in ("obj", "stl", "ply", "glb") for file in (context.root / "../shared/meshes").resolve().glob(f"*.{kind}"))
    if not found:
        result.notes.append("no meshes beside the repository (../shared/meshes): the shipped models alone")
    opened = [file for file in found if Path(file).stem in OPEN]
    closed = [file for file in found if file not in opened]
    exhibits = sorted(str(file) for file in context.root.glob("scenarios/*/*.x3d"))
    for program, arguments in (("bench_collision", seed), ("bench_models", [*shipped, *closed, *seed]), ("bench_open", [*opened, *seed]),
                               ("bench_wall", []), ("bench_build", exhibits), ("bench_fit", seed)):
        if program == "bench_fit" and not (context.bin / program).exists():
            continue
        print(f"  {program} ...", flush=True)
        try:
            part = own(context.bin, program, arguments, PROGRAM_LIMIT_S)
        except Missing as reason:
            missing.append(f"{program}: {reason}")
            continue
        result = Measured({**result.metrics, **part.metrics}, {**result.curves, **part.curves},
                          list(dict.fromkeys(result.notes + part.notes)))
    _add_memory(result)
    return result, missing


def _add_memory(result: Measured) -> None:
    """A plain distance field has a float where the brick has 16 bits."""
    if "bytes.brick" in result.metrics:
        result.metrics["bytes.distance_field"] = 2 * result.metrics["bytes.brick"]
        result.notes.append("bytes.distance_field: the brick's grid with a 32-bit float at each node")


def _shown(metrics: dict[str, float], metric: str, scale: float = 1) -> str:
    return number(metrics[metric] * scale) if metric in metrics else "-"


def _models(metrics: dict[str, float]) -> list[list[str]]:
    """A row for each mesh file's thing: what it takes, how exact it is, how fast beside its peers."""
    names = sorted({name.split(".")[1] for name in metrics if name.startswith("model.")})
    rows = [["", "triangles", "diag mm", "build s", "parts", "radial %", "KB", "brick KB", "err p99 %", "err p99 mm", "brick p99 %", "missed", "false",
             "step us", "brick us", "FCL us"]]
    for name in names:
        def show(metric: str, scale: float = 1) -> str:
            return _shown(metrics, f"model.{name}.{metric}", scale)

        rows.append([name, f"{metrics[f'model.{name}.triangles']:.0f}", show("diagonal_mm"), show("build_s"), show("parts"), show("share_radial", 100),
                     show("bytes.sqmap", 1e-3), show("bytes.brick", 1e-3), show("depth_error_pct.sqmap.p99"), show("depth_error_mm.sqmap.p99"),
                     show("depth_error_pct.brick.p99"), show("missed.sqmap"), show("false.sqmap"),
                     *(show(f"step_us.{method}.median") for method in MODEL_GRASP_METHODS)])
    return rows if names else []


def _open(metrics: dict[str, float]) -> list[list[str]]:
    """A row for each open or overlapping mesh."""
    names = sorted({name.split(".")[1] for name in metrics if name.startswith("open.") and name.endswith(".judged")})
    rows = [["open or overlapping", "triangles", "sheet", "build s", "parts", "KB", "judged", "measured", "err p99 %",
             "missed %", "false %"]]
    for name in names:
        rows.append([name, *(_shown(metrics, f"open.{name}.{metric}", scale) for metric, scale in
                             (("triangles", 1), ("sheet", 1), ("build_s", 1), ("parts", 1), ("bytes", 1e-3), ("judged", 1), ("measured", 1),
                              ("depth_error_pct.p99", 1), ("missed_pct", 1), ("false_pct", 1)))])
    return rows if names else []


def _built(metrics: dict[str, float]) -> list[list[str]]:
    """A row for each exhibit and for each number of triangles: how long it takes until a thing can be touched."""
    start = "build_cpu_s."
    names = [name[len(start):] for name in metrics if name.startswith(start)]
    rows = [["built from nothing", "s", "CPU s", "from kept parts s"]]
    for name in sorted(names, key=lambda name: (name.split(".")[0], int(name.split(".")[-1]) if name[-1].isdigit() else 0, name)):
        rows.append([name, *(_shown(metrics, f"{figure}.{name}") for figure in ("build_s", "build_cpu_s", "warm_s"))])
    return rows if names else []


def _wall(metrics: dict[str, float]) -> list[list[str]]:
    """A row for each way to let the wall of 30 blocks fall."""
    rows = [["falling wall of 30 blocks", "step us", "p99", "overlap mm", "p99", "max", "pairs"]]
    for name in WALL:
        rows.append([NAMES[name], *(_shown(metrics, f"wall_step_us.{name}.{q}") for q in ("median", "p99")),
                     *(_shown(metrics, f"wall.{name}.overlap_mm.{q}") for q in ("median", "p99", "max")),
                     _shown(metrics, f"wall.{name}.overlaps")])
    return rows if f"wall_step_us.{WALL[0]}.median" in metrics else []


def table(name: str, metrics: dict[str, float]) -> str:
    """One row for each method, then our figures object by object, then what neither table holds."""
    def show(metric: str, scale: float = 1) -> str:
        return _shown(metrics, metric, scale)

    methods, objects = _methods(metrics), _objects(metrics)
    lines_out = [f"\n{name}"]
    if methods:
        head = ["", "step us", "p99", "p99.9", "cold us", "x ours", "KB", "error p99 %", "missed", "false", "build s"]
        rows = [head]
        for method in methods:
            rows.append([NAMES.get(method, method), *(show(f"step_us.{method}.{q}") for q in ("median", "p99", "p999")),
                         show(f"cold_step_us.{method}.median"), show(f"ratio.{method}"),
                         show(f"bytes.{method}", 1e-3), show(f"depth_error_pct.{method}.p99"),
                         show(f"missed.{method}"), show(f"false.{method}"), show("build_s" if method == OURS else f"build_s.{method}")])
        lines_out += grid(rows)
    if objects:
        rows = [["", "step us", "p99", "brick us", "FCL us", "error p99 %", "error max %", "normal p99 deg", "missed", "false",
                 "parts", "KB", "radial KB", "brick KB", "peer KB"]]
        for thing in objects:
            rows.append([thing, show(f"step_us.{OURS}.{thing}.median"), show(f"step_us.{OURS}.{thing}.p99"),
                         show(f"step_us.brick.{thing}.median"), show(f"step_us.fcl_contacts.{thing}.median"),
                         show(f"depth_error_pct.{OURS}.{thing}.p99"), show(f"depth_error_pct.{OURS}.{thing}.max"),
                         show(f"normal_error_deg.{OURS}.{thing}.p99"), show(f"missed.{OURS}.{thing}"), show(f"false.{OURS}.{thing}"), show(f"parts.{thing}"),
                         show(f"bytes.{OURS}.{thing}", 1e-3), show(f"map_bytes.{thing}.radial", 1e-3), show(f"map_bytes.{thing}.brick", 1e-3),
                         show(f"bytes.brick.{thing}", 1e-3)])
        lines_out += ["", *grid(rows),
                      "  KB: our maps and what a part takes besides; radial, brick: the maps of either kind; peer: the int16 brick"]
    if models := _models(metrics):
        lines_out += ["", *grid(models)]
    if opened := _open(metrics):
        lines_out += ["", *grid(opened)]
    if wall := _wall(metrics):
        lines_out += ["", *grid(wall)]
    if built := _built(metrics):
        lines_out += ["", *grid(built)]
    rest = {metric: value for metric, value in metrics.items() if metric.split(".")[0] in ("scene", "fit", "share", "ratio_avx2", "hulls") and not metric.startswith("scene.first_step")}
    if rest:
        width = max(len(metric) for metric in rest)
        lines_out += ["", *(f"  {metric:<{width}}  {number(value):>12}" for metric, value in sorted(rest.items()))]
    return "\n".join(lines_out)


def _binned(curve: list[list[float]]) -> list[list[float]]:
    bins = [curve[i:i + BIN_STEPS] for i in range(0, len(curve), BIN_STEPS)]
    return [[part[0][0], sum(y for _, y in part) / len(part)] for part in bins]


def _cost(metrics: dict[str, float], kind: str) -> list[list[float]]:
    """Pairs (power of ten of the triangles, processor time) of balls of a kind."""
    start = f"build_cpu_s.{kind}."
    return sorted([math.log10(float(name[len(start):])), value] for name, value in metrics.items() if name.startswith(start))


def _share_of(curve: list[list[float]], base: list[list[float]]) -> list[list[float | None]]:
    """Per cent of the other curve; a break where the other has nothing near the hand and both do nothing."""
    return [[step, 100 * ours / theirs if theirs > IDLE_US else None] for (step, ours), (_, theirs) in zip(_binned(curve), _binned(base))]


def _grasps(metrics: dict[str, float], steps: float) -> list[tuple[float, float, str]]:
    """When which object is grasped: they come one after another."""
    start = "scene.first_step."
    firsts = sorted((value, name[len(start):]) for name, value in metrics.items() if name.startswith(start))
    ends = [first for first, _ in firsts[1:]] + [steps]
    return [(first, end, name) for (first, name), end in zip(firsts, ends)]


def plot(result: Measured, out: Path, machine: str) -> list[Path]:
    made, metrics = [], result.metrics
    methods = _methods(metrics)
    if methods:
        made.append(out / "collision-step.svg")
        rows = sorted(((NAMES.get(name, name), metrics[f"step_us.{name}.median"]) for name in methods), key=lambda row: row[1])
        bars(made[-1], "Contact query of a hand, one step", f"2048 points against five objects; median, logarithmic. {machine}",
             rows, "µs", logarithmic=True, ours=NAMES[OURS])
    base = result.curves.get("grasp.fcl_contacts")
    if base:
        made.append(out / "collision-grasp.svg")
        shown = {NAMES[name]: _share_of(result.curves[f"grasp.{name}"], base)
                 for name in (OURS, "brick", "openvdb", "embree", "fcl_gjk") if f"grasp.{name}" in result.curves}
        lines(made[-1], "A step of the grasp, as a share of FCL's trees of oriented boxes",
              f"the paper's Figure 15a with our data: per cent of FCL's contact query while the hand is near. {machine}", shown, "step", "%",
              _grasps(metrics, base[-1][0] + 1))
    sizes = [("distance field", "bytes.distance_field"), ("int16 brick", "bytes.brick"), ("OpenVDB, narrow band", "bytes.openvdb_narrow"),
             ("Mechane", f"bytes.{OURS}")]
    rows = [(label, metrics[name] / 1000) for label, name in sizes if name in metrics]
    if len(rows) > 1:
        made.append(out / "collision-memory.svg")
        triangles = metrics.get("scene.triangles", 0)
        bars(made[-1], "Memory of the scene", f"the paper's Figure 15b with our data: {triangles:.0f} triangles, equal depth error",
             rows, "KB", ours="Mechane")
    balls = {kind: _cost(metrics, kind) for kind in ("closed", "scan")}
    if all(balls.values()):
        made.append(out / "collision-build.svg")
        lines(made[-1], "Building a ball for touch, from nothing", f"processor time of all cores. {machine}", balls,
              "triangles, as a power of ten", "s")
    if "paper_map_mm" in result.curves:
        made.append(out / "collision-map.svg")
        _plot_map(made[-1], result.curves["paper_map_mm"])
    return made


def _plot_map(path: Path, rows: list[list[float | None]]) -> None:
    """Rows from pole to pole, both included; columns once around, the last at +180 degrees."""
    columns, last = len(rows[0]), len(rows) - 1
    around = [(max(0, (columns * (degrees + 180) / 360 - 0.5) / columns), f"{degrees}°".replace("-", "−")) for degrees in (-180, -90, 0, 90, 180)]
    up = [((last * (90 - degrees) / 180 + 0.5) / (last + 1), f"{degrees}°".replace("-", "−")) for degrees in (90, 45, 0, -45, -90)]
    heat_map(path, "The distance map of two spheres in one superquadric",
             "the paper's Figure 4 with our data: how far the surface lies under an ellipsoid; the light band is the waist", rows,
             "around, ω", "from pole to pole, η", "mm", around, up, "no hit")
