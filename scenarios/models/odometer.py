"""Models Vitruvius' odometer on its cart, part by part, and writes odometer.glb.

    blender -b --python odometer.py -- odometer.glb [PICTURES]        (Blender 3.4, with python3-numpy)

With PICTURES, the beginning of a path, it also renders the odometer put together and taken apart. Form: Vitruvius, De architectura X.9.
Metres, glTF's axes (y up); the visitor looks along -z, and the cart goes to the right.

Nodes at the root, all with identity transforms, each loose part in its own frame; where that frame is when the odometer is put together is
in PLACES, and where it waits to be put in, in LOOSE:
  CART          bed, axle and case, in the world's frame      CHANNEL   that the pebbles run down, in the world's frame
  WHEEL         origin at its middle; turns about z           TOOTH     the hub's drum; its one tooth points down
  DRUM          400 teeth round it, 80 pegs on its side; origin at its middle; turns about z
  FLAT          origin on its axis, at its lower face; turns about y; its first hole is at x = r cos(27 deg), z = -r sin(27 deg)
  PEBBLE        origin at its middle                          VESSEL    origin at the middle of its foot
  PANE          the case's transparent side; origin at its middle
  ROLLER        on which the wheel turns; origin at its middle; turns about z
  FLOOR, SCENE  what things fall on; what never moves and is not touched
Children named part_* are touched as well as drawn, and are closed and convex or nearly so; children named visual_* are drawn only.
"""
import math
import os
import sys
import tempfile

import bpy
import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from modelling import Model, Shape, block, export, lathe, paving, picture, shell, strip_uv, timber, to_blender, tube  # noqa: E402
from surfaces import Textures, material, mix, museum_materials  # noqa: E402

WHEEL_R, WHEEL_Y, WHEEL_Z = 0.592, 0.66, 0.10  # four feet across
SPOKES, GRIP_R, GRIP_ANGLE, GRIP_Z = 10, 0.30, math.radians(54), 0.11  # the grip stands on a spoke; GRIP_Z: its middle
HUB_R, HUB_BACK, HUB_FRONT, ARM_R = 0.085, -0.155, 0.15, 0.033
ROLLER_R, ROLLER_X, ROLLER_Y = 0.05, 0.27, 0.078
GEAR_Z, TOOTH_R, TOOTH_TIP, TOOTH_HALF = -0.085, 0.10, 0.125, 0.025
DRUM_Y, DRUM_TIP, DRUM_ROOT, DRUM_WOOD, DRUM_HALF, TEETH = 1.10, 0.320, 0.3155, 0.297, 0.015, 400
PEGS, PEG_R, PEG_END = 80, 0.290, -0.041  # pegs' circle, and how far back they reach
FLAT_Y, FLAT_Z, FLAT_R, FLAT_TOP, HOLE_CIRCLE, HOLES, HOLE_R, FIRST_HOLE = 1.443, -0.1615, 0.150, 0.030, 0.115, 12, 0.0205, math.radians(27)
PLATE_Y, PEBBLE_R, PEBBLE_UP = 1.436, 0.017, 0.010  # PEBBLE_UP: its middle over the drum's lower face
CASE_X, CASE_LOW, CASE_TOP, CASE_BACK = 0.42, 0.80, 1.425, -0.30
CHANNEL_FROM, CHANNEL_TO, SPOUT_X = (0.080, 1.408), (0.475, 1.232), 0.535  # the middle of its floor's top
VESSEL_X, SHELF_Y = 0.535, 1.05
LEFT_TOP, RIGHT_TOP = 0.42, 0.62

PLACES = {
    "WHEEL": (0, WHEEL_Y, WHEEL_Z),
    "TOOTH": (0, WHEEL_Y, GEAR_Z),
    "DRUM": (0, DRUM_Y, GEAR_Z),
    "FLAT": (0, FLAT_Y, FLAT_Z),
    "VESSEL": (VESSEL_X, SHELF_Y + 0.001, FLAT_Z),
    "PANE": (0, 0.5 * (CASE_LOW + CASE_TOP), 0.031),
    "ROLLER": (ROLLER_X, ROLLER_Y, WHEEL_Z),
}
LOOSE = {
    "WHEEL": (-1.15, 0.60, -0.20),
    "TOOTH": (-0.72, LEFT_TOP + 0.128, 0.48),
    "DRUM": (-1.06, LEFT_TOP + DRUM_TIP + 0.004, 0.28),
    "FLAT": (0.82, RIGHT_TOP + 0.080, 0.34),
    "VESSEL": (1.17, RIGHT_TOP + 0.001, 0.42),
    "PANE": (1.02, RIGHT_TOP + 0.5 * (CASE_TOP - CASE_LOW) + 0.002, 0.115),
}


def make_materials(textures):
    made = museum_materials(textures)
    made["pane"] = material("pane", base=(0.80, 0.88, 0.90, 0.14), roughness=0.05, two_sided=True)
    made["dark"] = material("dark", base=(0.030, 0.022, 0.016, 1), roughness=0.95)
    made["iron"] = material("iron", base=(0.115, 0.098, 0.088, 1), roughness=0.55, metallic=0.75)
    made["pebble"] = material("pebble", base=(0.50, 0.46, 0.39, 1), roughness=0.6)
    return made


# Shapes --------------------------------------------------------------------------------------------------------------------------


def plank_uv(x, y):
    """Of a face sawn from boards side by side, grain along y."""
    return ((x + 0.3) / 0.6, y / 2.3)


def circle(radius, z, count, start=0.0):
    return [(radius * math.cos(a), radius * math.sin(a), z) for a in start + np.arange(count) * 2 * math.pi / count]


