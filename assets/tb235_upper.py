"""Upper structure and cab of the compact excavator, in the upper frame."""

import math

import numpy as np

import paint
from solids import (Body, bar, both_sides, box, cylinder, ellipsoid, extrude, lathe, loft,
                    round_corners, rounded_rectangle, slab, smooth_path, tube, turned)
from tb235_dimensions import SWING_PIN_U

TAIL_RADIUS = 1.20
HALF_WIDTH = 0.745
CAB_RIGHT, CAB_LEFT = -0.02, 0.765
# Side view of the cab, from the front edge of its floor over the roof to the rear.
FRONT_LOW, FRONT_MID, FRONT_TOP = (0.66, 0.34), (0.655, 0.74), (0.43, 1.79)
REAR_TOP, REAR_MID, REAR_LOW = (-0.47, 1.80), (-0.565, 0.95), (-0.565, 0.34)
PILLAR = 0.055


def _tail_outline(radius, half_width, front_x, steps=14, corner=0.0):
    """A plate in x-y with a round rear about the slew axis and a straight front."""
    reach = math.asin(half_width / radius)
    angles = np.linspace(math.pi - reach, math.pi + reach, steps + 1)
    arc = [(radius * math.cos(a), radius * math.sin(a)) for a in angles]
    front = [(front_x, -half_width), (front_x, half_width)]
    if corner <= 0:
        return np.array(arc + front)
    return np.array(arc + [(front_x - corner, -half_width), (front_x, -half_width + corner),
                           (front_x, half_width - corner), (front_x - corner, half_width)])


def _frame(body):
    """Deck, bracket of the swing post and steps."""
    body.add(paint.CHARCOAL, extrude(_tail_outline(1.12, 0.72, 0.42, 10, 0.12), "z", 0.02, 0.11,
                                     0.012))
    x = SWING_PIN_U[0]
    nose = [(0.25, 0.24), (0.25, -0.24), (0.50, -0.145)]
    arc = [(x + 0.145 * math.cos(a), 0.145 * math.sin(a)) for a in np.linspace(-1.5, 1.5, 11)]
    outline = nose + arc + [(0.50, 0.145)]
    for low, high in ((-0.035, 0.025), (0.185, 0.235)):
        body.add(paint.CHARCOAL, extrude(outline, "z", low, high, 0.010))
    body.add(paint.CHARCOAL, box((0.36, 0, 0.105), (0.18, 0.34, 0.18), 0.015))
    body.add(paint.STEEL, cylinder((x, 0, -0.045), (x, 0, 0.26), 0.055, 16, 0.008))
    body.add(paint.STEEL, cylinder((x, 0, 0.255), (x, 0, 0.275), 0.035, 6))


