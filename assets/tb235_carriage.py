"""Undercarriage, track shoe and blade of the compact excavator."""

import math

import numpy as np

import paint
from solids import (Body, bar, both_sides, box, cylinder, extrude, lathe, loft, mirrored, moved,
                    pin, pipe, rectangle, ribbon, round_corners, rounded_rectangle, smooth_path)
from tb235_dimensions import (BLADE_PIN_B, BLADE_PROFILE, BLADE_WIDTH, CYLINDERS, SHOE_LENGTH, SLEW_HEIGHT,
                              TRACK_RADIUS, TRACK_WIDTH, TRACK_Y, TRACK_Z, WHEELBASE)

BELT_THICKNESS = 0.05        # shoe with its lug
SPROCKET_TEETH = 13


def _sprocket(x, y):
    """A toothed ring that drives the belt."""
    angles = 2 * math.pi * np.arange(4 * SPROCKET_TEETH) / (4 * SPROCKET_TEETH)
    radii = np.where(np.arange(len(angles)) % 4 < 2, TRACK_RADIUS - 0.052, TRACK_RADIUS - 0.085)
    outline = np.stack([x + radii * np.cos(angles), TRACK_Z + radii * np.sin(angles)], axis=1)
    return extrude(outline, "y", y - 0.03, y + 0.03)


def _wheel(x, z, y, radius, half_width, sides=16):
    """A roller or idler with a dished side."""
    profile = [(0, -half_width * 0.7), (radius * 0.55, -half_width * 0.7),
               (radius * 0.62, -half_width), (radius - 0.012, -half_width),
               (radius, -half_width + 0.012), (radius, half_width - 0.012),
               (radius - 0.012, half_width), (radius * 0.62, half_width),
               (radius * 0.55, half_width * 0.7), (0, half_width * 0.7)]
    return lathe(profile, (x, y, z), (0, 1, 0), sides)


def _track_frame(body, y):
    """Frame, wheels and drive of the left track."""
    reach = WHEELBASE / 2
    outline = round_corners([(-reach + 0.13, 0.17), (reach - 0.02, 0.19), (reach - 0.02, 0.30),
                             (reach - 0.20, 0.345), (-reach + 0.20, 0.345), (-reach + 0.05, 0.30)],
                            0.05, 2)
    body.add(paint.CHARCOAL, extrude(outline, "y", y - 0.075, y + 0.075, 0.012))
    body.add(paint.CHARCOAL, bar((reach - 0.25, y, TRACK_Z), (reach + 0.01, y, TRACK_Z), 0.20, 0.07))
    body.add(paint.STEEL, _wheel(reach, TRACK_Z, y, TRACK_RADIUS - BELT_THICKNESS, 0.05))
    body.add(paint.STEEL, _sprocket(-reach, y))
    hub = lathe([(0, -0.11), (0.12, -0.11), (0.13, -0.10), (0.13, 0.07), (0.115, 0.09),
                 (0.06, 0.10), (0, 0.10)], (-reach, y, TRACK_Z), (0, 1, 0), 14)
    body.add(paint.CHARCOAL, hub)
    for k in range(6):
        angle = 2 * math.pi * k / 6
        x, z = -reach + 0.09 * math.cos(angle), TRACK_Z + 0.09 * math.sin(angle)
        body.add(paint.STEEL, cylinder((x, y + 0.085, z), (x, y + 0.105, z), 0.011, 6))
    for x in (-0.50, -0.25, 0.0, 0.25, 0.50):
        body.add(paint.STEEL, pin(x, 0.05 + 0.062, 0.080, 0.062, 14, y))
        body.add(paint.CHARCOAL, pin(x, 0.05 + 0.062, 0.092, 0.030, 8, y))
        body.add(paint.CHARCOAL, box((x, y, 0.15), (0.05, 0.10, 0.07)))
    body.add(paint.STEEL, pin(0.0, 0.45 - 0.045, 0.06, 0.045, 10, y))
    body.add(paint.CHARCOAL, box((0.0, y, 0.355), (0.06, 0.06, 0.05)))
    step = box((0.15, y + 0.115, 0.33), (0.42, 0.09, 0.016), 0.005)
    body.add(paint.CHARCOAL, step)


def _leg(x_end, y_end):
    """One leg of the X frame from the middle to a track."""
    rings = []
    for t, half, low, high in ((0.0, 0.17, 0.27, 0.44), (0.55, 0.13, 0.24, 0.37),
                               (1.0, 0.12, 0.20, 0.32)):
        x, y = t * x_end, t * y_end
        rings.append([(x - half, y, low), (x + half, y, low), (x + half, y, high - 0.02),
                      (x + half - 0.02, y, high), (x - half + 0.02, y, high),
                      (x - half, y, high - 0.02)])
    return loft(rings)


