"""Closed solids from simple shapes, as arrays of triangles (n, 3, 3), lengths in metres.

Every function here returns one closed surface whose triangles turn counter-clockwise seen from
outside. Frames: x forward, y left, z up.
"""

import math

import numpy as np

WELD_M = 1e-6


class Body:
    """The solids of one node, each with its paint and with normals for shading."""

    def __init__(self):
        self._parts = []

    def add(self, paint, *solids, crease_deg=35.0):
        """Adds solids; faces that meet at less than `crease_deg` are shaded as one surface."""
        for solid in solids:
            self._parts.append((paint, solid, corner_normals(solid, crease_deg)))

    def add_shaded(self, paint, triangles, normals):
        """Adds triangles whose normals are known."""
        self._parts.append((paint, triangles, normals))

    def by_paint(self):
        """Triangles and normals by paint, in the order the paints came."""
        grouped = {}
        for paint, solid, normals in self._parts:
            grouped.setdefault(paint, []).append((solid, normals))
        return {paint: (np.concatenate([s for s, _ in pairs]),
                        np.concatenate([n for _, n in pairs]))
                for paint, pairs in grouped.items()}

    def triangle_count(self):
        return sum(len(solid) for _, solid, _ in self._parts)


def volume_m3(solid):
    """Signed volume of a closed solid: positive if its triangles face outwards."""
    return float(np.einsum("ij,ij->i", solid[:, 0],
                           np.cross(solid[:, 1], solid[:, 2])).sum() / 6.0)


