"""What the models of the museum share beside their surfaces: shapes with uvs, a model and its export, in metres and glTF's axes (y up).

A model's script lies beside this file; Blender does not look there of itself, so it begins with

    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

Every random number is seeded by what it is for: the same script gives the same file.
"""
import math
import os

import bpy
import numpy as np

from surfaces import WOOD_STRIPS, mix


def to_blender(p):
    return (p[0], -p[2], p[1])


class Shape:
    """Faces with a uv for each corner; vertices in glTF's axes."""

    def __init__(self):
        self.vertices, self.faces, self.uvs, self.slots, self.normals = [], [], [], [], []

    def face(self, corners, uvs, slot=0, normals=None):
        self.faces.append(corners)
        self.uvs.append(uvs)
        self.slots.append(slot)
        self.normals.append(normals)

    def points(self, points):
        first = len(self.vertices)
        self.vertices.extend(tuple(float(v) for v in p) for p in points)
        return list(range(first, first + len(points)))

    def loft(self, rings, uv, slot=0, cap_slot=None, cap_scale=1.0, cap_uv=(0.0, 0.0)):
        """Joins closed rings of equal length, counter-clockwise seen from the last ring; flat caps close the ends.
        `uv(i, j)` is the uv at ring i, corner j, where j runs one past the last corner."""
        index = [self.points(ring) for ring in rings]
        count = len(rings[0])
        for i in range(len(rings) - 1):
            for j in range(count):
                k = (j + 1) % count
                self.face((index[i][j], index[i][k], index[i + 1][k], index[i + 1][j]),
                          (uv(i, j), uv(i, j + 1), uv(i + 1, j + 1), uv(i + 1, j)), slot)
        for ring, points, flip in ((index[0], rings[0], True), (index[-1], rings[-1], False)):
            flat = flat_uv(points, cap_scale, cap_uv)
            order = list(range(count))[::-1] if flip else list(range(count))
            self.face(tuple(ring[j] for j in order), tuple(flat[j] for j in order), slot if cap_slot is None else cap_slot)
        return self


def flat_uv(points, scale, offset):
    """Plane coordinates of nearly coplanar points."""
    p = np.asarray(points, dtype=float)
    centre = p.mean(0)
    _, _, axes = np.linalg.svd(p - centre)
    return [tuple(((q - centre) @ axes[:2].T) * scale + np.asarray(offset)) for q in p]


def frame_of(direction, up):
    """Unit vectors (side, up) that make a right-handed frame with the direction: side x up = direction."""
    w = np.asarray(direction, float) / np.linalg.norm(direction)
    side = np.cross(up, w)
    side /= np.linalg.norm(side)
    return side, np.cross(w, side), w


def rounded_rectangle(width, height, bevel):
    """Corners, counter-clockwise, with the side (0..3) that each edge from it belongs to."""
    x, y, b = width / 2, height / 2, bevel
    corners = []
    for cx, cy, start in ((x - b, -y + b, -90), (x - b, y - b, 0), (-x + b, y - b, 90), (-x + b, -y + b, 180)):
        for degrees in (0, 45, 90):
            a = math.radians(start + degrees)
            corners.append((cx + b * math.cos(a), cy + b * math.sin(a)))
    return corners


def strip_uv(strip, across, along):
    return ((strip % WOOD_STRIPS + 0.04 + 0.92 * across) / WOOD_STRIPS, along)


