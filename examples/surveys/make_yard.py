#!/usr/bin/env python3
"""Makes the survey of a yard whose every height and every thing is known, for docs/guide/my-site.md.

    examples/surveys/make_yard.py FOLDER

yard.las     the yard, 40 x 30 m, as a drone's scanner has it: LAS 1.2 in UTM zone 32N, a point every 0.15 m with 10 mm of
             noise, 60 points that belong to nothing, and a pond of 3 m from which nothing comes back
scan.ply     a scanner's own view of the same yard from (18, 14), 2 m above the ground, turned by 30 degrees to the left
floor.ply    a flat floor, of which the place cannot be told
"""

import struct
import sys
from pathlib import Path

import numpy as np

NOISE_M = 0.01
MAP_M = np.array([600_000.0, 5_250_000.0, 420.0])  # the yard's south-western corner
EPSG = 32632
PILE_M, PILE_HEIGHT_M, PILE_RADIUS_M = np.array([28.0, 20.0]), 1.8, 1.8 / np.tan(np.radians(35))
TRENCH_M = (8.0, 9.2, 5.0, 17.0)  # x from and to, y from and to
TRENCH_DEPTH_M = 1.5
POND_M, POND_RADIUS_M = np.array([35.0, 24.0]), 1.5
# Place, turn (deg), length, width, height: a container, a crate, something as large as a person, a post.
THINGS = [
    ((15, 24), 20, 6.0, 2.4, 2.6),
    ((20, 8), -35, 1.2, 0.8, 1.0),
    ((25, 12), 70, 0.5, 0.4, 1.75),
    ((32, 8), 0, 0.2, 0.2, 3.0),
]


def ground(x, y):
    """Height of the ground: a plane that rises by 5 % to the east, a pile, a trench."""
    pile = np.maximum(0, PILE_HEIGHT_M * (1 - np.hypot(x - PILE_M[0], y - PILE_M[1]) / PILE_RADIUS_M))
    west, east, south, north = TRENCH_M
    trench = (x > west) & (x < east) & (y > south) & (y < north)
    return 0.05 * x + pile - TRENCH_DEPTH_M * trench


def in_thing(thing, x, y):
    (cx, cy), turn, length, width, _ = thing
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    u, v = c * (x - cx) + s * (y - cy), -s * (x - cx) + c * (y - cy)
    return (abs(u) < length / 2) & (abs(v) < width / 2)


def faces(thing, spacing, rng):
    """Points of a box's roof and sides."""
    (cx, cy), turn, length, width, height = thing
    count = lambda a, b: max(8, int(a * b / spacing**2))
    parts = []
    n = count(length, width)
    parts.append(np.column_stack([rng.uniform(-length / 2, length / 2, n), rng.uniform(-width / 2, width / 2, n), np.full(n, height)]))
    for side in (-1, 1):
        n = count(length, height)
        parts.append(np.column_stack([rng.uniform(-length / 2, length / 2, n), np.full(n, side * width / 2), rng.uniform(0, height, n)]))
        n = count(width, height)
        parts.append(np.column_stack([np.full(n, side * length / 2), rng.uniform(-width / 2, width / 2, n), rng.uniform(0, height, n)]))
    p = np.concatenate(parts)
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    x, y = cx + c * p[:, 0] - s * p[:, 1], cy + s * p[:, 0] + c * p[:, 1]
    z = ground(np.array([cx]), np.array([cy]))[0] + p[:, 2]
    above = z > ground(x, y)
    return np.column_stack([x, y, z])[above]


def surface(spacing, rng):
    """The yard's points, one anywhere in each square of the ground."""
    x, y = np.meshgrid(np.arange(0, 40, spacing), np.arange(0, 30, spacing))
    x, y = x.ravel() + rng.uniform(0, spacing, x.size), y.ravel() + rng.uniform(0, spacing, y.size)
    seen = np.hypot(x - POND_M[0], y - POND_M[1]) > POND_RADIUS_M
    for thing in THINGS:
        seen &= ~in_thing(thing, x, y)
    x, y = x[seen], y[seen]
    west, east, south, north = TRENCH_M
    walls = []
    for (x0, y0), (x1, y1) in [((west, south), (east, south)), ((west, north), (east, north)), ((west, south), (west, north)), ((east, south), (east, north))]:
        n = int(np.hypot(x1 - x0, y1 - y0) * TRENCH_DEPTH_M / spacing**2)
        t = rng.uniform(0, 1, n)
        wx = x0 + t * (x1 - x0)
        walls.append(np.column_stack([wx, y0 + t * (y1 - y0), 0.05 * wx - rng.uniform(0, TRENCH_DEPTH_M, n)]))
    p = np.concatenate([np.column_stack([x, y, ground(x, y)]), *walls, *[faces(thing, 0.5 * spacing, rng) for thing in THINGS]])
    return p + rng.normal(0, NOISE_M, p.shape)


def write_las(path, p):
    """LAS 1.2, point format 0, millimetres; its map by the GeoTIFF key 3072."""
    numbers = np.round((p - MAP_M) / 0.001).astype("<i4")
    keys = struct.pack("<8H", 1, 1, 0, 1, 3072, 0, 1, EPSG)
    record = struct.pack("<H16sHH32s", 0, b"LASF_Projection", 34735, len(keys), b"") + keys
    header = struct.pack("<4sHH16sBB32s32sHHHIIBHI5I", b"LASF", 0, 0, b"", 1, 2, b"OTHER", b"make_yard.py", 0, 0, 227,
                         227 + len(record), 1, 0, 20, len(p), *[0] * 5)
    low, high = p.min(0), p.max(0)
    header += struct.pack("<12d", 0.001, 0.001, 0.001, *MAP_M, *[v for pair in zip(high, low) for v in pair])
    points = np.zeros(len(p), dtype=[("xyz", "<i4", 3), ("rest", "V8")])
    points["xyz"] = numbers
    path.write_bytes(header + record + points.tobytes())


def write_ply(path, p):
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(p)}\n"
    header += "property float x\nproperty float y\nproperty float z\nend_header\n"
    path.write_bytes(header.encode() + p.astype("<f4").tobytes())


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(7)
    yard = surface(0.15, rng)
    n = 60
    x, y = rng.uniform(0, 40, n), rng.uniform(0, 30, n)
    away = np.where(np.arange(n) % 3 == 0, -rng.uniform(2.5, 4, n), rng.uniform(5, 12, n))
    write_las(folder / "yard.las", np.concatenate([yard, np.column_stack([x, y, 0.05 * x + away])]) + MAP_M)

    scanner = np.array([18.0, 14.0, 0.05 * 18 + 2])
    near = surface(0.2, rng) - scanner
    near = near[np.hypot(near[:, 0], near[:, 1]) < 12]
    c, s = np.cos(np.radians(30)), np.sin(np.radians(30))
    write_ply(folder / "scan.ply", near @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]))

    floor = np.column_stack([rng.uniform(-8, 8, 8000), rng.uniform(-8, 8, 8000), rng.normal(0, NOISE_M, 8000)])
    write_ply(folder / "floor.ply", floor)
    print(f"{folder / 'yard.las'}: {len(yard) + n} points\n{folder / 'scan.ply'}: {len(near)} points")


if __name__ == "__main__":
    main()
