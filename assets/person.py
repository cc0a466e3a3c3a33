"""A construction worker, 1.8 m with helmet, as lofted limbs; origin on the ground, x forward."""

import math
from typing import NamedTuple

import numpy as np

import paint
from solids import (Body, ellipsoid, extrude, lathe, loft, mirrored, moved, round_corners,
                    smooth_path, turned)

HIP = np.array([0.0, 0.095, 0.93])
THIGH, SHANK, ANKLE_HEIGHT = 0.43, 0.42, 0.09
SHOULDER = np.array([-0.01, 0.205, 1.435])
UPPER_ARM, FOREARM = 0.29, 0.26


class Gait(NamedTuple):
    """Angles of one leg and of the arm on the same side; forward and flexed are positive."""
    hip_deg: float
    knee_deg: float
    foot_deg: float     # toes up
    arm_deg: float
    elbow_deg: float


STANDING = (Gait(2, 4, 0, 4, 14), Gait(-2, 3, 0, -2, 12))       # left, right
WALKING = (Gait(26, 6, 16, -24, 14), Gait(-14, 26, -34, 26, 30))


def _limb(knots, sides=12):
    """Elliptic sections along a path; a knot is (x, y, z, half depth, half width)."""
    path = smooth_path(knots, 2)
    tangents = np.gradient(path[:, :3], axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    angles = 2 * math.pi * np.arange(sides) / sides
    rings = []
    for (x, y, z, depth, width), tangent in zip(path, tangents):
        side = np.array([0.0, 1.0, 0.0]) - tangent[1] * tangent
        side /= np.linalg.norm(side)
        front = np.cross(side, tangent)
        rings.append(np.array([x, y, z]) + depth * np.cos(angles)[:, None] * front
                     + width * np.sin(angles)[:, None] * side)
    return loft(rings)


def _stack(rows, sides=20, power=2.5):
    """Level sections (z, centre x, half depth, half width), between ellipse and rectangle."""
    angles = 2 * math.pi * np.arange(sides) / sides
    c, s = np.cos(angles), np.sin(angles)
    cs, sn = (np.sign(v) * np.abs(v)**(2 / power) for v in (c, s))
    path = smooth_path(rows, 2)
    return loft([np.column_stack([x + depth * cs, width * sn, np.full(sides, z)])
                 for z, x, depth, width in path])


def along(angle_deg):
    """Downward direction swung forwards by an angle."""
    return np.array([math.sin(math.radians(angle_deg)), 0, -math.cos(math.radians(angle_deg))])


def leg(gait):
    """Paints and solids of the left leg, and where its ankle is."""
    knee = HIP + THIGH * along(gait.hip_deg)
    ankle = knee + SHANK * along(gait.hip_deg - gait.knee_deg)
    thigh, shank = along(gait.hip_deg), along(gait.hip_deg - gait.knee_deg)

    def knot(place, depth, width):
        return (*place, depth, width)

    trousers = _limb([knot(HIP - 0.03 * thigh, 0.098, 0.090), knot(HIP + 0.12 * thigh, 0.092, 0.086),
                      knot(knee - 0.08 * thigh, 0.070, 0.068), knot(knee + 0.06 * shank, 0.064, 0.062),
                      knot(knee + 0.16 * shank, 0.068, 0.064), knot(ankle - 0.06 * shank, 0.058, 0.056),
                      knot(ankle + 0.005 * shank, 0.062, 0.060)])
    sections = ((-0.075, 0.000, 0.075, 0.030), (-0.060, -0.078, 0.090, 0.040),
                (0.0, -0.080, 0.095, 0.046), (0.055, -0.080, 0.060, 0.049),
                (0.120, -0.080, 0.005, 0.050), (0.165, -0.078, -0.012, 0.043),
                (0.190, -0.070, -0.030, 0.026))
    angles = 2 * math.pi * (np.arange(12) + 0.5) / 12
    c, s = (np.sign(v) * np.abs(v)**0.6 for v in (np.cos(angles), np.sin(angles)))
    boot = loft([np.column_stack([np.full(12, x), half * c, (low + high) / 2 + s * (high - low) / 2])
                 for x, low, high, half in sections])
    sole = extrude(round_corners([(-0.08, -0.04), (-0.05, -0.050), (0.13, -0.053), (0.19, -0.03),
                                  (0.195, 0.0), (0.19, 0.03), (0.13, 0.053), (-0.05, 0.050),
                                  (-0.08, 0.04)], 0.02, 2), "z", -ANKLE_HEIGHT, -0.062, 0.004)
    place = [moved(turned(part, "y", -gait.foot_deg), ankle) for part in (boot, sole)]
    band = [_limb([knot(ankle - t * shank, 0.0665, 0.0635) for t in (0.20, 0.16)])]
    return ((paint.TROUSERS, trousers), (paint.LEATHER, place[0]), (paint.RUBBER, place[1]),
            (paint.REFLECTIVE, band[0]))


def arm(gait):
    upper, lower = along(gait.arm_deg), along(gait.arm_deg + gait.elbow_deg)
    outward = np.array([0.0, 0.10, 0.0])
    elbow = SHOULDER + UPPER_ARM * (upper + outward)
    wrist = elbow + FOREARM * (lower + 0.3 * outward)
    sleeve = _limb([(*(SHOULDER + [0, -0.10, 0.045]), 0.050, 0.040),
                     (*(SHOULDER + [0, -0.045, 0.022]), 0.066, 0.055),
                     (*(SHOULDER + [0, 0.0, -0.035]), 0.068, 0.058),
                    (*(SHOULDER + 0.5 * (elbow - SHOULDER)), 0.056, 0.054), (*elbow, 0.047, 0.046),
                    (*(elbow + 0.35 * (wrist - elbow)), 0.046, 0.044), (*wrist, 0.034, 0.032)])
    cuff = _limb([(*(wrist - 0.035 * lower), 0.042, 0.038), (*(wrist + 0.01 * lower), 0.038, 0.033)])
    palm = _limb([(*(wrist - 0.01 * lower), 0.030, 0.024), (*(wrist + 0.06 * lower), 0.044, 0.022),
                  (*(wrist + 0.12 * lower), 0.040, 0.020), (*(wrist + 0.17 * lower), 0.026, 0.015),
                  (*(wrist + 0.185 * lower), 0.010, 0.006)], 10)
    front = np.array([-lower[2], 0, lower[0]])
    thumb = _limb([(*(wrist + 0.02 * lower + 0.02 * front), 0.016, 0.015),
                   (*(wrist + 0.07 * lower + 0.052 * front), 0.015, 0.014),
                   (*(wrist + 0.105 * lower + 0.056 * front), 0.008, 0.008)], 8)
    return ((paint.SHIRT, sleeve), (paint.GLOVE, cuff), (paint.GLOVE, palm), (paint.GLOVE, thumb))


def trunk(body):
    pelvis = [(0.825, 0.0, 0.070, 0.125), (0.87, -0.005, 0.105, 0.172), (0.94, -0.005, 0.118, 0.180),
              (1.02, 0.0, 0.112, 0.166), (1.06, 0.0, 0.105, 0.160)]
    body.add(paint.TROUSERS, _stack(pelvis), crease_deg=60)
    vest = [(0.925, 0.0, 0.128, 0.192), (1.02, 0.002, 0.124, 0.180), (1.15, 0.004, 0.126, 0.186),
            (1.30, 0.002, 0.130, 0.205), (1.40, -0.006, 0.118, 0.196), (1.465, -0.014, 0.088, 0.155),
            (1.505, -0.016, 0.062, 0.085)]
    body.add(paint.HI_VIS, _stack(vest), crease_deg=60)
    for z, depth, width in ((1.035, 0.127, 0.184), (1.175, 0.130, 0.193)):
        rows = [(z - 0.025, 0.003, depth, width), (z + 0.025, 0.003, depth + 0.002, width + 0.003)]
        body.add(paint.REFLECTIVE, _stack(rows), crease_deg=60)
    # Braces of the vest over both shoulders.
    path = np.array([(0.128, 1.20), (0.132, 1.30), (0.120, 1.40), (0.085, 1.468), (0.0, 1.498),
                     (-0.085, 1.480), (-0.125, 1.40), (-0.134, 1.30), (-0.124, 1.20)])
    outline = np.concatenate([path, path[::-1] * [0.97, 1.0] - [0, 0.006]])
    brace = extrude(outline, "y", 0.075, 0.125)
    body.add(paint.REFLECTIVE, brace, mirrored(brace), crease_deg=50)


def head(body):
    body.add(paint.SKIN, _limb([(-0.022, 0, 1.47, 0.058, 0.058), (-0.010, 0, 1.54, 0.054, 0.054),
                                (0.0, 0, 1.60, 0.052, 0.050)]), crease_deg=60)
    face = [(1.545, 0.052, 0.022, 0.018), (1.560, 0.035, 0.058, 0.046), (1.60, 0.016, 0.088, 0.066),
            (1.65, 0.006, 0.099, 0.074), (1.70, 0.0, 0.100, 0.076), (1.74, 0.0, 0.090, 0.068)]
    body.add(paint.SKIN, _stack(face, 16, 2.2), crease_deg=70)
    nose = _limb([(0.098, 0, 1.668, 0.006, 0.008), (0.110, 0, 1.640, 0.013, 0.013),
                  (0.102, 0, 1.622, 0.010, 0.011)], 8)
    body.add(paint.SKIN, nose, ellipsoid((0.0, 0.076, 1.645), (0.018, 0.010, 0.030), 8, 6),
             ellipsoid((0.0, -0.076, 1.645), (0.018, 0.010, 0.030), 8, 6), crease_deg=70)
    body.add(paint.BLACK, ellipsoid((0.090, 0.031, 1.668), (0.012, 0.015, 0.009), 8, 4),
             ellipsoid((0.090, -0.031, 1.668), (0.012, 0.015, 0.009), 8, 4), crease_deg=70)
    hair = [(1.60, -0.045, 0.050, 0.060), (1.66, -0.028, 0.080, 0.080), (1.71, -0.012, 0.095, 0.082)]
    body.add(paint.LEATHER, _stack(hair, 16, 2.2), crease_deg=70)
    shell = lathe([(0.0, 0.0), (0.104, 0.0), (0.106, 0.02), (0.100, 0.055), (0.082, 0.088),
                   (0.050, 0.108), (0.0, 0.115)], (0, 0, 0), (0, 0, 1), 20)
    shell = moved(shell * [1.18, 1.0, 1.0], (0.0, 0.0, 1.690))
    peak = round_corners([(0.06, 0.108), (0.06, -0.108), (0.165, -0.070), (0.175, 0.0),
                          (0.165, 0.070)], 0.03, 3)
    brim = lathe([(0.0, 0.0), (0.115, 0.0), (0.117, 0.006), (0.104, 0.012), (0.0, 0.012)],
                 (0, 0, 0), (0, 0, 1), 20)
    ridge = round_corners([(-0.09, 1.765), (-0.05, 1.803), (0.0, 1.812), (0.05, 1.803),
                           (0.09, 1.765)], 0.02, 3)
    body.add(paint.HELMET, shell, moved(brim * [1.16, 1.0, 1.0], (0, 0, 1.688)),
             turned(extrude(peak, "z", 1.684, 1.694, 0.003), "y", 5, (0.06, 0, 1.69)),
             extrude(ridge, "y", -0.014, 0.014, 0.006), crease_deg=45)


def worker(gaits):
    """A worker with the given gait of the left and of the right side."""
    parts = []
    for number, gait in enumerate(gaits):
        for color, solid in (*leg(gait), *arm(gait)):
            parts.append((color, mirrored(solid) if number else solid))
    lowest = min(solid[..., 2].min() for _, solid in parts)
    body = Body()
    upright = Body()
    trunk(upright)
    head(upright)
    for color, (triangles, normals) in upright.by_paint().items():
        body.add_shaded(color, moved(triangles, (0, 0, -lowest)), normals)
    for color, solid in parts:
        body.add(color, moved(solid, (0, 0, -lowest)), crease_deg=60)
    return body


def nodes():
    return {"body": worker(STANDING), "body_walk": worker(WALKING)}
