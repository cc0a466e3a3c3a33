"""Chassis with engine and cab, and track shoe of the dozer, in the chassis frame."""

import heavy_parts
import paint
from dozer_dimensions import (LIFT_PIN_B, LIFT_PINS, LIFT_SPACING, SHOE_LENGTH, TRACK_RADIUS,
                              TRACK_WIDTH, TRACK_Y, TRACK_Z, WHEELBASE)
from heavy_parts import grille, handrail
from solids import (bar, both_sides, box, cylinder, extrude, lathe, pin, round_corners,
                    rounded_rectangle, smooth_path, tube)

COLOR = paint.YELLOW
TRACK = heavy_parts.Track(TRACK_Y, TRACK_Z, TRACK_RADIUS, TRACK_WIDTH, WHEELBASE, rollers=6,
                          carriers=1, belt=0.115, frame=paint.YELLOW)
FENDER = 1.02
CAB = heavy_parts.Cab(front=[(0.42, 1.06), (0.40, 1.50), (0.20, 2.88)],
                      rear=[(-1.02, 1.06), (-1.00, 1.62), (-0.90, 2.88)],
                      right=-0.74, left=0.74, sill=1.52, door=(-0.42, -0.40), pillar=0.095,
                      body=COLOR, frame=paint.CHARCOAL)


def _frame(body):
    body.add(paint.CHARCOAL, box((0.0, 0, 0.66), (3.1, 1.06, 0.50), 0.05))
    guard = round_corners([(-1.55, 0.42), (1.30, 0.38), (1.62, 0.52), (1.62, 0.70), (-1.60, 0.70),
                           (-1.62, 0.52)], 0.06, 2)
    body.add(paint.CHARCOAL, extrude(guard, "y", -0.42, 0.42, 0.02))
    # Shaft and equaliser bar to the track frames.
    body.add(paint.CHARCOAL, pin(-0.95, 0.52, 0.80, 0.10, 16),
             box((0.95, 0, 0.52), (0.20, 1.60, 0.14), 0.02))
    body.add(paint.CHARCOAL, *both_sides(pin(LIFT_PIN_B[0], LIFT_PIN_B[2], 0.06, 0.10, 16, 0.595)))
    # Drawbar.
    body.add(paint.CHARCOAL, box((-1.72, 0, 0.52), (0.30, 0.26, 0.12), 0.02))
    body.add(paint.STEEL, cylinder((-1.78, 0, 0.42), (-1.78, 0, 0.66), 0.035, 14))


def _hood(body):
    side = round_corners([(0.40, 0.88), (1.74, 0.88), (1.78, 0.96), (1.74, 1.60), (1.62, 1.68),
                          (0.40, 1.80)], [0, 0.03, 0.05, 0.10, 0.12, 0], 3)
    body.add(COLOR, extrude(side, "y", -0.50, 0.50, 0.06, 3), crease_deg=45)
    # Radiator guard: frame, mesh of bars, lamps above.
    for y in (-0.52, 0.52):
        body.add(COLOR, bar((1.80, y, 0.62), (1.77, y, 1.66), 0.10, 0.14, chamfer_m=0.02))
    body.add(COLOR, bar((1.77, -0.52, 1.66), (1.77, 0.52, 1.66), 0.12, 0.12, (0, 0, 1), 0.02))
    body.add(paint.BLACK, box((1.77, 0, 1.24), (0.05, 0.94, 0.76)))
    grille(body, (1.805, 0, 1.24), (0.03, 0.92, 0.76), "z", 11, paint.CHARCOAL)
    body.add(COLOR, box((1.81, 0, 0.76), (0.08, 1.0, 0.24), 0.02))
    for y in (0.30,):
        body.add(paint.BLACK, *both_sides(box((1.80, y, 1.76), (0.10, 0.16, 0.11), 0.015)))
        body.add(paint.LAMP, *both_sides(box((1.852, y, 1.76), (0.014, 0.13, 0.085), 0.003)))
    for y in (-0.505, 0.505):
        for k in range(3):
            body.add(paint.BLACK, box((0.62 + 0.40 * k, y, 1.24), (0.012, 0.02, 0.62)))
        grille(body, (1.22, y, 1.30), (0.34, 0.022, 0.40), "z", 7)
        body.add(paint.BLACK, box((0.70, y, 1.24), (0.05, 0.03, 0.12), 0.008))
    # Exhaust and precleaner.
    stack = smooth_path([(1.02, 0.20, 1.66), (1.02, 0.20, 2.26), (0.98, 0.20, 2.40),
                         (0.88, 0.20, 2.46)], 4)
    body.add(paint.STEEL, tube(stack, 0.055, 14))
    body.add(paint.BLACK, cylinder((0.883, 0.20, 2.459), (0.872, 0.20, 2.466), 0.044, 14))
    body.add(paint.CHARCOAL, cylinder((1.02, 0.20, 1.68), (1.02, 0.20, 2.00), 0.095, 16, 0.015))
    body.add(paint.BLACK, lathe([(0, 0), (0.06, 0), (0.06, 0.16), (0.12, 0.18), (0.12, 0.30),
                                 (0.08, 0.35), (0, 0.35)], (0.80, -0.22, 1.70), (0, 0, 1), 16))
    # Brackets of the lift cylinders.
    x, y, z = LIFT_PINS[0][0], LIFT_SPACING / 2, LIFT_PINS[0][2]
    body.add(COLOR, *both_sides(box((x, y - 0.09, z), (0.24, 0.06, 0.24), 0.02),
                                pin(x, z, 0.075, 0.075, 16, y)))


