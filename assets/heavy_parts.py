"""Parts that large machines share: steel tracks, beams, hydraulic cylinders, cabs."""

import math
from typing import NamedTuple, Sequence, Tuple

import numpy as np

import paint
from solids import (Body, bar, both_sides, box, cylinder, extrude, lathe, loft, mirrored, pin, pipe,
                    rectangle, round_corners, rounded_rectangle, slab, smooth_path, tube)


def beam(path, heights, widths, chamfer_m):
    """A box beam along a curve in x-z, its section upright to the curve."""
    path = np.asarray(path, dtype=float)
    tangents = np.gradient(path, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    rings = []
    for place, tangent, height, width in zip(path, tangents, heights, widths):
        up = np.array([-tangent[1], tangent[0]])
        section = rounded_rectangle((0, 0), (width, height), chamfer_m, 1)
        flat = place + section[:, 1:] * up
        rings.append(np.column_stack([flat[:, 0], section[:, 0], flat[:, 1]]))
    return loft(rings)


def plate(points, radii, y, thickness, edge_m=0.006):
    """An upright plate, its middle at y, drawn by its outline in x-z."""
    outline = round_corners(points, radii, 2)
    return extrude(outline, "y", y - thickness / 2, y + thickness / 2, edge_m)


def cheeks(points, radii, y, thickness):
    """A pair of plates at y and -y."""
    return both_sides(plate(points, radii, y, thickness))


def mirrored_body(half):
    """What was built of the left side, and the right side."""
    body = Body()
    for part_paint, (triangles, _) in half.by_paint().items():
        body.add(part_paint, triangles, mirrored(triangles))
    return body


class Track(NamedTuple):
    y: float
    z: float            # of sprocket and idler
    radius: float       # outside of the shoes
    width: float
    wheelbase: float
    rollers: int
    carriers: int
    belt: float         # links and shoe with its grouser
    frame: paint.Paint


def _wheel(x, z, y, radius, half_width, sides=20):
    """A roller or idler with a dished side and a rim for the chain."""
    profile = [(0, -half_width * 0.6), (radius * 0.55, -half_width * 0.6),
               (radius * 0.70, -half_width), (radius - 0.03, -half_width),
               (radius - 0.03, -half_width * 0.45), (radius, -half_width * 0.40),
               (radius, half_width * 0.40), (radius - 0.03, half_width * 0.45),
               (radius - 0.03, half_width), (radius * 0.70, half_width),
               (radius * 0.55, half_width * 0.6), (0, half_width * 0.6)]
    return lathe(profile, (x, y, z), (0, 1, 0), sides)


def _roller(x, z, y, radius, half_width):
    """A roller of two flanges, of which the chain hides most."""
    profile = [(0, -half_width), (radius, -half_width), (radius, -0.35 * half_width),
               (0.75 * radius, -0.3 * half_width), (0.75 * radius, 0.3 * half_width),
               (radius, 0.35 * half_width), (radius, half_width), (0, half_width)]
    return lathe(profile, (x, y, z), (0, 1, 0), 12)


def _sprocket(x, y, z, radius, teeth):
    angles = 2 * math.pi * np.arange(4 * teeth) / (4 * teeth)
    radii = np.where(np.arange(len(angles)) % 4 < 2, radius, radius - 0.05)
    outline = np.stack([x + radii * np.cos(angles), z + radii * np.sin(angles)], axis=1)
    return extrude(outline, "y", y - 0.035, y + 0.035)


def track_side(track):
    """Frame, wheels and drive of the left track, drive at the rear."""
    body = Body()
    y, z, reach = track.y, track.z, track.wheelbase / 2
    chain = track.radius - track.belt
    low, high = z - 0.55 * chain, z + 0.42 * chain
    side = round_corners([(-reach + 0.42, low), (reach - 0.48, low), (reach - 0.12, z - 0.10),
                          (reach - 0.12, z + 0.11), (reach - 0.55, high), (-reach + 0.55, high),
                          (-reach + 0.22, z + 0.12), (-reach + 0.22, z - 0.12)], 0.06, 2)
    body.add(track.frame, extrude(side, "y", y - 0.16, y + 0.16, 0.03))
    # The yoke that the idler slides in.
    for side_y in (y - 0.125, y + 0.125):
        body.add(track.frame, bar((reach - 0.5, side_y, z), (reach + 0.06, side_y, z), 0.035, 0.15,
                                  chamfer_m=0.01))
    body.add(paint.STEEL, _wheel(reach, z, y, chain, 0.09))
    body.add(paint.CHARCOAL, pin(reach, z, 0.16, 0.065, 14, y))
    # Sprocket and final drive.
    body.add(paint.STEEL, _sprocket(-reach, y, z, chain + 0.01, 21))
    outside = [(0, -0.20), (0.60 * chain, -0.20), (0.64 * chain, -0.18), (0.64 * chain, 0.02),
               (0.72 * chain, 0.04), (0.72 * chain, 0.07), (0.56 * chain, 0.09),
               (0.52 * chain, 0.19), (0.42 * chain, 0.215), (0, 0.215)]
    body.add(track.frame, lathe(outside, (-reach, y, z), (0, 1, 0), 18))
    for k in range(8):
        angle = 2 * math.pi * k / 8
        x, up = -reach + 0.64 * chain * math.cos(angle), z + 0.64 * chain * math.sin(angle)
        body.add(paint.STEEL, cylinder((x, y + 0.06, up), (x, y + 0.092, up), 0.017, 6))
    bottom = track.belt - 0.005
    for x in np.linspace(-reach + 0.42, reach - 0.42, track.rollers):
        body.add(paint.STEEL, _roller(x, bottom + 0.10, y, 0.10, 0.11))
        body.add(track.frame, *(box((x, y + s * 0.135, low + 0.015), (0.15, 0.05, 0.10), 0.012)
                                for s in (-1, 1)))
    for x in np.linspace(-0.30 * track.wheelbase, 0.26 * track.wheelbase, track.carriers):
        body.add(paint.STEEL, _roller(x, z + chain - 0.075, y, 0.072, 0.09))
        body.add(track.frame, box((x, y - 0.06, high + 0.03), (0.14, 0.12, 0.14), 0.015))
    return body


def shoe(track, length, grousers=(0.62, -0.06, -0.74), height_m=0.026):
    """A steel shoe with its link: x along the belt, z outwards, grouser tips at z = 0.

    `grousers` are places along the shoe, in half lengths from its middle, front first.
    """
    body = Body()
    half = track.width / 2
    reach = length / 2 - 0.004
    top, under = -height_m, -height_m - 0.014
    outline = [(-reach, under), (reach, under), (reach, top)]
    for place in grousers:
        x = place * reach
        outline += [(x + 0.017, top), (x + 0.008, 0.0), (x - 0.008, 0.0), (x - 0.017, top)]
    outline.append((-reach, top))
    body.add(paint.WORN_STEEL, extrude(outline, "y", -half, half))
    link = rectangle((0, under - 0.032), (length, 0.064))
    for y in (-0.075, 0.075):
        body.add(paint.CHARCOAL, extrude(link, "y", y - 0.018, y + 0.018))
    return body


class Cylinder(NamedTuple):
    bore: float         # inside of the barrel
    rod: float          # diameter
    eye: float          # half width of the eyes
    clearance: float    # from a pin to the other part's end when shut


def cylinder_lengths(shape, span, name):
    """Length of barrel and rod from their pins, for the shortest and longest distance of these."""
    shortest, longest = span
    length = shortest - shape.clearance
    if 2 * length < longest + 0.04:
        raise ValueError(f"{name} cylinder does not reach over its joint's travel")
    return length


def barrel(shape, span, name, color):
    body = Body()
    length = cylinder_lengths(shape, span, name)
    radius = shape.bore / 2 + 0.012
    body.add(color, pipe((0, -shape.eye, 0), (0, shape.eye, 0), radius * 1.08, 0.040, 14))
    profile = [(0, 0.06), (radius * 0.8, 0.06), (radius + 0.006, 0.11), (radius + 0.006, 0.16),
               (radius, 0.17), (radius, length - 0.15), (radius + 0.014, length - 0.14),
               (radius + 0.014, length - 0.02), (radius * 0.8, length), (0, length)]
    body.add(color, lathe(profile, (0, 0, 0), (1, 0, 0), 14))
    for x in (0.22, length - 0.20):
        body.add(paint.STEEL, box((x, 0, radius + 0.012), (0.07, 0.06, 0.05), 0.008))
    line = smooth_path([(0.22, 0, radius + 0.03), (0.30, 0, radius + 0.052),
                        (length - 0.28, 0, radius + 0.052), (length - 0.20, 0, radius + 0.03)], 2)
    body.add(paint.STEEL, tube(line, 0.013, 6), crease_deg=75)
    for x in (0.40, length - 0.40):
        body.add(paint.CHARCOAL, lathe([(radius + 0.004, -0.02), (radius + 0.004, 0.02),
                                        (radius - 0.01, 0.02), (radius - 0.01, -0.02)], (x, 0, 0),
                                       (1, 0, 0), 14, closed=True))
    return body


def rod(shape, span, name, color):
    body = Body()
    length = cylinder_lengths(shape, span, name)
    radius = shape.rod / 2
    body.add(color, pipe((0, -shape.eye, 0), (0, shape.eye, 0), shape.bore / 2 + 0.015, 0.040, 14))
    neck = [(0, -0.15), (radius * 1.1, -0.15), (radius * 1.3, -0.07), (0, -0.045)]
    body.add(color, lathe(neck, (0, 0, 0), (1, 0, 0), 14))
    body.add(paint.CHROME, cylinder((-length, 0, 0), (-0.14, 0, 0), radius, 14))
    return body


class Cab(NamedTuple):
    """A cab by its side view: front and rear edge from the floor up to the roof, in x-z."""
    front: Sequence[Tuple[float, float]]
    rear: Sequence[Tuple[float, float]]
    right: float
    left: float
    sill: float             # lower edge of the panes at the sides
    door: Tuple[float, float]    # x of the pillar behind the door, at the sill and at the roof
    pillar: float
    body: paint.Paint
    frame: paint.Paint


def _on(edge, z):
    """x of an edge (polyline in x-z, rising) at a height."""
    heights = [p[1] for p in edge]
    return float(np.interp(z, heights, [p[0] for p in edge]))


def _cab_frame(body, cab):
    right, left = cab.right + cab.pillar / 2, cab.left - cab.pillar / 2
    roof = cab.front[-1][1]
    for edge, inward in ((cab.front, -0.45), (cab.rear, 0.45)):
        points = [(x + inward * cab.pillar, z) for x, z in edge]
        for a, b in zip(points, points[1:]):
            body.add(cab.frame, *(bar((a[0], y, a[1]), (b[0], y, b[1]), cab.pillar,
                                      cab.pillar * 1.1, chamfer_m=0.018) for y in (right, left)))
        for x, z in points[1:]:
            body.add(cab.frame, bar((x, right, z), (x, left, z), 0.07, 0.06, (0, 0, 1), 0.012))
    for y in (right, left):
        body.add(cab.frame, bar((cab.door[0], y, cab.sill), (cab.door[1], y, roof), cab.pillar,
                                cab.pillar, chamfer_m=0.016))
        for z in (cab.sill, roof - 0.02):
            body.add(cab.frame, bar((_on(cab.rear, z) + 0.03, y, z),
                                    (_on(cab.front, z) - 0.03, y, z), cab.pillar, 0.08,
                                    chamfer_m=0.014))


def _cab_panes(body, cab):
    roof, gap = cab.front[-1][1] - 0.03, 0.55 * cab.pillar
    inside = (cab.right + gap, cab.left - gap)
    for edge, inward in ((cab.front, -0.02), (cab.rear, 0.02)):
        for (x0, z0), (x1, z1) in zip(edge, edge[1:]):
            if z1 <= cab.sill and edge is cab.rear:
                continue
            low = z0 + 0.04
            x = x0 + (x1 - x0) * 0.04 / (z1 - z0)
            body.add(paint.GLASS, slab([(x + inward, inside[0], low), (x + inward, inside[1], low),
                                        (x1 + inward, inside[1], min(z1, roof)),
                                        (x1 + inward, inside[0], min(z1, roof))], 0.008))
    sill = cab.sill + 0.03
    for y in (cab.right + 0.02, cab.left - 0.02):
        heights = [sill] + [z for _, z in cab.front if sill < z < roof] + [roof]
        front = [(_on(cab.front, z) - gap, z) for z in heights]
        pillar = [(cab.door[1] + gap, roof), (cab.door[0] + gap, sill)]
        body.add(paint.GLASS, slab([(x, y, z) for x, z in front + pillar], 0.008))
        heights = [sill] + [z for _, z in cab.rear if sill < z < roof] + [roof]
        rear = [(_on(cab.rear, z) + gap, z) for z in heights]
        pillar = [(cab.door[1] - gap, roof), (cab.door[0] - gap, sill)]
        body.add(paint.GLASS, slab([(x, y, z) for x, z in rear + pillar], 0.008))


def _cab_inside(body, cab):
    floor, middle = cab.front[0][1], (cab.left + cab.right) / 2
    seat_x, width = _on(cab.rear, cab.sill) + 0.42, cab.left - cab.right
    body.add(paint.INTERIOR, box((seat_x - 0.28, middle, floor + 0.42),
                                 (0.16, width - 0.2, 0.75), 0.02))
    body.add(paint.BLACK, box((seat_x + 0.10, middle, floor + 0.26), (0.42, 0.46, 0.32), 0.03))
    cushion = round_corners([(seat_x - 0.15, floor + 0.42), (seat_x + 0.36, floor + 0.43),
                             (seat_x + 0.38, floor + 0.52), (seat_x - 0.15, floor + 0.53)], 0.04)
    body.add(paint.FABRIC, extrude(cushion, "y", middle - 0.26, middle + 0.26, 0.03, 2))
    back = round_corners([(seat_x - 0.15, floor + 0.50), (seat_x - 0.02, floor + 0.54),
                          (seat_x - 0.12, floor + 1.12), (seat_x - 0.24, floor + 1.12)], 0.05)
    body.add(paint.FABRIC, extrude(back, "y", middle - 0.25, middle + 0.25, 0.03, 2))
    for y in (middle - 0.33, middle + 0.33):
        body.add(paint.INTERIOR, box((seat_x + 0.16, y, floor + 0.58), (0.52, 0.14, 0.22), 0.03))
        stick = smooth_path([(seat_x + 0.36, y, floor + 0.68), (seat_x + 0.38, y, floor + 0.76),
                             (seat_x + 0.375, y, floor + 0.86)], 3)
        body.add(paint.BLACK, tube(stick, 0.020, 8))
    body.add(paint.BLACK, box((_on(cab.front, floor + 0.85) - 0.16, cab.right + 0.14, floor + 0.85),
                              (0.04, 0.20, 0.26), 0.01))


def add_cab(body, cab):
    """Lower body, pillars, panes, roof, door handle, work lamps, seat."""
    floor, roof = cab.front[0][1], cab.front[-1][1]
    top = cab.sill - 0.03
    side = [(x, z) for x, z in cab.front if z < top] + [(_on(cab.front, top), top),
            (_on(cab.rear, top), top)] + [(x, z) for x, z in reversed(cab.rear)
                                                    if z < top]
    thick = 0.05
    for y in (cab.right, cab.left - thick):
        body.add(cab.body, extrude(round_corners(side, 0.03, 2), "y", y, y + thick, 0.010))
    body.add(cab.body, box(((cab.front[0][0] + cab.rear[0][0]) / 2, (cab.left + cab.right) / 2,
                            floor + 0.02), (cab.front[0][0] - cab.rear[0][0] - 0.02,
                                            cab.left - cab.right - 0.02, 0.05), 0.01))
    rear_x = _on(cab.rear, cab.sill)
    body.add(cab.body, box((rear_x + 0.02, (cab.left + cab.right) / 2, (floor + cab.sill) / 2),
                           (0.05, cab.left - cab.right - 0.04, cab.sill - floor), 0.01))
    _cab_frame(body, cab)
    _cab_panes(body, cab)
    _cab_inside(body, cab)
    center = ((cab.front[-1][0] + cab.rear[-1][0]) / 2, (cab.left + cab.right) / 2)
    size = (cab.front[-1][0] - cab.rear[-1][0] + 0.10, cab.left - cab.right + 0.02)
    lid = rounded_rectangle(center, size, 0.12, 4)
    body.add(cab.body, extrude(lid, "z", roof - 0.03, roof + 0.08, 0.035, 3), crease_deg=50)
    x = cab.front[-1][0] + 0.03
    for y in (cab.right + 0.16, cab.left - 0.16):
        body.add(paint.BLACK, box((x + 0.02, y, roof + 0.02), (0.09, 0.15, 0.10), 0.015))
        body.add(paint.LAMP, box((x + 0.068, y, roof + 0.02), (0.014, 0.12, 0.075), 0.003))
    handle_x = cab.door[0] + 0.16
    body.add(paint.BLACK, box((handle_x, cab.left + 0.012, cab.sill + 0.02), (0.14, 0.03, 0.045),
                              0.008))


def handrail(points, radius=0.020):
    return tube(smooth_path(points, 3), radius, 6)


def grille(body, center, size, along, count, color=paint.BLACK):
    """Slots of a louvre: boxes spread along an axis ('x' or 'z') over a size (x, y, z)."""
    at = "xyz".index(along)
    for offset in (np.arange(count) + 0.5) / count - 0.5:
        place, part = np.array(center, dtype=float), np.array(size, dtype=float)
        place[at] += offset * size[at]
        part[at] = 0.45 * size[at] / count
        body.add(color, box(place, part))
