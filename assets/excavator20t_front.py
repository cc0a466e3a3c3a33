"""Boom, arm, bucket with its links, and cylinders of the 20-ton excavator."""

import numpy as np

import heavy_parts
import paint
from excavator20t_dimensions import (ARM_LENGTH, BOOM_LENGTH, BUCKET_BARREL_PIN, BUCKET_PROFILE,
                                     BUCKET_TEETH, BUCKET_WIDTH, COUPLER_LENGTH, COUPLER_PIN,
                                     CYLINDERS, ROCKER_LENGTH, ROCKER_PIN, pin_distance_range)
from heavy_parts import beam, cheeks
from solids import (Body, bar, both_sides, box, extrude, loft, pin, ribbon, smooth_path, tube)

COLOR = paint.ORANGE
SHELL = 0.025
# Bores and rods as on the data sheet of the class.
SHAPES = {"boom": heavy_parts.Cylinder(0.120, 0.085, 0.055, 0.13),
          "arm": heavy_parts.Cylinder(0.135, 0.095, 0.060, 0.14),
          "bucket": heavy_parts.Cylinder(0.115, 0.080, 0.055, 0.13)}


def _bosses(x, z, half_width, radius, pin_radius):
    """A pin across the machine with a collar at each end."""
    return (pin(x, z, half_width, pin_radius, 14),
            both_sides(pin(x, z, 0.014, radius, 14, half_width - 0.016)))


def _add_pin(body, x, z, half_width, radius, pin_radius, color):
    across, collars = _bosses(x, z, half_width, radius, pin_radius)
    body.add(paint.STEEL, across)
    body.add(color, *collars)


def _boom_curve():
    """Middle line of the boom with its height and width."""
    knots = np.array([(0.00, 0.00, 0.36, 0.60), (0.45, 0.17, 0.50, 0.56), (1.10, 0.45, 0.64, 0.48),
                      (1.75, 0.70, 0.76, 0.46), (2.35, 0.84, 0.84, 0.45), (2.90, 0.80, 0.78, 0.44),
                      (3.60, 0.60, 0.64, 0.42), (4.40, 0.34, 0.53, 0.40), (5.10, 0.12, 0.44, 0.38),
                      (5.48, 0.03, 0.36, 0.34)])
    return smooth_path(knots, 2)


def boom():
    body = Body()
    curve = _boom_curve()
    body.add(COLOR, beam(curve[:, :2], curve[:, 2], curve[:, 3], 0.025), crease_deg=30)
    body.add(COLOR, pin(0, 0, 0.31, 0.19, 18))
    body.add(COLOR, *cheeks([(4.95, 0.05), (5.52, -0.17), (5.80, -0.16), (5.90, 0.0), (5.80, 0.17),
                             (5.10, 0.40)], [0.05, 0.15, 0.16, 0.16, 0.16, 0.06], 0.205, 0.045))
    _add_pin(body, BOOM_LENGTH, 0, 0.27, 0.12, 0.06, COLOR)
    (ear_x, ear_z), rod = CYLINDERS["arm"][0], CYLINDERS["boom"][2]
    body.add(COLOR, *cheeks([(2.55, 1.16), (3.35, 0.98), (3.16, 1.06), (3.08, 1.12), (2.93, 1.13),
                             (2.84, 1.14)], [0, 0, 0.10, 0.08, 0.08, 0.05], 0.10, 0.045))
    body.add(COLOR, *cheeks([(2.72, 0.95), (3.28, 0.90), (3.14, 1.02), (3.10, 1.11), (2.90, 1.11),
                             (2.82, 1.05)], [0, 0, 0.08, 0.10, 0.10, 0.05], 0.10, 0.06))
    _add_pin(body, ear_x, ear_z, 0.15, 0.09, 0.045, COLOR)
    _add_pin(body, rod[0], rod[1], 0.475, 0.10, 0.05, COLOR)
    body.add(COLOR, pin(rod[0], rod[1], 0.335, 0.12, 16))
    # Work lamp on the left flank.
    body.add(paint.BLACK, box((2.05, 0.30, 0.92), (0.13, 0.13, 0.13), 0.02))
    body.add(paint.BLACK, bar((2.02, 0.20, 0.85), (2.02, 0.31, 0.87), 0.06, 0.04, (1, 0, 0)))
    body.add(paint.LAMP, box((2.122, 0.30, 0.92), (0.014, 0.105, 0.105), 0.003))
    _boom_lines(body, curve)
    return body


