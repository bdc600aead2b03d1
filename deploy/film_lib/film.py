"""Records a visit at each place, cuts scenes for the picture tests from it, and makes the film. Standard library, ffmpeg for the film alone."""

import argparse
import dataclasses
import pathlib
import shutil
import subprocess
import sys
import time

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / folder) for folder in ("common_lib", "demo_lib")]
import recording  # noqa: E402
from running import Programs  # noqa: E402

DISSOLVE_S = 0.4
VISIT_LIMIT_S, DRAW_LIMIT_S = 300, 3600
SMALL = "640x360"
SHEET_PICTURE = "640x360"


@dataclasses.dataclass(frozen=True)
class Place:
    name: str
    activity: str
    clip: tuple[str, float]  # where the film begins, and for how many seconds
    moments: tuple[str, str, str, str]  # of the picture tests: start, middle, a telling one, end
    whole_hand: bool = True  # else one point: one place for the picture of it, and one whose visit a whole hand does not always complete

    @property
    def scenario(self) -> str:
        return f"scenarios/{self.name}/{self.name}.x3d"


PLACES = (
    Place("village", "choose", ("choose@0.62", 3), ("@0", "@0.5", "choose@0.8", "@1")),
    Place("archimedes-screw", "use", ("fill@0.2", 4), ("@0", "turn@0.5", "fill@0.5", "@1")),
    Place("ktesibios-pump", "use", ("steady@0.1", 4), ("@0", "stroke@0.5", "fill@0.5", "@1")),
    Place("pulley-crane", "use", ("lift@0.4", 4), ("@0", "lift@0.3", "guide@0.5", "@1"), whole_hand=False),
    Place("compound-pulley-crane", "use", ("lift@0.4", 4), ("@0", "lift@0.3", "guide@0.5", "@1")),
    Place("catapult", "use", ("shoot@0", 4), ("@0", "wind@0.5", "load@0.7", "@1")),
    Place("crossbow", "use", ("shoot@0", 4), ("@0", "wind@0.5", "lay@0.7", "@1"), whole_hand=False),
    Place("aiolos-sphere", "use", ("spin@0.3", 4), ("@0", "light@0.7", "spin@0.7", "@1")),
    Place("odometer", "use", ("mile@0.2", 4), ("@0", "push@0.5", "mile@0.5", "@1")),
)


def fail(text: str) -> None:
    sys.exit(f"film: {text}")


def wait_for(condition, limit_s: float, what: str) -> None:
    end = time.monotonic() + limit_s
    while not condition():
        if time.monotonic() > end:
            fail(f"not within {limit_s:.0f} s: {what}")
        time.sleep(0.05)


def record(programs: Programs, place: Place, out: pathlib.Path) -> None:
    """A visit, as a display hears it from before its beginning to after its end."""
    scenarios = [place.scenario]
    if place.name == "village":  # its signs lead somewhere
        scenarios += sorted(str(file) for file in pathlib.Path("scenarios").glob("*/*.x3d") if file.stem != place.name)
    file = out / f"{place.name}.frames"
    file.unlink(missing_ok=True)
    programs.start("server", "server", "--scenario", *scenarios, "--records", "")
    programs.wait_ready()
    programs.start("record", *recording.record("film", file))
    wait_for(lambda: file.exists() and file.stat().st_size > 20_000, 300, f"the kiosk has a world: see {out / 'record.log'}")
    hand = ["--glove"] if place.whole_hand else []
    programs.start("visitor", "visitor", *hand, "--kiosk", "film", "--scenario", place.scenario, "--activity", place.activity, "--linger", "0", "--report",
                   str(out / f"{place.name}.json"))
    if programs.wait("visitor", VISIT_LIMIT_S) != 0:
        fail(f"the visit of {place.name} was not completed: see {out / 'visitor.log'}")
    for name in ("record", "server"):
        if programs.stop(name) != 0:
            fail(f"{name} ended badly: see {out / (name + '.log')}")
    print(f"  recorded {file}, {file.stat().st_size / 1e6:.1f} MB", flush=True)


def cut(programs: Programs, place: Place, out: pathlib.Path) -> None:
    scene = pathlib.Path("tests/golden/scenes") / f"{place.name}.frames"
    subprocess.run([str(programs.bin_dir / "cut_scenes"), str(out / f"{place.name}.frames"), str(scene), *place.moments], check=True)
    print(f"  cut {scene}, {scene.stat().st_size / 1e3:.0f} kB", flush=True)