def _counterweight(body):
    outline = _tail_outline(TAIL_RADIUS, HALF_WIDTH, -0.52, 12)
    body.add(paint.CHARCOAL, extrude(outline, "z", 0.06, 0.50, 0.055, 2), crease_deg=50)
    hood = _tail_outline(TAIL_RADIUS - 0.015, HALF_WIDTH - 0.01, -0.50, 14)
    body.add(paint.YELLOW, extrude(hood, "z", 0.505, 0.90, 0.075, 3), crease_deg=50)
    # Seam and latch of the engine door, tail lamps, tie-down loops.
    body.add(paint.BLACK, box((-TAIL_RADIUS + 0.012, 0, 0.62), (0.03, 0.13, 0.035), 0.008))
    for y in (0.46,):
        lamp = box((-1.105, y, 0.415), (0.05, 0.13, 0.055), 0.012)
        body.add(paint.RED_LAMP, *both_sides(turned(lamp, "z", -22.5, (-1.105, y, 0))))
    body.add(paint.STEEL, *both_sides(tube(smooth_path([(-0.85, 0.60, 0.88), (-0.85, 0.60, 0.945),
                                                        (-0.79, 0.60, 0.965),
                                                        (-0.73, 0.60, 0.945),
                                                        (-0.73, 0.60, 0.88)], 3), 0.012, 6)))
    # Cooling slots on both sides and at the rear.
    for k in range(6):
        z = 0.575 + 0.042 * k
        body.add(paint.BLACK, *both_sides(box((-0.71, HALF_WIDTH - 0.008, z), (0.26, 0.016, 0.020))))
    for k in range(5):
        for side in (-1, 1):
            angle = math.pi + side * math.radians(8 + 4.4 * k)
            radius = TAIL_RADIUS - 0.017
            slot = box((radius * math.cos(angle), radius * math.sin(angle), 0.69),
                       (0.014, 0.045, 0.16))
            slot = turned(slot, "z", math.degrees(angle) - 180,
                          (radius * math.cos(angle), radius * math.sin(angle), 0))
            body.add(paint.BLACK, slot)
    # Exhaust.
    pipe_path = smooth_path([(-0.92, -0.42, 0.88), (-0.92, -0.42, 1.00), (-0.94, -0.42, 1.06),
                             (-1.00, -0.42, 1.09)], 3)
    body.add(paint.STEEL, tube(pipe_path, 0.030, 12))
    body.add(paint.BLACK, cylinder((-0.998, -0.42, 1.089), (-1.003, -0.42, 1.0915), 0.024, 12))
    body.add(paint.BLACK, lathe([(0.055, 0.89), (0.055, 0.905), (0.034, 0.925), (0.0, 0.925),
                                 (0.0, 0.89)], (-0.92, -0.42, 0), (0, 0, 1), 14))


def _right_side(body):
    """Tank cover beside the cab, sloping to the front, with its rail."""
    side = round_corners([(-0.49, 0.12), (0.47, 0.12), (0.53, 0.20), (0.50, 0.40), (0.30, 0.62),
                          (-0.05, 0.80), (-0.49, 0.86)], [0, 0.05, 0.06, 0.12, 0.2, 0.2, 0.03], 3)
    body.add(paint.YELLOW, extrude(side, "y", -HALF_WIDTH, -0.10, 0.045, 2), crease_deg=50)
    skirt = round_corners([(-0.49, 0.06), (0.44, 0.06), (0.52, 0.12), (0.52, 0.17), (-0.49, 0.17)],
                          0.02, 2)
    body.add(paint.CHARCOAL, extrude(skirt, "y", -HALF_WIDTH - 0.004, -0.12, 0.010))
    seam = [(-0.02, 0.19), (-0.01, 0.19), (-0.01, 0.73), (-0.02, 0.73)]
    body.add(paint.BLACK, extrude(seam, "y", -HALF_WIDTH - 0.002, -HALF_WIDTH + 0.02))
    for k in range(5):
        z = 0.30 + 0.05 * k
        body.add(paint.BLACK, box((-0.26, -HALF_WIDTH + 0.002, z), (0.30, 0.016, 0.022)))
    body.add(paint.BLACK, box((0.10, -HALF_WIDTH, 0.50), (0.10, 0.02, 0.035), 0.008))
    body.add(paint.BLACK, cylinder((0.13, -0.62, 0.69), (0.14, -0.62, 0.735), 0.045, 14, 0.008))
    rail = smooth_path([(0.46, -0.66, 0.42), (0.455, -0.66, 0.60), (0.40, -0.66, 0.74),
                        (0.22, -0.66, 0.88), (0.00, -0.66, 0.96), (-0.09, -0.66, 0.93),
                        (-0.10, -0.66, 0.80)], 3)
    body.add(paint.CHARCOAL, tube(rail, 0.015, 6), crease_deg=65)
    # Hoses from the valve to the swing post.
    for k, y in enumerate((-0.075, -0.035, 0.0)):
        hose = smooth_path([(0.30, y - 0.12, 0.16), (0.42, y - 0.10, 0.30), (0.55, y - 0.06, 0.36),
                            (0.64, y, 0.32)], 4)
        body.add(paint.RUBBER, tube(hose, 0.014, 6), crease_deg=65)