def timber(shape, start, end, width, height, up=(0, 1, 0), bevel=0.006, seed=0, slot=0, rough=0.0015, taper=1.0):
    """A hewn beam from `start` to `end`: grain along it, a different plank of the atlas on each side."""
    rng = np.random.default_rng(1000 + seed)
    start, end = np.asarray(start, float), np.asarray(end, float)
    length = np.linalg.norm(end - start)
    side, top, _ = frame_of(end - start, up)
    outline = rounded_rectangle(width, height, bevel)
    count, steps = len(outline), max(2, int(length / 0.12))
    along = [0.0, bevel] + [length * k / steps for k in range(1, steps)] + [length - bevel, length]
    rings = []
    for i, s in enumerate(along):
        shrink = 1 - 1.4 * bevel / min(width, height) if i in (0, len(along) - 1) else 1.0
        size = shrink * mix(1.0, taper, s / length)
        jitter = rng.normal(0, rough, (count, 2)) if 0 < i < len(along) - 1 else np.zeros((count, 2))
        rings.append([start + (end - start) * (s / length) + side * (x * size + jx) + top * (y * size + jy)
                      for (x, y), (jx, jy) in zip(outline, jitter)])
    strips = [seed * 3 + k for k in range(4)]
    offset = rng.uniform(0, 1)

    index = [shape.points(r) for r in rings]
    for i in range(len(rings) - 1):
        for j in range(count):
            k = (j + 1) % count
            which, inside = divmod(j, 3)
            low, high = ((0.0, 0.02), (0.02, 0.04), (0.04, 0.96))[inside]
            strip = strips[which]
            shape.face((index[i][j], index[i][k], index[i + 1][k], index[i + 1][j]),
                       (strip_uv(strip, low, offset + along[i] / 2.3), strip_uv(strip, high, offset + along[i] / 2.3),
                        strip_uv(strip, high, offset + along[i + 1] / 2.3), strip_uv(strip, low, offset + along[i + 1] / 2.3)), slot)
    for ring, points, flip in ((index[0], rings[0], True), (index[-1], rings[-1], False)):
        flat = flat_uv(points, 0.9, (0.06 + (seed % WOOD_STRIPS) / WOOD_STRIPS, 0.5))
        order = list(range(count))[::-1] if flip else list(range(count))
        shape.face(tuple(ring[j] for j in order), tuple(flat[j] for j in order), slot)
    return shape


def lathe(shape, profile, segments, origin=(0, 0, 0), axis=(0, 0, 1), up=(0, 1, 0), slots=None, uv_scale=(1.0, 1.0), uv_offset=(0.0, 0.0),
          end_grain=()):
    """Turns (radius, height) points about the axis, bottom first. A radius of 0 closes the end in a point. u runs round, v along;
    on the segments in `end_grain` u runs outwards, so that a timber's rings lie round its middle."""
    side, top, w = frame_of(axis, up)
    origin = np.asarray(origin, float)
    travelled = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(np.asarray(profile), axis=0).T))])
    rings = []
    for radius, z in profile:
        angles = [2 * math.pi * k / segments for k in range(segments)]
        ring = [origin + w * z + radius * (side * math.cos(a) + top * math.sin(a)) for a in angles]
        rings.append(shape.points(ring if radius > 0 else ring[:1]))

    for i in range(len(profile) - 1):
        slot = slots[i] if slots else 0

        def uv(row, j, across=i in end_grain):
            if across:
                return strip_uv(5, profile[row][0] / 0.077, 0.02 * math.sin(2 * math.pi * j / segments))
            return (uv_offset[0] + uv_scale[0] * j / segments, uv_offset[1] + uv_scale[1] * travelled[row])

        for j in range(segments):
            k = (j + 1) % segments
            low, high = rings[i], rings[i + 1]
            if len(low) == 1:
                shape.face((low[0], high[k], high[j]), (uv(i, j + 0.5), uv(i + 1, j + 1), uv(i + 1, j)), slot)
            elif len(high) == 1:
                shape.face((low[j], low[k], high[0]), (uv(i, j), uv(i, j + 1), uv(i + 1, j + 0.5)), slot)
            else:
                shape.face((low[j], low[k], high[k], high[j]), (uv(i, j), uv(i, j + 1), uv(i + 1, j + 1), uv(i + 1, j)), slot)
    return shape