def draw(programs: Programs, place: Place, size: str, fps: int, folder: pathlib.Path) -> int:
    """Its clip, picture by picture; how many."""
    shutil.rmtree(folder, ignore_errors=True)
    name = f"draw-{folder.name}"
    programs.start(name, *recording.draw(folder.parent / f"{place.name}.frames", folder, size, "--play-from", place.clip[0], "--seconds",
                                         str(place.clip[1]), "--assets", f"scenarios/{place.name}", "--language", "en", "--film-fps", str(fps)))
    if programs.wait(name, DRAW_LIMIT_S) != 0:
        fail(f"{place.name} could not be drawn: see {programs.out / (name + '.log')}")
    return len(list(folder.glob("film-*.png")))


def ffmpeg(*arguments: str) -> None:
    subprocess.run(["ffmpeg", "-hide_banner", "-loglevel", "error", "-y", *arguments], check=True)


def dissolves(count: int, seconds: list[float]) -> str:
    """ffmpeg's filter: one place fades into the next, the last one into black."""
    text, last, at = "", "0:v", 0.0
    for i in range(1, count):
        at += seconds[i - 1] - DISSOLVE_S
        text += f"[{last}][{i}:v]xfade=transition=fade:duration={DISSOLVE_S}:offset={at:.3f}[v{i}];"
        last = f"v{i}"
    end = at + seconds[-1]
    return text + f"[{last}]fade=in:st=0:d=0.4,fade=out:st={end - 0.6:.3f}:d=0.6,format=yuv420p[out]"


def make_film(programs: Programs, places: list[Place], size: str, fps: int, out: pathlib.Path) -> None:
    inputs, seconds = [], []
    for place in places:
        folder = out / place.name
        began = time.monotonic()
        drawn = draw(programs, place, size, fps, folder)
        print(f"  drew {place.name}: {drawn} pictures, {time.monotonic() - began:.0f} s", flush=True)
        inputs += ["-framerate", str(fps), "-i", str(folder / "film-%05d-mono.png")]
        seconds.append(drawn / fps)
    film = out / "mechane.mp4"
    h264 = ("-c:v", "libx264", "-preset", "slow", "-movflags", "+faststart", "-an")
    ffmpeg(*inputs, "-filter_complex", dissolves(len(places), seconds), "-map", "[out]", *h264, "-crf", "19", str(film))
    small = out / "mechane-small.mp4"
    ffmpeg("-i", str(film), "-vf", f"scale={SMALL.replace('x', ':')}:flags=lanczos", *h264, "-crf", "27", str(small))
    print(f"  {film}: {sum(seconds) - DISSOLVE_S * (len(places) - 1):.0f} s; {small}: {small.stat().st_size / 1e6:.1f} MB")


def make_sheet(programs: Programs, places: list[Place], out: pathlib.Path) -> None:
    """Each place at its telling moment, three a row."""
    sheet = out / "sheet"
    shutil.rmtree(sheet, ignore_errors=True)
    sheet.mkdir()
    for i, place in enumerate(places):
        folder = out / f"one-of-{place.name}"
        shutil.rmtree(folder, ignore_errors=True)
        programs.start("sheet", *recording.draw(out / f"{place.name}.frames", folder, SHEET_PICTURE, "--play-from", place.moments[2], "--assets",
                                                f"scenarios/{place.name}", "--language", "en", "--frames", "1"))
        if programs.wait("sheet", DRAW_LIMIT_S) != 0:
            fail(f"{place.name} could not be drawn: see {out / 'sheet.log'}")
        shutil.move(str(folder / "frame-mono.png"), sheet / f"{i}.png")
        folder.rmdir()
    ffmpeg("-i", str(sheet / "%d.png"), "-vf", "tile=3x3", "-frames:v", "1", "-q:v", "4", str(out / "nine-places.jpg"))
    print(f"  {out / 'nine-places.jpg'}")


def main() -> int:
    parser = argparse.ArgumentParser(description="Records a visit at each place and makes the film.")
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--again", action="store_true", help="draw what was recorded before")
    parser.add_argument("--scenes", action="store_true", help="cut the picture tests' scenes; no film")
    parser.add_argument("--only", action="append", choices=[place.name for place in PLACES], default=[])
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--fps", type=int, default=25)
    options = parser.parse_args()
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    places = [place for place in PLACES if not options.only or place.name in options.only]
    if not options.scenes and shutil.which("ffmpeg") is None:
        fail("ffmpeg is not there: deploy/install-deps --film installs it")
    programs = Programs("film", options.bin.resolve(), out)
    try:
        for place in places:
            if not options.again:
                record(programs, place, out)
            if options.scenes:
                cut(programs, place, out)
        if not options.scenes:
            make_sheet(programs, places, out)
            make_film(programs, places, options.size, options.fps, out)
    finally:
        programs.stop_all()
    return 0


if __name__ == "__main__":
    sys.exit(main())