def boarded_disc(shape, inner, outer, low, high, count=72, bevel=0.003, slot=0):
    """A wheel of boards about z, with a hole."""
    profile = [(inner, low), (outer - bevel, low), (outer, low + bevel), (outer, high - bevel), (outer - bevel, high), (inner, high)]
    rings = [shape.points(circle(r, z, count)) for r, z in profile]
    for i in range(len(profile)):
        n = (i + 1) % len(profile)
        for j in range(count):
            k = (j + 1) % count
            corners = (rings[i][j], rings[i][k], rings[n][k], rings[n][j])
            if i in (0, 4):
                uvs = tuple(plank_uv(*shape.vertices[c][:2]) for c in corners)
            else:
                along = {0: profile[i][1], 1: profile[n][1]}
                uvs = tuple(strip_uv(3, 0.2 + 8 * along[b], a * outer * 2 * math.pi / count / 2.3) for a, b in ((j, 0), (j + 1, 0), (j + 1, 1), (j, 1)))
            shape.face(corners, uvs, slot)
    return shape


def toothed_ring(shape, inner, root, tip, half, teeth):
    """A ring about z with `teeth` pointed teeth round it."""
    outline, pitch = [], 2 * math.pi / teeth
    for t in range(teeth):
        for share, r in ((-0.36, root), (-0.14, tip), (0.14, tip), (0.36, root)):
            outline.append((r, (t + share) * pitch))
    count = len(outline)
    rings = []
    for z, of_teeth in ((-half, False), (-half, True), (half, True), (half, False)):
        rings.append(shape.points([((r if of_teeth else inner) * math.cos(a), (r if of_teeth else inner) * math.sin(a), z) for r, a in outline]))
    for i in range(3):
        for j in range(count):
            k = (j + 1) % count
            corners = (rings[i][j], rings[i][k], rings[i + 1][k], rings[i + 1][j])
            flat = tuple((shape.vertices[c][0] * 3 + shape.vertices[c][2] * 5, shape.vertices[c][1] * 3) for c in corners)
            shape.face(corners, flat)
    return shape


def peg(shape, start, end, radius, sides=10, slot=0):
    """A pin with a rounded end."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    length = np.linalg.norm(end - start)
    profile = [(0.0, 0.0), (radius, 0.0), (radius, length - 0.3 * radius), (0.7 * radius, length), (0.0, length)]
    up = (0, 1, 0) if abs((end - start)[1]) < 0.7 * length else (0, 0, 1)
    return lathe(shape, profile, sides, start, end - start, up, slots=[slot] * 4, uv_scale=(0.3, 5))


def hoop(shape, outline, axis=(0, 0, 1), tiles=(2, 5)):
    """A thin band about an axis; its (radius, height) outline is open towards the axis."""
    return lathe(shape, outline, 56, (0, 0, 0), axis, (0, 0, 1) if axis[1] else (0, 1, 0), uv_scale=tiles)


def board(shape, low, high, along, seed, bevel=0.003, rough=0.0006):
    """A sawn board that fills the box, grain along an axis. What is touched is not rough: it is fitted the sooner."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    middle, size = (low + high) / 2, high - low
    start, end = middle.copy(), middle.copy()
    start[along], end[along] = low[along], high[along]
    up = 1 if along != 1 else 2
    side = 3 - along - up
    return timber(shape, start, end, size[side], size[up], up=np.eye(3)[up], bevel=bevel, seed=seed, rough=rough)


# Parts ---------------------------------------------------------------------------------------------------------------------------


def wheel_shapes(touched):
    """(name, shape, materials) of a wheel about z. The near one is touched by rim, spokes, hub and grip."""
    part = "part" if touched else "visual"
    sector = 2 * math.pi / SPOKES
    rim = [(0.520, -0.026), (0.524, -0.030), (0.580, -0.030), (0.584, -0.026), (0.584, 0.026), (0.580, 0.030), (0.524, 0.030), (0.520, 0.026)]
    for k in range(SPOKES):
        shape = Shape()
        count = 7
        angles = np.linspace((k - 0.5) * sector + (0.002 if k % 2 else 0), (k + 0.5) * sector - (0 if k % 2 else 0.002), count) + GRIP_ANGLE
        rings = [[(r * math.cos(a), r * math.sin(a), z) for r, z in reversed(rim)] for a in angles]
        us = (0.02, 0.1, 0.4, 0.5, 0.6, 0.9, 0.95, 0.98, 1.0)
        shape.loft(rings, lambda i, j, k=k, us=us: strip_uv(k * 3, us[j], 0.37 * k + i * 0.58 * sector / 6 / 1.6), cap_uv=((k % 8 + 0.4) / 8, 0.3))
        yield f"{part}_felloe_{k}", shape, ["planks"], 35
    for k in range(SPOKES):
        a = GRIP_ANGLE + k * sector
        out = np.array([math.cos(a), math.sin(a), 0])
        spoke = timber(Shape(), out * 0.075, out * 0.524, 0.046, 0.038, up=(0, 0, 1), bevel=0.011, seed=20 + k, rough=0.0, taper=0.80)
        yield f"{part}_spoke_{k}", spoke, ["planks"], 40
    hub = [(0.0, HUB_BACK), (0.066, HUB_BACK), (0.070, HUB_BACK + 0.006), (0.074, -0.07), (HUB_R, -0.035), (HUB_R, 0.035), (0.074, 0.07), (0.066, HUB_FRONT - 0.006),
           (0.062, HUB_FRONT), (0.0, HUB_FRONT)]
    yield f"{part}_hub", lathe(Shape(), hub, 40, uv_scale=(0.9, 0.6), end_grain=(0, 8)), ["planks"], 30
    iron = Shape()
    shell(iron, [(0.584, -0.029), (0.592, -0.027), (0.592, 0.027), (0.584, 0.029)], 0, 2 * math.pi, 96, axis=(0, 0, 1), up=(0, 1, 0), uv=(8, 4), caps=False)
    for z, r in ((-0.138, 0.0715), (-0.060, 0.0775), (0.060, 0.0775), (0.132, 0.0685)):
        shell(iron, [(r - 0.004, z - 0.012), (r + 0.004, z - 0.012), (r + 0.004, z + 0.012), (r - 0.004, z + 0.012)], 0, 2 * math.pi, 40, axis=(0, 0, 1), up=(0, 1, 0), uv=(2, 4), caps=False)
    yield "visual_tyre", iron, ["iron"], 180
    pins = Shape()
    for k in range(SPOKES):
        for side in (-1, 1):
            a = GRIP_ANGLE + (k + 0.30 * side) * sector
            out = np.array([0.592 * math.cos(a), 0.592 * math.sin(a), 0])
            peg(pins, out * 0.995, out * 1.004, 0.010, 8)
    lathe(pins, [(0.0, 0.0), (0.041, 0.0), (0.041, 0.006), (0.036, 0.016), (0.012, 0.022), (0.0, 0.022)], 32, (0, 0, HUB_FRONT), uv_scale=(1, 5))
    yield "visual_nails", pins, ["bronze"], 40