def shell(shape, profile, start, stop, steps, origin=(0, 0, 0), axis=(0, 1, 0), up=(0, 0, 1), slot=0, uv=(1, 1.0), smooth_degrees=40.0, caps=True):
    """Turns a closed (radius, height) outline, counter-clockwise, from angle `start` to `stop`: a sector of a hollow body, closed itself
    by flat caps. Normals are those of the whole, so that sectors side by side show no seam. `uv`: tiles round a turn, tiles a metre."""
    side, top, w = frame_of(axis, up)
    origin = np.asarray(origin, float)
    count = len(profile)
    edges = np.diff(np.asarray(profile + profile[:1], float), axis=0)
    lengths = np.hypot(*edges.T)
    out = np.stack([edges[:, 1], -edges[:, 0]], 1) / lengths[:, None]
    travelled = np.concatenate([[0], np.cumsum(lengths)])
    limit = math.cos(math.radians(smooth_degrees))

    def normal(edge, corner, a):
        other = (corner - 1) % count if corner == edge else corner % count
        n = out[edge] + out[other] if out[edge] @ out[other] > limit else out[edge]
        n = n / np.linalg.norm(n)
        return n[0] * (side * math.cos(a) + top * math.sin(a)) + n[1] * w

    angles = np.linspace(start, stop, steps + 1)
    rings = [shape.points([origin + w * h + r * (side * math.cos(a) + top * math.sin(a)) for r, h in profile]) for a in angles]
    for e in range(count):
        n = (e + 1) % count
        for i in range(steps):
            corners = ((i, e, e), (i + 1, e, e), (i + 1, n, e + 1), (i, n, e + 1))
            shape.face(tuple(rings[i_][c] for i_, c, _ in corners),
                       tuple((uv[0] * angles[i_] / (2 * math.pi), uv[1] * travelled[v]) for i_, _, v in corners), slot,
                       [normal(e, e if c == e and v == e else e + 1, angles[i_]) for i_, c, v in corners])
    if caps:
        flat = [(r * uv[1], h * uv[1]) for r, h in profile]
        for i, sign in ((0, -1), (steps, 1)):
            order = list(range(count)) if sign < 0 else list(range(count))[::-1]
            across = sign * (top * math.cos(angles[i]) - side * math.sin(angles[i]))
            shape.face(tuple(rings[i][c] for c in order), tuple(flat[c] for c in order), slot, [across] * count)
    return shape


def tube(shape, path, radius, sides=7, slot=0, closed=False, v_scale=6.0):
    """A rope or stalk along a path of points."""
    path = [np.asarray(p, float) for p in path]
    count = len(path)
    rings, along = [], 0.0
    lengths = []
    previous = None
    for i, p in enumerate(path):
        ahead = path[(i + 1) % count] if closed else path[min(i + 1, count - 1)]
        behind = path[i - 1] if closed or i else path[0]
        direction = ahead - behind
        hint = previous if previous is not None else np.array([0.31, 0.87, 0.38])
        side, top, _ = frame_of(direction, hint)
        previous = top
        r = radius(i / (count - 1)) if callable(radius) else radius
        rings.append([p + r * (side * math.cos(a) + top * math.sin(a)) for a in np.arange(sides) * 2 * math.pi / sides])
        lengths.append(along)
        along += np.linalg.norm(ahead - p)
    if not closed:
        return shape.loft(rings, lambda i, j: (j / sides, lengths[i] * v_scale), slot)
    index = [shape.points(r) for r in rings]
    for i in range(count):
        n = (i + 1) % count
        v0, v1 = lengths[i] * v_scale, (lengths[n] if n else along) * v_scale
        for j in range(sides):
            k = (j + 1) % sides
            shape.face((index[i][j], index[i][k], index[n][k], index[n][j]),
                       ((j / sides, v0), ((j + 1) / sides, v0), ((j + 1) / sides, v1), (j / sides, v1)), slot)
    return shape


def cut_cube(shape, cuts, vertex, uv, slot=0):
    """A cube from -1 to 1 whose faces are cut along each axis; vertex(corner, axis of the face) places a corner and gives its index,
    uv(corner, axis, the face's own two axes) its place in the texture."""
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for sign in (-1.0, 1.0):
            for i in range(len(cuts[u]) - 1):
                for j in range(len(cuts[v]) - 1):
                    corners = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        p = [0.0, 0.0, 0.0]
                        p[axis], p[u], p[v] = sign, cuts[u][a], cuts[v][b]
                        corners.append(p)
                    if sign < 0:
                        corners.reverse()
                    shape.face(tuple(vertex(c, axis) for c in corners), tuple(uv(c, axis, u, v) for c in corners), slot)
    return shape


