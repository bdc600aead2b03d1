"""Plain shapes for what stands far off, and for flat work in relief: fewer faces than `modelling`'s, which are to be looked at closely."""
import math

import numpy as np

from modelling import cut_cube, frame_of, lathe, strip_uv


def box(shape, low, high, tile=1.4, slot=0, seed=0):
    """A box with sharp edges, uv by the direction that each face looks to."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    centre, half = (low + high) / 2, (high - low) / 2
    offset = np.random.default_rng(4000 + seed).uniform(0, 1, 2)
    seen = {}

    def vertex(c, _axis):
        if tuple(c) not in seen:
            seen[tuple(c)] = shape.points([centre + np.array(c) * half])[0]
        return seen[tuple(c)]

    def uv(c, _axis, u, v):
        return tuple((np.array([c[u] * half[u], c[v] * half[v]]) + centre[[u, v]]) / tile + offset)

    return cut_cube(shape, [[-1.0, 1.0]] * 3, vertex, uv, slot)


def beam(shape, start, end, width, height=None, up=(0, 1, 0), slot=0, seed=0):
    """A squared timber with sharp edges, grain along it."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    length = float(np.linalg.norm(end - start))
    if abs(np.dot(np.cross(up, end - start), np.cross(up, end - start))) < 1e-12:
        up = (1, 0, 0)
    side, top, _ = frame_of(end - start, up)
    x, y = width / 2, (height or width) / 2
    ring = [side * x - top * y, side * x + top * y, -side * x + top * y, -side * x - top * y]
    offset = np.random.default_rng(5000 + seed).uniform()
    return shape.loft([[start + r for r in ring], [end + r for r in ring]], lambda i, j: strip_uv(seed + j // 2, j % 2, offset + i * length / 2.3), slot,
                      cap_scale=0.9, cap_uv=(0.06 + seed % 8 / 8, 0.5))


def prism(shape, outline, back, front, slot=0, grain=True, tile=0.5):
    """An outline in x and y, counter-clockwise, from z `back` to `front`; as boards with upright grain, or with plain uv."""
    def flat(p):
        return (p[0] / 0.60 + 0.5, p[1] / 2.3) if grain else (p[0] / tile, p[1] / tile)

    low, high = shape.points([(x, y, back) for x, y in outline]), shape.points([(x, y, front) for x, y in outline])
    count = len(outline)
    shape.face(tuple(high), tuple(flat(p) for p in outline), slot)
    shape.face(tuple(low[::-1]), tuple(flat(p) for p in outline[::-1]), slot)
    run = 0.0
    for j in range(count):
        k = (j + 1) % count
        step = math.dist(outline[j], outline[k])
        a, b = run / 0.6, (run + step) / 0.6
        run += step
        shape.face((low[j], low[k], high[k], high[j]), ((a, 0), (b, 0), (b, 0.01), (a, 0.01)), slot)
    return shape


def circle(centre, radius, count=24, start=0.0, squash=1.0):
    return [(centre[0] + radius * math.cos(start + 2 * math.pi * k / count), centre[1] + squash * radius * math.sin(start + 2 * math.pi * k / count)) for k in range(count)]


def arc(centre, radius, start, stop, count=12):
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in np.linspace(start, stop, count)]


def stroke(shape, path, width, back, front, slot=0, closed=False):
    """A line of a width in relief along points in x and y."""
    path = [np.asarray(p, float) for p in path]
    count = len(path)
    sides = []
    for i, p in enumerate(path):
        before = path[i - 1] if i or closed else p
        after = path[(i + 1) % count] if i + 1 < count or closed else p
        a, b = p - before, after - p
        a, b = (v / np.linalg.norm(v) if np.linalg.norm(v) else None for v in (a, b))
        a, b = (b if a is None else a), (a if b is None else b)
        normal = np.array([-a[1] - b[1], a[0] + b[0]])
        normal = normal / np.linalg.norm(normal)
        reach = width / 2 / max(0.45, float(normal @ np.array([-a[1], a[0]])))
        sides.append((p + normal * reach, p - normal * reach))
    pairs = list(zip(range(count), range(1, count))) + ([(count - 1, 0)] if closed else [])
    for i, k in pairs:
        prism(shape, [tuple(sides[i][1]), tuple(sides[k][1]), tuple(sides[k][0]), tuple(sides[i][0])], back, front, slot, False)
    return shape


