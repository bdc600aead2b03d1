"""How a visit is recorded while it is played, and drawn afterwards, as slowly as the machine must: for the demo and the film."""

import pathlib


def record(kiosk: str, file: pathlib.Path) -> list[str]:
    """Records all that a display hears, without drawing: what draws misses steps on a slow machine."""
    return ["record", str(file), "--kiosk", kiosk]


def draw(file: pathlib.Path, out: pathlib.Path, size: str, *arguments: str) -> list[str]:
    """A display that draws of a recording what the arguments say, into a folder."""
    return ["display", "--play", str(file), "--offscreen", "--size", size, "--out", str(out), *arguments]