def make_wheel(model):
    wheel = model.group("WHEEL")
    for name, shape, materials, smooth in wheel_shapes(True):
        model.add(name, shape, materials, wheel, smooth)
    x, y = GRIP_R * math.cos(GRIP_ANGLE), GRIP_R * math.sin(GRIP_ANGLE)
    handle = [(0.0, -0.060), (0.013, -0.060), (0.016, -0.054), (0.0175, -0.03), (0.0185, 0.0), (0.0175, 0.03), (0.016, 0.054), (0.013, 0.060), (0.0, 0.060)]
    model.add("part_grip", lathe(Shape(), handle, 28, (x, y, GRIP_Z), uv_scale=(0.115, 1.2), uv_offset=(0.13, 0.3)), ["grip"], wheel, 45)
    shape = Shape()
    lathe(shape, [(0.0, 0.014), (0.027, 0.014), (0.027, 0.024), (0.018, 0.032), (0.012, 0.052), (0.0, 0.052)], 24, (x, y, 0), uv_scale=(1, 5))
    lathe(shape, [(0.0, 0.168), (0.013, 0.168), (0.014, 0.174), (0.010, 0.181), (0.0, 0.183)], 20, (x, y, 0), uv_scale=(1, 5))
    model.add("visual_pin", shape, ["bronze"], wheel, 40)


def make_tooth(model):
    tooth = model.group("TOOTH")
    shape = boarded_disc(Shape(), 0.034, TOOTH_R, -TOOTH_HALF, TOOTH_HALF, 56)
    model.add("part_drum", shape, ["timber"], tooth, 35)
    shape = Shape()
    for z in (-0.017, 0.017):
        hoop(shape, [(TOOTH_R - 0.002, z - 0.006), (TOOTH_R + 0.0022, z - 0.006), (TOOTH_R + 0.0022, z + 0.006), (TOOTH_R - 0.002, z + 0.006)])
    block(shape, (-0.006, -TOOTH_R - 0.006, -0.020), (0.006, -TOOTH_R + 0.030, 0.0275), 0.0015, 4, 0.0, 0.3)
    half = 0.0030
    wedge = [[(s * w, -r, z) for s, z in ((-1, -0.014), (1, -0.014), (1, 0.014), (-1, 0.014))] for r, w in ((TOOTH_R + 0.004, 0.0050), (TOOTH_TIP - 0.006, half), (TOOTH_TIP, 0.0012))]
    shape.loft(wedge, lambda i, j: (0.1 * j, 0.2 * i))
    for s in (-1, 1):  # dowels that the hub takes it along by
        peg(shape, (s * 0.055, 0, 0.02), (s * 0.055, 0, TOOTH_HALF + 0.004), 0.008)
    lathe(shape, [(0.034, -0.0285), (0.047, -0.0285), (0.049, -0.024), (0.034, -0.024)], 40, uv_scale=(1, 5))
    lathe(shape, [(0.034, 0.024), (0.049, 0.024), (0.047, 0.0285), (0.034, 0.0285)], 40, uv_scale=(1, 5))
    model.add("visual_tooth", shape, ["bronze"], tooth, 40)


def make_drum(model):
    drum = model.group("DRUM")
    model.add("part_disc", boarded_disc(Shape(), 0.016, DRUM_WOOD, -DRUM_HALF, DRUM_HALF, 96), ["timber"], drum, 35)
    boss = [(0.017, 0.012), (0.034, 0.012), (0.034, 0.062), (0.030, 0.068), (0.017, 0.068)]
    model.add("part_boss", lathe(Shape(), boss, 32, uv_scale=(0.5, 1.2), uv_offset=(0.51, 0.2)), ["grip"], drum, 35)
    model.add("visual_teeth", toothed_ring(Shape(), DRUM_WOOD - 0.006, DRUM_ROOT, DRUM_TIP, 0.0165, TEETH), ["bronze"], drum, 25)
    shape = Shape()
    for k in range(PEGS):
        a = 2 * math.pi * (k + 0.5) / PEGS + math.pi / 2
        x, y = PEG_R * math.cos(a), PEG_R * math.sin(a)
        peg(shape, (x, y, -DRUM_HALF + 0.002), (x, y, PEG_END), 0.0046, 8)
    for k in range(4):
        a = math.pi / 4 + k * math.pi / 2
        out, across = np.array([math.cos(a), math.sin(a), 0]), np.array([-math.sin(a), math.cos(a), 0])
        for side in (-1, 1):
            ends = [[out * r + across * w * 0.010 + np.array([0, 0, side * z]) for w, z in ((-side, 0.0145), (side, 0.0145), (side, 0.0172), (-side, 0.0172))] for r in (0.036, 0.282)]
            shape.loft(ends, lambda i, j: (0.08 * j, 0.9 * i))
            for r in (0.07, 0.14, 0.21, 0.265):
                peg(shape, out * r + np.array([0, 0, side * 0.016]), out * r + np.array([0, 0, side * 0.0205]), 0.0055, 8)
    for side in (-1, 1):
        hoop(shape, [(0.016, 0.0145), (0.044, 0.0145), (0.042, 0.0185), (0.016, 0.0185)], (0, 0, side))
    model.add("visual_pegs", shape, ["bronze"], drum, 40)
    mark = Shape()  # one tooth in fifty is marked, so that its going on is seen
    for k in range(8):
        a = 2 * math.pi * k / 8 + math.pi / 2
        out, across = np.array([math.cos(a), math.sin(a), 0]), np.array([-math.sin(a), math.cos(a), 0])
        w = 0.0045 if k else 0.009
        corners = mark.points([out * 0.250 - across * w + (0, 0, 0.0154), out * 0.286 - across * 0.4 * w + (0, 0, 0.0154), out * 0.286 + across * 0.4 * w + (0, 0, 0.0154), out * 0.250 + across * w + (0, 0, 0.0154)][::-1])
        mark.face(tuple(corners), ((0, 0), (0, 1), (1, 1), (1, 0)))
    model.add("visual_marks", mark, ["terracotta"], drum, 40)


