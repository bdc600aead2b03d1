"""Models the village from which a visitor chooses a machine, and writes village.glb.

    blender -b --python village.py -- village.glb [PICTURES [VIEWS]]        (Blender 3.4, with python3-numpy)

With PICTURES, the beginning of a path, it also renders the village. Metres, glTF's axes (y up); the visitor stands at about z = 1.1 and
looks along -z. Beside this file: village_signs.py, village_place.py, village_machines.py, village_shapes.py.

Nodes at the root, all with identity transforms; each sign is in its own frame, and where that is, PLACES says:
  STAND         low wall and posts, in the world's frame
  SIGN_*        eight boards; origin in the middle of the bar that a board hangs from; they swing about x
  WATER_RIVER   the river's surface        SCENE   all else, which is neither touched nor moves
Children named part_* are touched as well as drawn, and are closed and convex or nearly so; children named visual_* are drawn only.
"""
import os
import sys
import tempfile

import bpy
import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import surfaces  # noqa: E402
from modelling import Model, export, picture, to_blender  # noqa: E402
from surfaces import Textures, fractal, iron_material, material, mix, museum_materials, noise, step, surface, tint  # noqa: E402
from village_machines import make_machines  # noqa: E402
from village_place import make_agora, make_bank, make_ground, make_house, make_masonry, make_range, make_smithy, make_temple, make_trees  # noqa: E402
from village_signs import SIGNS, make_sign, make_stand, place_of  # noqa: E402

surfaces.TEXTURE = 640  # for all but the signs this is far off; the file is to stay small

PLACES = {"SIGN_" + name: place_of(column, row) for name, column, row in SIGNS}
SMALL = (384, 384)


def rubble():
    """Fieldstones in mud: light stones, dark joints."""
    rng = np.random.default_rng(81)
    rows, columns = np.mgrid[0:SMALL[0], 0:SMALL[1]] / SMALL[0]
    wobble = 0.02 * (fractal(SMALL, (6, 6), rng, 4) - 0.5)
    first, second, which = np.full(SMALL, 9.0), np.full(SMALL, 9.0), np.zeros(SMALL)
    cells = 9
    for i in range(cells):
        for j in range(cells):
            x, y, shade = (j + rng.uniform(0.2, 0.8)) / cells, (i + rng.uniform(0.3, 0.7)) / cells, rng.random()
            dx, dy = np.abs(columns + wobble - x), np.abs(rows + wobble - y)
            d = np.hypot(0.75 * np.minimum(dx, 1 - dx), np.minimum(dy, 1 - dy))
            nearer = d < first
            second = np.where(nearer, first, np.minimum(second, d))
            which, first = np.where(nearer, shade, which), np.where(nearer, d, first)
    stone, fine = step(0.004, 0.022, second - first), fractal(SMALL, (30, 30), rng, 4, 0.6)
    colour = tint((0.40, 0.35, 0.27), (0.24, 0.20, 0.15), which) * (0.75 + 0.45 * fine)[..., None]
    return np.clip(mix(np.array([0.15, 0.115, 0.075])[None, None, :] * (0.7 + 0.6 * fine)[..., None], colour, stone[..., None]), 0, 1), 3.0 * stone + fine


def plaster():
    rng = np.random.default_rng(83)
    broad, fine = fractal(SMALL, (3, 3), rng, 6, 0.6), fractal(SMALL, (50, 50), rng, 3, 0.6)
    colour = tint((0.66, 0.55, 0.39), (0.50, 0.38, 0.25), np.clip(1.6 * broad - 0.35, 0, 1)) * (0.86 + 0.2 * fine)[..., None]
    return np.clip(colour, 0, 1), 1.5 * fine + 1.2 * broad


def rooftiles():
    """Terracotta, a course every half tile of v."""
    rng = np.random.default_rng(85)
    rows, columns = np.mgrid[0:SMALL[0], 0:SMALL[1]] / SMALL[0]
    fine, broad = fractal(SMALL, (24, 24), rng, 4, 0.6), fractal(SMALL, (4, 4), rng, 5, 0.6)
    course = np.mod(2 * rows, 1.0)
    each = rng.random((2, 2))[(rows * 2).astype(int) % 2, (columns * 2).astype(int) % 2]
    colour = tint((0.44, 0.175, 0.085), (0.27, 0.105, 0.055), np.clip(0.5 * each + 0.9 * broad - 0.2, 0, 1))
    colour = mix(colour, np.array([0.31, 0.27, 0.17])[None, None, :], 0.4 * step(0.58, 0.72, broad)[..., None]) * (0.72 + 0.4 * fine)[..., None]
    return np.clip(colour * (1 - 0.55 * step(0.90, 0.99, course))[..., None], 0, 1), 2.0 * course + fine


def fields():
    """Hills from afar: dry grass, scrub, bare limestone."""
    rng = np.random.default_rng(87)
    broad, fine, spots = fractal(SMALL, (4, 4), rng, 6, 0.6), fractal(SMALL, (40, 40), rng, 3, 0.6), fractal(SMALL, (26, 26), rng, 3, 0.5)
    colour = tint((0.31, 0.285, 0.135), (0.19, 0.195, 0.08), np.clip(1.8 * broad - 0.4, 0, 1))
    colour = mix(colour, np.array([0.105, 0.125, 0.05])[None, None, :], (0.85 * step(0.50, 0.60, spots) * step(0.30, 0.62, broad))[..., None])
    colour = mix(colour, np.array([0.46, 0.42, 0.34])[None, None, :], (0.7 * step(0.62, 0.74, 0.5 * fine + 0.5 * noise(SMALL, (11, 11), rng)))[..., None])
    return np.clip(colour * (0.78 + 0.4 * fine)[..., None], 0, 1)


