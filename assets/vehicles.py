"""Vehicles around the excavator: a three-axle tipper and a skid-steer robot.

Frames: x forward, y left, z up; the origin is on the ground under the middle.
"""

import math

import numpy as np

import paint
from solids import (Body, bar, both_sides, box, cylinder, extrude, lathe, loft, moved, pin,
                    round_corners, rounded_rectangle, slab, smooth_path, tube, turned)

TYRE_RADIUS = 0.50
AXLES = (2.35, -1.35, -2.65)
CAB_REAR, CAB_WIDTH = 1.78, 2.36

ROBOT_WHEEL_RADIUS, ROBOT_WHEEL_WIDTH = 0.30, 0.24
ROBOT_TRACK, ROBOT_WHEELBASE = 1.08, 0.90


def _truck_wheel(x, y, width, dished):
    """A tyre with its rim; `dished` is +1 or -1 for the side that shows."""
    half, r = width / 2, TYRE_RADIUS
    tyre = lathe([(0.29, -half + 0.02), (r - 0.06, -half), (r - 0.012, -half + 0.03), (r, -half + 0.07),
                  (r, half - 0.07), (r - 0.012, half - 0.03), (r - 0.06, half), (0.29, half - 0.02)],
                 (x, y, r), (0, 1, 0), 28, closed=True)
    face = half - 0.03
    rim = lathe([(0, -face), (0.29, -face), (0.29, face), (0.27, face), (0.22, face - 0.10),
                 (0.14, face - 0.10), (0.12, face - 0.03), (0, face - 0.03)], (x, y, r),
                (0, dished, 0), 24)
    return tyre, rim


def _wheel_place(number):
    """Width of a wheel of that axle, and how far from the middle it stands."""
    return (0.32, 1.05) if number == 0 else (0.58, 0.92)


def _running_gear(body, with_wheels=True):
    for number, x in enumerate(AXLES):
        for side in (-1, 1):
            if not with_wheels:
                continue
            width, y = _wheel_place(number)
            tyre, rim = _truck_wheel(x, side * y, width, side)
            body.add(paint.RUBBER, tyre, crease_deg=40)
            body.add(paint.STEEL, rim)
        body.add(paint.CHARCOAL, cylinder((x, -0.9, TYRE_RADIUS), (x, 0.9, TYRE_RADIUS), 0.09, 12))
    for y in (0.42,):
        body.add(paint.CHARCOAL, *both_sides(box((-0.25, y, 0.86), (6.8, 0.09, 0.26), 0.01)))
    for x in (-3.4, -2.0, -0.4, 1.0, 2.9):
        body.add(paint.CHARCOAL, box((x, 0, 0.86), (0.12, 0.84, 0.18)))
    for x in (-1.35, -2.65):
        arch = [(x + 0.62 * math.cos(a), 0.52 + 0.60 * math.sin(a))
                for a in np.linspace(0.25, math.pi - 0.25, 9)]
        inner = [(x + 0.60 * math.cos(a), 0.52 + 0.58 * math.sin(a))
                 for a in np.linspace(math.pi - 0.25, 0.25, 9)]
        body.add(paint.BLACK, *both_sides(extrude(arch + inner, "y", 0.64, 1.22)))
    tank = rounded_rectangle((0.85, 0.66), (0.95, 0.50), 0.10)
    body.add(paint.STEEL, extrude(tank, "y", -1.18, -0.60, 0.03, 2))
    body.add(paint.CHARCOAL, box((0.75, 0.90, 0.68), (0.75, 0.50, 0.45), 0.03))
    body.add(paint.CHARCOAL, box((-3.62, 0, 0.62), (0.10, 2.3, 0.14), 0.02))
    body.add(paint.CHARCOAL, *both_sides(box((-3.62, 0.5, 0.76), (0.08, 0.10, 0.22))))
    body.add(paint.RED_LAMP, *both_sides(box((-3.68, 0.95, 0.63), (0.03, 0.34, 0.09), 0.01)))