def block(shape, low, high, bevel=0.012, seed=0, rough=0.004, tile=1.4, slot=0):
    """A dressed stone: a box with worn edges, uv by the direction that each face looks to."""
    rng = np.random.default_rng(2000 + seed)
    low, high = np.asarray(low, float), np.asarray(high, float)
    centre, half = (low + high) / 2, (high - low) / 2
    cuts = [[-1.0, -1 + bevel / h] + list(np.linspace(-1, 1, max(3, int(h * 2 / 0.14)))[1:-1]) + [1 - bevel / h, 1.0] for h in half]
    offset = rng.uniform(0, 1, 2)
    seen = {}

    def vertex(p, _axis):
        key = tuple(np.round(p, 6))
        if key not in seen:
            q = np.array(p) * half
            inner = np.clip(q, -half + bevel, half - bevel)
            out = q - inner
            length = np.linalg.norm(out)
            place = inner + out / length * bevel if length > 0 else q
            place = place + np.sin(place * 9.1 + seed) * rough + rng.normal(0, rough * 0.35, 3)
            seen[key] = shape.points([centre + place])[0]
        return seen[key]

    def uv(c, axis, u, v):
        return tuple((np.array([c[u] * half[u], c[v] * half[v]]) + centre[[u, v]]) / tile + offset)

    return cut_cube(shape, cuts, vertex, uv, slot)


def paving(x_range, z_range, edge, depths, widths, tops, level=0.0):
    """Flagstones, no two alike, in rows along x that begin within z_range; none ends beyond the edge. Tops are about the level."""
    rng = np.random.default_rng(131)
    shape = Shape()
    z, row = z_range[0], 0
    while z < z_range[1]:
        depth = rng.uniform(*depths)
        left = x_range[0] + 0.18 * (row % 2)
        while left < x_range[1]:
            width = min(rng.uniform(*widths), edge - left)
            block(shape, (left, -0.10, z), (left + width - 0.008, level + rng.uniform(*tops), z + depth - 0.008), 0.010, int(rng.integers(1000)), 0.0025)
            left += width
        z += depth
        row += 1
    return shape


def rod(shape, start, end, radius, segments=16, tiles=3.0, least_u=0.0):
    """A round bar with worn ends; a thin one may ask for the least width of texture round it."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    length = np.linalg.norm(end - start)
    b = min(0.002, radius / 3)
    up = (0, 1, 0) if abs(end[1] - start[1]) < 0.9 * length else (0, 0, 1)
    return lathe(shape, [(0, 0), (radius - b, 0), (radius, b), (radius, length - b), (radius - b, length), (0, length)], segments, start, end - start, up,
                 uv_scale=(max(least_u, radius * 30), tiles))


def earth(grid, tile=1.5, lean=0.0):
    """Ground through a grid of points, rows along x of points along z; with the grid's vertices. On a slope `lean` of its height goes into v."""
    shape = Shape()
    index = [shape.points(row) for row in grid]

    def uv(i, j):
        return (grid[i][j][0] / tile + 0.05 * math.sin(grid[i][j][2] * 2), (grid[i][j][2] + lean * grid[i][j][1]) / tile)

    for i in range(len(grid) - 1):
        for j in range(len(grid[0]) - 1):
            shape.face((index[i][j], index[i][j + 1], index[i + 1][j + 1], index[i + 1][j]), (uv(i, j), uv(i, j + 1), uv(i + 1, j + 1), uv(i + 1, j)))
    return shape, index


def rim(grid):
    """The indices round the grid's edge."""
    rows, columns = len(grid), len(grid[0])
    return [(i, 0) for i in range(rows)] + [(rows - 1, j) for j in range(1, columns)] + [(i, columns - 1) for i in range(rows - 2, -1, -1)] + \
           [(0, j) for j in range(columns - 2, 0, -1)]


def skirt(shape, grid, index, foot):
    """The cut sides of earth, down to `foot`."""
    edge = rim(grid)
    top = [index[i][j] for i, j in edge]
    low = shape.points([(grid[i][j][0], foot, grid[i][j][2]) for i, j in edge])
    for k in range(len(edge)):
        n = (k + 1) % len(edge)
        a, b = k * 0.05, (k + 1) * 0.05
        shape.face((top[k], top[n], low[n], low[k]), ((a, 0.15), (b, 0.15), (b, 0), (a, 0)))