def _boom_lines(body, curve):
    """Pipes along the top, with hoses over the joints."""
    tangents = np.gradient(curve[:, :2], axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    top = curve[:, :2] + np.column_stack([-tangents[:, 1], tangents[:, 0]]) * (
        curve[:, 2:3] / 2 + 0.045)
    for y in (-0.16, -0.11, 0.11, 0.16):
        line = [(p[0], y, p[1]) for p in top[3::2]]
        body.add(paint.CHARCOAL, tube(line, 0.017, 6), crease_deg=75)
        start = top[3]
        hose = smooth_path([(-0.32, y, 0.10), (-0.10, y, 0.34), (0.12, y, 0.38),
                            (start[0], y, start[1])], 4)
        body.add(paint.RUBBER, tube(hose, 0.024, 6), crease_deg=65)
    for y in (-0.13, 0.13):
        end = top[-1]
        hose = smooth_path([(end[0] - 0.05, y, end[1]), (5.60, y, 0.42), (5.86, y, 0.40),
                            (6.02, y * 0.9, 0.16)], 4)
        body.add(paint.RUBBER, tube(hose, 0.024, 6), crease_deg=65)
    for k in (5, 8, 12, 15):
        body.add(paint.BLACK, box((top[k][0], 0, top[k][1] + 0.004), (0.06, 0.40, 0.05), 0.010))


def arm():
    body = Body()
    knots = np.array([(-0.98, 0.24, 0.20, 0.20), (-0.60, 0.21, 0.42, 0.26),
                      (0.00, 0.15, 0.66, 0.31), (0.45, 0.13, 0.62, 0.31), (1.20, 0.08, 0.47, 0.30), (2.10, 0.03, 0.35, 0.28),
                      (2.62, 0.00, 0.29, 0.26), (ARM_LENGTH, 0.0, 0.25, 0.25)])
    curve = smooth_path(knots, 2)
    body.add(COLOR, beam(curve[:, :2], curve[:, 2], curve[:, 3], 0.022), crease_deg=30)
    body.add(COLOR, pin(0, 0, 0.178, 0.18, 18), pin(ARM_LENGTH, 0, 0.165, 0.15, 18))
    boss = [(-0.40, -0.02), (0.00, -0.21), (0.30, -0.14), (0.50, 0.10), (0.20, 0.34), (-0.20, 0.34)]
    body.add(COLOR, *cheeks(boss, 0.12, 0.160, 0.025))
    rod = CYLINDERS["arm"][2]
    body.add(COLOR, *cheeks([(-0.20, 0.12), (-0.30, 0.45), (-0.72, 0.40), (-0.96, 0.36),
                             (-0.97, 0.20), (-0.70, 0.05)], [0, 0.08, 0.12, 0.10, 0.10, 0.12],
                             0.120,
                            0.045))
    _add_pin(body, rod[0], rod[1], 0.17, 0.10, 0.045, COLOR)
    x, z = BUCKET_BARREL_PIN
    body.add(COLOR, *cheeks([(0.05, 0.40), (0.82, 0.32), (0.52, 0.50), (0.46, 0.60), (0.30, 0.60),
                             (0.24, 0.52)], [0, 0, 0.10, 0.08, 0.08, 0.08], 0.105, 0.045))
    _add_pin(body, x, z, 0.155, 0.085, 0.040, COLOR)
    body.add(COLOR, pin(*ROCKER_PIN, 0.150, 0.11, 20))
    _add_pin(body, *ROCKER_PIN, 0.235, 0.075, 0.040, COLOR)
    body.add(paint.STEEL, pin(ARM_LENGTH, 0, 0.17, 0.05, 18))
    for y in (-0.07, 0.07):
        line = smooth_path([(-0.10, y * 2.0, 0.46), (0.10, y * 2.2, 0.54), (0.34, y * 2.4, 0.70),
                            (0.50, y * 1.4, 0.66), (0.60, y, 0.58)], 4)
        body.add(paint.RUBBER, tube(line, 0.020, 6), crease_deg=65)
    return body


def _link_plate(length, y, thickness, width):
    """A straight link of rounded ends from the origin to (length, 0) in x-z."""
    half = width / 2
    outline = [(-half, -half), (length + half, -half), (length + half, half), (-half, half)]
    return heavy_parts.plate(outline, half, y, thickness)


def rocker():
    """Pair of links on the arm: its pin at the origin, the coupler's at (length, 0)."""
    body = Body()
    body.add(COLOR, *both_sides(_link_plate(ROCKER_LENGTH, 0.195, 0.045, 0.17)))
    _add_pin(body, ROCKER_LENGTH, 0, 0.245, 0.075, 0.042, COLOR)
    return body


def coupler():
    """Link from its pin on the bucket (origin) to the rocker's end at (length, 0), forked there."""
    body = Body()
    half = 0.10
    side = [(-half, -half), (0.15, -0.085), (COUPLER_LENGTH - 0.20, -0.085),
            (COUPLER_LENGTH + half, -half), (COUPLER_LENGTH + half, half),
            (COUPLER_LENGTH - 0.20, 0.085), (0.15, 0.085), (-half, half)]
    radii = [half, 0.06, 0.06, half, half, 0.06, 0.06, half]
    body.add(COLOR, *both_sides(heavy_parts.plate(side, radii, 0.125, 0.05)))
    body.add(COLOR, box((0.24, 0, 0), (0.16, 0.22, 0.13), 0.012))
    body.add(COLOR, pin(0, 0, 0.148, 0.085, 18))
    return body


def _bucket_outline():
    """Inner side view of the shell from where the teeth begin over the floor to the back's lip."""
    lip = np.array(BUCKET_PROFILE[0]) + 0.85 * (np.array(BUCKET_PROFILE[1]) - BUCKET_PROFILE[0])
    return np.concatenate([[lip], smooth_path(BUCKET_PROFILE[1:7], 3), [BUCKET_PROFILE[7]]])


def bucket():
    body = Body()
    inner, half = _bucket_outline(), BUCKET_WIDTH / 2
    body.add(paint.WORN_STEEL, extrude(ribbon(inner, 0.008), "y", -half, half))
    outside = ribbon(inner, 0.008)[len(inner):][::-1]
    body.add(paint.CHARCOAL, extrude(ribbon(outside, SHELL - 0.008), "y", -half, half))
    outer = ribbon(inner, SHELL)[len(inner):][::-1]
    side = np.concatenate([outer, [(0.22, -0.065), (0.74, 0.035), (1.23, 0.11)]])
    for low, high, color in ((half - 0.006, half, paint.WORN_STEEL),
                             (half, half + 0.022, paint.CHARCOAL)):
        body.add(color, *both_sides(extrude(side, "y", low, high)))
    cutter = [(1.38, 0.17), (1.30, 0.35), (0.90, 0.16), (0.92, 0.06), (1.22, 0.09)]
    body.add(paint.WORN_STEEL, *both_sides(extrude(cutter, "y", half + 0.016, half + 0.042, 0.006)))
    strap = ribbon(ribbon(inner[3:15], SHELL)[12:][::-1], 0.018)
    for y in (-0.40, -0.14, 0.14, 0.40):
        body.add(paint.WORN_STEEL, extrude(strap, "y", y - 0.05, y + 0.05))
    tip, root = np.array(BUCKET_PROFILE[0]), np.array(BUCKET_PROFILE[1])
    along = (tip - root) / np.linalg.norm(tip - root)
    across = np.array([-along[1], along[0]])
    lip = [tip - 0.150 * along - 0.004 * across, tip - 0.135 * along + 0.018 * across,
           tip - 0.36 * along + 0.045 * across, tip - 0.36 * along - 0.004 * across]
    body.add(paint.WORN_STEEL, extrude(lip, "y", -half, half))
    _teeth(body, tip, along, across, half)
    _bucket_ears(body)
    return body


def _teeth(body, tip, along, across, half):
    for y in np.linspace(-half + 0.075, half - 0.075, BUCKET_TEETH):
        rings = []
        for back, half_width, low, high in ((0.0, 0.026, 0.0, 0.010), (0.10, 0.042, -0.020, 0.032),
                                            (0.18, 0.048, -0.038, 0.058)):
            low_end, high_end = (tip - back * along + h * across for h in (low, high))
            rings.append([(low_end[0], y - half_width, low_end[1]),
                          (low_end[0], y + half_width, low_end[1]),
                          (high_end[0], y + half_width, high_end[1]),
                          (high_end[0], y - half_width, high_end[1])])
        body.add(paint.STEEL, loft(rings))
        adapter = [tip - b * along + h * across
                   for b, h in ((0.155, -0.046), (0.155, 0.064), (0.24, 0.068), (0.39, 0.030),
                                (0.39, 0.0), (0.28, -0.030))]
        body.add(paint.CHARCOAL, extrude(adapter, "y", y - 0.055, y + 0.055))


def _bucket_ears(body):
    outline = _bucket_outline()
    middle = ribbon(outline, SHELL / 2)[len(outline):][::-1]
    against_shell = [tuple(point) for point in middle if point[0] < 0.45 and point[1] < 0.64]
    free = [(0.08, -0.10), (-0.10, -0.08), (-0.115, 0.20), (-0.165, 0.40), (-0.12, 0.55),
            (0.02, 0.58), (0.22, 0.64)]
    ear = against_shell + free
    radii = [0.0] * len(against_shell) + [0.09, 0.09, 0.15, 0.10, 0.09, 0.10, 0.10]
    body.add(paint.CHARCOAL, *cheeks(ear, radii, 0.205, 0.05))
    for x, z in ((0, 0), COUPLER_PIN):
        _add_pin(body, x, z, 0.26, 0.095, 0.045, paint.CHARCOAL)


def barrel(name):
    return heavy_parts.barrel(SHAPES[name], pin_distance_range(name), name, COLOR)


def rod(name):
    return heavy_parts.rod(SHAPES[name], pin_distance_range(name), name, COLOR)