def _cab(body):
    half = CAB_WIDTH / 2
    low = round_corners([(CAB_REAR, 0.75), (1.82, 0.75), (1.82, 0.72), (1.90, 1.05), (2.80, 1.05),
                         (2.90, 0.55), (3.66, 0.55), (3.73, 0.75), (3.71, 1.80), (CAB_REAR, 1.80)],
                        [0, 0, 0, 0.25, 0.25, 0.05, 0.10, 0.15, 0.02, 0], 3)
    body.add(paint.WHITE, extrude(low, "y", -half, half, 0.06, 3), crease_deg=40)
    front_low, front_top = np.array([3.70, 1.80]), np.array([3.44, 2.72])
    inset_y = half - 0.05
    for side in (-1, 1):
        y = side * inset_y
        for a, b, depth in (((3.66, 1.77), (3.40, 2.74), 0.08), ((2.55, 1.77), (2.55, 2.74), 0.10),
                            ((1.83, 1.77), (1.83, 2.74), 0.10)):
            body.add(paint.WHITE, bar((a[0], y, a[1]), (b[0], y, b[1]), 0.08, depth,
                                      chamfer_m=0.02))
        body.add(paint.WHITE, box((2.18, y, 2.25), (0.70, 0.06, 1.0), 0.01))
        body.add(paint.GLASS, slab([(2.60, y, 1.80), (3.62, y, 1.80), (3.38, y, 2.72),
                                    (2.60, y, 2.72)], 0.008))
    shift = np.array([-0.03, 0.0])
    body.add(paint.GLASS, slab([(*(front_low + shift)[:1], -inset_y + 0.04, 1.80),
                                (*(front_low + shift)[:1], inset_y - 0.04, 1.80),
                                (*(front_top + shift)[:1], inset_y - 0.04, 2.72),
                                (*(front_top + shift)[:1], -inset_y + 0.04, 2.72)], 0.008))
    body.add(paint.WHITE, box((1.82, 0, 2.25), (0.05, 2 * half - 0.12, 1.0), 0.01))
    rings = []
    for z, shrink in ((2.70, 0.02), (2.72, 0.0), (2.84, 0.01), (2.93, 0.06), (2.96, 0.16)):
        outline = rounded_rectangle((2.62, 0), (1.72 - 2 * shrink, CAB_WIDTH - 2 * shrink), 0.16)
        rings.append(np.column_stack([outline, np.full(len(outline), z)]))
    body.add(paint.WHITE, loft(rings), crease_deg=50)
    _cab_fittings(body, half)


def _cab_fittings(body, half):
    body.add(paint.BLACK, box((3.725, 0, 1.28), (0.05, 1.7, 0.42), 0.02))
    for k in range(4):
        body.add(paint.CHARCOAL, box((3.755, 0, 1.14 + 0.095 * k), (0.02, 1.6, 0.035), 0.006))
    body.add(paint.CHARCOAL, box((3.70, 0, 0.60), (0.14, 2.42, 0.28), 0.04))
    body.add(paint.LAMP, *both_sides(box((3.735, 0.92, 0.92), (0.05, 0.34, 0.16), 0.02)))
    body.add(paint.BEACON, *both_sides(box((3.72, 1.12, 0.92), (0.05, 0.06, 0.16), 0.015)))
    body.add(paint.BLACK, *both_sides(tube(smooth_path([(3.45, half - 0.04, 2.62),
                                                        (3.58, half + 0.10, 2.58),
                                                        (3.56, half + 0.15, 2.10)], 3), 0.018, 6)),
             crease_deg=65)
    body.add(paint.BLACK, *both_sides(box((3.55, half + 0.15, 2.28), (0.09, 0.20, 0.46), 0.03)))
    body.add(paint.MIRROR, *both_sides(box((3.503, half + 0.15, 2.28), (0.008, 0.16, 0.40))))
    body.add(paint.BLACK, *both_sides(box((2.72, half, 1.62), (0.16, 0.03, 0.035), 0.01)))
    for y in (-0.55, 0.55):
        body.add(paint.FABRIC, box((2.55, y, 1.90), (0.52, 0.52, 0.20), 0.05),
                 turned(box((2.26, y, 2.28), (0.14, 0.50, 0.72), 0.05), "y", -10, (2.26, y, 2.0)))
    body.add(paint.INTERIOR, box((3.42, 0, 1.86), (0.36, 2.1, 0.22), 0.05))
    wheel = lathe([(0.22, -0.014), (0.22, 0.014), (0.19, 0.014), (0.19, -0.014)], (3.10, 0.55, 2.05),
                  (-0.5, 0, 0.87), 18, closed=True)
    body.add(paint.BLACK, wheel)
    body.add(paint.STEEL, cylinder((1.66, -0.98, 1.0), (1.66, -0.98, 2.85), 0.065, 14))
    body.add(paint.BEACON, cylinder((2.2, 0, 2.95), (2.2, 0, 3.07), 0.07, 14, 0.02))