def undercarriage():
    body = Body()
    for y in (TRACK_Y,):
        half = Body()
        _track_frame(half, y)
        for part_paint, (triangles, _) in half.by_paint().items():
            body.add(part_paint, triangles, mirrored(triangles))
    body.add(paint.CHARCOAL, *both_sides(_leg(0.38, TRACK_Y - 0.06), _leg(-0.38, TRACK_Y - 0.06)))
    center = rounded_rectangle((0, 0), (0.98, 0.62), 0.10)
    body.add(paint.CHARCOAL, extrude(center, "z", 0.24, 0.46, 0.025))
    body.add(paint.CHARCOAL, lathe([(0, 0.40), (0.37, 0.40), (0.37, 0.49), (0.34, 0.50), (0, 0.50)],
                                   (0, 0, 0), (0, 0, 1), 24))
    body.add(paint.STEEL, pipe((0, 0, 0.49), (0, 0, SLEW_HEIGHT + 0.01), 0.33, 0.24, 24))
    # Lugs that hold the blade, and the barrel of its cylinder.
    lug = round_corners([(0.40, 0.27), (BLADE_PIN_B[0] + 0.06, 0.29), (BLADE_PIN_B[0] + 0.06, 0.41),
                         (BLADE_PIN_B[0] - 0.04, 0.42), (0.40, 0.44)], 0.05)
    for y in (0.23, 0.37):
        body.add(paint.CHARCOAL, *both_sides(extrude(lug, "y", y - 0.015, y + 0.015)))
    body.add(paint.STEEL, *both_sides(pin(BLADE_PIN_B[0], BLADE_PIN_B[2], 0.10, 0.025, y=0.30)))
    foot_x, foot_z = CYLINDERS["blade"][0]
    foot = round_corners([(0.40, 0.33), (0.66, 0.33), (foot_x + 0.045, foot_z), (foot_x, foot_z + 0.05),
                          (0.40, 0.46)], 0.03)
    body.add(paint.CHARCOAL, *both_sides(extrude(foot, "y", 0.045, 0.065)))
    body.add(paint.STEEL, pin(foot_x, foot_z, 0.085, 0.02))
    return body


def shoe():
    """One shoe of the rubber belt: x along the belt, z outwards, lug tip at z = 0."""
    body = Body()
    half, width = SHOE_LENGTH / 2, TRACK_WIDTH / 2
    belt = rectangle((0, -0.037), (SHOE_LENGTH, 0.026))
    body.add(paint.RUBBER, extrude(belt, "y", -width, width))
    lug = [(-0.030, -0.024), (0.030, -0.024), (0.019, 0.0), (-0.019, 0.0)]
    body.add(paint.RUBBER, moved(extrude(lug, "y", 0.015, width), (0.25 * half, 0, 0)))
    body.add(paint.RUBBER, moved(extrude(lug, "y", -width, -0.015), (-0.25 * half, 0, 0)))
    guide = [(-0.022, -0.050), (0.022, -0.050), (0.012, -0.075), (-0.012, -0.075)]
    body.add(paint.STEEL, extrude(guide, "y", 0.03, 0.055), extrude(guide, "y", -0.055, -0.03))
    return body


def blade():
    body = Body()
    half = BLADE_WIDTH / 2
    profile = smooth_path(BLADE_PROFILE, 3)
    front = ribbon(profile[::-1], 0.014)
    front[:, 1] = np.maximum(front[:, 1], BLADE_PROFILE[0][1])
    body.add(paint.CHARCOAL, extrude(front, "y", -half, half))
    edge = [(0.552, -0.300), (0.517, -0.235), (0.492, -0.235), (0.512, -0.300)]
    body.add(paint.WORN_STEEL, extrude(edge, "y", -half, half))
    rim = round_corners([(0.556, 0.082), (0.50, 0.082), (0.44, 0.0), (0.44, -0.18), (0.50, -0.27),
                         (0.512, -0.235), (0.488, -0.10), (0.508, 0.02)], 0.012, 2)
    body.add(paint.CHARCOAL, *both_sides(extrude(rim, "y", half - 0.018, half - 0.001, 0.003)))
    for z in (-0.19, 0.0):
        body.add(paint.CHARCOAL, box((0.455, 0, z), (0.07, BLADE_WIDTH - 0.05, 0.055), 0.008))
    for y in (0.30,):
        rings = []
        for x, z, h in ((0.0, 0.0, 0.06), (0.20, -0.06, 0.07), (0.44, -0.10, 0.11)):
            rings.append([(x, y - 0.035, z - h), (x, y + 0.035, z - h), (x, y + 0.045, z - h + 0.02),
                          (x, y + 0.045, z + h - 0.02), (x, y + 0.035, z + h), (x, y - 0.035, z + h),
                          (x, y - 0.045, z + h - 0.02), (x, y - 0.045, z - h + 0.02)])
        body.add(paint.CHARCOAL, *both_sides(loft(rings), pin(0, 0, 0.05, 0.062, 16, y)))
    # Lugs that take the rod of its cylinder.
    head_x, head_z = CYLINDERS["blade"][2]
    web = round_corners([(0.45, -0.16), (0.49, 0.06), (head_x + 0.045, head_z + 0.02),
                         (head_x, head_z + 0.05), (head_x - 0.05, head_z), (0.33, -0.02)], 0.03)
    body.add(paint.CHARCOAL, *both_sides(extrude(web, "y", 0.045, 0.065)))
    body.add(paint.STEEL, pin(head_x, head_z, 0.085, 0.02))
    return body
