"""Upper structure and cab of the 20-ton excavator, in the upper frame."""

import math

import numpy as np

import heavy_parts
import paint
from excavator20t_dimensions import BOOM_PIN_U, CYLINDERS, TAIL_RADIUS
from heavy_parts import cheeks, grille, handrail
from solids import (Body, bar, both_sides, box, cylinder, extrude, lathe, pin, round_corners,
                    rounded_rectangle, smooth_path, tube)

COLOR = paint.ORANGE
HALF_WIDTH = 1.355
DECK = 0.30          # top of the deck
HOOD = 1.34          # top of the engine's hood
CAB = heavy_parts.Cab(front=[(1.42, 0.34), (1.40, 0.95), (1.12, 1.93)],
                      rear=[(-0.45, 0.34), (-0.43, 1.10), (-0.36, 1.93)],
                      right=0.38, left=1.345, sill=0.95, door=(0.28, 0.32), pillar=0.085,
                      body=COLOR, frame=paint.CHARCOAL)


def _tail(radius, half_width, front_x, steps=12, corner=0.0):
    """A plate in x-y with a round rear about the slew axis and a straight front."""
    reach = math.asin(half_width / radius)
    arc = [(radius * math.cos(a), radius * math.sin(a))
           for a in np.linspace(math.pi - reach, math.pi + reach, steps + 1)]
    front = [(front_x, -half_width), (front_x, half_width)]
    if corner > 0:
        front = [(front_x - corner, -half_width), (front_x, -half_width + corner),
                 (front_x, half_width - corner), (front_x - corner, half_width)]
    return np.array(arc + front)


def _deck(body):
    middle = rounded_rectangle((-0.75, 0), (4.0, 1.5), 0.1)
    body.add(paint.CHARCOAL, extrude(middle, "z", 0.04, 0.24, 0.02))
    body.add(paint.CHARCOAL, extrude(rounded_rectangle((-0.35, 0), (3.5, 2.62), 0.08), "z", 0.14,
                                     DECK, 0.02))
    # The bracket of boom and boom cylinders.
    x, z = BOOM_PIN_U[0], BOOM_PIN_U[2]
    (foot_x, foot_z) = CYLINDERS["boom"][0]
    outline = [(-0.75, 0.22), (foot_x + 0.10, 0.08), (foot_x + 0.17, 0.20), (foot_x + 0.13, 0.42),
               (foot_x - 0.10, 0.46), (x + 0.22, z), (x + 0.14, z + 0.19), (x - 0.14, z + 0.19),
               (x - 0.22, z), (-0.55, 0.55)]
    body.add(paint.CHARCOAL, *cheeks(outline, [0, 0.1, 0.1, 0.1, 0.1, 0.1, 0.12, 0.12, 0.1, 0.15],
                                     0.345, 0.05))
    for px, pz, radius in ((x, z, 0.12), (foot_x, foot_z, 0.10)):
        body.add(paint.STEEL, pin(px, pz, 0.475 if pz == foot_z else 0.39, 0.06, 18))
        body.add(paint.CHARCOAL, *both_sides(pin(px, pz, 0.016, radius, 18,
                                                 0.475 if pz == foot_z else 0.375)))
    body.add(paint.CHARCOAL, box((foot_x - 0.10, 0, 0.26), (0.30, 0.66, 0.16), 0.02))


def _counterweight(body):
    outline = _tail(TAIL_RADIUS, HALF_WIDTH, -1.98)
    body.add(paint.CHARCOAL, extrude(outline, "z", 0.065, 0.46, 0.10, 2), crease_deg=50)
    body.add(COLOR, extrude(_tail(TAIL_RADIUS, HALF_WIDTH, -1.99), "z", 0.44, 1.16, 0.09, 2),
             crease_deg=50)
    for y in (-0.75, 0.75):
        angle = math.asin(y / TAIL_RADIUS)
        body.add(paint.RED_LAMP, box((-TAIL_RADIUS * math.cos(angle) + 0.008, y, 0.62),
                                     (0.05, 0.20, 0.09), 0.02))
    body.add(paint.STEEL, *both_sides(handrail([(-2.35, 0.70, 1.13), (-2.35, 0.70, 1.25),
                                                (-2.28, 0.70, 1.29), (-2.18, 0.70, 1.29),
                                                (-2.11, 0.70, 1.25), (-2.11, 0.70, 1.13)], 0.022)))


