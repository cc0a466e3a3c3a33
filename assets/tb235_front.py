"""Swing post, boom, arm, bucket and cylinders of the compact excavator."""

import numpy as np

import paint
from heavy_parts import beam
from solids import (Body, bar, both_sides, box, cylinder, extrude, lathe, loft, pin, pipe, ribbon,
                    round_corners, smooth_path, tube)
from tb235_dimensions import (ARM_LENGTH, BOOM_LENGTH, BOOM_PIN_S, BUCKET_BARREL_PIN,
                              BUCKET_PROFILE, BUCKET_TEETH, BUCKET_WIDTH, COUPLER_LENGTH,
                              COUPLER_PIN, CYLINDERS, ROCKER_LENGTH, ROCKER_PIN,
                              pin_distance_range)

SHELL = 0.014
ROD_CLEARANCE = 0.10      # from a barrel's pin to the end of the rod when shut
GLAND_CLEARANCE = 0.075   # from the rod's pin to the barrel's end when shut

# Barrel radius, rod radius, half width of the eyes.
BORES = {"boom": (0.050, 0.0225, 0.040), "arm": (0.050, 0.0225, 0.036),
         "bucket": (0.045, 0.020, 0.034), "swing": (0.050, 0.020, 0.034),
         "blade": (0.055, 0.025, 0.034)}

# Half widths across the bucket's linkage, from the rod's eye outwards: coupler, rocker, ears.
COUPLER_Y, ROCKER_Y, PLATE = 0.053, 0.077, 0.014


def _cheek(points, radii, y, thickness):
    """A pair of plates at y and -y."""
    outline = round_corners(points, radii, 2)
    return both_sides(extrude(outline, "y", y - thickness / 2, y + thickness / 2, 0.004))


def swing_post():
    body = Body()
    body.add(paint.CHARCOAL, cylinder((0, 0, -0.072), (0, 0, 0.082), 0.115, 24, 0.012))
    neck = [[(0.02, -0.105, -0.065), (0.02, 0.105, -0.065), (0.02, 0.105, 0.075),
             (0.02, -0.105, 0.075)],
            [(0.14, -0.135, -0.075), (0.14, 0.135, -0.075), (0.14, 0.135, 0.10),
             (0.14, -0.135, 0.10)],
            [(0.20, -0.135, -0.06), (0.20, 0.135, -0.06), (0.20, 0.135, 0.06),
             (0.20, -0.135, 0.06)]]
    body.add(paint.CHARCOAL, loft(neck))
    x, z = BOOM_PIN_S[0], BOOM_PIN_S[2]
    cheek = [(0.06, -0.06), (0.30, -0.115), (0.37, -0.06), (0.35, 0.02), (x + 0.085, z),
             (x + 0.06, z + 0.085), (x - 0.06, z + 0.085), (x - 0.085, z), (0.07, 0.09)]
    body.add(paint.CHARCOAL, *_cheek(cheek, 0.045, 0.140, 0.035))
    body.add(paint.STEEL, pin(x, z, 0.170, 0.038, 16), pin(0.30, -0.04, 0.168, 0.034, 16))
    body.add(paint.CHARCOAL, *both_sides(pin(x, z, 0.010, 0.066, 14, 0.160),
                                         pin(0.30, -0.04, 0.010, 0.058, 14, 0.160)))
    body.add(paint.CHARCOAL, *both_sides(pin(0.30, -0.04, 0.035, 0.055, 16, 0.09)))
    return body


def _boom_curve():
    """Middle line of the boom with its height and width."""
    knots = np.array([(0.00, 0.00, 0.155, 0.185), (0.30, 0.085, 0.215, 0.200),
                      (0.62, 0.225, 0.285, 0.205), (0.90, 0.375, 0.340, 0.205),
                      (1.15, 0.462, 0.370, 0.200), (1.40, 0.452, 0.340, 0.195),
                      (1.70, 0.345, 0.285, 0.185), (2.00, 0.215, 0.240, 0.175),
                      (2.28, 0.095, 0.200, 0.165), (2.50, 0.000, 0.155, 0.155)])
    return smooth_path(knots, 2)


