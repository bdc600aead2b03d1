"""Models Ktesibios' force pump, part by part, and writes ktesibios-pump.glb.

    blender -b --python ktesibios-pump.py -- ktesibios-pump.glb [PICTURES]        (Blender 3.4, with python3-numpy)

With PICTURES, the beginning of a path, it also renders the pump put together and taken apart. Form: Vitruvius, De architectura X.7;
Heron, Pneumatica I.28. Metres, glTF's axes (y up); the visitor looks along -z.

Nodes at the root, all with identity transforms, each loose part in its own frame; where that frame is when the pump is put together, with
the beam level, is in PLACES, and where it waits to be put in, in LOOSE:
  PUMP            what is built already, in place: CYLINDER_*, PIPE_*, VALVE_IN_*, VALVE_OUT_* and VESSEL are groups in it
  PISTON_L, _R    with its rod; origin at the middle of the lower face
  COWL, TRUMPET   origin at the middle of the lower rim
  BEAM            origin at its hinge, which is along z
  HANDLE          origin at its seat on the beam's top
  SCENE           what never moves; WATER_WELL and WATER_BASIN are the water's surfaces
Children named part_* are touched as well as drawn, and are closed; children named visual_* are drawn only.
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
from surfaces import TEXTURE, WOOD_STRIPS, Textures, fractal, material, mix, museum_materials, noise, step, surface, tint  # noqa: E402

BORE, WALL = 0.050, 0.009  # radius of the bore; thickness of the bronze
CYLINDER_X, CYLINDER_Y, CYLINDER_HEIGHT = 0.22, 0.12, 0.36
STROKE, PISTON_HEIGHT, DEAD = 0.10, 0.055, 0.03
PIPE_RADIUS, PIPE_Y, SEAT_X = 0.020, 0.055, 0.052  # PIPE_Y: above the cylinder's foot
VESSEL_Y, VESSEL_RADIUS, VESSEL_HEIGHT = 0.40, 0.108, 0.11
COWL_HEIGHT, TRUMPET_RADIUS = 0.17, 0.019
PIVOT_Y, ARM = 0.94, 0.22
MOUTH_Y, MOUTH_Z, BEND = 1.20, -0.44, 0.085  # the middle of the trumpet's mouth
HANDLE_X, HANDLE_END, GRIP_RADIUS = 0.20, 0.70, 0.017  # HANDLE_END: from the seat; so 0.90 m from the hinge
TROUGH_X, TROUGH_Z, TROUGH_WALL, TROUGH_FLOOR, TROUGH_TOP, WELL_LEVEL = 0.38, 0.21, 0.085, 0.06, 0.26, 0.20
TUB_Z, TUB_RADIUS, TUB_FOOT, TUB_HEIGHT, TUB_STAVES = -0.62, 0.25, 0.16, 0.40, 18
SECTORS = 8

PISTON_MID = CYLINDER_Y + DEAD + STROKE / 2
SIDES = (("L", -1), ("R", 1))
PLACES = {
    **{f"CYLINDER_{n}": (s * CYLINDER_X, CYLINDER_Y, 0) for n, s in SIDES},
    **{f"VALVE_IN_{n}": (s * CYLINDER_X, CYLINDER_Y + 0.010, 0) for n, s in SIDES},
    **{f"PIPE_{n}": (s * (CYLINDER_X - BORE - WALL), CYLINDER_Y + PIPE_Y, 0) for n, s in SIDES},
    **{f"VALVE_OUT_{n}": (s * SEAT_X, VESSEL_Y + 0.022, 0) for n, s in SIDES},
    **{f"PISTON_{n}": (s * CYLINDER_X, PISTON_MID, 0) for n, s in SIDES},
    "VESSEL": (0, VESSEL_Y, 0),
    "COWL": (0, VESSEL_Y + VESSEL_HEIGHT, 0),
    "TRUMPET": (0, VESSEL_Y + VESSEL_HEIGHT + COWL_HEIGHT, 0),
    "BEAM": (0, PIVOT_Y, 0),
    "HANDLE": (HANDLE_X, PIVOT_Y + 0.032, 0),
}
BUILT = [name for name in PLACES if name.startswith(("CYLINDER", "VALVE", "PIPE", "VESSEL"))]
RACK_Y, RACK_Z, BENCH_TOP, TABLE_TOP = 1.22, 0.34, 0.42, 0.66  # the pistons' rack; the bench of cowl and trumpet; the table behind it
EYE = PIVOT_Y - PISTON_MID  # from a piston's lower face to its rod's eye
LOOSE = {
    "PISTON_L": (-0.96, RACK_Y - 0.12 - EYE, RACK_Z), "PISTON_R": (-0.74, RACK_Y - 0.12 - EYE, RACK_Z),
    "COWL": (0.76, BENCH_TOP, 0.36), "TRUMPET": (1.06, BENCH_TOP, 0.40),
    "BEAM": (0.80, TABLE_TOP + 0.036, -0.30), "HANDLE": (0.62, TABLE_TOP + 0.022, -0.55),
}


# Materials -----------------------------------------------------------------------------------------------------------------------


def cast_bronze(seed, bright, dull, green, patina_from):
    """Colour, height, and occlusion-roughness-metal of cast and filed bronze: warm metal, brown where it is handled less, verdigris in the
    pits. Filing runs along u, round a turned part."""
    rng = np.random.default_rng(seed)
    shape = (TEXTURE, TEXTURE)
    broad, middle, fine = fractal(shape, (3, 3), rng, 6, 0.55), fractal(shape, (10, 10), rng, 5, 0.6), fractal(shape, (70, 70), rng, 3, 0.6)
    filing = noise(shape, (TEXTURE // 4, 6), rng)
    pits = step(0.66, 0.80, fractal(shape, (46, 46), rng, 3)) * step(0.38, 0.62, middle)
    tarnish = np.clip(1.9 * broad - 0.55 + 0.35 * (middle - 0.5), 0, 1)
    colour = tint(bright, dull, tarnish) * (0.90 + 0.20 * filing)[..., None]
    patina = step(patina_from, patina_from + 0.13, 0.55 * broad + 0.30 * middle + 0.15 * fine)
    patina = np.clip(patina + 0.7 * pits, 0, 1)
    salt = np.array(green)[None, None, :] * (0.7 + 0.6 * fine)[..., None]
    colour = mix(colour, salt, (0.80 * patina)[..., None])
    roughness = np.clip(0.24 + 0.14 * tarnish + 0.10 * (filing - 0.5) + 0.42 * patina, 0, 1)
    metal = 0.86 - 0.66 * patina  # not all mirror: where it faces dark ground it still reads as bronze
    height = 0.55 * filing + 0.9 * fine + 1.6 * middle - 1.6 * pits + 0.5 * patina * fine
    return np.clip(colour, 0, 1), height, np.dstack([np.ones(shape), roughness, metal])


def leather():
    rng = np.random.default_rng(95)
    shape = (256, 256)
    grain, broad = fractal(shape, (50, 50), rng, 3), fractal(shape, (4, 4), rng, 4)
    colour = tint((0.16, 0.075, 0.035), (0.075, 0.034, 0.018), np.clip(1.4 * broad - 0.2, 0, 1)) * (0.7 + 0.6 * grain)[..., None]
    return np.clip(colour, 0, 1), 2.0 * grain


def make_materials(textures):
    made = museum_materials(textures)
    for name, values in (("bronze", (63, (0.86, 0.56, 0.25), (0.50, 0.285, 0.125), (0.13, 0.24, 0.18), 0.60)),
                         ("verdigris", (67, (0.46, 0.27, 0.12), (0.27, 0.155, 0.075), (0.155, 0.285, 0.215), 0.46))):
        colour, height, orm = cast_bronze(*values)
        images = surface(textures, f"pump_{name}", colour, height, 0.30)
        made[name] = material(f"pump_{name}", *images, textures.image(f"pump_{name}_orm", orm[::2, ::2], linear=True))
    made["leather"] = material("leather", *surface(textures, "leather", *leather(), 0.5), roughness=0.6)
    return made


# Parts ---------------------------------------------------------------------------------------------------------------------------


def rounded(outline, bevel=0.0018):
    """Cuts every convex or concave corner of a closed outline by a small bevel."""
    points = [np.asarray(p, float) for p in outline]
    result = []
    for i, p in enumerate(points):
        for q in (points[i - 1], points[(i + 1) % len(points)]):
            length = np.linalg.norm(q - p)
            result.append(tuple(p + (q - p) * min(bevel / length, 0.35)))
    return result


def add_shell(model, parent, name, outline, tiles=(2, 5.0), origin=(0, 0, 0), bevel=0.0018):
    """A hollow turned body that is touched: as closed sectors that together look like one."""
    for k in range(SECTORS):
        shape = shell(Shape(), rounded(outline, bevel), 2 * math.pi * k / SECTORS, 2 * math.pi * (k + 1) / SECTORS, 48 // SECTORS, origin, uv=tiles)
        model.add(f"part_{name}_{k:02d}", shape, ["bronze"], parent, 180)


def add_ring(model, parent, name, outline, tiles=(2, 5.0), origin=(0, 0, 0), bevel=0.0018):
    """A turned ring that is drawn only."""
    model.add(f"visual_{name}", shell(Shape(), rounded(outline, bevel), 0, 2 * math.pi, 48, origin, uv=tiles, caps=False), ["bronze"], parent, 180)


def add_disc(model, parent, name, radius, low, high, tiles=5.0, origin=(0, 0, 0), material_name="bronze", segments=40, bevel=0.002, kind="part"):
    outline = [(0.0, low), (radius - bevel, low), (radius, low + bevel), (radius, high - bevel), (radius - bevel, high), (0.0, high)]
    shape = lathe(Shape(), outline, segments, origin, (0, 1, 0), (0, 0, 1), uv_scale=(2, tiles))
    model.add(f"{kind}_{name}", shape, [material_name], parent, 35)


def bolts(shape, count, circle, y, radius=0.0065, height=0.007, start=0.0):
    """Rivet heads round a flange."""
    dome = [(radius, 0.0), (radius * 0.96, height * 0.4), (radius * 0.6, height * 0.85), (0.0, height)]
    for k in range(count):
        a = start + 2 * math.pi * k / count
        lathe(shape, dome, 12, (circle * math.cos(a), y, circle * math.sin(a)), (0, 1, 0), (0, 0, 1), uv_scale=(0.1, 3), uv_offset=(0.13 * k, 0.2))


def make_cylinders(model):
    r, o, h = BORE, BORE + WALL, CYLINDER_HEIGHT
    for name, side in SIDES:
        group = model.group(f"CYLINDER_{name}")
        add_shell(model, group, "barrel", [(r, 0.010), (o, 0.010), (o, h - 0.004), (o - 0.003, h), (r + 0.002, h), (r, h - 0.004)])
        add_ring(model, group, "flange", [(o - 0.002, 0.010), (o + 0.020, 0.010), (o + 0.020, 0.022), (o + 0.004, 0.026), (o - 0.002, 0.034)])
        add_ring(model, group, "lip", [(o - 0.002, h - 0.032), (o + 0.013, h - 0.020), (o + 0.015, h - 0.003), (o + 0.012, h), (o - 0.003, h)])
        shape = Shape()
        for y in (0.120, 0.225):
            band = rounded([(o - 0.002, y), (o, y), (o + 0.0045, y + 0.004), (o + 0.0045, y + 0.014), (o, y + 0.018), (o - 0.002, y + 0.018)], 0.0012)
            shell(shape, band, 0, 2 * math.pi, 48, uv=(2, 5), caps=False)
        model.add("visual_bands", shape, ["bronze"], group, 180)
        # The bottom: a ring round the inlet's hole, on three feet that let the water in.
        floor = rounded([(0.024, 0.0), (o + 0.018, 0.0), (o + 0.018, 0.010), (0.028, 0.010)], 0.0015)
        for k in range(4):
            model.add(f"visual_floor_{k}", shell(Shape(), floor, math.pi / 2 * k, math.pi / 2 * (k + 1), 12, uv=(2, 5)), ["verdigris"], group, 180)
        for k in range(3):
            a = 2 * math.pi * (k + 0.25 + 0.5 * (side > 0)) / 3
            foot = [(0.0, -0.060), (0.021, -0.060), (0.022, -0.054), (0.014, -0.040), (0.011, -0.020), (0.014, 0.0), (0.0, 0.001)]
            shape = lathe(Shape(), foot, 20, ((o + 0.002) * math.cos(a), 0.0, (o + 0.002) * math.sin(a)), (0, 1, 0), (0, 0, 1), uv_scale=(1, 5))
            model.add(f"visual_foot_{k}", shape, ["verdigris"], group)
        shape = Shape()
        bolts(shape, 8, o + 0.012, 0.022, start=0.2)
        lathe(shape, [(0.0, -0.006), (0.031, -0.006), (0.033, 0.0), (0.028, 0.009), (PIPE_RADIUS, 0.013)], 32, (-side * (o - 0.004), PIPE_Y, 0), (-side, 0, 0),
              (0, 1, 0), uv_scale=(1, 5))
        model.add("visual_boss", shape, ["bronze"], group, 40)


def make_valves(model):
    for name, _ in SIDES:
        for kind, radius in (("IN", 0.034), ("OUT", 0.029)):
            group = model.group(f"VALVE_{kind}_{name}")
            add_disc(model, group, "flap", radius, 0.0, 0.006, kind="visual")
            shape = block(Shape(), (-0.007, 0.004, -radius - 0.006), (0.007, 0.010, radius * 0.55), 0.0012, 3, 0.0, 0.2)
            model.add("visual_strap", shape, ["verdigris"], group)
            pin = lathe(Shape(), [(0, -0.014), (0.0045, -0.014), (0.0045, 0.014), (0, 0.014)], 14, (0, 0.006, -radius - 0.006), (1, 0, 0), uv_scale=(0.2, 4))
            leather_disc = lathe(Shape(), [(0, -0.003), (radius - 0.004, -0.003), (radius - 0.004, 0.0005), (0, 0.0005)], 32, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(1, 6))
            model.add("visual_pin", pin, ["bronze"], group)
            model.add("visual_leather", leather_disc, ["leather"], group)


def pipe_path(side):
    """From a cylinder towards the middle, then up into the vessel's floor; in the pipe's own frame."""
    run = CYLINDER_X - BORE - WALL - SEAT_X
    rise = VESSEL_Y + 0.016 - CYLINDER_Y - PIPE_Y
    bend = 0.055
    arc = [np.array([-side * (run - bend + bend * math.sin(a)), bend - bend * math.cos(a), 0]) for a in np.linspace(0, math.pi / 2, 9)]
    return [np.array([side * 0.004, 0, 0])], arc, [np.array([-side * run, rise, 0])]


def collar(shape, centre, axis, radius, half=0.009, out=0.008):
    outline = rounded([(radius - 0.002, -half), (radius + out, -half), (radius + out, half), (radius - 0.002, half)], 0.002)
    shell(shape, outline, 0, 2 * math.pi, 36, centre, axis, (0, 1, 0) if axis[2] else (0, 0, 1), uv=(1, 5), caps=False)


def make_pipes(model):
    for name, side in SIDES:
        group = model.group(f"PIPE_{name}")
        first, arc, last = pipe_path(side)
        for k, path in enumerate((first + arc[:1], arc, arc[-1:] + last)):
            model.add(f"visual_pipe_{k}", tube(Shape(), path, PIPE_RADIUS, 28, v_scale=5), ["bronze"], group, 50)
        shape = Shape()
        for centre, axis in ((arc[0], (1, 0, 0)), (arc[-1], (0, 1, 0))):
            collar(shape, centre, axis, PIPE_RADIUS)
        model.add("visual_collars", shape, ["verdigris"], group, 180)


def make_vessel(model):
    r, o, h = VESSEL_RADIUS - 0.008, VESSEL_RADIUS, VESSEL_HEIGHT
    vessel = model.group("VESSEL")
    outline = [(r - 0.020, 0.0), (o - 0.018, 0.0), (o - 0.004, 0.010), (o, 0.028), (o, h - 0.020), (o + 0.020, h - 0.014), (o + 0.020, h), (r, h), (r, 0.030),
               (r - 0.010, 0.016), (r - 0.020, 0.012)]
    add_shell(model, vessel, "wall", outline)
    add_disc(model, vessel, "floor", r - 0.018, 0.001, 0.012, material_name="verdigris")
    for name, side in SIDES:
        seat = rounded([(0.017, 0.010), (0.034, 0.010), (0.031, 0.021), (0.017, 0.021)], 0.0015)
        for k in range(4):
            shape = shell(Shape(), seat, math.pi / 2 * k, math.pi / 2 * (k + 1), 9, (side * SEAT_X, 0, 0), uv=(1, 5))
            model.add(f"visual_seat_{name.lower()}_{k}", shape, ["bronze"], vessel, 180)
    shape = Shape()
    for _, side in SIDES:
        collar(shape, (side * SEAT_X, -0.006, 0), (0, 1, 0), PIPE_RADIUS, 0.007, 0.010)
    model.add("visual_sockets", shape, ["verdigris"], vessel, 180)
    shape = Shape()
    for k in range(4):  # staples through the rim, for the wedges that hold the cowl
        a = math.pi / 4 + math.pi / 2 * k
        x, z = (o + 0.011) * math.cos(a), (o + 0.011) * math.sin(a)
        for s in (-1, 1):
            dx, dz = -0.011 * s * math.sin(a), 0.011 * s * math.cos(a)
            block(shape, (x + dx - 0.003, h - 0.004, z + dz - 0.003), (x + dx + 0.003, h + 0.034, z + dz + 0.003), 0.001, k, 0.0, 0.2)
        tangent = np.array([-math.sin(a), 0, math.cos(a)])
        timber(shape, np.array([x, h + 0.036, z]) - tangent * 0.014, np.array([x, h + 0.036, z]) + tangent * 0.014, 0.006, 0.006, bevel=0.001, rough=0)
    model.add("visual_staples", shape, ["bronze"], vessel, 40)


def make_cowl(model):
    cowl = model.group("COWL")
    o, h = VESSEL_RADIUS, COWL_HEIGHT
    curve = [(0.0975, 0.012), (0.092, 0.020), (0.088, 0.040), (0.076, 0.064), (0.058, 0.088), (0.042, 0.112), (0.032, 0.138), (0.028, h - 0.014)]
    # Felt as a few solids, each close to convex; that it is hollow is seen from below alone.
    solids = [("flange", [(o + 0.0185, 0.0), (o + 0.020, 0.0015), (o + 0.020, 0.0105), (o + 0.0185, 0.012), (0.096, 0.014)])]
    solids += [(f"funnel_{k}", piece) for k, piece in enumerate((curve[0:3], curve[2:5], curve[4:8]))]
    for k, (name, profile) in enumerate(solids):
        outline = [(0.0, profile[0][1]), *profile, (0.0, profile[-1][1])]
        model.add(f"part_{name}", lathe(Shape(), outline, 48, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(2, 5.0), uv_offset=(0, 0.06 * k)), ["bronze"], cowl, 40)
    add_ring(model, cowl, "neck", [(TRUMPET_RADIUS, h - 0.018), (0.034, h - 0.018), (0.0345, h - 0.012), (0.0345, h), (TRUMPET_RADIUS, h)], bevel=0.0012)
    shape = Shape()
    for k in range(4):  # wedges of oak, driven through the staples
        a = math.pi / 4 + math.pi / 2 * k
        x, z = (o + 0.011) * math.cos(a), (o + 0.011) * math.sin(a)
        out = np.array([math.cos(a), 0, math.sin(a)])
        centre = np.array([x, 0.0225, z])
        timber(shape, centre - out * 0.022, centre + out * 0.030, 0.015, 0.016, bevel=0.0015, seed=60 + k, rough=0.0003, taper=1.25)
    model.add("visual_wedges", shape, ["timber"], cowl)
    shape = Shape()
    bolts(shape, 8, o + 0.011, 0.012, start=0.0)
    model.add("visual_rivets", shape, ["bronze"], cowl, 45)


def trumpet_path():
    """Upright, over the beam, a bend to the back, a level run, a bend down: as (y, z) from the trumpet's foot."""
    foot = PLACES["TRUMPET"][1]
    fall = math.radians(65)
    top = MOUTH_Y + 0.06 * (1 - math.cos(fall)) + 0.092 * math.sin(fall) - foot - BEND
    points = [(0.0, 0.0), (top, 0.0)]
    bend = [(top + BEND * math.sin(a), -BEND + BEND * math.cos(a)) for a in np.linspace(0, math.pi / 2, 10)]
    end = MOUTH_Z + 0.06 * math.sin(fall) + 0.092 * math.cos(fall)
    down = [(top + BEND - 0.06 * (1 - math.cos(a)), end - 0.06 * math.sin(a)) for a in np.linspace(0, fall, 8)]
    return points, bend, down, fall