def corner_normals(solid, crease_deg):
    """A normal for each corner: faces around it within the crease, weighted by their angle there."""
    edges = np.roll(solid, -1, axis=1) - solid
    faces = np.cross(edges[:, 0], edges[:, 1])
    faces /= np.linalg.norm(faces, axis=1, keepdims=True)
    along = edges / np.linalg.norm(edges, axis=2, keepdims=True)
    cosines = -np.einsum("tij,tij->ti", along, np.roll(along, 1, axis=1))
    angles = np.arccos(np.clip(cosines, -1, 1))
    _, vertex = np.unique(np.round(solid.reshape(-1, 3) / WELD_M), axis=0, return_inverse=True)
    vertex = vertex.reshape(-1)
    corners_at = [[] for _ in range(vertex.max() + 1)]
    for corner, at in enumerate(vertex):
        corners_at[at].append(corner)
    normals = np.empty((len(vertex), 3))
    limit = math.cos(math.radians(crease_deg))
    for corners in corners_at:
        near = faces[[c // 3 for c in corners]]
        weights = angles.reshape(-1)[corners]
        smooth = (near @ near.T > limit) * weights
        normals[corners] = smooth @ near
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return normals.reshape(-1, 3, 3)


def _finish(triangles):
    """Drops triangles without area and turns the surface outwards."""
    solid = np.asarray(triangles, dtype=float)
    twice_area = np.linalg.norm(
        np.cross(solid[:, 1] - solid[:, 0], solid[:, 2] - solid[:, 0]), axis=1)
    solid = solid[twice_area > 1e-10]
    return solid if volume_m3(solid) > 0 else solid[:, ::-1]


def _cross2(a, b):
    return a[0] * b[1] - a[1] * b[0]


def _signed_area(outline):
    x, y = outline[:, 0], outline[:, 1]
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def triangulate(outline):
    """Index triples that fill a simple polygon (m, 2), by cutting ears."""
    points = np.asarray(outline, dtype=float)
    order = list(range(len(points)))
    if _signed_area(points) < 0:
        order.reverse()
    triples = []
    while len(order) > 3:
        best, best_quality = None, -math.inf
        for k in range(len(order)):
            i, j, l = order[k - 1], order[k], order[(k + 1) % len(order)]
            a, b, c = points[i], points[j], points[l]
            area = _cross2(b - a, c - a)
            if area <= 1e-14:
                continue
            others = points[[o for o in order if o not in (i, j, l)]]
            inside = np.ones(len(others), dtype=bool)
            for p, q in ((a, b), (b, c), (c, a)):
                d = others - p
                inside &= (q - p)[0] * d[:, 1] - (q - p)[1] * d[:, 0] > -1e-12
            if inside.any():
                continue
            quality = area / (np.sum((a - b)**2) + np.sum((b - c)**2) + np.sum((c - a)**2))
            if quality > best_quality:
                best, best_quality = k, quality
        if best is None:  # only flat ears are left
            best = 1
        triples.append((order[best - 1], order[best], order[(best + 1) % len(order)]))
        del order[best]
    triples.append(tuple(order))
    return triples


def _cap(ring, forward):
    """Triangles that fill a nearly flat ring (m, 3), along its way or against it."""
    if np.ptp(ring, axis=0).max() < WELD_M:
        return []
    ring = ring[np.linalg.norm(ring - np.roll(ring, 1, axis=0), axis=1) > WELD_M]
    center = ring - ring.mean(axis=0)
    normal = np.cross(center, np.roll(center, -1, axis=0)).sum(axis=0)
    across = int(np.argmax(np.abs(normal)))
    keep = [k for k in range(3) if k != across]
    flat = ring[:, keep]
    triples = triangulate(flat)
    # triangulate turns counter-clockwise in `flat`; the ring does where its area is positive.
    if (_signed_area(flat) > 0) != forward:
        triples = [triple[::-1] for triple in triples]
    return [ring[list(triple)] for triple in triples]


def loft(rings, closed=False):
    """Skin over rings (k, m, 3) of equally many points, capped at both ends unless closed."""
    rings = [np.asarray(ring, dtype=float) for ring in rings]
    triangles = []
    for number in range(len(rings) if closed else len(rings) - 1):
        a, b = rings[number], rings[(number + 1) % len(rings)]
        for i in range(len(a)):
            j = (i + 1) % len(a)
            triangles.append((a[i], a[j], b[j]))
            triangles.append((a[i], b[j], b[i]))
    if not closed:
        triangles.extend(_cap(rings[0], forward=False))
        triangles.extend(_cap(rings[-1], forward=True))
    return _finish(triangles)


def outline_points(points):
    """Points as an array, counter-clockwise."""
    outline = np.asarray(points, dtype=float)
    return outline if _signed_area(outline) > 0 else outline[::-1]


def inset(outline, distance_m):
    """A counter-clockwise outline moved inwards by a distance, corners mitred."""
    edges = np.roll(outline, -1, axis=0) - outline
    edges /= np.linalg.norm(edges, axis=1, keepdims=True)
    inward = np.stack([-edges[:, 1], edges[:, 0]], axis=1)
    before = np.roll(inward, 1, axis=0)
    spread = 1 + np.einsum("ij,ij->i", inward, before)
    return outline + distance_m * (inward + before) / np.maximum(spread, 0.25)[:, None]


def _place(outline, axis, height_m):
    """Points of an outline in the plane across `axis` ('x': y-z, 'y': x-z, 'z': x-y)."""
    ring = np.empty((len(outline), 3))
    at = "xyz".index(axis)
    ring[:, at] = height_m
    ring[:, [k for k in range(3) if k != at]] = outline
    return ring


def extrude(outline, axis, low_m, high_m, edge_m=0.0, steps=1):
    """A plate or block: an outline drawn along an axis, its rims chamfered or, in steps, rounded."""
    points = outline_points(outline)
    if edge_m <= 0:
        return loft([_place(points, axis, low_m), _place(points, axis, high_m)])
    lower, upper = [], []
    for step in range(steps + 1):
        angle = 0.5 * math.pi * step / steps
        ring = inset(points, edge_m * (1 - math.sin(angle)))
        rise = edge_m * (1 - math.cos(angle))
        lower.append(_place(ring, axis, low_m + rise))
        upper.append(_place(ring, axis, high_m - rise))
    return loft(lower + upper[::-1])


def rounded_rectangle(center, size, radius_m, steps=3):
    """Outline of a rectangle with round (steps > 1) or cut (steps = 1) corners."""
    points = []
    for number, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        corner = (center[0] + sx * (size[0] / 2 - radius_m),
                  center[1] + sy * (size[1] / 2 - radius_m))
        for step in range(steps + 1):
            angle = 0.5 * math.pi * (number + step / steps)
            points.append((corner[0] + radius_m * math.cos(angle),
                           corner[1] + radius_m * math.sin(angle)))
    return np.array(points)


def round_corners(points, radii_m, steps=3):
    """An outline with its corners rounded, one radius for all or one for each."""
    points = np.asarray(points, dtype=float)
    radii = np.broadcast_to(np.asarray(radii_m, dtype=float), len(points))
    result = []
    for k, (corner, radius) in enumerate(zip(points, radii)):
        if radius <= 0:
            result.append(corner)
            continue
        to_previous, to_next = points[k - 1] - corner, points[(k + 1) % len(points)] - corner
        reach = min(radius, 0.45 * np.linalg.norm(to_previous), 0.45 * np.linalg.norm(to_next))
        start = corner + reach * to_previous / np.linalg.norm(to_previous)
        end = corner + reach * to_next / np.linalg.norm(to_next)
        for step in range(steps + 1):
            t = step / steps
            result.append((1 - t)**2 * start + 2 * t * (1 - t) * corner + t**2 * end)
    return np.array(result)


def box(center, size, chamfer_m=0.0):
    """A box; with a chamfer all its edges are cut."""
    low, high = center[2] - size[2] / 2, center[2] + size[2] / 2
    if chamfer_m <= 0:
        outline = rectangle(center, size)
        return extrude(outline, "z", low, high)
    outline = rounded_rectangle(center, size, chamfer_m, steps=1)
    # Both points of a cut corner meet in one point of the lid.
    lid = np.repeat(rectangle(center, np.subtract(size[:2], 2 * chamfer_m)), 2, axis=0)
    return loft([_place(ring, "z", height) for ring, height in
                 ((lid, low), (outline, low + chamfer_m), (outline, high - chamfer_m),
                  (lid, high))])


def rectangle(center, size):
    """Outline of a rectangle."""
    return np.array([(center[0] + sx * size[0] / 2, center[1] + sy * size[1] / 2)
                     for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1))])