def hole_angle(k):
    """Of a hole at the start, from x towards z: the drum turns so."""
    return -FIRST_HOLE - 2 * math.pi * k / HOLES


def drum_with_holes(shape, count=20):
    """The flat drum's board, in sectors about y, each with a hole through it."""
    half = math.pi / HOLES
    inner, outer = 0.020, FLAT_R

    def on_edge(middle, direction):
        """From the hole's middle to the edge of its sector."""
        low, high = 0.0, 0.2
        for _ in range(40):
            t = 0.5 * (low + high)
            p = np.array([HOLE_CIRCLE, 0.0]) + t * direction
            inside = inner < np.hypot(*p) < outer and abs(math.atan2(p[1], p[0])) < half
            low, high = (t, high) if inside else (low, t)
        return np.array([HOLE_CIRCLE, 0.0]) + low * direction

    corners = [math.atan2(r * math.sin(s * half), r * math.cos(s * half) - HOLE_CIRCLE) for r in (inner, outer) for s in (-1, 1)]
    angles = sorted(set([round(2 * math.pi * k / count - math.pi, 6) for k in range(count)] + [round(c, 6) for c in corners]))
    for k in range(HOLES):
        turn = hole_angle(k)
        c, s = math.cos(turn), math.sin(turn)

        def place(p, y):
            return (c * p[0] - s * p[1], y, s * p[0] + c * p[1])

        rim = [np.array([HOLE_CIRCLE, 0]) + HOLE_R * np.array([math.cos(a), math.sin(a)]) for a in angles]
        edge = [on_edge(k, np.array([math.cos(a), math.sin(a)])) for a in angles]
        rings = {(name, y): shape.points([place(p, y) for p in points]) for name, points in (("rim", rim), ("edge", edge)) for y in (0.0, FLAT_TOP)}
        for i in range(len(angles)):
            n = (i + 1) % len(angles)
            for y, flip in ((FLAT_TOP, True), (0.0, False)):
                face = [rings["rim", y][i], rings["rim", y][n], rings["edge", y][n], rings["edge", y][i]]
                face = face if flip else face[::-1]
                shape.face(tuple(face), tuple(plank_uv(shape.vertices[v][0], shape.vertices[v][2]) for v in face))
            wall = (rings["rim", 0.0][i], rings["rim", 0.0][n], rings["rim", FLAT_TOP][n], rings["rim", FLAT_TOP][i])
            shape.face(wall, ((0, 0), (1, 0), (1, 1), (0, 1)), 1)
            if min(np.hypot(*edge[i]), np.hypot(*edge[n])) > outer - 1e-4:
                wall = (rings["edge", 0.0][n], rings["edge", 0.0][i], rings["edge", FLAT_TOP][i], rings["edge", FLAT_TOP][n])
                a = turn + math.atan2(edge[i][1], edge[i][0])
                b = turn + math.atan2(edge[n][1], edge[n][0])
                shape.face(wall, (strip_uv(3, 0.1, b * outer / 2.3), strip_uv(3, 0.1, a * outer / 2.3), strip_uv(3, 0.5, a * outer / 2.3), strip_uv(3, 0.5, b * outer / 2.3)))
    return shape


def make_flat(model):
    flat = model.group("FLAT")
    model.add("visual_disc", drum_with_holes(Shape()), ["timber", "dark"], flat, 35)
    knob = [(0.0, 0.0), (0.030, 0.0), (0.030, FLAT_TOP + 0.004), (0.020, FLAT_TOP + 0.012), (0.019, FLAT_TOP + 0.040), (0.024, FLAT_TOP + 0.052), (0.024, FLAT_TOP + 0.066),
            (0.016, FLAT_TOP + 0.074), (0.0, FLAT_TOP + 0.075)]
    model.add("part_knob", lathe(Shape(), knob, 32, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(0.23, 1.2), uv_offset=(0.13, 0.1)), ["grip"], flat, 45)
    teeth = Shape()
    hoop(teeth, [(FLAT_R - 0.001, 0.004), (FLAT_R + 0.0025, 0.004), (FLAT_R + 0.0025, 0.026), (FLAT_R - 0.001, 0.026)], (0, 1, 0), (3, 5))
    for k in range(12):  # the twelve teeth below, between the pegs
        a = hole_angle(k) + math.pi / 12
        out = np.array([math.cos(a), 0, math.sin(a)])
        peg(teeth, out * 0.026 + (0, -0.050, 0), out * 0.0505 + (0, -0.050, 0), 0.0058, 10)
    lathe(teeth, [(0.0, -0.003), (0.032, -0.003), (0.032, 0.0), (0.0, 0.0)], 24, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(1, 5))
    model.add("visual_teeth", teeth, ["bronze"], flat, 45)
    star = [(0.0, -0.070), (0.014, -0.070), (0.030, -0.064), (0.030, -0.036), (0.014, -0.030), (0.014, 0.0), (0.0, 0.0)]
    model.add("visual_star", lathe(Shape(), star, 32, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(0.23, 1.2), uv_offset=(0.26, 0.1)), ["timber"], flat, 40)
    # What is touched of the board, within it and its holes.
    core = [(0.0, 0.001), (0.088, 0.001), (0.092, 0.005), (0.092, FLAT_TOP - 0.005), (0.088, FLAT_TOP - 0.0012), (0.0, FLAT_TOP - 0.0012)]
    model.add("part_core", lathe(Shape(), core, 32, (0, 0, 0), (0, 1, 0), (0, 0, 1)), ["dark"], flat, 35)