def make_trumpet(model):
    trumpet = model.group("TRUMPET")
    straight, bend, down, fall = trumpet_path()

    def at(places):
        return [np.array([0, y, z]) for y, z in places]

    for k, path in enumerate((straight, bend, [bend[-1], down[0]], down)):
        model.add(f"part_pipe_{k}", tube(Shape(), at(path), TRUMPET_RADIUS, 28, v_scale=5), ["bronze"], trumpet, 50)
    direction = np.array([0, -math.sin(fall), -math.cos(fall)])
    bell = [(TRUMPET_RADIUS - 0.001, -0.004), (TRUMPET_RADIUS + 0.002, 0.0), (0.021, 0.030), (0.027, 0.058), (0.040, 0.082), (0.047, 0.090), (0.047, 0.095),
            (0.040, 0.095), (0.031, 0.083), (0.020, 0.058), (0.016, 0.030), (0.015, -0.004)]
    for k in range(6):
        shape = shell(Shape(), bell, 2 * math.pi * k / 6, 2 * math.pi * (k + 1) / 6, 8, at(down[-1:])[0], direction, (1, 0, 0), uv=(1, 5), smooth_degrees=50)
        model.add(f"visual_bell_{k}", shape, ["bronze"], trumpet, 180)
    shape = Shape()
    outline = rounded([(TRUMPET_RADIUS - 0.001, 0.0), (0.0335, 0.0), (0.0335, 0.010), (TRUMPET_RADIUS + 0.004, 0.014), (TRUMPET_RADIUS - 0.001, 0.030)], 0.0015)
    shell(shape, outline, 0, 2 * math.pi, 36, uv=(1, 5), caps=False)
    for place, axis in ((bend[0], (0, 1, 0)), (bend[-1], (0, 0, -1)), (down[0], (0, 0, -1))):
        collar(shape, at([place])[0], axis, TRUMPET_RADIUS, 0.008, 0.006)
    model.add("visual_collars", shape, ["verdigris"], trumpet, 180)