def put(shape, piece, at=(0, 0, 0), turn=0.0, tilt=None, slots=None):
    """Adds a piece that was made about the origin: turned about y (and first by a matrix `tilt`), then moved; `slots` renumbers its materials."""
    c, s = math.cos(turn), math.sin(turn)
    turned = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) @ (np.eye(3) if tilt is None else tilt)
    first = len(shape.vertices)
    shape.vertices += [tuple(turned @ np.array(v) + at) for v in piece.vertices]
    for face, uvs, slot in zip(piece.faces, piece.uvs, piece.slots):
        shape.face(tuple(i + first for i in face), uvs, slots[slot] if slots else slot)
    return shape


def pole(shape, start, end, radius, end_radius=None, sides=8, slot=0, seed=0):
    """A round pole or column, its ends closed."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    length = float(np.linalg.norm(end - start))
    up = (0, 1, 0) if abs(end[1] - start[1]) < 0.9 * length else (0, 0, 1)
    last = radius if end_radius is None else end_radius
    profile = [(0, 0), (radius, 0), (last, length), (0, length)]
    return lathe(shape, profile, sides, start, end - start, up, slots=[slot] * 3, uv_scale=(max(0.12, radius * 6), 1 / 2.3), uv_offset=(0.13 * seed, 0.37 * seed))


def gable(shape, x, low, high, z, thick, slots=(0, 0), over=0.25):
    """A saddle roof with its ridge along z: two slopes of some thickness; `x` and `z` are pairs, `low` at the eaves, `high` at the ridge."""
    middle = (x[0] + x[1]) / 2
    for side in (-1, 1):
        eave = x[0] if side < 0 else x[1]
        slope = np.array([eave - middle, low - high])
        edge = np.array([eave, low]) + slope / np.linalg.norm(slope) * over
        run = float(np.linalg.norm(edge - (middle, high)))
        ridge_top, edge_top = (middle, high + thick), (edge[0], edge[1] + thick)
        i = shape.points([(p[0], p[1], q) for p in (ridge_top, edge_top, tuple(edge), (middle, high)) for q in z])
        across = (z[1] - z[0]) / 0.5
        order = lambda *c: c if side > 0 else c[::-1]
        faces = (((1, 3, 2, 0), ((0, 0), (0, run / 0.5), (across, run / 0.5), (across, 0)), 0), ((3, 5, 4, 2), ((0, 0), (0, 0.1), (across, 0.1), (across, 0)), 0),
                 ((5, 7, 6, 4), ((0, 0), (0, 1), (1, 1), (1, 0)), 1), ((1, 7, 5, 3), ((0, 0), (0.1, 0), (0.1, 1), (0, 1)), 0), ((0, 2, 4, 6), ((0, 0), (0, 1), (0.1, 1), (0.1, 0)), 0))
        for face, uvs, slot in faces:
            shape.face(tuple(i[c] for c in order(*face)), uvs if side > 0 else uvs[::-1], slots[slot])
    return shape


def sheet(shape, rows, tile=1.0, slot=0, level=False):
    """A cloth or a strip through rows of points; uv by their order, or (`level`) by x and z."""
    index = [shape.points(r) for r in rows]

    def uv(i, j):
        return (rows[i][j][0] / tile, rows[i][j][2] / tile) if level else (i / tile, j / tile)

    for i in range(len(rows) - 1):
        for j in range(len(rows[0]) - 1):
            shape.face((index[i][j], index[i][j + 1], index[i + 1][j + 1], index[i + 1][j]), (uv(i, j), uv(i, j + 1), uv(i + 1, j + 1), uv(i + 1, j)), slot)
    return shape


def flames(shape, rng, foot, count, spread, tallest):
    """Tongues of fire about a place, v from foot to tip."""
    for _ in range(count):
        at = np.asarray(foot, float) + (rng.normal(0, spread), 0, rng.normal(0, spread))
        h = tallest * rng.uniform(0.45, 1.0) * math.exp(-((at[0] - foot[0]) ** 2 + (at[2] - foot[2]) ** 2) / (4 * spread**2))
        sway, r = rng.uniform(0, 6.28), 0.10 * tallest * rng.uniform(0.7, 1.2)
        rings = []
        for t in np.linspace(0, 1, 7):
            middle = at + (0.5 * r * t * math.sin(4 * t + sway), h * t, 0.5 * r * t * math.cos(5 * t + sway))
            rings.append([middle + r * (math.sin(math.pi * (0.18 + 0.81 * t)) * (1 - 0.5 * t)) * np.array([math.cos(a), 0, -math.sin(a)]) for a in np.arange(6) * math.pi / 3])
        shape.loft(rings, lambda i, j: (j / 6, min(0.98, i / 6)), cap_scale=0.0, cap_uv=(0.5, 0.9))
    return shape