def _at(point, y):
    return np.array([point[0], y, point[1]])


def _pillars(body):
    right, left = CAB_RIGHT + PILLAR / 2, CAB_LEFT - PILLAR / 2
    b_low, b_top = (-0.14, 0.34), (-0.10, 1.80)
    for y in (right, left):
        for start, end, depth in ((FRONT_LOW, FRONT_MID, 0.06), (FRONT_MID, FRONT_TOP, 0.06),
                                  (b_low, b_top, 0.055), (REAR_MID, REAR_TOP, 0.07),
                                  (REAR_LOW, REAR_MID, 0.07)):
            # Pillars stand inside the outline.
            inward = 0.03 if start[0] > 0 else (-0.03 if start[0] < -0.3 else 0.0)
            a = (start[0] - inward, start[1])
            b = (end[0] - inward, end[1])
            body.add(paint.CHARCOAL, bar(_at(a, y), _at(b, y), PILLAR, depth, chamfer_m=0.014))
        body.add(paint.CHARCOAL, bar(_at((-0.55, 0.97), y), _at((-0.12, 0.97), y), PILLAR, 0.05,
                                     chamfer_m=0.01))
    for x, z in ((FRONT_MID[0] - 0.03, FRONT_MID[1]), (REAR_MID[0] + 0.03, 0.97)):
        body.add(paint.CHARCOAL, bar((x, right, z), (x, left, z), 0.05, 0.05, (0, 0, 1), 0.01))
    body.add(paint.CHARCOAL, bar(_at((0.12, 0.74), right), _at((0.62, 0.74), right), PILLAR, 0.05,
                                 chamfer_m=0.01),
             bar(_at((-0.12, 0.74), right), _at((0.12, 0.74), right), PILLAR, 0.05,
                 chamfer_m=0.01))


def _roof(body):
    middle = (CAB_LEFT + CAB_RIGHT) / 2
    width = CAB_LEFT - CAB_RIGHT + 0.03
    rings = []
    for z, shrink in ((1.770, 0.030), (1.775, 0.012), (1.795, 0.0), (1.825, 0.004), (1.855, 0.03),
                      (1.875, 0.075), (1.885, 0.13)):
        outline = rounded_rectangle((-0.02, middle), (1.02 - 2 * shrink, width - 2 * shrink),
                                    0.11 - 0.3 * shrink, 4)
        rings.append(np.column_stack([outline, np.full(len(outline), z)]))
    body.add(paint.YELLOW, loft(rings), crease_deg=50)
    body.add(paint.BLACK, box((0.08, middle, 1.888), (0.42, 0.46, 0.012), 0.004))
    body.add(paint.BLACK, cylinder((-0.38, 0.60, 1.87), (-0.38, 0.60, 1.915), 0.045, 14, 0.006))
    body.add(paint.BEACON, lathe([(0.0, 0.0), (0.042, 0.0), (0.042, 0.07), (0.034, 0.098),
                                  (0.018, 0.112), (0.0, 0.115)], (-0.38, 0.60, 1.912), (0, 0, 1), 14),
             crease_deg=50)
    for y in (0.08, 0.66):
        body.add(paint.BLACK, box((0.475, y, 1.845), (0.05, 0.11, 0.075), 0.012))
        body.add(paint.LAMP, box((0.503, y, 1.845), (0.012, 0.09, 0.055), 0.003))
        body.add(paint.BLACK, box((-0.52, y, 1.845), (0.05, 0.10, 0.065), 0.012))
        body.add(paint.LAMP, box((-0.547, y, 1.845), (0.010, 0.08, 0.045), 0.003))