def make_pistons(model):
    r, h = BORE - 0.0006, PISTON_HEIGHT
    for name, side in SIDES:
        group = model.group(f"PISTON_{name}")
        outline = [(0.0, 0.0), (r - 0.006, 0.0), (r - 0.002, 0.003), (r - 0.002, 0.012), (r - 0.005, 0.014), (r - 0.005, 0.032), (r - 0.002, 0.034), (r - 0.002, 0.046),
                   (r - 0.006, 0.050), (0.020, h), (0.016, h + 0.016), (0.0, h + 0.017)]
        model.add("part_body", lathe(Shape(), outline, 48, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(2, 5)), ["bronze"], group, 35)
        cup = rounded([(r - 0.008, 0.0125), (r, 0.0125), (r + 0.0004, 0.033), (r - 0.008, 0.0335)], 0.002)
        model.add("visual_leather", shell(Shape(), cup, 0, 2 * math.pi, 48, uv=(3, 8), caps=False), ["leather"], group, 180)

        eye_at = np.array([0, EYE, 0])
        low = h + 0.010
        for k in range(4):  # short pieces: their maps are finer
            bottom, top = mix(low, EYE - 0.020, k / 4), mix(low, EYE - 0.020, (k + 1) / 4)
            outline = [(0.0, bottom), (0.0095, bottom), (0.0095, top), (0.0, top)]
            model.add(f"part_rod_{k}", lathe(Shape(), outline, 24, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(0.5, 5), uv_offset=(0, 5 * bottom)), ["bronze"], group, 35)
        neck = lathe(Shape(), [(0.0095, -0.046), (0.013, -0.036), (0.0135, -0.024), (0.0, -0.020)], 24, eye_at, (0, 1, 0), (0, 0, 1), uv_scale=(0.5, 5))
        model.add("visual_neck", neck, ["bronze"], group, 35)
        eye = rounded([(0.0105, -0.010), (0.025, -0.010), (0.025, 0.010), (0.0105, 0.010)], 0.002)
        model.add("visual_eye", shell(Shape(), eye, 0, 2 * math.pi, 36, eye_at, (0, 0, 1), (0, 1, 0), uv=(1, 5), caps=False), ["bronze"], group, 180)


