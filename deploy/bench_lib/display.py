"""What a picture costs: by pass, by size, for one eye and for two of full size; how long after a frame's receipt its picture is done; memory.
On a machine without a graphics card the processor draws."""

from peers import Measured, Missing, own
from plots import bars, number

PROGRAM_LIMIT_S = 600
SCENES = ("village", "odometer")
PICTURES = (("mono", 1280, 720), ("mono", 1920, 1080), ("quad", 1280, 720), ("quad", 1920, 1080))  # quad: two eyes, each of the full size
FRAMES_PER_S = 1  # that the slowest machine draws: the time given says how many pictures count
AIMS = {
    "*.eyes_ratio": (("under", 1.7),),
    "*.frame.wall_ms.median": (("under", 16.7),),  # 60 pictures a second, on a graphics card
}


def _key(scene: str, stereo: str, height: int) -> str:
    return f"{scene}.{stereo}{height}"


def measure(context) -> tuple[Measured, list[str]]:
    result, missing, drawn_by = Measured(), [], set()
    frames = max(5, int(context.seconds * FRAMES_PER_S / len(PICTURES)))
    for scene in SCENES:
        scenario = context.root / f"scenarios/{scene}/{scene}.x3d"
        for stereo, width, height in PICTURES:
            print(f"  bench_display, {scene}, {stereo} {width}x{height}, {frames} pictures ...", flush=True)
            try:
                one = own(context.bin, "bench_display", [str(scenario), "--stereo", stereo, "--width", str(width), "--height", str(height), "--frames", str(frames)],
                          PROGRAM_LIMIT_S)
            except Missing as reason:
                missing.append(f"display: {reason}")
                continue
            drawn_by.update(one.notes)
            result.metrics |= {f"{_key(scene, stereo, height)}.{name}": value for name, value in one.metrics.items()}
    for scene in SCENES:
        add_ratio(result.metrics, scene)
    result.notes += [f"drawn by {name}" for name in sorted(drawn_by)]
    return result, missing


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
    return "\n".join(text)


def plot(result: Measured, out, machine: str) -> list:
    rows = sorted(((metric.removesuffix(".cpu_ms.median").replace("mono720.", ""), value) for metric, value in result.metrics.items()
                   if ".mono720." in metric and metric.endswith(".cpu_ms.median") and not metric.startswith("frame")), key=lambda row: -row[1])
    rows = [(name, value) for name, value in rows if value >= 0.1]
    if not rows:
        return []
    made = out / "display-passes.svg"
    bars(made, "A picture of 1280x720, pass by pass", f"median processor time of all threads. {machine}", rows, "ms", logarithmic=True)
    return [made]
