#!/usr/bin/env python3
"""Writes the seeds of mesh_fuzz.cpp into corpus/mesh; the layout of the bytes stands there. What the fuzzer itself found is kept
beside them under names that begin with 'found_'."""

import math
import pathlib
import struct

FLOATS, AS_GIVEN, DECOMPOSED, BRICKS, LARGE, NO_SEAM = 1, 2, 4, 8, 16, 32
QUADS = ((3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def prism(ring, low, high):
    """The solid over a polygon that runs counter-clockwise and is seen whole from its first corner."""
    n = len(ring)
    vertices = [(x, y, low) for x, y in ring] + [(x, y, high) for x, y in ring]
    triangles = []
    for i in range(n):
        j = (i + 1) % n
        triangles += [(i, j, n + j), (i, n + j, n + i)]
    for i in range(1, n - 1):
        triangles += [(0, i + 1, i), (n, n + i, n + i + 1)]
    return vertices, triangles


def box(half, centre=(0, 0, 0)):
    ring = [(centre[0] + sx * half[0], centre[1] + sy * half[1]) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return prism(ring, centre[2] - half[2], centre[2] + half[2])


def joined(*meshes):
    vertices, triangles = [], []
    for v, t in meshes:
        triangles += [tuple(len(vertices) + i for i in one) for one in t]
        vertices += v
    return vertices, triangles


def turned(mesh):
    return mesh[0], [(a, c, b) for a, b, c in mesh[1]]


def encoded(flags, *meshes):
    data = bytes([flags, len(meshes) - 1])
    for vertices, triangles in meshes:
        data += bytes([len(vertices), len(triangles)])
        for vertex in vertices:
            data += struct.pack("<3f", *vertex) if flags & FLOATS else struct.pack("3b", *vertex)
        for triangle in triangles:
            data += bytes(triangle)
    return data


BOX = box((6, 4, 3))
L_SHAPE = prism([(0, 0), (20, 0), (20, 4), (4, 4), (4, 14), (0, 14)], -3, 3)
IN_METRES = [(0.05 * x, 0.04 * y, 0.03 * z) for x, y, z in box((1, 1, 1))[0]]


def with_vertex(value):
    return [(value, 0.04, 0.03)] + IN_METRES[1:], BOX[1]


SEEDS = {
    "box": encoded(0, BOX),
    "box_brick": encoded(BRICKS, BOX),
    "l_shape": encoded(DECOMPOSED, L_SHAPE),
    "l_shape_brick": encoded(DECOMPOSED | BRICKS, L_SHAPE),
    "parts_that_touch": encoded(AS_GIVEN, BOX, box((2, 2, 2), (8, 0, 0))),
    "open": encoded(0, (BOX[0], BOX[1][:-1])),
    "inverted": encoded(AS_GIVEN, turned(BOX)),
    "one_of_two_inverted": encoded(AS_GIVEN, BOX, turned(box((2, 2, 2), (9, 0, 0)))),
    "hollow": encoded(AS_GIVEN, joined(box((9, 9, 9)), turned(box((5, 5, 5))))),
    "self_intersecting": encoded(AS_GIVEN, joined(BOX, box((2, 9, 2), (1, 0, 1)))),
    "edge_of_four": encoded(AS_GIVEN, joined(box((3, 3, 3), (-3, -3, 0)), box((3, 3, 3), (3, 3, 0)))),
    "three_at_an_edge": encoded(AS_GIVEN, (BOX[0] + [(0, 0, 20)], BOX[1] + [(0, 1, 8)])),
    "duplicate": encoded(AS_GIVEN, (BOX[0], BOX[1] * 2)),
    "degenerate": encoded(AS_GIVEN, (BOX[0], BOX[1] + [(0, 0, 1), (2, 2, 2)])),
    "all_degenerate": encoded(AS_GIVEN, (BOX[0], [(0, 0, 1), (2, 2, 2)])),
    "needle": encoded(AS_GIVEN, box((100, 1, 0))),
    "two_triangles": encoded(0, ([(0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 0)], [(0, 1, 2), (0, 2, 3)])),
    "two_sides": encoded(0, ([(0, 0, 0), (9, 0, 0), (9, 9, 0)], [(0, 1, 2), (0, 2, 1)])),
    "empty": encoded(0, ([], [])),
    "no_triangles": encoded(0, (BOX[0], [])),
    "out_of_range": encoded(0, (BOX[0], BOX[1] + [(0, 1, 200)])),
    "a_hundred_metres": encoded(LARGE | AS_GIVEN, box((120, 90, 100))),
    "metres": encoded(FLOATS | AS_GIVEN, (IN_METRES, BOX[1])),
    "nan": encoded(FLOATS, with_vertex(math.nan)),
    "infinite": encoded(FLOATS, with_vertex(math.inf)),
    "huge": encoded(FLOATS, with_vertex(3e38)),
    "far_spike": encoded(FLOATS, with_vertex(-999.0)),
    "denormal": encoded(FLOATS, ([tuple(1e-41 * c for c in v) for v in BOX[0]], BOX[1])),
    "microscopic": encoded(FLOATS, ([tuple(1e-8 * c for c in v) for v in BOX[0]], BOX[1])),
    "sheet_of_a_micron": encoded(FLOATS | AS_GIVEN, ([(x, y, 1e-5 * z) for x, y, z in IN_METRES], BOX[1])),
}

if __name__ == "__main__":
    folder = pathlib.Path(__file__).parent / "corpus/mesh"
    folder.mkdir(parents=True, exist_ok=True)
    for name, data in SEEDS.items():
        (folder / name).write_bytes(data)
