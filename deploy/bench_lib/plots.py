"""Plain plots as SVG: tails of distributions, bars, lines, a map of values. No library: a plot is a few lines and some text."""

import math
from html import escape
from pathlib import Path

INK, QUIET, GRID, PAPER = "#1f1e1b", "#6b6a64", "#e4e2da", "#fcfcfb"
MUTED = "#a9bccf"  # of what stands beside the row that counts
COLOURS = ["#2a78d6", "#eb6834", "#1a9e77", "#7a5cc8", "#b3266e"]
FONT = "font-family='DejaVu Sans, Helvetica, Arial, sans-serif'"


def _text(x: float, y: float, text: str, size: int = 12, colour: str = INK, anchor: str = "start", weight: str = "normal") -> str:
    return (f"<text x='{x:.1f}' y='{y:.1f}' {FONT} font-size='{size}' font-weight='{weight}' fill='{colour}' "
            f"text-anchor='{anchor}'>{escape(text)}</text>")


def _line(x1: float, y1: float, x2: float, y2: float, colour: str = GRID) -> str:
    return f"<line x1='{x1:.1f}' y1='{y1:.1f}' x2='{x2:.1f}' y2='{y2:.1f}' stroke='{colour}'/>"


def _page(path: Path, width: int, height: int, title: str, subtitle: str, parts: list[str]) -> None:
    head = [f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {width} {height}' width='{width}' height='{height}'>",
            f"<rect width='{width}' height='{height}' fill='{PAPER}'/>",
            _text(24, 32, title, 16, weight="bold"), _text(24, 52, subtitle, 12, QUIET)]
    path.write_text("\n".join([*head, *parts, "</svg>\n"]))


def number(value: float) -> str:
    """Three digits that count. What is below 1e-9 is what rounding leaves of a zero."""
    if abs(value) < 1e-9:
        return "0"
    digits = max(0, 2 - math.floor(math.log10(abs(value))))
    return f"{value:,.{digits}f}"