def _tipping_bed(body, frame=None, gate=None):
    """A steel bed, open on top: inner floor at 1.19 m, walls up to 2.15 m. What stays on the chassis
    as it tips goes to `frame`, its tail gate to `gate`."""
    rear, front, half, low, high = -3.68, 1.48, 1.22, 1.14, 2.15
    frame, gate = frame or body, gate or body
    middle, length = (rear + front) / 2, front - rear
    body.add(paint.BLUE, box((middle, 0, low), (length, 2 * half, 0.07)))
    frame.add(paint.CHARCOAL, *both_sides(box((middle, 0.50, 1.045), (length - 0.1, 0.12, 0.12))))
    wall_z, wall_height = (low + high) / 2, high - low
    body.add(paint.BLUE, *both_sides(box((middle, half - 0.02, wall_z), (length, 0.04, wall_height))))
    body.add(paint.BLUE, box((front - 0.02, 0, wall_z + 0.12), (0.05, 2 * half, wall_height + 0.24)))
    gate.add(paint.BLUE, box((rear + 0.03, 0, wall_z), (0.05, 2 * half - 0.09, wall_height - 0.02)))
    body.add(paint.BLUE, *both_sides(box((middle, half, high), (length, 0.11, 0.09), 0.015)))
    for x in np.linspace(rear + 0.06, front - 0.06, 8):
        body.add(paint.BLUE, *both_sides(box((x, half + 0.015, wall_z), (0.09, 0.07, wall_height),
                                             0.012)))
    for y in np.linspace(-0.95, 0.95, 5):
        gate.add(paint.BLUE, box((rear - 0.01, y, wall_z), (0.06, 0.08, wall_height - 0.04), 0.01))
    gate.add(paint.BLUE, box((rear - 0.01, 0, high - 0.04), (0.07, 2 * half - 0.1, 0.08), 0.012))
    canopy = [(front - 0.04, 2.36), (front + 0.42, 2.66), (front + 0.42, 2.70), (front - 0.04, 2.41)]
    body.add(paint.BLUE, extrude(canopy, "y", -half + 0.05, half - 0.05))
    frame.add(paint.CHROME, cylinder((1.30, 0, 0.80), (1.30, 0, 1.16), 0.09, 14))
    frame.add(paint.STEEL, pin(rear + 0.15, 1.02, 0.75, 0.05))
    body.add(paint.RED, *both_sides(box((-0.3, half + 0.006, 1.16), (3.0, 0.012, 0.05))))


def truck():
    body = Body()
    _running_gear(body)
    _cab(body)
    _tipping_bed(body)
    return {"body": body}


def _rolling_wheel(width, dished):
    """A wheel about its centre, its axle along y; bolts and the blocks of its tread show its turn."""
    tyre, rim = _truck_wheel(0.0, 0.0, width, dished)
    body = Body()
    body.add(paint.RUBBER, moved(tyre, (0, 0, -TYRE_RADIUS)), crease_deg=40)
    body.add(paint.STEEL, moved(rim, (0, 0, -TYRE_RADIUS)))
    face = width / 2 - 0.03
    for k in range(10):
        a = 2 * math.pi * k / 10
        x, z = 0.115 * math.cos(a), 0.115 * math.sin(a)
        ends = sorted((dished * (face - 0.10), dished * (face + 0.015)))
        body.add(paint.CHARCOAL, cylinder((x, ends[0], z), (x, ends[1], z), 0.017, 6))
    reach = width / 2 - 0.07
    for k in range(36):
        block = [(-0.022, TYRE_RADIUS - 0.012), (0.022, TYRE_RADIUS - 0.012),
                 (0.018, TYRE_RADIUS + 0.006), (-0.018, TYRE_RADIUS + 0.006)]
        for low, high in ((-reach, -0.02), (0.02, reach)):
            body.add(paint.RUBBER, turned(extrude(block, "y", low, high), "y",
                                          10 * k + (5 if low > 0 else 0)))
    return body


def truck_with_wheels():
    """The tipper in parts: chassis and cab; bed; tail gate; a front and a rear wheel of either side."""
    body, bed, gate = Body(), Body(), Body()
    _running_gear(body, with_wheels=False)
    _cab(body)
    _tipping_bed(bed, body, gate)
    bodies = {"body": body, "bed": bed, "gate": gate}
    for name, number in (("front", 0), ("rear", 1)):
        for side, dished in (("left", 1), ("right", -1)):
            bodies[f"{name}_{side}"] = _rolling_wheel(_wheel_place(number)[0], dished)
    return bodies