def make_pebble(model):
    pebble = model.group("PEBBLE")
    ball = [(PEBBLE_R * math.sin(a), -PEBBLE_R * math.cos(a)) for a in np.linspace(0, math.pi, 13)]
    ball[0], ball[-1] = (0.0, -PEBBLE_R), (0.0, PEBBLE_R)
    model.add("part_stone", lathe(Shape(), ball, 20, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(0.2, 2)), ["pebble"], pebble, 80)


def make_vessel(model):
    vessel = model.group("VESSEL")
    outline = [(0.072, 0.010), (0.080, 0.004), (0.094, 0.020), (0.107, 0.055), (0.112, 0.085), (0.119, 0.092), (0.119, 0.097), (0.108, 0.097), (0.104, 0.086), (0.097, 0.055), (0.085, 0.026)]
    for k in range(8):
        sector = shell(Shape(), outline, 2 * math.pi * k / 8, 2 * math.pi * (k + 1) / 8, 6, uv=(2, 5))
        model.add(f"part_wall_{k:02d}", sector, ["bronze"], vessel, 180)
    foot = [(0.0, 0.004), (0.084, 0.004), (0.088, 0.010), (0.088, 0.018), (0.0, 0.018)]
    model.add("part_foot", lathe(Shape(), foot, 40, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(1, 5)), ["bronze"], vessel, 40)
    shape = Shape()
    shell(shape, [(0.050, 0.0), (0.056, 0.0), (0.058, 0.006), (0.048, 0.006)], 0, 2 * math.pi, 40, uv=(2, 5), caps=False)
    for y, r in ((0.068, 0.1105), (0.061, 0.1090)):
        shell(shape, [(r - 0.002, y - 0.002), (r + 0.0016, y - 0.002), (r + 0.0016, y + 0.002), (r - 0.002, y + 0.002)], 0, 2 * math.pi, 48, uv=(3, 5), caps=False)
    model.add("visual_rings", shape, ["bronze"], vessel, 180)


def make_pane(model):
    pane = model.group("PANE")
    w, h = CASE_X + 0.020, 0.5 * (CASE_TOP - CASE_LOW)
    for name, low, high, along, seed in (("top", (-w, h - 0.036, -0.010), (w, h, 0.010), 0, 3), ("bottom", (-w, -h, -0.010), (w, -h + 0.036, 0.010), 0, 5),
                                         ("left", (-w, -h + 0.036, -0.010), (-w + 0.036, h - 0.036, 0.010), 1, 7), ("right", (w - 0.036, -h + 0.036, -0.010), (w, h - 0.036, 0.010), 1, 9)):
        model.add(f"part_{name}", board(Shape(), low, high, along, seed, rough=0.0), ["timber"], pane, 40)
    glass = Shape()
    corners = glass.points([(-w + 0.030, -h + 0.030, 0), (w - 0.030, -h + 0.030, 0), (w - 0.030, h - 0.030, 0), (-w + 0.030, h - 0.030, 0)])
    glass.face(tuple(corners), ((0, 0), (1, 0), (1, 1), (0, 1)))
    model.add("visual_glass", glass, ["pane"], pane)
    grip = [(0.0, -0.055), (0.011, -0.055), (0.013, -0.05), (0.0145, 0.0), (0.013, 0.05), (0.011, 0.055), (0.0, 0.055)]
    model.add("part_grip", lathe(Shape(), grip, 24, (0, h - 0.018, 0.046), (1, 0, 0), uv_scale=(0.115, 1.2), uv_offset=(0.38, 0.2)), ["grip"], pane, 45)
    bronze = Shape()
    for s in (-1, 1):
        tube(bronze, [np.array([s * 0.062, h - 0.018, 0.008]), np.array([s * 0.062, h - 0.018, 0.030]), np.array([s * 0.060, h - 0.018, 0.044]), np.array([s * 0.050, h - 0.018, 0.046])], 0.006, 10, v_scale=5)
        lathe(bronze, [(0.0, 0.009), (0.016, 0.009), (0.014, 0.013), (0.0, 0.014)], 16, (s * 0.062, h - 0.018, 0), uv_scale=(0.5, 5))
        for t in (-1, 1):  # corner plates
            block(bronze, (min(s * w, s * (w - 0.055)), min(t * h, t * (h - 0.012)), 0.009), (max(s * w, s * (w - 0.055)), max(t * h, t * (h - 0.012)), 0.0125), 0.001, 4, 0.0, 0.3)
            block(bronze, (min(s * w, s * (w - 0.012)), min(t * h, t * (h - 0.055)), 0.009), (max(s * w, s * (w - 0.012)), max(t * h, t * (h - 0.055)), 0.0125), 0.001, 5, 0.0, 0.3)
    model.add("visual_fittings", bronze, ["bronze"], pane, 40)


def make_roller(model):
    roller = model.group("ROLLER")
    profile = [(0.0, -0.085), (ROLLER_R - 0.004, -0.085), (ROLLER_R, -0.080), (ROLLER_R, 0.080), (ROLLER_R - 0.004, 0.085), (0.0, 0.085)]
    model.add("part_roller", lathe(Shape(), profile, 32, uv_scale=(0.5, 0.6), uv_offset=(0.02, 0.1), end_grain=(0, 4)), ["planks"], roller, 35)
    shape = Shape()
    peg(shape, (0, 0, -0.08), (0, 0, -0.125), 0.012)
    peg(shape, (0, 0, 0.08), (0, 0, 0.125), 0.012)
    for z in (-0.070, 0.070):
        hoop(shape, [(ROLLER_R - 0.003, z - 0.008), (ROLLER_R + 0.0015, z - 0.008), (ROLLER_R + 0.0015, z + 0.008), (ROLLER_R - 0.003, z + 0.008)])
    model.add("visual_pins", shape, ["iron"], roller, 40)