def _marks(low: float, high: float) -> list[float]:
    """1, 2, 5 in each decade, as a logarithmic axis from low to high needs them."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    return [m * 10.0 ** d for d in decades for m in (1, 2, 5) if low <= m * 10.0 ** d <= high]


def _apart(wanted: list[float], gap: float) -> list[float]:
    """The same heights, moved down just enough that labels do not overlap."""
    placed = {}
    last = -math.inf
    for index in sorted(range(len(wanted)), key=lambda i: wanted[i]):
        last = max(wanted[index], last + gap)
        placed[index] = last
    return [placed[i] for i in range(len(wanted))]


def tails(path: Path, title: str, subtitle: str, series: dict[str, list[list[float]]]) -> None:
    """One line each: how long the slowest share of the samples took at least. `series`: name -> pairs (share slower, us)."""
    width, height, left, right, top, bottom = 760, 420, 64, 190, 76, 56
    every = [us for curve in series.values() for _, us in curve if us > 0]
    low, high = min(every) / 1.15, max(every) * 1.15
    far = min(beyond for curve in series.values() for beyond, _ in curve)

    def x(beyond: float) -> float:
        return left + (width - left - right) * math.log10(1 / beyond) / math.log10(1 / far)

    def y(us: float) -> float:
        return top + (height - top - bottom) * (1 - math.log(us / low) / math.log(high / low))

    parts = []
    for mark in _marks(low, high):
        parts += [_line(left, y(mark), width - right, y(mark)), _text(left - 8, y(mark) + 4, f"{mark:g}", 11, QUIET, "end")]
    for beyond, name in ((0.5, "median"), (0.1, "90 %"), (0.01, "99 %"), (0.001, "99.9 %"), (0.0001, "99.99 %")):
        if beyond >= far:
            parts += [_line(x(beyond), top, x(beyond), height - bottom),
                      _text(x(beyond), height - bottom + 18, name, 11, QUIET, "middle")]
    parts += [_text(left - 8, top - 10, "µs", 11, QUIET, "end"),
              _text((left + width - right) / 2, height - 14, "share of samples that are faster", 11, QUIET, "middle")]
    label_y = _apart([y(max(curve[-1][1], low)) + 4 for curve in series.values()], 32)
    for index, (name, curve) in enumerate(series.items()):
        colour = COLOURS[index % len(COLOURS)]
        points = " ".join(f"{x(beyond):.1f},{y(us):.1f}" for beyond, us in curve if us > 0)
        median = min(curve, key=lambda pair: abs(pair[0] - 0.5))[1]
        parts += [f"<polyline points='{points}' fill='none' stroke='{colour}' stroke-width='2.2' stroke-linejoin='round'/>",
                  _text(width - right + 10, label_y[index], name, 12, colour, weight="bold"),
                  _text(width - right + 10, label_y[index] + 14, f"median {number(median)} µs", 11, QUIET)]
    _page(path, width, height, title, subtitle, parts)


def bars(path: Path, title: str, subtitle: str, rows: list[tuple[str, float]], unit: str, *, logarithmic: bool = False,
         ours: str = "") -> None:
    """One bar each with its value at its end, from zero, or from below the shortest on a logarithmic scale. The row `ours` stands out."""
    left, right, top, step = max([150, *(8 * len(name) + 16 for name, _ in rows)]), 110, 72, 30
    width, height = 760, top + step * len(rows) + 24
    parts = []
    positive = [value for _, value in rows if value > 0]
    logarithmic = logarithmic and bool(positive)
    if logarithmic:
        low, high = 10 ** math.floor(math.log10(min(positive) / 1.5)), max(positive)
        for mark in _marks(low, high):
            x = left + (width - left - right) * math.log(mark / low) / math.log(high / low)
            parts.append(_line(x, top - 6, x, height - 20))
            if math.log10(mark) % 1 == 0 or high / low < 100:
                parts.append(_text(x, height - 6, f"{mark:g}", 11, QUIET, "middle"))
    longest = max((value for _, value in rows), default=0) or 1
    for index, (name, value) in enumerate(rows):
        share = math.log(max(value, low) / low) / math.log(high / low) if logarithmic else value / longest
        y, length = top + step * index, (width - left - right) * share
        colour = COLOURS[0] if name == ours or not ours else MUTED
        parts += [_text(left - 10, y + 15, name, 12, INK, "end", "bold" if name == ours else "normal"),
                  f"<rect x='{left}' y='{y}' width='{max(length, 1):.1f}' height='20' rx='2' fill='{colour}'/>",
                  _text(left + length + 8, y + 15, f"{number(value)} {unit}", 12, QUIET)]
    parts.append(_line(left, top - 6, left, height - 20, QUIET))
    _page(path, width, height, title, subtitle, parts)


def ranges(path: Path, title: str, subtitle: str, rows: list[tuple[str, float, float, float]], unit: str,
           limits: list[tuple[float, str]]) -> None:
    """One row each: three values that rise, as a mark on a band that ends in a tick, over a logarithmic axis; `limits` are lines with
    a name."""
    width, left, right, top, step = 760, 190, 90, 108, 30
    height = top + step * len(rows) + 44
    low = min(row[1] for row in rows) / 1.3
    high = max([row[3] for row in rows] + [value for value, _ in limits]) * 1.15

    def x(value: float) -> float:
        return left + (width - left - right) * math.log(max(value, low) / low) / math.log(high / low)

    bottom = top + step * len(rows)
    parts = []
    for mark in _marks(low, high):
        parts += [_line(x(mark), top - 6, x(mark), bottom), _text(x(mark), bottom + 18, f"{mark:g}", 11, QUIET, "middle")]
    parts.append(_text(left - 10, bottom + 18, unit, 11, QUIET, "end"))
    for value, name in limits:
        parts += [_line(x(value), top - 14, x(value), bottom, COLOURS[1]), _text(x(value), top - 34, f"{value:g}", 11, COLOURS[1], "middle"),
                  _text(x(value), top - 20, name, 11, COLOURS[1], "middle")]
    for index, (name, middle, far, farther) in enumerate(rows):
        y = top + step * index + step / 2
        parts += [_text(left - 10, y + 4, name, 12, INK, "end"),
                  f"<line x1='{x(middle):.1f}' y1='{y}' x2='{x(farther):.1f}' y2='{y}' stroke='{MUTED}' stroke-width='2'/>",
                  f"<rect x='{x(middle):.1f}' y='{y - 4}' width='{max(x(far) - x(middle), 1):.1f}' height='8' fill='{MUTED}'/>",
                  f"<line x1='{x(farther):.1f}' y1='{y - 6}' x2='{x(farther):.1f}' y2='{y + 6}' stroke='{COLOURS[0]}' stroke-width='2'/>",
                  f"<circle cx='{x(middle):.1f}' cy='{y}' r='5' fill='{COLOURS[0]}'/>",
                  _text(width - right + 8, y + 4, f"{number(middle)} – {number(farther)}", 11, QUIET)]
    _page(path, width, height, title, subtitle, parts)


def _pieces(curve: list[list[float | None]]) -> list[list[tuple[float, float]]]:
    """The stretches of a curve between its breaks."""
    pieces: list[list[tuple[float, float]]] = [[]]
    for x, y in curve:
        if y:
            pieces[-1].append((x, y))
        elif pieces[-1]:
            pieces.append([])
    return [piece for piece in pieces if piece]


def _curve(points: list[tuple[float, float]], colour: str, radius: float, broken: bool) -> str:
    """A line through points of the page, with a dot on each where `radius` is not 0."""
    way, dash = " ".join(f"{x:.1f},{y:.1f}" for x, y in points), " stroke-dasharray='7 5'" if broken else ""
    dots = [f"<circle cx='{x:.1f}' cy='{y:.1f}' r='{radius:g}' fill='{colour}'/>" for x, y in points] if radius else []
    return "".join([f"<polyline points='{way}' fill='none' stroke='{colour}' stroke-width='1.8' stroke-linejoin='round'{dash}/>", *dots])


def lines(path: Path, title: str, subtitle: str, series: dict[str, list[list[float | None]]], x_name: str, y_name: str,
          bands: list[tuple[float, float, str]] = (), *, logarithmic: bool = True, points: tuple[str, ...] = (),
          dashed: tuple[str, ...] = (), beside: dict[str, float] | None = None, limit: tuple[float, str] | None = None) -> None:
    """One line each over a plain x axis, y logarithmic or from zero. `series`: name -> pairs (x, y), y None where the line breaks;
    `bands`: stretches of x with a name. Few points are marked, smaller from line to line, so that equal ones are all seen.
    `points`: names of series that are open circles without a line; `dashed`: of broken lines; `beside`: a height for a series, a broken
    line of its colour; `limit`: a height with a name."""
    beside = beside or {}
    right = max(150, *(round(8.6 * len(name)) + 20 for name in series))  # room for the longest label
    width, height, left, top, bottom = 610 + right, 420, 64, 96, 56
    every = [y for curve in series.values() for _, y in curve if y] + [*beside.values()]
    low, high = _marks(min(every) / 10, min(every) / 1.05)[-1] if logarithmic else 0, max(every) * 1.15
    wide = logarithmic and high / low > 300  # decades alone
    low = 10 ** math.floor(math.log10(low)) if wide else low
    begin = min(x for curve in series.values() for x, _ in curve)
    end = max(x for curve in series.values() for x, _ in curve)

    def place_x(x: float) -> float:
        return left + (width - left - right) * (x - begin) / ((end - begin) or 1)

    def place_y(y: float) -> float:
        return top + (height - top - bottom) * (1 - (math.log(y / low) / math.log(high / low) if logarithmic else y / high))

    parts = []
    step = _round_step(high - low)
    for mark in _marks(low, high) if logarithmic else [step * i for i in range(math.floor(high / step) + 1)]:
        if not wide or math.log10(mark) % 1 == 0:
            parts += [_line(left, place_y(mark), width - right, place_y(mark)),
                      _text(left - 8, place_y(mark) + 4, f"{mark:g}", 11, QUIET, "end")]
    for first, last, name in bands:
        parts += [_line(place_x(first), top - 16, place_x(first), height - bottom),
                  _text(place_x((first + last) / 2), top - 8, name, 11, QUIET, "middle"),
                  _text(place_x(first), height - bottom + 18, f"{first:g}", 11, QUIET, "middle")]
    if not bands and end > begin:
        step = _round_step(end - begin)
        marks = [step * i for i in range(math.ceil(begin / step), math.floor(end / step) + 1)]
        parts += [_text(place_x(mark), height - bottom + 18, f"{mark:g}", 11, QUIET, "middle") for mark in marks]
    parts += [_text(24, top - 10, y_name, 11, QUIET), _text((left + width - right) / 2, height - 14, x_name, 11, QUIET, "middle")]
    if limit:
        parts += [_line(left, place_y(limit[0]), width - right, place_y(limit[0]), QUIET),
                  _text(width - right - 16, place_y(limit[0]) - 4, limit[1], 11, QUIET, "end")]
    label_y = _apart([place_y([y for _, y in curve if y][-1]) + 4 for curve in series.values()], 18)
    for index, (name, curve) in enumerate(series.items()):
        colour = COLOURS[index % len(COLOURS)]
        placed = [[(place_x(x), place_y(y)) for x, y in piece] for piece in _pieces(curve)]
        if name in points:
            parts += [f"<circle cx='{x:.1f}' cy='{y:.1f}' r='5' fill='none' stroke='{colour}' stroke-width='1.8'/>"
                      for piece in placed for x, y in piece]
        else:
            radius = 1 + 1.5 * (len(series) - index) if len(curve) <= 8 else 0
            parts += [_curve(piece, colour, radius, name in dashed) for piece in placed]
        if name in beside:
            parts.append(_curve([(x, place_y(beside[name])) for x in (left, width - right)], colour, 0, True))
        parts.append(_text(width - right + 10, label_y[index], name, 12, colour, weight="bold"))
    _page(path, width, height, title, subtitle, parts)


DEPTHS = ["#0d2b52", "#1b5aa6", "#5b9bdc", "#b9d6ee", "#fbf6e6"]  # of a map of values: from low, dark, to high, light
SHADES = 32


def _shade(share: float) -> str:
    place = min(max(share, 0), 1) * (len(DEPTHS) - 1)
    index = min(int(place), len(DEPTHS) - 2)
    low, high = (tuple(int(colour[i:i + 2], 16) for i in (1, 3, 5)) for colour in DEPTHS[index:index + 2])
    return "#" + "".join(f"{round(a + (b - a) * (place - index)):02x}" for a, b in zip(low, high))


def _round_step(span: float) -> float:
    """1, 2 or 5 times a power of ten, so that three to seven fit into the span."""
    power = 10.0 ** math.floor(math.log10(span / 3))
    return max(step * power for step in (1, 2, 5) if step * power <= span / 3)


def _cells(rows: list[list[float | None]], span: float, left: float, top: float, cell: float) -> list[str]:
    """One path for each shade: cells of the same shade that lie side by side are one rectangle."""
    runs: dict[int | None, list[str]] = {}
    for j, row in enumerate(rows):
        begin = 0
        shades = [None if value is None else min(int(max(value, 0) / span * SHADES), SHADES - 1) for value in row]
        for i in range(1, len(shades) + 1):
            if i == len(shades) or shades[i] != shades[begin]:
                wide = cell * (i - begin)
                runs.setdefault(shades[begin], []).append(f"M{left + cell * begin:g} {top + cell * j:g}h{wide:g}v{cell:g}h{-wide:g}z")
                begin = i
    return [f"<path d='{''.join(run)}' fill='{'url(#none)' if shade is None else _shade((shade + 0.5) / SHADES)}' "
            "shape-rendering='crispEdges'/>" for shade, run in runs.items()]


def heat_map(path: Path, title: str, subtitle: str, rows: list[list[float | None]], x_name: str, y_name: str, unit: str,
             x_marks: list[tuple[float, str]], y_marks: list[tuple[float, str]], none_name: str) -> None:
    """Values from 0 on as shades, top row first; None is hatched and goes by `none_name`. Marks: pairs of (share of the axis from the
    left or the top, text)."""
    left, top, cell = 64, 80, 5.6
    wide, high = cell * len(rows[0]), cell * len(rows)
    width, height = round(left + wide + 136), round(top + high + 60)
    span = max((value for row in rows for value in row if value is not None), default=0) or 1
    bare = any(value is None for row in rows for value in row)
    parts = ["<defs><pattern id='none' width='6' height='6' patternUnits='userSpaceOnUse' patternTransform='rotate(45)'>"
             f"<rect width='6' height='6' fill='{GRID}'/><rect width='1.5' height='6' fill='{QUIET}'/></pattern></defs>",
             *_cells(rows, span, left, top, cell)]
    for share, text in x_marks:
        x = left + share * wide
        parts += [_line(x, top + high, x, top + high + 5, QUIET), _text(x, top + high + 20, text, 11, QUIET, "middle")]
    for share, text in y_marks:
        y = top + share * high
        parts += [_line(left - 5, y, left, y, QUIET), _text(left - 9, y + 4, text, 11, QUIET, "end")]
    parts += [_text(left + wide / 2, height - 16, x_name, 12, QUIET, "middle"),
              f"<g transform='translate(18 {top + high / 2:.1f}) rotate(-90)'>{_text(0, 0, y_name, 12, QUIET, 'middle')}</g>"]
    bar, bar_high = left + wide + 36, high - (40 if bare else 0)
    parts += [f"<rect x='{bar}' y='{top + bar_high * (1 - (k + 1) / SHADES):.2f}' width='16' height='{bar_high / SHADES + 0.3:.2f}' "
              f"fill='{_shade((k + 0.5) / SHADES)}' shape-rendering='crispEdges'/>" for k in range(SHADES)]
    step = _round_step(span)
    for k in range(int(span / step + 1e-9) + 1):
        y = top + bar_high * (1 - k * step / span)
        parts += [_line(bar + 16, y, bar + 21, y, QUIET), _text(bar + 26, y + 4, f"{k * step:g}", 11, QUIET)]
    parts.append(_text(bar, top - 10, unit, 11, QUIET))
    if bare:
        parts += [f"<rect x='{bar}' y='{top + high - 16:.1f}' width='16' height='16' fill='url(#none)'/>",
                  _text(bar + 26, top + high - 4, none_name, 11, QUIET)]
    _page(path, width, height, title, subtitle, parts)