def make_beam(model):
    beam = model.group("BEAM")
    half = ARM + 0.10
    for k, z in enumerate((-0.052, 0.052)):
        model.add(f"part_cheek_{k}", timber(Shape(), (-half, 0, z), (half, 0, z), 0.032, 0.064, bevel=0.006, seed=71 + k, rough=0.0012), ["timber"], beam)
    for k, x in enumerate((-half + 0.035, half - 0.035)):
        model.add(f"part_spacer_{k}", timber(Shape(), (x - 0.024, 0, 0), (x + 0.024, 0, 0), 0.071, 0.046, bevel=0.004, seed=75 + k, rough=0.0008), ["timber"], beam)
    shape = Shape()
    pin = [(0.0, -0.077), (0.011, -0.077), (0.014, -0.074), (0.014, -0.069), (0.0095, -0.068), (0.0095, 0.068), (0.014, 0.069), (0.014, 0.074), (0.011, 0.077), (0.0, 0.077)]
    for _, side in SIDES:
        lathe(shape, pin, 24, (side * ARM, 0, 0), (0, 0, 1), uv_scale=(0.5, 5))
    for s in (-1, 1):  # plates and stub axles: the trumpet stands between them, where one axle would be
        z = s * 0.070
        plate = [(0.012, min(z, z - s * 0.004)), (0.030, min(z, z - s * 0.004)), (0.032, z), (0.030, max(z, z - s * 0.004) + 0.003), (0.012, max(z, z - s * 0.004) + 0.003)]
        lathe(shape, plate, 36, (0, 0, 0), (0, 0, 1), uv_scale=(1, 5))
        stub = [(0.0, -0.012), (0.0125, -0.012), (0.0125, 0.130), (0.010, 0.133), (0.0, 0.133)]
        lathe(shape, stub, 24, (0, 0, s * 0.060), (0, 0, s), uv_scale=(0.5, 5))
    for x in (-half + 0.010, half - 0.010):  # straps that bind the cheeks' ends
        for z in (-0.052, 0.052):
            block(shape, (x - 0.009, -0.0345, z - 0.0185), (x + 0.009, 0.0345, z + 0.0185), 0.0015, 5, 0.0, 0.2)
    model.add("visual_bronze", shape, ["bronze"], beam, 38)