def _frame_across(direction):
    """Two unit vectors across a direction; with it they are right-handed."""
    along = np.asarray(direction, dtype=float)
    along = along / np.linalg.norm(along)
    helper = np.array([0.0, 1.0, 0.0]) if abs(along[1]) < 0.9 else np.array([0.0, 0.0, 1.0])
    u = np.cross(helper, along)
    u /= np.linalg.norm(u)
    return u, np.cross(along, u), along


def lathe(profile, origin, direction, sides=16, closed=False):
    """A solid of revolution; the profile lists (radius, height along the axis)."""
    u, v, along = _frame_across(direction)
    origin = np.asarray(origin, dtype=float)
    angles = 2 * math.pi * (np.arange(sides) + 0.5) / sides
    circle = np.cos(angles)[:, None] * u + np.sin(angles)[:, None] * v
    rings = [origin + height * along + radius * circle for radius, height in profile]
    return loft(rings, closed)


def cylinder(start, end, radius_m, sides=16, chamfer_m=0.0):
    """A cylinder between two points."""
    length = float(np.linalg.norm(np.subtract(end, start)))
    profile = [(radius_m, 0), (radius_m, length)]
    if chamfer_m > 0:
        profile = [(radius_m - chamfer_m, 0), (radius_m, chamfer_m),
                   (radius_m, length - chamfer_m), (radius_m - chamfer_m, length)]
    return lathe(profile, start, np.subtract(end, start), sides)


def pipe(start, end, outer_m, inner_m, sides=16):
    """A hollow cylinder between two points."""
    length = float(np.linalg.norm(np.subtract(end, start)))
    return lathe([(outer_m, 0), (outer_m, length), (inner_m, length), (inner_m, 0)], start,
                 np.subtract(end, start), sides, closed=True)


def pin(x, z, half_width_m, radius_m, sides=12, y=0.0):
    """A pin or boss across the machine (along y)."""
    return cylinder((x, y - half_width_m, z), (x, y + half_width_m, z), radius_m, sides,
                    min(0.006, radius_m / 4))