def make_channel(model):
    """A gutter from under the flat drum's opening, through the case's side, to over the vessel."""
    channel = model.group("CHANNEL")
    (x0, y0), (x1, y1) = CHANNEL_FROM, CHANNEL_TO
    slope = np.array([x1 - x0, y1 - y0, 0]) / math.hypot(x1 - x0, y1 - y0)
    normal = np.array([-slope[1], slope[0], 0])
    start, end = np.array([x0, y0, FLAT_Z]), np.array([x1, y1, FLAT_Z])

    def plank(name, across, up, thick, high, seed, before=0.0, after=0.0):
        shift = np.array([0, 0, across]) + normal * up
        model.add(f"part_{name}", timber(Shape(), start + shift - slope * before, end + shift + slope * after, thick, high, up=normal, bevel=0.0015, seed=seed, rough=0.0), ["timber"], channel, 40)

    plank("floor", 0, -0.006, 0.058, 0.012, 61)
    plank("back", -0.026, 0.010, 0.006, 0.030, 62, 0.006)
    plank("front", 0.026, 0.010, 0.006, 0.030, 63, 0.006)
    model.add("part_head", board(Shape(), (x0 - 0.010, y0 - 0.014, FLAT_Z - 0.029), (x0 - 0.002, y0 + 0.022, FLAT_Z + 0.029), 2, 64, 0.001, 0.0), ["timber"], channel, 40)
    # A board across its end, with two cheeks: what comes down the gutter falls into the vessel.
    model.add("part_stop", board(Shape(), (SPOUT_X, y1 - 0.042, FLAT_Z - 0.035), (SPOUT_X + 0.010, y1 + 0.050, FLAT_Z + 0.035), 1, 65, 0.0015, 0.0), ["timber"], channel, 40)
    for s, name in ((-1, "back"), (1, "front")):
        z = FLAT_Z + s * 0.032
        model.add(f"part_cheek_{name}", board(Shape(), (x1 - 0.035, y1 - 0.040, z - 0.003), (SPOUT_X + 0.001, y1 + 0.048, z + 0.003), 0, 66, 0.001, 0.0), ["timber"], channel, 40)


def make_cart(model):
    """What stands already: axle, bed, and the case with the drums' axles."""
    cart = model.group("CART")

    def beam(name, low, high, along, seed, material_name="planks", bevel=0.006):
        model.add(name, board(Shape(), low, high, along, seed, bevel, 0.0), [material_name], cart, 40)

    arm = [(0.0, 0.0), (ARM_R + 0.001, 0.0), (ARM_R - 0.002, 0.640), (ARM_R - 0.004, 0.642), (0.0, 0.642)]
    model.add("part_arm", lathe(Shape(), arm, 32, (0, WHEEL_Y, -0.42), (0, 0, 1), uv_scale=(0.3, 0.6)), ["planks"], cart, 30)
    beam("part_axle", (-0.05, WHEEL_Y - 0.05, -1.30), (0.05, WHEEL_Y + 0.045, -0.34), 2, 31)
    for k, z in enumerate((-0.42, -1.22)):
        beam(f"{('part', 'visual')[k]}_sill_{k}", (-0.78, 0.705, z - 0.04), (0.92, 0.775, z + 0.04), 0, 33 + k)
    for s, name in ((-1, "left"), (1, "right")):
        x = s * CASE_X
        beam(f"part_bearer_{name}", (x - 0.030, 0.725, -0.40), (x + 0.030, CASE_LOW - 0.010, 0.020), 2, 35 + s)
        for z, where in ((-0.30, "back"), (0.0, "front")):
            beam(f"{'part' if z == 0 else 'visual'}_post_{name}_{where}", (x - 0.020, CASE_LOW - 0.012, z - 0.020), (x + 0.020, CASE_TOP, z + 0.020), 1, 37 + s, "timber", 0.003)
    # Boards: left, back, and the right side below the channel.
    beam("part_side_left", (-CASE_X - 0.008, CASE_LOW, -0.28), (-CASE_X + 0.008, CASE_TOP - 0.01, -0.02), 1, 41, "timber", 0.002)
    beam("part_side_right", (CASE_X - 0.008, CASE_LOW, -0.28), (CASE_X + 0.008, 1.205, -0.02), 1, 43, "timber", 0.002)
    for k in range(5):
        low, high = (mix(CASE_LOW, CASE_TOP, (k + e) / 5) for e in (0.004, 0.996))
        beam(f"visual_back_{k}", (-CASE_X - 0.02, low, -0.334), (CASE_X + 0.02, high, -0.321), 0, 45 + k, "timber", 0.002)
    beam("part_back", (-CASE_X - 0.019, CASE_LOW + 0.004, -0.333), (CASE_X + 0.019, CASE_TOP - 0.004, -0.322), 0, 45, "timber", 0.002)
    beam("visual_bridge", (-CASE_X + 0.01, DRUM_Y - 0.035, -0.320), (CASE_X - 0.01, DRUM_Y + 0.035, -0.245), 0, 51, "timber", 0.004)
    beam("visual_bracket", (-0.024, 1.320, -0.330), (0.024, 1.358, -0.138), 2, 53, "timber", 0.003)
    beam("part_shelf", (CASE_X + 0.02, SHELF_Y - 0.020, -0.300), (0.680, SHELF_Y, -0.030), 0, 55, "timber", 0.003)
    shape = Shape()
    for z in (-0.27, -0.06):
        timber(shape, (CASE_X + 0.008, SHELF_Y - 0.17, z), (0.63, SHELF_Y - 0.022, z), 0.026, 0.030, up=(0, 0, 1), bevel=0.003, seed=57, rough=0.0004)
    for z in (-0.30, 0.0):  # rails on top, over the posts
        if z < 0:
            timber(shape, (-CASE_X - 0.025, CASE_TOP + 0.010, z), (CASE_X + 0.025, CASE_TOP + 0.010, z), 0.040, 0.022, bevel=0.003, seed=58, rough=0.0004)
    for s in (-1, 1):
        timber(shape, (s * CASE_X, CASE_TOP + 0.010, -0.32), (s * CASE_X, CASE_TOP + 0.010, 0.020), 0.040, 0.022, bevel=0.003, seed=59, rough=0.0004)
    model.add("visual_rails", shape, ["timber"], cart, 40)
    # The floor under the flat drum, a ring of boards with one opening, on two ledgers.
    plate, gap = Shape(), math.radians(13)
    outline = [(0.062, PLATE_Y - 0.010), (0.172, PLATE_Y - 0.010), (0.172, PLATE_Y), (0.062, PLATE_Y)]
    shell(plate, outline, math.pi + gap, 3 * math.pi - gap, 60, (0, 0, FLAT_Z), uv=(2, 0.8))
    model.add("visual_plate", plate, ["timber"], cart, 30)
    ledgers = Shape()
    for z in (-0.285, -0.318):
        timber(ledgers, (-CASE_X, PLATE_Y - 0.022, z), (CASE_X, PLATE_Y - 0.022, z), 0.030, 0.022, bevel=0.002, seed=60, rough=0.0004)
    model.add("visual_ledgers", ledgers, ["timber"], cart, 30)
    bronze = Shape()
    peg(bronze, (0, DRUM_Y, -0.25), (0, DRUM_Y, -0.005), 0.0150, 20)
    lathe(bronze, [(0.0, 0.0), (0.030, 0.0), (0.030, 0.006), (0.022, 0.014), (0.015, 0.10), (0.0, 0.10)], 24, (0, DRUM_Y, -0.247), uv_scale=(1, 5))
    lathe(bronze, [(0.0, 0.0), (0.018, 0.0), (0.010, 0.012), (0.006, 0.02), (0.0, 0.02)], 20, (0, 1.357, FLAT_Z), (0, 1, 0), (0, 0, 1), uv_scale=(1, 5))
    for s in (-1, 1):
        for y in (CASE_LOW + 0.02, CASE_TOP - 0.02):
            for z in (-0.30, 0.0):
                peg(bronze, (s * (CASE_X + 0.019), y, z), (s * (CASE_X + 0.024), y, z), 0.008, 10)
    model.add("visual_axles", bronze, ["bronze"], cart, 40)


