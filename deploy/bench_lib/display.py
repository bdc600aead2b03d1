"""What a picture costs: by pass, by size, for one eye and for two of full size; how long after a frame's receipt its picture is done; memory.
On a machine without a graphics card the processor draws."""

from fnmatch import fnmatchcase

from peers import Measured, Missing, own
from plots import bars, number

PROGRAM_LIMIT_S = 600
SCENES = ("village", "odometer")
PICTURES = (("mono", 1280, 720), ("mono", 1920, 1080), ("quad", 1280, 720), ("quad", 1920, 1080))  # quad: two eyes, each of the full size
PLACES = ("village", "archimedes-screw", "ktesibios-pump", "pulley-crane", "compound-pulley-crane", "catapult", "crossbow", "aiolos-sphere",
          "odometer")
QUALITIES = ("cached", "low")
CORES = 2  # whose processor time fps counts, however many there are and whatever else they do
FRAMES_PER_S = 1  # that the slowest machine draws: the time given says how many pictures count
AIMS = {
    "fps.cached.720p.min": (("at least", 25),),
    "fps.low.720p.min": (("at least", 12),),
    "ratio.stereo_over_mono": (("under", 1.6),),
    "frame_cpu_ms.other.p99": (("under", 5),),
    "*.eyes_ratio": (("under", 1.7),),
    "*.frame.wall_ms.median": (("under", 16.7),),  # 60 pictures a second, on a graphics card
}


def _key(scene: str, stereo: str, height: int) -> str:
    return f"{scene}.{stereo}{height}"


def measure(context) -> tuple[Measured, list[str]]:
    result, missing, drawn_by = Measured(), [], set()
    frames = max(5, int(context.seconds * FRAMES_PER_S / len(PICTURES)))

    def draw(key: str, scene: str, *options: str) -> None:
        scenario = str(context.root / f"scenarios/{scene}/{scene}.x3d")
        print(f"  bench_display, {key}, {frames} pictures ...", flush=True)
        try:
            one = own(context.bin, "bench_display", [scenario, *options, "--frames", str(frames)], PROGRAM_LIMIT_S)
        except Missing as reason:
            missing.append(f"display: {reason}")
            return
        drawn_by.update(one.notes)
        result.metrics.update({f"{key}.{name}": value for name, value in one.metrics.items()})

    for scene in SCENES:
        for stereo, width, height in PICTURES:
            draw(_key(scene, stereo, height), scene, "--stereo", stereo, "--width", str(width), "--height", str(height))
    for scene in SCENES:
        add_ratio(result.metrics, scene)
    # Each place in the third moment of its recorded visit, hands and parts moving; the village for two eyes as well.
    for quality in QUALITIES:
        for place in PLACES:
            visit = str(context.root / f"tests/golden/scenes/{place}.frames")
            for stereo in ("mono", "quad") if place == "village" else ("mono",):
                draw(f"moving.{quality}.{stereo}.{place}", place, "--quality", quality, "--stereo", stereo, "--visit", visit)
    add_frames_a_second(result.metrics)
    result.notes += [f"drawn by {name}" for name in sorted(drawn_by)]
    return result, missing


def add_frames_a_second(metrics: dict[str, float]) -> None:
    """Pictures a second by the processor's time, of the slowest place; and by the wall clock, which counts what else runs."""
    def values(pattern: str) -> list[float]:
        return [value for name, value in metrics.items() if fnmatchcase(name, pattern)]

    for quality in QUALITIES:
        cpu, wall = (values(f"moving.{quality}.mono.*.picture.{kind}") for kind in ("cpu_ms.mean", "wall_ms.median"))
        if cpu:
            metrics[f"fps.{quality}.720p.min"] = 1000 * CORES / max(cpu)
            metrics[f"fps.{quality}.720p.wall.min"] = 1000 / max(wall)
    other = values("moving.*.mono.*.other.cpu_ms.p99")
    if other:
        metrics["frame_cpu_ms.other.p99"] = max(other)
    one, two = (metrics.get(f"moving.low.{stereo}.village.picture.cpu_ms.mean") for stereo in ("mono", "quad"))
    if one and two:
        metrics["ratio.stereo_over_mono"] = two / one


def add_ratio(metrics: dict[str, float], scene: str) -> None:
    one, two = (metrics.get(f"{_key(scene, stereo, 720)}.frame.cpu_ms.median") for stereo in ("mono", "quad"))
    if one and two:
        metrics[f"{scene}.eyes_ratio"] = two / one


def table(name: str, metrics: dict[str, float]) -> str:
    keys = [_key(scene, stereo, height) for scene in SCENES for stereo, _, height in PICTURES]
    keys = [key for key in keys if f"{key}.frame.cpu_ms.median" in metrics]
    passes = sorted({metric.split(".")[2] for metric in metrics if metric.endswith(".cpu_ms.median")} - {"frame"})
    rows = [["CPU ms, all threads", "frame", "p99", *passes, "wall ms", "triangles", "frame to picture ms", "p99", "peak MiB"]]
    for key in keys:
        shown = [f"{key}.frame.cpu_ms.median", f"{key}.frame.cpu_ms.p99", *(f"{key}.{one}.cpu_ms.median" for one in passes), f"{key}.frame.wall_ms.median",
                 f"{key}.triangles", f"{key}.latency_ms.median", f"{key}.latency_ms.p99", f"{key}.peak_mib"]
        rows.append([key, *(number(metrics[metric]) if metric in metrics else "-" for metric in shown)])
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    text = [f"\n{name}", *("  " + "  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in rows)]
    for scene in SCENES:
        if f"{scene}.eyes_ratio" in metrics:
            text.append(f"  {scene}: two eyes of full size cost {number(metrics[f'{scene}.eyes_ratio'])} times one")
    for quality in QUALITIES:
        shown = [(place, metrics.get(f"moving.{quality}.mono.{place}.picture.cpu_ms.mean")) for place in PLACES]
        text += [f"  {quality}, {place}, things moving: {number(value)} ms of the processors a picture" for place, value in shown if value]
    return "\n".join(text)


def plot(result: Measured, out, machine: str) -> list:
    rows = sorted(((metric.removesuffix(".cpu_ms.median").replace("mono720.", ""), value) for metric, value in result.metrics.items()
                   if ".mono720." in metric and metric.endswith(".cpu_ms.median") and not metric.startswith(("moving", "frame"))),
                  key=lambda row: -row[1])
    rows = [(name, value) for name, value in rows if value >= 0.1]
    if not rows:
        return []
    made = out / "display-passes.svg"
    bars(made, "A picture of 1280x720, pass by pass", f"median processor time of all threads. {machine}", rows, "ms", logarithmic=True)
    return [made]