def make_handle(model):
    handle = model.group("HANDLE")
    start, end = np.array([-0.135, 0.021, 0]), np.array([HANDLE_END, 0.055, 0])
    model.add("part_lever", timber(Shape(), start, end + (end - start) * 0.04, 0.046, 0.040, bevel=0.007, seed=81, rough=0.0005, taper=0.86), ["timber"], handle)
    saddle = timber(Shape(), (-0.10, 0.006, 0), (0.09, 0.006, 0), 0.066, 0.012, bevel=0.003, seed=83, rough=0.0006)
    model.add("part_saddle", saddle, ["timber"], handle)
    swell = [(0.0, -1.0), (0.0115, -1.0), (0.0145, -0.97), (0.0155, -0.90), (0.0150, -0.80), (0.0160, -0.5), (GRIP_RADIUS, -0.2), (GRIP_RADIUS, 0.2), (0.0160, 0.5),
             (0.0150, 0.80), (0.0155, 0.90), (0.0145, 0.97), (0.0115, 1.0), (0.0, 1.0)]
    grip = lathe(Shape(), [(r, t * 0.150) for r, t in swell], 36, end, (0, 0, 1), uv_scale=(0.115, 1.2), uv_offset=(0.13, 0.3))
    model.add("part_grip", grip, ["grip"], handle, 45)
    shape = Shape()
    for x in (-0.075, 0.065):  # straps that hold the lever to the beam
        y = 0.021 + (x + 0.135) / (HANDLE_END + 0.135) * 0.034
        block(shape, (x - 0.010, y - 0.030, -0.0255), (x + 0.010, y + 0.0225, 0.0255), 0.0015, 6, 0.0, 0.2)
        for z in (-0.052, 0.052):
            block(shape, (x - 0.010, -0.020, min(z, z * 0.45)), (x + 0.010, 0.0015, max(z, z * 0.45)), 0.0015, 6, 0.0, 0.2)
    model.add("visual_bronze", shape, ["bronze"], handle, 40)
    shape = Shape()
    ferrule = rounded([(0.012, -0.007), (0.0188, -0.007), (0.0188, 0.007), (0.012, 0.007)], 0.0015)
    for s in (-1, 1):
        shell(shape, ferrule, 0, 2 * math.pi, 28, end + np.array([0, 0, s * 0.030]), (0, 0, 1), (0, 1, 0), uv=(1, 5), caps=False)
    model.add("visual_ferrules", shape, ["bronze"], handle, 180)