def _panes(body):
    thickness = 0.006
    right, left = CAB_RIGHT + 0.018, CAB_LEFT - 0.018
    inner_right, inner_left = CAB_RIGHT + PILLAR - 0.01, CAB_LEFT - PILLAR + 0.01
    front = [(FRONT_MID[0] - 0.02, 0.76), (FRONT_TOP[0] - 0.015, 1.78)]
    rear = [(REAR_MID[0] + 0.02, 0.99), (REAR_TOP[0] + 0.018, 1.78)]
    panes = [
        [_at(front[0], inner_right), _at(front[0], inner_left), _at(front[1], inner_left),
         _at(front[1], inner_right)],
        [(0.637, inner_right, 0.40), (0.637, inner_left, 0.40), (0.635, inner_left, 0.72),
         (0.635, inner_right, 0.72)],
        [_at(rear[0], inner_right), _at(rear[0], inner_left), _at(rear[1], inner_left),
         _at(rear[1], inner_right)],
    ]
    side_rear = [(-0.52, 0.99), (-0.155, 0.99), (-0.125, 1.78), (-0.44, 1.78)]
    right_front = [(-0.11, 0.76), (0.60, 0.76), (0.38, 1.78), (-0.075, 1.78)]
    door = [(-0.115, 0.80), (0.59, 0.80), (0.375, 1.75), (-0.075, 1.75)]
    door_low = [(-0.115, 0.42), (0.595, 0.42), (0.595, 0.72), (-0.115, 0.72)]
    panes += [[_at(p, left) for p in outline] for outline in (side_rear, door, door_low)]
    panes += [[_at(p, right) for p in outline] for outline in (side_rear, right_front)]
    for pane in panes:
        body.add(paint.GLASS, slab(pane, thickness))


def _door(body):
    y = CAB_LEFT - 0.012
    body.add(paint.CHARCOAL, bar((-0.11, y, 0.76), (0.62, y, 0.76), 0.03, 0.07, chamfer_m=0.008),
             bar((-0.11, y, 0.40), (0.63, y, 0.40), 0.03, 0.05, chamfer_m=0.008))
    body.add(paint.BLACK, box((-0.06, y + 0.02, 0.78), (0.10, 0.025, 0.035), 0.008))
    handle = smooth_path([(0.52, y + 0.01, 0.84), (0.515, y + 0.05, 0.88), (0.45, y + 0.05, 1.22),
                          (0.442, y + 0.01, 1.26)], 4)
    body.add(paint.BLACK, tube(handle, 0.012, 8), crease_deg=50)
    for z in (0.50, 1.55):
        body.add(paint.BLACK, cylinder((-0.14, y + 0.016, z - 0.04), (-0.13, y + 0.016, z + 0.04),
                                       0.016, 10, 0.003))


def _cab_base(body):
    middle, width = (CAB_LEFT + CAB_RIGHT) / 2, CAB_LEFT - CAB_RIGHT
    side = round_corners([(-0.51, 0.11), (0.56, 0.11), (0.645, 0.20), (0.665, 0.345),
                          (-0.51, 0.345)], [0, 0.05, 0.05, 0.01, 0], 3)
    body.add(paint.YELLOW, extrude(side, "y", CAB_RIGHT, CAB_LEFT, 0.022, 2), crease_deg=40)
    body.add(paint.CHARCOAL, box((0.02, CAB_LEFT - 0.05, 0.085), (1.0, 0.10, 0.05), 0.01))
    # Panels under the rear side windows, under the right window and behind the seat.
    for y in (CAB_RIGHT + 0.02, CAB_LEFT - 0.02):
        body.add(paint.YELLOW, box((-0.345, y, 0.655), (0.40, 0.035, 0.62), 0.008))
    body.add(paint.YELLOW, box((0.25, CAB_RIGHT + 0.02, 0.54), (0.74, 0.035, 0.40), 0.008))
    body.add(paint.CHARCOAL, box((-0.545, middle, 0.65), (0.03, width - 0.06, 0.62), 0.006))