def tuft(shape, rng, x, z, height_at, blades=7, spread=0.03, tallest=0.16, dry=0.6):
    """Blades of grass about a place; that share of them has the second material."""
    for _ in range(blades):
        a, lean, h = rng.uniform(0, 2 * math.pi), rng.uniform(0.05, 0.5), rng.uniform(0.05, tallest)
        base = np.array([x + rng.normal(0, spread), 0, z + rng.normal(0, spread)])
        base[1] = height_at(base[0], base[2]) - 0.01
        out, across = np.array([math.cos(a), 0, math.sin(a)]), np.array([-math.sin(a), 0, math.cos(a)])
        spine = [base + np.array([0, h * t * (1 - 0.25 * lean * t), 0]) + out * (h * lean * t * t) for t in (0, 0.5, 1.0)]
        i = shape.points([spine[0] - across * 0.003, spine[0] + across * 0.003, spine[1] - across * 0.0022, spine[1] + across * 0.0022, spine[2]])
        slot, u = int(rng.random() < dry), (0.5, 0.5)
        shape.face((i[0], i[1], i[3], i[2]), (u,) * 4, slot)
        shape.face((i[2], i[3], i[4]), (u,) * 3, slot)


class Model:
    def __init__(self, materials):
        self.materials = materials
        self.collection = bpy.context.scene.collection

    def group(self, name):
        made = bpy.data.objects.new(name, None)
        self.collection.objects.link(made)
        return made

    def add(self, name, shape, material_names, parent=None, smooth_degrees=35.0):
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata([to_blender(v) for v in shape.vertices], [], [list(f) for f in shape.faces])
        layer = mesh.uv_layers.new(name="uv")
        layer.data.foreach_set("uv", np.array([c for face in shape.uvs for c in face], dtype=np.float32).ravel())
        mesh.polygons.foreach_set("material_index", shape.slots)
        mesh.polygons.foreach_set("use_smooth", [True] * len(shape.faces))
        for used in material_names:
            mesh.materials.append(self.materials[used])
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = math.radians(smooth_degrees)
        if any(n is not None for n in shape.normals):
            mesh.normals_split_custom_set([to_blender(n) for face in shape.normals for n in face])
        if mesh.validate(verbose=True):
            raise RuntimeError(f"{name} has faulty faces")
        made = bpy.data.objects.new(name, mesh)
        made.parent = parent
        self.collection.objects.link(made)
        return made


def export(path):
    """Writes the scene as it is to a glb."""
    bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", export_apply=False, export_yup=True, export_normals=True,
                              export_texcoords=True, export_tangents=False, export_colors=False, export_animations=False,
                              export_morph=False, export_skins=False, export_extras=False, export_image_format="AUTO")
    print(f"wrote {path}, {os.path.getsize(path)} bytes")


def picture(path, eye, look_at, width=640, height=480, samples=48, lens=40):
    """Renders the scene by Cycles on the CPU, under a hazy sky and a low sun: to judge a model by."""
    scene = bpy.context.scene
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    sky, fill = nodes.new("ShaderNodeTexSky"), nodes.new("ShaderNodeMixRGB")
    sky.sun_elevation, sky.sun_rotation, sky.sun_intensity, sky.dust_density = math.radians(42), math.radians(-40), 0.25, 1.0
    fill.blend_type, fill.inputs["Fac"].default_value, fill.inputs["Color2"].default_value = "ADD", 1.0, (1.1, 1.05, 1.0, 1)
    links.new(sky.outputs["Color"], fill.inputs["Color1"])
    links.new(fill.outputs["Color"], nodes["Background"].inputs["Color"])
    nodes["Background"].inputs["Strength"].default_value = 0.15
    scene.world = world
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens = lens
    scene.collection.objects.link(camera)
    from mathutils import Vector
    camera.location = to_blender(eye)
    camera.rotation_euler = (Vector(to_blender(look_at)) - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", samples, False  # Debian's has no denoiser
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.view_settings.view_transform = "Filmic"
    scene.view_settings.look = "Medium High Contrast"
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    bpy.data.objects.remove(camera)