def _hood(body):
    side = round_corners([(-2.02, DECK), (-0.52, DECK), (-0.52, HOOD - 0.16), (-0.68, HOOD),
                          (-1.95, HOOD), (-2.02, HOOD - 0.10)], [0, 0, 0.1, 0.1, 0.06, 0.06], 3)
    body.add(COLOR, extrude(side, "y", -HALF_WIDTH + 0.02, HALF_WIDTH - 0.02, 0.06, 3),
             crease_deg=50)
    # Doors with louvres: radiator on the left, pumps on the right.
    for y in (-HALF_WIDTH + 0.014, HALF_WIDTH - 0.014):
        for x in (-1.50, -0.76):
            body.add(paint.BLACK, box((x, y, 0.76), (0.012, 0.024, 0.80)))
        grille(body, (-1.13, y, 0.82), (0.56, 0.024, 0.50), "z", 8)
        body.add(paint.BLACK, box((-1.42, y, 0.62), (0.05, 0.03, 0.11), 0.008))
    grille(body, (-1.74, HALF_WIDTH - 0.014, 0.82), (0.36, 0.024, 0.50), "z", 8)
    # Raised lid over the engine, exhaust and air intake.
    lid = rounded_rectangle((-1.32, -0.05), (1.05, 1.35), 0.10, 3)
    body.add(COLOR, extrude(lid, "z", HOOD - 0.02, HOOD + 0.09, 0.04, 2), crease_deg=50)
    grille(body, (-1.32, -0.05, HOOD + 0.088), (0.70, 0.80, 0.012), "x", 7)
    stack = smooth_path([(-1.72, -0.86, HOOD - 0.04), (-1.72, -0.86, HOOD + 0.34),
                         (-1.75, -0.86, HOOD + 0.46), (-1.84, -0.86, HOOD + 0.54)], 4)
    body.add(paint.STEEL, tube(stack, 0.062, 14))
    body.add(paint.BLACK, cylinder((-1.838, -0.86, HOOD + 0.538), (-1.846, -0.86, HOOD + 0.546),
                                   0.050, 14))
    body.add(paint.BLACK, lathe([(0.10, HOOD - 0.02), (0.10, HOOD + 0.10), (0.06, HOOD + 0.13),
                                 (0.0, HOOD + 0.13), (0.0, HOOD - 0.02)], (-1.72, -0.86, 0),
                                (0, 0, 1), 16))
    for y in (HALF_WIDTH - 0.12, -HALF_WIDTH + 0.12):
        body.add(paint.CHARCOAL, handrail([(-1.95, y, HOOD - 0.03), (-1.95, y, HOOD + 0.20),
                                           (-1.85, y, HOOD + 0.28), (-0.85, y, HOOD + 0.28),
                                           (-0.75, y, HOOD + 0.20), (-0.75, y, HOOD - 0.03)]))