def _interior(body):
    seat_y = 0.37
    body.add(paint.INTERIOR, box((0.05, seat_y, 0.355), (1.15, 0.70, 0.03)))
    body.add(paint.INTERIOR, box((-0.37, seat_y, 0.62), (0.30, 0.66, 0.56), 0.02))
    body.add(paint.BLACK, box((-0.14, seat_y, 0.47), (0.36, 0.40, 0.22), 0.03))
    cushion = round_corners([(-0.34, 0.58), (0.13, 0.59), (0.16, 0.64), (0.10, 0.70),
                             (-0.34, 0.67)], 0.04)
    body.add(paint.FABRIC, extrude(cushion, "y", seat_y - 0.24, seat_y + 0.24, 0.035, 2))
    back = round_corners([(-0.33, 0.66), (-0.24, 0.70), (-0.33, 1.22), (-0.42, 1.22),
                          (-0.42, 0.80)], 0.05)
    body.add(paint.FABRIC, extrude(back, "y", seat_y - 0.23, seat_y + 0.23, 0.035, 2))
    head = round_corners([(-0.36, 1.23), (-0.31, 1.24), (-0.335, 1.40), (-0.40, 1.40)], 0.04)
    body.add(paint.FABRIC, extrude(head, "y", seat_y - 0.12, seat_y + 0.12, 0.025, 2))
    for y in (seat_y - 0.29, seat_y + 0.27):
        body.add(paint.INTERIOR, box((-0.06, y, 0.72), (0.46, 0.11, 0.20), 0.025))
        stick = smooth_path([(0.10, y, 0.82), (0.12, y, 0.88), (0.115, y, 0.94)], 3)
        body.add(paint.BLACK, tube(stick, 0.014, 8))
        body.add(paint.BLACK, ellipsoid((0.115, y, 0.98), (0.028, 0.026, 0.055), 8, 4))
    for y in (0.30, 0.42):
        body.add(paint.BLACK, turned(box((0.47, y, 0.40), (0.16, 0.07, 0.015), 0.004), "y", -25,
                                     (0.47, y, 0.40)))
        body.add(paint.STEEL, tube(smooth_path([(0.42, y, 0.38), (0.44, y, 0.60),
                                                (0.40, y, 0.78)], 3), 0.010, 6))
        body.add(paint.BLACK, ellipsoid((0.40, y, 0.80), (0.02, 0.02, 0.03), 6, 4))
    body.add(paint.BLACK, turned(box((0.44, 0.10, 0.98), (0.03, 0.13, 0.17), 0.008), "z", 25,
                                 (0.44, 0.10, 0.98)))
    body.add(paint.INTERIOR, bar((0.55, 0.06, 0.76), (0.45, 0.09, 0.92), 0.03, 0.03))


def _mirrors(body):
    for y, side in ((CAB_LEFT, 1), (CAB_RIGHT, -1)):
        if side > 0:
            path = [(0.47, y - 0.01, 1.66), (0.56, y + 0.05, 1.68), (0.60, y + 0.10, 1.60)]
            place = (0.60, y + 0.11, 1.49)
        else:
            path = [(0.44, -0.68, 0.58), (0.48, -0.72, 0.80), (0.50, -0.74, 0.98)]
            place = (0.50, -0.74, 1.08)
        body.add(paint.BLACK, tube(smooth_path(path, 3), 0.010, 6), crease_deg=65)
        shell = rounded_rectangle((place[1], place[2]), (0.14, 0.22), 0.035)
        glass = rounded_rectangle((place[1], place[2]), (0.12, 0.20), 0.03)
        body.add(paint.BLACK, extrude(shell, "x", place[0] - 0.012, place[0] + 0.03, 0.012, 2))
        body.add(paint.MIRROR, extrude(glass, "x", place[0] - 0.015, place[0] - 0.011))


def upper():
    body = Body()
    _frame(body)
    _counterweight(body)
    _right_side(body)
    _cab_base(body)
    _pillars(body)
    _roof(body)
    _panes(body)
    _door(body)
    _interior(body)
    _mirrors(body)
    return body