def make_bed(model, scene):
    """The rest of the cart: its floor, its far wheel, its pole on a trestle."""
    shape = Shape()
    for k in range(9):
        x0, x1 = (mix(-0.78, 0.92, (k + e) / 9) for e in (0.004, 0.996))
        board(shape, (x0, 0.776, -1.27), (x1, 0.802, -0.375), 2, 71 + k, 0.003)
    for x in (-0.76, 0.07, 0.90):
        for z in (-1.22,):
            board(shape, (x - 0.022, 0.80, z - 0.022), (x + 0.022, 1.12, z + 0.022), 1, 81, 0.004)
    for y in (0.90, 1.06):
        board(shape, (-0.80, y - 0.045, -1.200), (0.94, y + 0.045, -1.178), 0, 83, 0.003)
    for x, s in ((-0.74, 85), (0.88, 87)):
        board(shape, (x - 0.04, 0.70, -1.20), (x + 0.04, 0.772, -0.44), 2, s, 0.005)
    timber(shape, (0.02, 0.735, -0.82), (2.05, 0.735, -0.82), 0.075, 0.080, bevel=0.012, seed=89, rough=0.002, taper=0.7)
    for dx in (-0.14, 0.14):
        timber(shape, (1.72 + dx, 0.0, -0.98), (1.72 + 0.1 * dx, 0.70, -0.82), 0.05, 0.05, up=(1, 0, 0), bevel=0.006, seed=91, rough=0.001)
        timber(shape, (1.72 + dx, 0.0, -0.66), (1.72 + 0.1 * dx, 0.70, -0.82), 0.05, 0.05, up=(1, 0, 0), bevel=0.006, seed=92, rough=0.001)
    model.add("visual_bed", shape, ["planks"], scene, 40)
    ropes = Shape()
    for k in range(5):
        ring = [np.array([1.70 + 0.013 * k + 0.013 * a / (2 * math.pi), 0.728 + 0.052 * math.sin(a), -0.82 + 0.052 * math.cos(a)]) for a in np.linspace(0, 2 * math.pi, 21)]
        tube(ropes, ring, 0.007, 8, v_scale=8)
    model.add("visual_ropes", ropes, ["hemp"], scene, 60)
    far = np.array([0, WHEEL_Y, -1.50])
    for name, made, materials, smooth in wheel_shapes(False):
        made.vertices = [(-x, y + far[1], far[2] - z) for x, y, z in made.vertices]
        made.normals = [None if n is None else [(-p[0], p[1], -p[2]) for p in n] for n in made.normals]
        model.add(f"{name}_far", made, materials, scene, smooth)
    arm = Shape()
    lathe(arm, [(0.0, 0.0), (0.045, 0.0), (ARM_R, 0.1), (ARM_R, 0.36), (0.0, 0.36)], 24, (0, WHEEL_Y, -1.29), (0, 0, -1), uv_scale=(0.3, 0.6))
    model.add("visual_arm_far", arm, ["planks"], scene, 30)
    chocks = Shape()
    block(chocks, (-0.30, -0.02, -1.62), (0.30, 0.062, -1.38), 0.012, 93, 0.003)
    for s in (-1, 1):
        block(chocks, (s * 0.24 - 0.07, 0.055, -1.60), (s * 0.24 + 0.07, 0.15, -1.40), 0.014, 94, 0.004)
    model.add("visual_chocks", chocks, ["limestone"], scene, 42)


