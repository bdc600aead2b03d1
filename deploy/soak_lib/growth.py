"""Whether memory grows: a line that single peaks do not bend, through what came after the beginning."""

from dataclasses import dataclass
from statistics import median

JUDGED_SHARE = 2 / 3  # what is loaded once is loaded in the first third
LIMIT_MIB_PER_H = 12.0  # a week of it is 2 GiB: a kiosk is started anew before
LEAST_GROWTH_MIB = 4.0  # less, over all that was judged, is how allocators breathe; it decides in short runs alone


@dataclass
class Growth:
    slope_mib_per_h: float
    judged_h: float
    first_mib: float  # medians of the judged samples' first and last tenth
    last_mib: float
    samples: int

    @property
    def grown_mib(self) -> float:
        return self.slope_mib_per_h * self.judged_h

    @property
    def allowed_mib(self) -> float:
        return max(LIMIT_MIB_PER_H * self.judged_h, LEAST_GROWTH_MIB)

    @property
    def good(self) -> bool:
        return self.grown_mib <= self.allowed_mib


def thinned(samples: list[tuple[float, float]], most: int) -> list[tuple[float, float]]:
    """The medians of so many groups: all pairs of a night's samples would be too many."""
    if len(samples) <= most:
        return samples
    groups = [samples[i * len(samples) // most:(i + 1) * len(samples) // most] for i in range(most)]
    return [(median([t for t, _ in group]), median([m for _, m in group])) for group in groups]


def growth_of(samples: list[tuple[float, float]]) -> Growth:
    """Of (seconds, MiB), in the order of time, at least ten: the median of the slopes of all pairs (Theil, Sen)."""
    if len(samples) < 10:
        raise ValueError(f"{len(samples)} samples say nothing")
    end = samples[-1][0]
    begin = end - JUDGED_SHARE * (end - samples[0][0])
    judged = [sample for sample in samples if sample[0] >= begin]
    points = thinned(judged, 300)
    slopes = [(m2 - m1) / (t2 - t1) for i, (t1, m1) in enumerate(points) for t2, m2 in points[i + 1:] if t2 > t1]
    tenth = max(1, len(judged) // 10)
    return Growth(3600 * median(slopes), (judged[-1][0] - judged[0][0]) / 3600, median([m for _, m in judged[:tenth]]),
                  median([m for _, m in judged[-tenth:]]), len(judged))