def _fenders(body):
    side = round_corners([(-1.48, FENDER - 0.05), (0.98, FENDER - 0.05), (1.02, FENDER),
                          (-1.48, FENDER)], 0.01, 1)
    body.add(COLOR, *both_sides(extrude(side, "y", 0.55, 1.16, 0.012)))
    mat = box((0.66, 0.86, FENDER + 0.008), (0.60, 0.50, 0.016), 0.004)
    body.add(paint.BLACK, *both_sides(mat))
    # Boxes beside the cab: batteries on the right, hydraulic oil on the left.
    for y in (0.95,):
        chest = box((-0.62, y, 1.25), (1.10, 0.40, 0.46), 0.05)
        body.add(COLOR, *both_sides(chest))
        body.add(paint.BLACK, *both_sides(box((-0.62, y + 0.196, 1.30), (0.10, 0.02, 0.05), 0.006)))
    body.add(paint.CHARCOAL, *both_sides(handrail([(0.36, 1.10, FENDER), (0.36, 1.10, 1.62),
                                                   (0.28, 1.10, 1.72), (-0.02, 1.10, 1.72),
                                                   (-0.08, 1.10, 1.64), (-0.08, 1.10, 1.46)])))
    step = round_corners([(0.44, 0.66), (0.74, 0.66), (0.74, 0.70), (0.44, 0.70)], 0.01, 1)
    body.add(paint.CHARCOAL, *both_sides(extrude(step, "y", 1.13, 1.22, 0.008)))
    for x in (0.46, 0.72):
        body.add(paint.CHARCOAL, *both_sides(bar((x, 1.15, 0.67), (x, 1.13, FENDER - 0.02), 0.025,
                                                 0.04)))


def _rear(body):
    tank = round_corners([(-1.04, 0.90), (-1.62, 0.90), (-1.70, 1.00), (-1.68, 1.52), (-1.56, 1.64),
                          (-1.04, 1.66)], [0, 0.08, 0.08, 0.12, 0.12, 0], 4)
    body.add(COLOR, extrude(tank, "y", -0.86, 0.86, 0.08, 3), crease_deg=50)
    body.add(paint.BLACK, cylinder((-1.35, 0.55, 1.63), (-1.35, 0.55, 1.70), 0.08, 16, 0.012))
    grille(body, (-1.695, 0.0, 1.26), (0.03, 0.80, 0.34), "z", 6)
    for y in (0.66,):
        body.add(paint.RED_LAMP, *both_sides(box((-1.69, y, 1.40), (0.05, 0.12, 0.08), 0.015)))
    body.add(paint.CHARCOAL, box((-1.66, 0, 0.78), (0.10, 1.0, 0.36), 0.03))


def _cab_extras(body):
    heavy_parts.add_cab(body, CAB)
    # Roll-over posts at the rear and air conditioning on the roof.
    for y in (-0.72, 0.72):
        body.add(paint.CHARCOAL, bar((-1.05, y, 1.10), (-0.97, y, 2.92), 0.14, 0.16,
                                     chamfer_m=0.025))
    body.add(paint.CHARCOAL, bar((-0.97, -0.74, 2.92), (-0.97, 0.74, 2.92), 0.13, 0.14, (0, 0, 1),
                                 0.02))
    body.add(COLOR, box((-0.52, 0, 3.0), (0.62, 0.90, 0.12), 0.04))
    body.add(paint.BLACK, cylinder((-0.95, 0.45, 2.98), (-0.95, 0.45, 3.03), 0.055, 14, 0.008))
    body.add(paint.BEACON, lathe([(0.0, 0.0), (0.05, 0.0), (0.05, 0.08), (0.035, 0.115),
                                  (0.0, 0.13)], (-0.95, 0.45, 3.02), (0, 0, 1), 14), crease_deg=50)
    for y in (0.40,):
        body.add(paint.BLACK, *both_sides(box((-1.06, y, 2.86), (0.09, 0.15, 0.10), 0.015)))
        body.add(paint.LAMP, *both_sides(box((-1.108, y, 2.86), (0.014, 0.12, 0.075), 0.003)))
    for side in (-1, 1):
        path = smooth_path([(0.22, side * 0.74, 2.60), (0.32, side * 0.86, 2.58),
                            (0.34, side * 0.92, 2.48)], 3)
        body.add(paint.BLACK, tube(path, 0.014, 7), crease_deg=65)
        shell = rounded_rectangle((side * 0.93, 2.32), (0.17, 0.30), 0.04)
        body.add(paint.BLACK, extrude(shell, "x", 0.32, 0.37, 0.014, 2))
        glass = rounded_rectangle((side * 0.93, 2.32), (0.145, 0.27), 0.03)
        body.add(paint.MIRROR, extrude(glass, "x", 0.315, 0.319))


def chassis():
    body = heavy_parts.mirrored_body(heavy_parts.track_side(TRACK))
    _frame(body)
    _hood(body)
    _fenders(body)
    _rear(body)
    _cab_extras(body)
    return body


def shoe():
    """One grouser over the middle of the plate."""
    return heavy_parts.shoe(TRACK, SHOE_LENGTH, grousers=(0.0,), height_m=0.052)