def _right_side(body):
    """Tank, tool box with its step, rails on the right of the boom."""
    tank = round_corners([(-0.50, DECK), (0.42, DECK), (0.42, 1.10), (0.34, 1.18), (-0.50, 1.18)],
                         [0, 0, 0.08, 0.08, 0.02], 3)
    body.add(COLOR, extrude(tank, "y", -HALF_WIDTH + 0.01, -0.46, 0.05, 3), crease_deg=50)
    chest = round_corners([(0.44, DECK), (1.30, DECK), (1.36, 0.36), (1.34, 0.70), (1.26, 0.78),
                           (0.44, 0.78)], [0, 0, 0.04, 0.06, 0.06, 0], 3)
    body.add(COLOR, extrude(chest, "y", -HALF_WIDTH + 0.01, -0.50, 0.05, 3), crease_deg=50)
    for x, z, length in ((1.10, 0.80, 0.42), (0.64, 0.80, 0.42)):
        body.add(paint.BLACK, box((x, -0.93, z), (length, 0.66, 0.020), 0.006))
    body.add(paint.BLACK, cylinder((-0.05, -0.92, 1.17), (-0.05, -0.92, 1.24), 0.085, 16, 0.012))
    for y in (-HALF_WIDTH + 0.06, -0.52):
        body.add(paint.CHARCOAL, handrail([(1.28, y, 0.70), (1.28, y, 1.05), (1.10, y, 1.40),
                                           (0.70, y, 1.76), (0.30, y, 1.86), (-0.30, y, 1.86),
                                           (-0.42, y, 1.76), (-0.42, y, 1.15)]))
        body.add(paint.CHARCOAL, bar((0.30, y, 1.16), (0.30, y, 1.86), 0.035, 0.035, (0, 1, 0)))
    body.add(paint.BLACK, box((0.90, -HALF_WIDTH + 0.004, 0.55), (0.12, 0.024, 0.05), 0.008),
             box((-0.04, -HALF_WIDTH + 0.004, 0.72), (0.10, 0.024, 0.05), 0.008))
    # Step and lamp in front.
    body.add(paint.BLACK, box((1.36, -0.93, 0.24), (0.16, 0.50, 0.03), 0.006))
    body.add(paint.BLACK, box((1.35, -1.15, 0.60), (0.08, 0.16, 0.12), 0.015))
    body.add(paint.LAMP, box((1.393, -1.15, 0.60), (0.014, 0.13, 0.09), 0.003))


def _middle(body):
    """Valves and hoses behind the boom's foot, between the cab and the tank."""
    body.add(paint.CHARCOAL, box((-0.52, 0.0, 0.62), (0.36, 0.62, 0.60), 0.03))
    for y in (-0.2, -0.1, 0.0, 0.1, 0.2):
        hose = smooth_path([(-0.40, y, 0.75), (-0.22, y, 0.98), (0.00, y, 1.10),
                            (0.18, y, 1.08)], 4)
        body.add(paint.RUBBER, tube(hose, 0.024, 6), crease_deg=65)


def _mirrors(body):
    for points, place in ((((1.24, 1.33, 1.72), (1.40, 1.42, 1.74), (1.46, 1.50, 1.62)),
                           (1.46, 1.50, 1.46)),
                          (((1.26, -1.29, 1.00), (1.32, -1.34, 1.20), (1.34, -1.36, 1.34)),
                           (1.34, -1.36, 1.48))):
        body.add(paint.BLACK, tube(smooth_path(points, 3), 0.016, 7), crease_deg=65)
        shell = rounded_rectangle((place[1], place[2]), (0.20, 0.34), 0.05)
        glass = rounded_rectangle((place[1], place[2]), (0.17, 0.31), 0.04)
        body.add(paint.BLACK, extrude(shell, "x", place[0] - 0.016, place[0] + 0.045, 0.016, 2))
        body.add(paint.MIRROR, extrude(glass, "x", place[0] - 0.020, place[0] - 0.015))


def upper():
    body = Body()
    _deck(body)
    _counterweight(body)
    _hood(body)
    _right_side(body)
    _middle(body)
    body.add(paint.CHARCOAL, box((0.48, 0.86, 0.315), (1.84, 0.94, 0.07), 0.015))
    heavy_parts.add_cab(body, CAB)
    for x in (-0.02, 0.20):
        body.add(paint.CHARCOAL, box((0.85 + x, 1.36, 0.20 - x), (0.40, 0.12, 0.03), 0.006))
    body.add(paint.STEEL, handrail([(0.36, 1.38, 0.75), (0.36, 1.43, 0.80), (0.38, 1.43, 1.45),
                                    (0.38, 1.38, 1.50)]))
    body.add(paint.BLACK, cylinder((-0.24, 1.18, 2.0), (-0.24, 1.18, 2.05), 0.06, 16, 0.008))
    body.add(paint.BEACON, lathe([(0.0, 0.0), (0.055, 0.0), (0.055, 0.09), (0.04, 0.13),
                                  (0.0, 0.145)], (-0.24, 1.18, 2.04), (0, 0, 1), 16), crease_deg=50)
    _mirrors(body)
    return body
