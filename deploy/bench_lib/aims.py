"""Holds figures against their aims, for every benchmark. Its AIMS has for each figure, or pattern of figures, what that is to be."""

import operator
from dataclasses import dataclass
from fnmatch import fnmatchcase

import peers  # noqa: F401  # so that `text` is found
from plots import number
from text import grid

_HOLDS = {"at least": operator.ge, "at most": operator.le, "under": operator.lt}


@dataclass
class Judged:
    aim: str  # "at least 0.9, at most 1.1"
    met: bool


def judge(metrics: dict[str, float], aims: dict[str, tuple[tuple[str, float], ...]]) -> dict[str, Judged]:
    """Each figure that has an aim, in the order of the aims. A pattern such as `load_s.*` is for all figures that it matches."""
    return {name: Judged(", ".join(f"{word} {limit:,.12g}" for word, limit in limits),
                         all(_HOLDS[word](metrics[name], limit) for word, limit in limits))
            for pattern, limits in aims.items() for name in sorted(metrics) if fnmatchcase(name, pattern)}


def table(metrics: dict[str, float], judged: dict[str, Judged]) -> str:
    if not judged:
        return ""
    rows = [[name, number(metrics[name]), one.aim, "met" if one.met else "MISSED"] for name, one in judged.items()]
    return "\n".join(["", *grid([["figures that have an aim", "measured", "aim", ""], *rows])])