def boom():
    body = Body()
    curve = _boom_curve()
    body.add(paint.YELLOW, beam(curve[:, :2], curve[:, 2], curve[:, 3], 0.016), crease_deg=30)
    body.add(paint.YELLOW, pin(0, 0, 0.118, 0.088, 18))
    body.add(paint.YELLOW, pin(BOOM_LENGTH, 0, 0.050, 0.088, 12))
    body.add(paint.YELLOW, *_cheek([(2.20, 0.045), (2.44, -0.085), (2.56, -0.080), (2.595, 0.0),
                                    (2.55, 0.085), (2.28, 0.195)], [0.02, 0.07, 0.08, 0.08, 0.08, 0.03],
                                   0.098, 0.022))
    body.add(paint.STEEL, pin(BOOM_LENGTH, 0, 0.118, 0.034, 16))
    # Ears of the arm cylinder on top and of the boom cylinder below.
    (barrel_x, barrel_z), rod = CYLINDERS["arm"][0], CYLINDERS["boom"][2]
    body.add(paint.YELLOW, *_cheek([(0.86, 0.50), (1.34, 0.60), (1.20, 0.70), (1.16, 0.775),
                                    (1.04, 0.775), (0.99, 0.66)], [0, 0, 0.06, 0.05, 0.05, 0.08],
                                   0.058, 0.022))
    body.add(paint.STEEL, pin(barrel_x, barrel_z, 0.085, 0.028, 14))
    body.add(paint.YELLOW, *_cheek([(0.98, 0.30), (1.12, 0.175), (1.19, 0.140), (1.25, 0.140),
                                    (1.30, 0.185), (1.46, 0.34)], [0, 0.05, 0.04, 0.04, 0.05, 0],
                                   0.064, 0.024))
    body.add(paint.STEEL, pin(rod[0], rod[1], 0.095, 0.030, 14))
    # Work lamp on the left flank.
    body.add(paint.BLACK, box((1.02, 0.150, 0.50), (0.09, 0.075, 0.085), 0.014))
    body.add(paint.BLACK, bar((1.00, 0.09, 0.44), (1.00, 0.15, 0.47), 0.03, 0.03, (1, 0, 0)))
    body.add(paint.LAMP, box((1.068, 0.150, 0.50), (0.012, 0.06, 0.07), 0.003))
    _boom_hoses(body, curve)
    return body


