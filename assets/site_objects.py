"""Things that stand on a construction site; origins on the ground, x along their length, z up."""

import math

import numpy as np

import paint
from solids import (Body, bar, both_sides, box, cylinder, extrude, lathe, loft, moved, pin, ribbon,
                    round_corners, rounded_rectangle, turned)

ROCK_SEED = 20
FOLIAGE_SEED = 7


def _geodesic_directions():
    """Triangles of a twice divided icosahedron on the unit sphere."""
    t = (1 + math.sqrt(5)) / 2
    corners = np.array([(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t),
                        (0, -1, -t), (0, 1, -t), (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)])
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    triangles = corners[np.array(faces)]
    for _ in range(2):
        a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        triangles = np.concatenate([np.stack(t, axis=1) for t in
                                    ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return triangles / np.linalg.norm(triangles, axis=2, keepdims=True)


def _rock(number, size, planes):
    """A boulder: a ball cut by random planes, a little uneven, sunk by a twentieth."""
    chance = np.random.default_rng([ROCK_SEED, number])
    normals = chance.normal(size=(planes, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    heights = chance.uniform(0.62, 0.95, planes)
    waves, phases = chance.normal(scale=2.2, size=(6, 3)), chance.uniform(0, 2 * math.pi, 6)
    directions = _geodesic_directions()
    facing = np.maximum(directions @ normals.T, 1e-3)
    radius = np.minimum(1.0, (heights / facing).min(axis=-1))
    radius = radius * (1 + 0.022 * np.sin(directions @ waves.T * 2 + phases).sum(axis=-1))
    solid = directions * radius[..., None] * (np.asarray(size) / 2)
    low = solid[..., 2].min()
    body = Body()
    body.add(paint.ROCK, moved(solid, (0, 0, -low - 0.05 * size[2])), crease_deg=22)
    return body


def rocks():
    return {"body": _rock(0, (0.95, 0.80, 0.70), 16), "rock2": _rock(1, (0.70, 0.55, 0.50), 13),
            "rock3": _rock(2, (1.15, 0.75, 0.62), 19)}


def cone():
    """A traffic cone, 0.75 m."""
    body = Body()
    body.add(paint.BLACK, extrude(round_corners([(0.2, 0.2), (-0.2, 0.2), (-0.2, -0.2), (0.2, -0.2)],
                                                0.05, 3), "z", 0.0, 0.035, 0.008))
    levels = ((0.035, 0.145, None), (0.055, 0.132, paint.CONE_ORANGE),
              (0.28, 0.0968, paint.CONE_ORANGE), (0.40, 0.0781, paint.REFLECTIVE),
              (0.50, 0.0626, paint.CONE_ORANGE), (0.60, 0.0470, paint.REFLECTIVE),
              (0.74, 0.0252, paint.CONE_ORANGE), (0.75, 0.0200, paint.CONE_ORANGE))
    for (z0, r0, _), (z1, r1, color) in zip(levels, levels[1:]):
        body.add(color, lathe([(0, z0), (r0, z0), (r1, z1), (0, z1)], (0, 0, 0), (0, 0, 1), 24))
    return {"body": body}


def barrier():
    """A concrete barrier of New Jersey shape, 2 m, and a fence panel, 3.5 m by 2 m."""
    body = Body()
    half = [(0.30, 0.0), (0.30, 0.075), (0.13, 0.33), (0.085, 0.80), (0.07, 0.815)]
    outline = half + [(-y, z) for y, z in half[::-1]]
    body.add(paint.CONCRETE, extrude(outline, "x", -0.99, 0.99, 0.012))
    body.add(paint.BLACK, *both_sides(box((0.45, 0.285, 0.03), (0.30, 0.05, 0.061)),
                                      box((-0.45, 0.285, 0.03), (0.30, 0.05, 0.061))))
    for x in (-0.6, 0.0, 0.6):
        body.add(paint.HI_VIS, *both_sides(box((x, 0.107, 0.62), (0.10, 0.02, 0.05), 0.004)))
    for x in (-0.994, 0.994):
        body.add(paint.STEEL, *both_sides(box((x, 0.03, 0.45), (0.02, 0.012, 0.35))))
    return {"body": body, "fence": _fence()}


def _fence():
    body = Body()
    length, low, high = 3.5, 0.12, 2.0
    for x in (-length / 2 + 0.02, length / 2 - 0.02):
        body.add(paint.GALVANISED, cylinder((x, 0, 0.02), (x, 0, high), 0.020, 10, 0.004))
        foot = rounded_rectangle((x, 0), (0.22, 0.68), 0.05, 2)
        body.add(paint.CONCRETE, extrude(foot, "z", 0.0, 0.13, 0.02))
    for z in (low + 0.04, high - 0.03):
        body.add(paint.GALVANISED, cylinder((-length / 2, 0, z), (length / 2, 0, z), 0.018, 8))
    for x in np.linspace(-length / 2 + 0.12, length / 2 - 0.12, 30):
        body.add(paint.GALVANISED, bar((x, 0, low + 0.04), (x, 0, high - 0.03), 0.008, 0.008))
    for z in np.linspace(0.40, 1.70, 6):
        body.add(paint.GALVANISED, bar((-length / 2 + 0.02, 0.008, z), (length / 2 - 0.02, 0.008, z),
                                       0.008, 0.008, (0, 0, 1)))
    return body


def trees():
    """A conifer of 6 m and a shrub of 1.3 m."""
    chance = np.random.default_rng(FOLIAGE_SEED)
    conifer = Body()
    conifer.add(paint.BARK, lathe([(0, -0.1), (0.17, -0.1), (0.12, 0.5), (0.07, 3.5), (0, 5.0)],
                                  (0, 0, 0), (0, 0, 1), 8))
    sides, tiers = 14, 6
    for tier in range(tiers):
        t = tier / (tiers - 1)
        low, top, radius = 0.75 + 3.95 * t, 2.5 + 3.5 * t, 1.45 - 1.08 * t
        angles = 2 * math.pi * (np.arange(sides) + chance.uniform(0, 1)) / sides
        reach = radius * np.where(np.arange(sides) % 2, 0.62, 1.0) * chance.uniform(0.85, 1.1, sides)
        rings = []
        for scale, height in ((0.0, low + 0.28), (1.0, low), (0.45, low + 0.42 * (top - low)),
                              (0.0, top)):
            drop = np.where(np.arange(sides) % 2, 0.10, -0.05) * scale * radius
            rings.append(np.column_stack([scale * reach * np.cos(angles),
                                          scale * reach * np.sin(angles), height + drop]))
        conifer.add(paint.FOLIAGE if tier % 2 else paint.LIGHT_FOLIAGE, loft(rings), crease_deg=50)
    shrub = Body()
    for k in range(4):
        angle = 2 * math.pi * k / 4 + chance.uniform(-0.4, 0.4)
        radius, height = chance.uniform(0.38, 0.55), chance.uniform(0.7, 1.3)
        rings = []
        for row in range(6):
            a = math.pi * row / 5
            spread = 0 if row in (0, 5) else radius * math.sin(a)
            ring = 2 * math.pi * np.arange(12) / 12
            rough = chance.uniform(0.78, 1.15, 12)
            rings.append(np.column_stack([0.35 * math.cos(angle) + spread * rough * np.cos(ring),
                                          0.35 * math.sin(angle) + spread * rough * np.sin(ring),
                                          np.full(12, height * (1 - math.cos(a)) / 2 - 0.03)
                                          + (chance.uniform(-0.06, 0.06, 12) if spread else 0)]))
        shrub.add(paint.LIGHT_FOLIAGE if k % 2 else paint.FOLIAGE, loft(rings), crease_deg=50)
    return {"body": conifer, "shrub": shrub}


def _corrugated(start, end, depth, pitch):
    """A ribbed sheet in plan from start to end (along x), as an open line."""
    count = int(round((end - start) / pitch))
    step = (end - start) / count
    points = []
    for k in range(count):
        x = start + k * step
        points += [(x, 0.0), (x + 0.30 * step, 0.0), (x + 0.45 * step, depth), (x + 0.85 * step, depth)]
    return points + [(end, 0.0)]


def container():
    """A site office in a container, 6.06 m by 2.44 m by 2.59 m."""
    body = Body()
    length, width, height = 6.06, 2.44, 2.59
    x, y = length / 2, width / 2
    for sx in (-1, 1):
        for sy in (-1, 1):
            body.add(paint.BLUE, box((sx * (x - 0.08), sy * (y - 0.08), height / 2),
                                     (0.16, 0.16, height), 0.015))
            for z in (0.06, height - 0.06):
                body.add(paint.BLUE, box((sx * (x - 0.085), sy * (y - 0.08), z), (0.18, 0.17, 0.12),
                                         0.01))
    for z in (0.09, height - 0.08):
        body.add(paint.BLUE, *both_sides(box((0, y - 0.06, z), (length - 0.2, 0.12, 0.15), 0.012)))
        for sx in (-1, 1):
            body.add(paint.BLUE, box((sx * (x - 0.06), 0, z), (0.12, width - 0.2, 0.15), 0.012))
    wall = ribbon(_corrugated(-x + 0.10, x - 0.10, 0.036, 0.25), 0.012)
    sheet = moved(extrude(wall, "z", 0.12, height - 0.10), (0, y - 0.065, 0))
    body.add(paint.WHITE, *both_sides(sheet))
    end = ribbon(_corrugated(-y + 0.10, y - 0.10, 0.036, 0.25), 0.012)
    end_sheet = turned(extrude(end, "z", 0.12, height - 0.10), "z", -90)
    body.add(paint.WHITE, moved(end_sheet, (x - 0.065, 0, 0)),
             turned(moved(end_sheet, (x - 0.065, 0, 0)), "z", 180))
    body.add(paint.WHITE, box((0, 0, height - 0.03), (length - 0.1, width - 0.1, 0.04)))
    body.add(paint.CHARCOAL, box((0, 0, 0.10), (length - 0.2, width - 0.2, 0.06)))
    body.add(paint.INTERIOR, box((0, 0, 0.15), (length - 0.25, width - 0.25, 0.03)))
    _container_openings(body, y)
    return {"body": body}


def _container_openings(body, y):
    """Door, windows and step on the left side."""
    body.add(paint.CHARCOAL, box((-1.9, y - 0.02, 1.18), (1.02, 0.09, 2.14), 0.012))
    body.add(paint.WHITE, box((-1.9, y + 0.012, 1.18), (0.90, 0.05, 2.02), 0.01))
    body.add(paint.BLACK, box((-1.54, y + 0.05, 1.12), (0.13, 0.04, 0.03), 0.008))
    body.add(paint.GLASS, box((-1.9, y + 0.036, 1.70), (0.44, 0.01, 0.62)))
    body.add(paint.INTERIOR, box((-1.9, y + 0.031, 1.70), (0.44, 0.02, 0.62)))
    for x in (0.0, 1.75):
        for dx, dz, sx, sz in ((0, 0.50, 1.26, 0.08), (0, -0.50, 1.26, 0.08), (0.59, 0, 0.08, 1.08),
                               (-0.59, 0, 0.08, 1.08), (0, 0, 0.05, 0.95)):
            body.add(paint.WHITE, box((x + dx, y - 0.005, 1.55 + dz), (sx, 0.07, sz), 0.008))
        body.add(paint.INTERIOR, box((x, y - 0.018, 1.55), (1.12, 0.012, 0.94)))
        body.add(paint.GLASS, box((x, y + 0.012, 1.55), (1.12, 0.008, 0.94)))
    body.add(paint.GALVANISED, box((-1.9, y + 0.22, 0.08), (0.95, 0.36, 0.05), 0.006),
             box((-2.3, y + 0.22, 0.03), (0.04, 0.34, 0.06)),
             box((-1.5, y + 0.22, 0.03), (0.04, 0.34, 0.06)))


def fixed_arm():
    """A pedestal and three equal links, each 0.8 m along its x to the next joint (axis y)."""
    length = 0.8
    base = Body()
    base.add(paint.CHARCOAL, extrude(rounded_rectangle((0, 0), (0.7, 0.7), 0.08), "z", 0, 0.04, 0.01),
             lathe([(0.26, 0.04), (0.20, 0.07), (0.16, 0.25), (0, 0.25), (0, 0.04)], (0, 0, 0),
                   (0, 0, 1), 24))
    base.add(paint.YELLOW, *both_sides(_plate([(-0.13, 0.22), (0.13, 0.22), (0.10, 0.44),
                                               (0.05, 0.50), (-0.05, 0.50), (-0.10, 0.44)], 0.115)))
    base.add(paint.STEEL, pin(0, 0.40, 0.16, 0.04))
    bodies = {"base": base}
    for number, (root, tip) in enumerate(((0.18, 0.15), (0.15, 0.12), (0.12, 0.09)), start=1):
        link = Body()
        rings = []
        for x, height, width in ((0.0, root, 0.16), (0.10, root, 0.16), (length - 0.14, tip, 0.13),
                                 (length - 0.12, tip, 0.08), (length, tip, 0.08)):
            section = rounded_rectangle((0, 0), (width, height), 0.015, 1)
            rings.append(np.column_stack([np.full(len(section), x), section]))
        link.add(paint.YELLOW, loft(rings), pin(0, 0, 0.085, root / 2 + 0.015, 20),
                 pin(length, 0, 0.045, tip / 2 + 0.012, 20))
        link.add(paint.STEEL, pin(length, 0, 0.10, 0.030))
        bodies[f"link{number}"] = link
    return bodies


def _plate(points, y):
    return extrude(round_corners(points, 0.04), "y", y - 0.02, y + 0.02, 0.005)