# Its place -----------------------------------------------------------------------------------------------------------------------


def make_trough(model, scene):
    """A trough of dressed stone that the cylinders stand in."""
    x, z, w, top = TROUGH_X, TROUGH_Z, TROUGH_WALL, TROUGH_TOP
    shape = block(Shape(), (-x - w, -0.02, -z - w), (x + w, TROUGH_FLOOR, z + w), 0.012, 31, 0.003)
    for k, s in enumerate((-1, 1)):
        for half, (a, b) in enumerate(((-x - w, -0.002), (0.002, x + w))):
            block(shape, (a, TROUGH_FLOOR + 0.002, min(s * z, s * (z + w))), (b, top, max(s * z, s * (z + w))), 0.012, 32 + 2 * k + half, 0.003)
        block(shape, (min(s * x, s * (x + w)), TROUGH_FLOOR + 0.002, -z + 0.002), (max(s * x, s * (x + w)), top, z - 0.002), 0.012, 38 + k, 0.003)
    model.add("visual_trough", shape, ["limestone"], scene, 42)


def make_frame(model, scene):
    """Two trestles on the trough's rim carry the beam's stub axles in bearings that are open above; the pump is seen between their legs."""
    shape = Shape()
    for k, s in enumerate((-1, 1)):
        z = s * 0.165
        timber(shape, (0, PIVOT_Y - 0.17, z), (0, PIVOT_Y - 0.012, z), 0.105, 0.056, up=(0, 0, 1), bevel=0.008, seed=41 + k, rough=0.0015)
        for m, side in enumerate((-1, 1)):
            timber(shape, (side * 0.345, TROUGH_TOP - 0.005, s * 0.250), (side * 0.026, PIVOT_Y - 0.05, s * 0.172), 0.052, 0.046, up=(0, 0, 1), bevel=0.006,
                   seed=45 + 2 * k + m, rough=0.0015)
        timber(shape, (-0.44, TROUGH_TOP + 0.020, s * 0.250), (0.44, TROUGH_TOP + 0.020, s * 0.250), 0.070, 0.046, bevel=0.006, seed=51 + k, rough=0.002)
    model.add("visual_frame", shape, ["planks"], scene)
    shape = Shape()
    for s in (-1, 1):
        for out in (-0.029, 0.035):  # half rings of bronze round the bearing, on both sides of a post, and a bush between them
            z, d = s * (0.165 + out), 0.003
            half = rounded([(0.013, z - d), (0.034, z - d), (0.034, z + d), (0.013, z + d)], 0.001)
            shell(shape, half, 0, math.pi, 20, (0, PIVOT_Y, 0), (0, 0, 1), (0, -1, 0), uv=(1, 5))
        bush = rounded([(0.0128, s * 0.165 - 0.028), (0.018, s * 0.165 - 0.028), (0.018, s * 0.165 + 0.028), (0.0128, s * 0.165 + 0.028)], 0.001)
        shell(shape, bush, 0, math.pi, 20, (0, PIVOT_Y, 0), (0, 0, 1), (0, -1, 0), uv=(1, 5))
    model.add("visual_bearings", shape, ["bronze"], scene, 180)
    shape = Shape()
    for s in (-1, 1):
        for side in (-1, 1):
            peg = [(0.0, -0.002), (0.010, -0.002), (0.010, 0.012), (0.007, 0.015), (0.0, 0.016)]
            lathe(shape, peg, 14, (side * 0.034, PIVOT_Y - 0.075, s * 0.2015), (0, 0, s), uv_scale=(0.2, 3))
    model.add("visual_pegs", shape, ["bronze"], scene, 40)