def _robot_hull(body):
    side = round_corners([(-0.70, 0.30), (-0.58, 0.16), (0.58, 0.16), (0.70, 0.30), (0.72, 0.52),
                          (0.60, 0.62), (-0.60, 0.62), (-0.72, 0.52)], 0.06, 3)
    body.add(paint.YELLOW, extrude(side, "y", -0.34, 0.34, 0.03, 2), crease_deg=40)
    body.add(paint.CHARCOAL, extrude(rounded_rectangle((0, 0), (1.12, 0.60), 0.05), "z", 0.615, 0.66,
                                     0.012))
    for y in (0.22,):
        body.add(paint.STEEL, *both_sides(box((0, y, 0.675), (1.0, 0.03, 0.03), 0.004)))
    for side in (-1, 1):
        y = side * (ROBOT_TRACK / 2 - ROBOT_WHEEL_WIDTH / 2 - 0.07)
        body.add(paint.CHARCOAL, box((0, y, 0.33), (1.14, 0.10, 0.15), 0.025))
        for x in (-ROBOT_WHEELBASE / 2, ROBOT_WHEELBASE / 2):
            body.add(paint.STEEL, cylinder((x, y - side * 0.02, ROBOT_WHEEL_RADIUS),
                                           (x, side * ROBOT_TRACK / 2, ROBOT_WHEEL_RADIUS), 0.045, 14))
        fender = box((0, side * ROBOT_TRACK / 2, 0.665), (1.30, 0.24, 0.018), 0.005)
        body.add(paint.CHARCOAL, fender)
        for x in (-0.35, 0.35):
            body.add(paint.CHARCOAL, bar((x, side * 0.30, 0.60), (x, side * 0.50, 0.655), 0.04, 0.03,
                                         (1, 0, 0)))
    for end in (-1, 1):
        bumper = smooth_path([(end * 0.66, -0.30, 0.34), (end * 0.80, -0.27, 0.36),
                              (end * 0.83, 0.0, 0.36), (end * 0.80, 0.27, 0.36),
                              (end * 0.66, 0.30, 0.34)], 4)
        body.add(paint.CHARCOAL, tube(bumper, 0.028, 8), crease_deg=50)
        color = paint.LAMP if end > 0 else paint.RED_LAMP
        body.add(color, *both_sides(box((end * 0.715, 0.22, 0.47), (0.03, 0.13, 0.06), 0.012)))
    for k in range(5):
        body.add(paint.BLACK, box((0.0, 0.0, 0.668), (0.30, 0.02, 0.012)) + [0, -0.08 + 0.04 * k, 0])
    # Sensor mast and antennas.
    body.add(paint.CHARCOAL, box((0.38, 0, 0.70), (0.16, 0.22, 0.08), 0.015),
             cylinder((0.38, 0, 0.72), (0.38, 0, 0.92), 0.025, 10))
    body.add(paint.BLACK, cylinder((0.38, 0, 0.92), (0.38, 0, 1.00), 0.052, 18, 0.008))
    body.add(paint.BLACK, *both_sides(cylinder((-0.45, 0.20, 0.66), (-0.45, 0.20, 0.98), 0.008, 6)))
    body.add(paint.RED, cylinder((-0.35, 0, 0.66), (-0.35, 0, 0.70), 0.035, 14, 0.008))


def _robot_wheel():
    body = Body()
    half, r = ROBOT_WHEEL_WIDTH / 2, ROBOT_WHEEL_RADIUS
    core = r - 0.022
    tyre = lathe([(0.15, -half + 0.02), (core - 0.05, -half), (core, -half + 0.04),
                  (core, half - 0.04), (core - 0.05, half), (0.15, half - 0.02)], (0, 0, 0),
                 (0, 1, 0), 28, closed=True)
    body.add(paint.RUBBER, tyre, crease_deg=45)
    for k in range(18):
        for side in (-1, 1):
            lug = [(-0.016, core - 0.01), (0.016, core - 0.01), (0.011, r), (-0.011, r)]
            low, high = sorted((side * 0.006, side * (half - 0.012)))
            solid = extrude(lug, "y", low, high)
            body.add(paint.RUBBER, turned(solid, "y", 20 * k + (10 if side > 0 else 0)))
    for side in (-1, 1):
        face = half - 0.03
        rim = lathe([(0, 0), (0.15, 0), (0.15, face), (0.135, face), (0.11, face - 0.05),
                     (0.05, face - 0.05), (0.045, face - 0.015), (0, face - 0.015)], (0, 0, 0),
                    (0, side, 0), 22)
        body.add(paint.STEEL, rim)
    return body


def skid_steer():
    body = Body()
    _robot_hull(body)
    return {"body": body, "wheel": _robot_wheel()}