def smooth_path(points, per_span=5):
    """A Catmull-Rom curve through the points."""
    points = np.asarray(points, dtype=float)
    padded = np.concatenate([[2 * points[0] - points[1]], points, [2 * points[-1] - points[-2]]])
    curve = []
    for k in range(1, len(padded) - 2):
        p0, p1, p2, p3 = padded[k - 1:k + 3]
        for step in range(per_span):
            t = step / per_span
            curve.append(0.5 * (2 * p1 + (p2 - p0) * t + (2 * p0 - 5 * p1 + 4 * p2 - p3) * t**2
                                + (3 * p1 - p0 - 3 * p2 + p3) * t**3))
    curve.append(points[-1])
    return np.array(curve)


def sweep(path, section):
    """A section (m, 2) carried along a path without twist."""
    path = np.asarray(path, dtype=float)
    tangents = np.gradient(path, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    u, _, _ = _frame_across(tangents[0])
    rings = []
    for place, tangent in zip(path, tangents):
        u = u - np.dot(u, tangent) * tangent
        u /= np.linalg.norm(u)
        v = np.cross(tangent, u)
        rings.append(place + section[:, :1] * u + section[:, 1:] * v)
    return loft(rings)


def tube(path, radius_m, sides=8):
    """A round bar or hose along a path."""
    angles = 2 * math.pi * np.arange(sides) / sides
    return sweep(path, radius_m * np.stack([np.cos(angles), np.sin(angles)], axis=1))


def bar(start, end, width_m, depth_m, across=(0, 1, 0), chamfer_m=0.0):
    """A straight bar with a rectangular section: `width_m` along `across`, `depth_m` the other way."""
    start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    along = (end - start) / np.linalg.norm(end - start)
    u = np.asarray(across, dtype=float)
    u = u - np.dot(u, along) * along
    u /= np.linalg.norm(u)
    v = np.cross(along, u)
    section = (rounded_rectangle((0, 0), (width_m, depth_m), chamfer_m, 1) if chamfer_m > 0 else
               rectangle((0, 0), (width_m, depth_m)))
    return loft([place + section[:, :1] * u + section[:, 1:] * v for place in (start, end)])


def slab(corners, thickness_m):
    """A flat pane given by its corners in space, thickened evenly to both sides."""
    corners = np.asarray(corners, dtype=float)
    normal = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    shift = 0.5 * thickness_m * normal / np.linalg.norm(normal)
    return loft([corners - shift, corners + shift])


def ribbon(profile, thickness_m):
    """Outline of a bent plate: an open profile (n, 2) and its parallel to the right of its way."""
    profile = np.asarray(profile, dtype=float)
    steps = np.diff(profile, axis=0)
    steps /= np.linalg.norm(steps, axis=1, keepdims=True)
    right = np.stack([steps[:, 1], -steps[:, 0]], axis=1)
    before = np.concatenate([right[:1], right])
    after = np.concatenate([right, right[-1:]])
    spread = 1 + np.einsum("ij,ij->i", before, after)
    other = profile + thickness_m * (before + after) / spread[:, None]
    return np.concatenate([profile, other[::-1]])


def ellipsoid(center, radii, sides=16, rows=8):
    """An ellipsoid with its poles along z."""
    angles = np.linspace(-0.5 * math.pi, 0.5 * math.pi, rows + 1)
    profile = [(max(math.cos(a), 0.0) if 0 < k < rows else 0.0, math.sin(a))
               for k, a in enumerate(angles)]
    unit = lathe(profile, (0, 0, 0), (0, 0, 1), sides)
    return _finish(unit * np.asarray(radii) + np.asarray(center))


def moved(solid, shift):
    return solid + np.asarray(shift, dtype=float)


def turned(solid, axis, angle_deg, about=(0, 0, 0)):
    """Turned about an axis ('x', 'y' or 'z', right-handed) through a point."""
    c, s = math.cos(math.radians(angle_deg)), math.sin(math.radians(angle_deg))
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    rotation = np.eye(3)
    rotation[i, i], rotation[i, j], rotation[j, i], rotation[j, j] = c, -s, s, c
    about = np.asarray(about, dtype=float)
    return (solid - about) @ rotation.T + about


def mirrored(solid):
    """The mirror image to the other side (y to -y)."""
    return (solid * np.array([1.0, -1.0, 1.0]))[:, ::-1]


def both_sides(*solids):
    """The solids and their mirror images."""
    return [*solids, *(mirrored(solid) for solid in solids)]