def make_stands(model, scene):
    """The rollers' frame, and two tables where the parts wait."""
    shape = Shape()
    for z in (WHEEL_Z - 0.115, WHEEL_Z + 0.115):
        board(shape, (-0.44, 0.004, z - 0.022), (0.44, 0.118, z + 0.022), 0, 101, 0.005)
    for x in (-0.40, 0.40):
        board(shape, (x - 0.03, 0.0, WHEEL_Z - 0.15), (x + 0.03, 0.055, WHEEL_Z + 0.15), 2, 103, 0.005)
    for k, (x0, x1, z0, z1, top) in enumerate(((-1.42, -0.60, 0.10, 0.62, LEFT_TOP), (0.62, 1.46, 0.06, 0.60, RIGHT_TOP))):
        for j in range(4):
            a, b = (mix(z0, z1, (j + e) / 4) for e in (0.006, 0.994))
            board(shape, (x0, top - 0.032, a), (x1, top, b), 0, 111 + 10 * k + j, 0.004)
        for x in (x0 + 0.07, x1 - 0.07):
            for z in (z0 + 0.05, z1 - 0.05):
                board(shape, (x - 0.028, 0.0, z - 0.028), (x + 0.028, top - 0.031, z + 0.028), 1, 121 + 10 * k + int(50 * z), 0.005)
            board(shape, (x - 0.024, top - 0.085, z0 + 0.01), (x + 0.024, top - 0.032, z1 - 0.01), 2, 141 + k, 0.005)
    x, z = LOOSE["DRUM"][0], LOOSE["DRUM"][2]
    for dz in (-0.068, 0.045):  # a rack that keeps the drum upright
        for s in (-1, 1):
            board(shape, (x + s * 0.16 - 0.02, LEFT_TOP - 0.01, z + dz - 0.012), (x + s * 0.16 + 0.02, LEFT_TOP + 0.12, z + dz + 0.012), 1, 151, 0.003)
    x, z = LOOSE["FLAT"][0], LOOSE["FLAT"][2]
    for s in (-1, 1):
        board(shape, (x + s * 0.11 - 0.02, RIGHT_TOP - 0.002, z - 0.10), (x + s * 0.11 + 0.02, RIGHT_TOP + 0.077, z + 0.10), 2, 153, 0.003)
    x = LOOSE["TOOTH"][0]
    for s in (-1, 1):
        board(shape, (x + s * 0.075 - 0.015, LEFT_TOP - 0.002, LOOSE["TOOTH"][2] - 0.04), (x + s * 0.075 + 0.015, LEFT_TOP + 0.055, LOOSE["TOOTH"][2] + 0.04), 2, 155, 0.003)
    model.add("visual_stands", shape, ["timber"], scene, 40)


def make_place(model, scene):
    """Flagstones, no two alike, and what things fall on."""
    floor = model.group("FLOOR")
    model.add("part_floor", block(Shape(), (-1.66, -0.30, -1.8), (2.2, 0.0, 1.5), 0.01, 28, 0.0, 1.0), ["earth"], floor, 42)
    model.add("visual_flags", paving((-1.68, 2.12), (-1.80, 1.45), 2.22, (0.32, 0.46), (0.40, 0.70), (0.002, 0.007)), ["limestone"], scene, 42)
    bed = Shape()
    corners = bed.points([(-1.82, -0.03, -1.95), (-1.82, -0.03, 1.75), (2.35, -0.03, 1.75), (2.35, -0.03, -1.95)])
    bed.face(tuple(corners), ((0, 0), (0, 2.2), (2.4, 2.2), (2.4, 0)))
    model.add("visual_ground", bed, ["earth"], scene)


# The file ------------------------------------------------------------------------------------------------------------------------


def put(apart):
    """Puts the parts where they are in the odometer, or where they wait for it, and pebbles into the holes: for pictures."""
    for name, place in {**PLACES, **(LOOSE if apart else {})}.items():
        bpy.data.objects[name].location = to_blender(place)
    stone = bpy.data.objects["PEBBLE"].children[0]
    for made in [o for o in bpy.data.objects if o.name.startswith("COPY")]:
        bpy.data.objects.remove(made)
    bpy.data.objects["PEBBLE"].location = to_blender((VESSEL_X, SHELF_Y + 0.036, FLAT_Z))
    at = (LOOSE if apart else PLACES)["FLAT"]
    for k in range(HOLES):
        copy = bpy.data.objects.new(f"COPY{k}", stone.data)
        a = hole_angle(k)
        copy.location = to_blender((at[0] + HOLE_CIRCLE * math.cos(a), at[1] + PEBBLE_UP, at[2] + HOLE_CIRCLE * math.sin(a)))
        bpy.context.scene.collection.objects.link(copy)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with tempfile.TemporaryDirectory() as folder:
        model = Model(make_materials(Textures(folder)))
        for make in (make_wheel, make_tooth, make_drum, make_flat, make_pebble, make_vessel, make_pane, make_roller, make_channel, make_cart):
            make(model)
        scene = model.group("SCENE")
        for make in (make_bed, make_stands, make_place):
            make(model, scene)
        export(os.path.abspath(arguments[0]))
        if len(arguments) > 1:
            views = (("together", False, (1.05, 1.85, 2.35), (0.10, 0.85, -0.15)), ("near", False, (0.62, 1.95, 0.75), (0.18, 1.28, -0.14)), ("apart", True, (0.35, 1.85, 3.0), (0.0, 0.75, 0.0)),
                     ("gear", False, (0.26, 0.98, 0.62), (0.0, 0.80, -0.08)))
            for name, apart, eye, look_at in views:
                if len(arguments) > 2 and name not in arguments[2:]:
                    continue
                put(apart)
                picture(os.path.abspath(arguments[1]) + f"-{name}.png", eye, look_at, samples=16)


main()