def _boom_hoses(body, curve):
    """Pipes along the top and flank, with hoses over the joints."""
    tangents = np.gradient(curve[:, :2], axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    top = curve[:, :2] + np.column_stack([-tangents[:, 1], tangents[:, 0]]) * (
        curve[:, 2:3] / 2 + 0.018)
    for y in (-0.085, 0.085):
        line = [(-0.02, y * 1.1, 0.17)] + [(p[0], y, p[1]) for p in top[3:7]]
        body.add(paint.RUBBER, tube(smooth_path(line, 2), 0.013, 6), crease_deg=65)
    for y in (-0.075, -0.050, 0.050, 0.075):
        line = [(p[0], y, p[1]) for p in top[6:17]]
        body.add(paint.STEEL, tube(line, 0.008, 5), crease_deg=75)
    for y in (-0.060, 0.060):
        end = top[16]
        hose = smooth_path([(end[0] - 0.02, y, end[1]), (2.34, y, 0.27), (2.52, y, 0.24),
                            (2.62, y * 0.9, 0.12)], 4)
        body.add(paint.RUBBER, tube(hose, 0.014, 6), crease_deg=65)
    for k in (7, 10, 13, 15):
        clamp = box((top[k][0], 0, top[k][1] + 0.002), (0.035, 0.175, 0.026), 0.006)
        body.add(paint.CHARCOAL, clamp)


def arm():
    body = Body()
    knots = np.array([(-0.40, 0.075, 0.120, 0.105), (-0.22, 0.085, 0.235, 0.125),
                      (0.00, 0.075, 0.300, 0.150), (0.25, 0.065, 0.280, 0.150),
                      (0.70, 0.038, 0.225, 0.145), (1.15, 0.015, 0.175, 0.135),
                      (1.42, 0.002, 0.140, 0.125), (ARM_LENGTH, 0.0, 0.120, 0.120)])
    curve = smooth_path(knots, 2)
    body.add(paint.YELLOW, beam(curve[:, :2], curve[:, 2], curve[:, 3], 0.013), crease_deg=30)
    body.add(paint.YELLOW, pin(0, 0, 0.084, 0.090, 18), pin(ARM_LENGTH, 0, 0.070, 0.070, 18))
    boss = [(-0.16, -0.05), (0.02, -0.10), (0.14, -0.06), (0.22, 0.05), (0.10, 0.15),
            (-0.10, 0.16)]
    body.add(paint.YELLOW, *_cheek(boss, 0.06, 0.079, 0.010))
    rod, barrel = CYLINDERS["arm"][2], BUCKET_BARREL_PIN
    body.add(paint.YELLOW, *_cheek([(-0.10, 0.02), (-0.10, 0.19), (-0.30, 0.155), (-0.405, 0.115),
                                    (-0.405, 0.045), (-0.33, 0.010)], [0, 0.02, 0.05, 0.05, 0.05, 0.05],
                                   0.060, 0.024))
    body.add(paint.STEEL, pin(rod[0], rod[1], 0.086, 0.028, 14))
    body.add(paint.YELLOW, *_cheek([(-0.16, 0.17), (0.22, 0.17), (0.09, 0.29), (0.06, 0.355),
                                    (-0.02, 0.355), (-0.06, 0.29)], [0, 0, 0.06, 0.04, 0.04, 0.06],
                                   0.056, 0.020))
    body.add(paint.STEEL, pin(barrel[0], barrel[1], 0.080, 0.026, 14))
    body.add(paint.STEEL, pin(ARM_LENGTH, 0, 0.076, 0.030, 14))
    body.add(paint.YELLOW, pin(ROCKER_PIN[0], ROCKER_PIN[1], ROCKER_Y - PLATE / 2, 0.050, 10))
    body.add(paint.STEEL, pin(ROCKER_PIN[0], ROCKER_PIN[1], 0.090, 0.024, 10))
    # Pipes to the bucket cylinder.
    for y in (-0.035, 0.035):
        line = smooth_path([(-0.02, y * 2.4, 0.16), (0.10, y * 2.4, 0.20), (0.26, y * 1.3, 0.218),
                            (0.60, y, 0.170)], 4)
        body.add(paint.RUBBER, tube(line, 0.011, 6), crease_deg=65)
    return body


def _bucket_outline():
    """Inner side view of the shell from where the teeth begin over the floor to the back's lip."""
    lip = np.array(BUCKET_PROFILE[0]) + 0.85 * (np.array(BUCKET_PROFILE[1]) - BUCKET_PROFILE[0])
    return np.concatenate([[lip], smooth_path(BUCKET_PROFILE[1:7], 3), [BUCKET_PROFILE[7]]])


def bucket():
    body = Body()
    inner = _bucket_outline()
    half = BUCKET_WIDTH / 2
    # The profile runs from the edge over the floor to the back: its outside is on the right.
    body.add(paint.WORN_STEEL, extrude(ribbon(inner, 0.005), "y", -half, half))
    outside = ribbon(inner, 0.005)[len(inner):][::-1]
    body.add(paint.CHARCOAL, extrude(ribbon(outside, SHELL - 0.005), "y", -half, half))
    outer = ribbon(inner, SHELL)[len(inner):][::-1]
    side = np.concatenate([outer, [(0.12, -0.035), (0.40, 0.020), (0.66, 0.060)]])
    for low, high, color in ((half - 0.004, half, paint.WORN_STEEL),
                             (half, half + 0.014, paint.CHARCOAL)):
        body.add(color, *both_sides(extrude(side, "y", low, high)))
    # Side cutters, wear straps and the thick lip.
    cutter = [(0.745, 0.095), (0.700, 0.185), (0.42, 0.050), (0.44, 0.015), (0.66, 0.048)]
    body.add(paint.WORN_STEEL, *both_sides(extrude(cutter, "y", half + 0.010, half + 0.026, 0.004)))
    strap = ribbon(ribbon(inner[3:15], SHELL)[12:][::-1], 0.010)
    for y in (-0.18, 0.18):
        body.add(paint.WORN_STEEL, extrude(strap, "y", y - 0.03, y + 0.03))
    tip, root = np.array(BUCKET_PROFILE[0]), np.array(BUCKET_PROFILE[1])
    along = (tip - root) / np.linalg.norm(tip - root)
    across = np.array([-along[1], along[0]])  # towards the outside of the shell
    lip = [tip - 0.085 * along - 0.002 * across, tip - 0.075 * along + 0.010 * across,
           tip - 0.20 * along + 0.026 * across, tip - 0.20 * along - 0.002 * across]
    body.add(paint.WORN_STEEL, extrude(lip, "y", -half, half))
    _teeth(body, tip, along, across, half)
    _bucket_ears(body)
    return body


def _teeth(body, tip, along, across, half):
    for y in np.linspace(-half + 0.035, half - 0.035, BUCKET_TEETH):
        sections = ((0.0, 0.012, 0.0, 0.005), (0.05, 0.020, -0.010, 0.016),
                    (0.098, 0.024, -0.020, 0.030))
        rings = []
        for back, half_width, low, high in sections:
            corners = [tip - back * along + h * across for h in (low, high)]
            rings.append([(corners[0][0], y - half_width, corners[0][1]),
                          (corners[0][0], y + half_width, corners[0][1]),
                          (corners[1][0], y + half_width, corners[1][1]),
                          (corners[1][0], y - half_width, corners[1][1])])
        body.add(paint.STEEL, loft(rings))
        adapter = [tip - b * along + h * across
                   for b, h in ((0.085, -0.024), (0.085, 0.034), (0.13, 0.036), (0.215, 0.016),
                                (0.215, 0.0), (0.15, -0.016))]
        body.add(paint.CHARCOAL, extrude(adapter, "y", y - 0.028, y + 0.028))


def _bucket_ears(body):
    middle = ribbon(_bucket_outline(), SHELL / 2)[len(_bucket_outline()):][::-1]
    against_shell = [tuple(point) for point in middle if point[0] < 0.24 and point[1] < 0.42]
    free = [(0.04, -0.055), (-0.055, -0.040), (-0.065, 0.06), (-0.175, 0.135), (-0.165, 0.205),
            (-0.09, 0.225), (0.03, 0.290), (0.17, 0.378)]
    ear = against_shell + free
    radii = [0.0] * len(against_shell) + [0.05, 0.05, 0.06, 0.045, 0.045, 0.06, 0.08, 0.02]
    body.add(paint.CHARCOAL, *_cheek(ear, radii, 0.098, 0.026))
    x, z = COUPLER_PIN
    body.add(paint.STEEL, pin(0, 0, 0.125, 0.032, 16), pin(x, z, 0.125, 0.024, 16))
    body.add(paint.CHARCOAL, *both_sides(pin(0, 0, 0.010, 0.054, 14, 0.116),
                                         pin(x, z, 0.010, 0.042, 14, 0.116)))


def _link_plates(length, ends, waist, y, thickness):
    """A pair of plates from lug to lug along x, narrower between them."""
    arc = np.radians(np.linspace(90, 270, 6))
    left = [(ends * np.cos(a), ends * np.sin(a)) for a in arc]
    right = [(length - px, -pz) for px, pz in left]
    outline = (left + [(0.28 * length, -waist), (0.72 * length, -waist)] + right +
               [(0.72 * length, waist), (0.28 * length, waist)])
    return both_sides(extrude(outline, "y", y - thickness / 2, y + thickness / 2))


def bucket_rocker():
    """From its pin in the arm along +x to the knee, astride of arm and coupler."""
    body = Body()
    body.add(paint.CHARCOAL, *_link_plates(ROCKER_LENGTH, 0.042, 0.032, ROCKER_Y, PLATE))
    body.add(paint.STEEL, pin(ROCKER_LENGTH, 0, 0.092, 0.022, 10))
    return body


def bucket_coupler():
    """From its pin in the bucket along +x to the knee, where it takes the rod's eye between."""
    body = Body()
    body.add(paint.CHARCOAL, *_link_plates(COUPLER_LENGTH, 0.044, 0.034, COUPLER_Y, 0.024))
    body.add(paint.CHARCOAL, box((0.12, 0, 0), (0.11, 2 * COUPLER_Y, 0.050)))
    body.add(paint.CHARCOAL, pipe((0, -0.082, 0), (0, 0.082, 0), 0.044, 0.022, 12))
    return body


def cylinder_lengths(name):
    """Length of the barrel from its pin and of the rod from its eye."""
    shortest, longest = pin_distance_range(name)
    barrel, rod = shortest - GLAND_CLEARANCE, shortest - ROD_CLEARANCE
    if barrel + rod < longest + 0.02:
        raise ValueError(f"{name} cylinder does not reach over its joint's travel")
    return barrel, rod


def barrel(name):
    body = Body()
    radius, _, eye = BORES[name]
    length, _ = cylinder_lengths(name)
    body.add(paint.CHARCOAL, pipe((0, -eye, 0), (0, eye, 0), radius * 1.05, 0.022, 14))
    profile = [(0, 0.03), (radius * 0.8, 0.03), (radius + 0.004, 0.055), (radius + 0.004, 0.085),
               (radius, 0.09), (radius, length - 0.075), (radius + 0.008, length - 0.070),
               (radius + 0.008, length - 0.012), (radius * 0.85, length), (0, length)]
    body.add(paint.CHARCOAL, lathe(profile, (0, 0, 0), (1, 0, 0), 14))
    for x in (0.12, length - 0.10):
        body.add(paint.STEEL, cylinder((x, 0, radius - 0.01), (x, 0, radius + 0.022), 0.014, 8))
    line = smooth_path([(0.12, 0, radius + 0.018), (0.17, 0, radius + 0.030),
                        (length - 0.15, 0, radius + 0.030), (length - 0.10, 0, radius + 0.018)], 2)
    body.add(paint.STEEL, tube(line, 0.007, 5), crease_deg=75)
    return body


def rod(name):
    body = Body()
    radius, bar_radius, eye = BORES[name]
    _, length = cylinder_lengths(name)
    body.add(paint.CHARCOAL, pipe((0, -eye, 0), (0, eye, 0), radius * 0.95, 0.022, 14))
    neck = [(0, -0.065), (bar_radius * 1.35, -0.065), (bar_radius * 1.45, -0.03), (0, -0.02)]
    body.add(paint.CHARCOAL, lathe(neck, (0, 0, 0), (1, 0, 0), 16))
    body.add(paint.CHROME, cylinder((-length, 0, 0), (-0.06, 0, 0), bar_radius, 16))
    return body