def make_stands(model, scene):
    """Where the loose parts wait: a rack with hooks for the pistons, a bench, and a table behind it."""
    shape, bronze = Shape(), Shape()
    left, right = LOOSE["PISTON_L"][0] - 0.13, LOOSE["PISTON_R"][0] + 0.13
    for k, x in enumerate((left, right)):
        timber(shape, (x, -0.02, RACK_Z), (x, RACK_Y + 0.03, RACK_Z), 0.055, 0.055, up=(0, 0, 1), bevel=0.006, seed=151 + k, rough=0.0015)
        timber(shape, (x, 0.012, RACK_Z - 0.20), (x, 0.012, RACK_Z + 0.20), 0.060, 0.060, bevel=0.006, seed=153 + k, rough=0.002)
    timber(shape, (left - 0.07, RACK_Y, RACK_Z), (right + 0.07, RACK_Y, RACK_Z), 0.045, 0.060, bevel=0.006, seed=157, rough=0.0015)
    for name in ("PISTON_L", "PISTON_R"):
        x, y = LOOSE[name][0], LOOSE[name][1] + EYE
        arc = [np.array([x, y + 0.005 - 0.010 * math.cos(a), RACK_Z - 0.010 * math.sin(a)]) for a in np.linspace(-1.9, 0.6, 9)]
        tube(bronze, [np.array([x, RACK_Y, RACK_Z + 0.012])] + [np.array([x, y + 0.04, RACK_Z + 0.012])] + arc, 0.0035, 10, v_scale=5)
    for k, (x0, x1, z0, z1, top) in enumerate(((0.60, 1.22, 0.16, 0.60, BENCH_TOP), (0.46, 1.36, -0.66, -0.14, TABLE_TOP))):
        count = 3
        for j in range(count):
            z = mix(z0, z1, (j + 0.5) / count)
            timber(shape, (x0, top - 0.018, z), (x1, top - 0.018, z), (z1 - z0) / count - 0.004, 0.036, bevel=0.004, seed=161 + 10 * k + j, rough=0.0015)
        for x in (x0 + 0.09, x1 - 0.09):
            for z in (z0 + 0.05, z1 - 0.05):
                timber(shape, (x, -0.02, z), (x, top - 0.034, z), 0.055, 0.055, up=(0, 0, 1), bevel=0.005, seed=171 + 10 * k + int(90 * z), rough=0.0015)
            timber(shape, (x, top - 0.062, z0 + 0.01), (x, top - 0.062, z1 - 0.01), 0.050, 0.052, bevel=0.005, seed=181 + 10 * k, rough=0.0015)
    model.add("visual_stands", shape, ["timber"], scene)
    model.add("visual_hooks", bronze, ["bronze"], scene, 40)


