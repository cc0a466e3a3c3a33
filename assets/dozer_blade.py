"""Push frame, blade and cylinders of the dozer."""

import numpy as np

import heavy_parts
import paint
from dozer_dimensions import (BLADE_PROFILE, BLADE_WIDTH, LIFT_PINS, LIFT_SPACING, TILT_PINS,
                              lift_range, tilt_range)
from solids import (Body, both_sides, box, ellipsoid, extrude, loft, pin, ribbon,
                    round_corners, smooth_path)

COLOR = paint.YELLOW
SHAPES = {"lift": heavy_parts.Cylinder(0.090, 0.055, 0.045, 0.09),
          "tilt": heavy_parts.Cylinder(0.100, 0.055, 0.045, 0.09)}
RANGES = {"lift": lift_range(), "tilt": tilt_range()}


def _arm():
    """The left arm from its pivot inside the track to the nose."""
    rings = []
    for x, y, half, low, high in ((0.0, 0.585, 0.055, -0.10, 0.10),
                                  (0.35, 0.585, 0.06, -0.12, 0.11),
                                  (1.55, 0.52, 0.07, -0.14, 0.10), (1.85, 0.36, 0.10, -0.14, 0.10),
                                  (2.02, 0.08, 0.11, -0.13, 0.10)):
        rings.append([(x, y - half, low), (x, y + half, low), (x, y + half, high),
                      (x, y - half, high)])
    return loft(rings)


def push_frame():
    body = Body()
    body.add(COLOR, *both_sides(_arm(), pin(0, 0, 0.075, 0.13, 20, 0.585)))
    body.add(COLOR, box((1.72, 0, -0.02), (0.30, 1.02, 0.20), 0.03))
    nose = round_corners([(1.72, -0.14), (2.02, -0.16), (2.14, -0.09), (2.14, 0.09), (2.02, 0.16),
                          (1.72, 0.14)], 0.06, 3)
    body.add(COLOR, extrude(nose, "y", -0.20, 0.20, 0.03))
    x, y, z = LIFT_PINS[1][0], LIFT_SPACING / 2, LIFT_PINS[1][2]
    body.add(COLOR, *both_sides(box((x, y, z + 0.02), (0.18, 0.24, 0.16), 0.02)))
    body.add(paint.STEEL, *both_sides(pin(x, z, 0.10, 0.035, 14, y)))
    x, y, z = TILT_PINS[0]
    tower = round_corners([(1.68, 0.08), (1.98, 0.08), (x + 0.07, z), (x + 0.05, z + 0.07),
                           (x - 0.05, z + 0.07), (x - 0.09, z)], [0, 0, 0.05, 0.05, 0.05, 0.05], 2)
    body.add(COLOR, *(extrude(tower, "y", y + s * 0.075 - 0.018, y + s * 0.075 + 0.018, 0.005)
                      for s in (-1, 1)))
    return body


def blade():
    body = Body()
    half = BLADE_WIDTH / 2
    profile = smooth_path(BLADE_PROFILE, 4)
    # Mouldboard: worn face, painted back.
    face = ribbon(profile[::-1], 0.012)
    face[:, 1] = np.maximum(face[:, 1], BLADE_PROFILE[0][1])
    body.add(paint.WORN_STEEL, extrude(face, "y", -half, half))
    behind = ribbon((profile - np.array([0.012, 0.0]))[::-1], 0.022)
    behind[:, 1] = np.maximum(behind[:, 1], BLADE_PROFILE[0][1])
    body.add(COLOR, extrude(behind, "y", -half, half))
    edge = [(0.428, -0.420), (0.400, -0.420), (0.255, -0.205), (0.283, -0.205)]
    body.add(paint.STEEL, extrude(edge, "y", -half, half))
    # End plates, which reach no further than the face.
    plate = np.concatenate([profile + np.array([0.006, 0.0]),
                            [(0.30, 0.690), (0.16, 0.42), (0.09, 0.10), (0.13, -0.18)]])
    body.add(COLOR, *both_sides(extrude(plate, "y", half - 0.002, half + 0.022)))
    for y in (half,):
        bit = [(0.436, -0.420), (0.392, -0.420), (0.23, -0.18), (0.27, -0.18)]
        body.add(paint.STEEL, *both_sides(extrude(bit, "y", y - 0.28, y + 0.024)))
    # Ribs and beams on the back.
    for z, x, size in ((-0.16, 0.16, 0.16), (0.14, 0.12, 0.14), (0.44, 0.16, 0.14)):
        body.add(COLOR, box((x, 0, z), (0.16, BLADE_WIDTH - 0.06, size), 0.03))
    rib = round_corners([(0.26, -0.30), (0.20, 0.0), (0.20, 0.22), (0.30, 0.52), (0.12, 0.50),
                         (0.04, 0.16), (0.06, -0.14)], 0.04, 2)
    for y in (0.40, 0.95):
        body.add(COLOR, *both_sides(extrude(rib, "y", y - 0.015, y + 0.015)))
    # Socket of the ball, and the ears of the tilt cylinder.
    body.add(COLOR, box((0.07, 0, 0.0), (0.14, 0.42, 0.34), 0.04))
    body.add(paint.STEEL, ellipsoid((0.0, 0.0, 0.0), (0.11, 0.11, 0.11), 18, 10))
    x, y, z = TILT_PINS[1]
    ear = round_corners([(0.14, z - 0.12), (0.14, z + 0.12), (x - 0.05, z + 0.06),
                         (x - 0.07, z - 0.02)], [0, 0, 0.05, 0.05], 2)
    body.add(COLOR, *(extrude(ear, "y", y + s * 0.075 - 0.018, y + s * 0.075 + 0.018, 0.005)
                      for s in (-1, 1)))
    return body


def barrel(name):
    return heavy_parts.barrel(SHAPES[name], RANGES[name], name, COLOR)


def rod(name):
    return heavy_parts.rod(SHAPES[name], RANGES[name], name, COLOR)