def gravel():
    rng = np.random.default_rng(89)
    broad, grit = fractal(SMALL, (4, 4), rng, 5, 0.6), fractal(SMALL, (60, 60), rng, 3, 0.7)
    return np.clip(tint((0.46, 0.385, 0.27), (0.33, 0.265, 0.175), broad) * (0.62 + 0.7 * grit)[..., None], 0, 1)


def fire(textures):
    """Light of flames, from their foot at v 0 to their tips at v 1."""
    v = np.mgrid[0:64, 0:8][0] / 63
    light = mix(tint((1.0, 0.60, 0.15), (1.0, 0.20, 0.02), step(0.05, 0.5, v)), np.array([0.50, 0.045, 0.004])[None, None, :], step(0.45, 1.0, v)[..., None])
    made = material("fire", base=(0.02, 0.01, 0.005, 1), roughness=1.0)
    node, shader = made.node_tree.nodes.new("ShaderNodeTexImage"), made.node_tree.nodes["Principled BSDF"]
    node.image = textures.image("fire", light)
    made.node_tree.links.new(node.outputs["Color"], shader.inputs["Emission"])
    shader.inputs["Emission Strength"].default_value = 1.0
    return made


def make_materials(textures):
    made = museum_materials(textures)
    made["iron"] = iron_material(textures)
    made["rubble"] = material("rubble", *surface(textures, "rubble", *rubble(), 0.6), roughness=0.92)
    made["plaster"] = material("plaster", *surface(textures, "plaster", *plaster(), 0.35), roughness=0.95)
    made["rooftiles"] = material("rooftiles", textures.image("rooftiles", rooftiles()[0]), roughness=0.85, two_sided=True)
    made["fields"] = material("fields", textures.image("fields", fields()), roughness=1.0)
    made["gravel"] = material("gravel", textures.image("gravel", gravel()), roughness=1.0)
    grain = surfaces.stone()[0][::2, ::2]
    made["pale_stone"] = material("pale_stone", textures.image("pale_stone", np.clip(0.07 + 1.12 * grain, 0, 1)), roughness=0.8)
    made["flagstone"] = material("flagstone", textures.image("flagstone", 0.66 * grain * np.array([1.0, 0.94, 0.86])), roughness=0.9)
    # Pigments that were had: red and yellow ochre, Egyptian blue, lime, soot.
    for name, colour in (("paint_red", (0.36, 0.052, 0.024)), ("paint_blue", (0.030, 0.115, 0.30)), ("paint_white", (0.78, 0.73, 0.62)), ("paint_black", (0.030, 0.026, 0.023)), ("paint_ochre", (0.62, 0.34, 0.06)),
                         ("paint_water", (0.10, 0.17, 0.17)), ("bark", (0.135, 0.105, 0.075)), ("straw_bale", (0.46, 0.36, 0.16)), ("cloth", (0.50, 0.42, 0.28))):
        made[name] = material(name, base=(*colour, 1), roughness=0.75 if name.startswith("paint") else 0.95)
    for name, colour in (("leaf_pale", (0.205, 0.235, 0.120)), ("leaf_dark", (0.088, 0.112, 0.050)), ("leaf_cypress", (0.035, 0.058, 0.026)), ("blade", (0.20, 0.23, 0.07)), ("straw", (0.42, 0.35, 0.16))):
        made[name] = material(name, base=(*colour, 1), roughness=0.8, two_sided=True)
    made["fire"] = fire(textures)
    return made


VIEWS = {"visitor": ((0, 1.5, 1.1), (0, 1.10, -0.1), 24), "front": ((0, 1.6, 1.7), (0, 1.34, 0.7), 27), "signs": ((0, 1.42, 1.25), (0, 0.98, 0.2), 40), "far": ((0, 1.6, 1.1), (0, 1.25, -4), 26),
         "left": ((0, 1.8, 1.0), (-3.4, 0.9, -6), 38), "right": ((0, 1.8, 1.0), (3.6, 1.2, -6), 38), "temple": ((1.5, 3.0, -12.0), (4.4, 3.4, -22), 34), "range": ((-1.2, 1.9, -4), (-1.2, 0.9, -20), 38), "bird": ((-3, 13, 10), (0.5, 0, -12), 24)}


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with tempfile.TemporaryDirectory() as folder:
        model = Model(make_materials(Textures(folder)))
        make_stand(model)
        for name, _, _ in SIGNS:
            make_sign(model, name)
        scene = model.group("SCENE")
        for make in (make_ground, make_bank, make_agora, make_house, make_temple, make_masonry, make_smithy, make_range, make_machines, make_trees):
            make(model, scene)
        export(os.path.abspath(arguments[0]))
        if len(arguments) < 2:
            return
        for name, place in PLACES.items():
            bpy.data.objects[name].location = to_blender(place)
        for name, (eye, look_at, lens) in VIEWS.items():
            if len(arguments) > 2 and name not in arguments[2:]:
                continue
            picture(os.path.abspath(arguments[1]) + f"-{name}.png", eye, look_at, samples=16, lens=lens)


main()