def make_tub(model, scene):
    """A tub of staves on a stone, where the jet falls."""
    inner, outer, low = TUB_RADIUS, TUB_RADIUS + 0.020, TUB_FOOT
    along = [0.0, 0.004, 0.13, 0.27, TUB_HEIGHT - 0.004, TUB_HEIGHT]
    for s in range(TUB_STAVES):
        rng = np.random.default_rng(6000 + s)
        middle, half = 2 * math.pi * (s + 0.5) / TUB_STAVES, math.pi / TUB_STAVES
        strip, shift, swell = int(rng.integers(WOOD_STRIPS)), rng.uniform(0, 1), rng.uniform(-0.001, 0.001)
        rings = []
        us = [0.06 + 0.88 * k / 6 for k in range(7)] + [0.97, 0.94, 0.5, 0.06, 0.03]
        for i, y in enumerate(along):
            end = i in (0, len(along) - 1)
            o, edge = outer + swell + 0.022 * y - (0.003 if end else 0), 0.0024
            i_r = inner + 0.022 * y + (0.002 if end else 0)
            gap = 0.0006
            angles = [(o, middle - half + (edge + gap) / o + 2 * (half - (edge + gap) / o) * k / 6) for k in range(7)]
            angles += [(o - edge, middle + half - gap / o), (i_r, middle + half - gap / i_r), (i_r, middle), (i_r, middle - half + gap / i_r),
                       (o - edge, middle - half + gap / o)]
            rings.append([(r * math.cos(a), low + y, TUB_Z - r * math.sin(a)) for r, a in angles])
        shape = Shape().loft(rings, lambda i, j: strip_uv(strip, us[j % len(us)], shift + along[i] / 1.6), cap_uv=((strip + 0.5) / WOOD_STRIPS, 0.4))
        model.add(f"visual_stave_{s:02d}", shape, ["planks"], scene, 30)
    floor = lathe(Shape(), [(0.0, low + 0.01), (inner + 0.004, low + 0.01), (inner + 0.004, low + 0.035), (0.0, low + 0.035)], 40, (0, 0, TUB_Z), (0, 1, 0), (0, 0, 1),
                  uv_scale=(2, 1))
    model.add("visual_tub_floor", floor, ["planks"], scene, 30)
    shape = Shape()
    for y in (0.055, 0.315):
        r = outer + 0.022 * y
        outline = rounded([(r - 0.002, low + y - 0.016), (r + 0.004, low + y - 0.016), (r + 0.0047, low + y + 0.016), (r - 0.002, low + y + 0.016)], 0.001)
        shell(shape, outline, 0, 2 * math.pi, 72, (0, 0, TUB_Z), uv=(5, 5), caps=False)
    model.add("visual_tub_hoops", shape, ["bronze"], scene, 180)
    stone_block = block(Shape(), (-0.30, -0.02, TUB_Z - 0.30), (0.30, low, TUB_Z + 0.30), 0.016, 55, 0.004)
    model.add("visual_plinth", stone_block, ["limestone"], scene, 42)


def make_floor(model, scene):
    """Flagstones, no two alike."""
    model.add("visual_flags", paving((-1.35, 1.35), (-1.25, 1.0), 1.42, (0.30, 0.42), (0.34, 0.62), (-0.003, 0.003), -0.018), ["limestone"], scene, 42)
    bed = Shape()
    corners = bed.points([(-1.45, -0.045, -1.30), (-1.45, -0.045, 1.12), (1.50, -0.045, 1.12), (1.50, -0.045, -1.30)])
    bed.face(tuple(corners), ((0, 0), (0, 1.6), (2, 1.6), (2, 0)))
    model.add("visual_bed", bed, ["earth"], scene)


def make_water(model):
    well = Shape()
    corners = well.points([(-TROUGH_X, WELL_LEVEL, -TROUGH_Z), (-TROUGH_X, WELL_LEVEL, TROUGH_Z), (TROUGH_X, WELL_LEVEL, TROUGH_Z), (TROUGH_X, WELL_LEVEL, -TROUGH_Z)])
    well.face(tuple(corners), ((0, 0), (0, 1), (1, 1), (1, 0)))
    model.add("WATER_WELL", well, ["water"])
    basin = Shape()
    ring = basin.points([(TUB_RADIUS * math.cos(a), TUB_FOOT + 0.036, TUB_Z - TUB_RADIUS * math.sin(a)) for a in np.arange(40) * 2 * math.pi / 40])
    basin.face(tuple(ring), tuple((0.5, 0.5) for _ in ring))
    model.add("WATER_BASIN", basin, ["water"])


# The file ------------------------------------------------------------------------------------------------------------------------


def put(apart):
    """Puts the parts where they are in the pump, or where they wait for it: for pictures."""
    for name in LOOSE:
        bpy.data.objects[name].location = to_blender((LOOSE if apart else PLACES)[name])


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with tempfile.TemporaryDirectory() as folder:
        model = Model(make_materials(Textures(folder)))
        for make in (make_cylinders, make_valves, make_pipes, make_vessel, make_cowl, make_trumpet, make_pistons, make_beam, make_handle):
            make(model)
        pump = model.group("PUMP")
        for name in BUILT:
            bpy.data.objects[name].parent = pump
            bpy.data.objects[name].location = to_blender(PLACES[name])
        scene = model.group("SCENE")
        for make in (make_trough, make_frame, make_stands, make_tub, make_floor):
            make(model, scene)
        make_water(model)
        export(os.path.abspath(arguments[0]))
        if len(arguments) > 1:
            for name, apart, eye, look_at in (("together", False, (1.45, 1.45, 2.1), (0.10, 0.58, -0.12)), ("near", False, (0.55, 0.78, 0.95), (0.0, 0.48, 0)),
                                              ("apart", True, (0.60, 1.55, 3.0), (0.20, 0.55, 0.0))):
                put(apart)
                picture(os.path.abspath(arguments[1]) + f"-{name}.png", eye, look_at)


main()
