"""What lies about on a building site and grows where nobody drives; origins on the ground, x along their length, z up."""

import math

import numpy as np

import paint
from solids import Body, box, cylinder, lathe, loft, moved, tube, turned

SEED = 47


def _pallet(body, turned_deg=0.0, rise_m=0.0):
    """A Euro pallet, 1.2 m by 0.8 m by 0.144 m (EN 13698-1)."""
    solids = []
    for y in (-0.35, 0.0, 0.35):
        solids.append(box((0, y, 0.011), (1.2, 0.10, 0.022)))
        solids += [box((x, y, 0.061), (0.145, 0.10, 0.078)) for x in (-0.5275, 0.0, 0.5275)]
    solids += [box((x, 0, 0.111), (0.145, 0.80, 0.022)) for x in (-0.5275, 0.0, 0.5275)]
    solids += [box((0, y, 0.133), (1.2, wide, 0.022)) for y, wide in
               ((-0.3275, 0.145), (-0.1625, 0.10), (0.0, 0.145), (0.1625, 0.10), (0.3275, 0.145))]
    body.add(paint.OLD_WOOD, *(moved(turned(s, "z", turned_deg), (0, 0, rise_m)) for s in solids))


def pallets():
    """Three empty pallets, one on the other, a little askew."""
    body = Body()
    for k, askew_deg in enumerate((0.0, 3.5, -2.0)):
        _pallet(body, askew_deg, 0.145 * k)
    return body


def _bag(length, width, height):
    """A full paper bag: a rounded cushion."""
    rings = []
    for t in np.linspace(-1, 1, 9):
        swell = max(1 - abs(t) ** 4, 0.0) ** 0.5
        angles = 2 * math.pi * np.arange(14) / 14
        c, s = np.cos(angles), np.sin(angles)
        y = 0.5 * width * (0.75 + 0.25 * swell) * np.sign(c) * np.abs(c) ** 0.6
        z = 0.5 * height * (0.10 + 0.90 * swell) * np.sign(s) * np.abs(s) ** 0.7
        rings.append(np.column_stack([np.full(14, 0.5 * length * t), y, z]))
    return loft(rings)


def bags():
    """Cement in bags of 25 kg on a pallet, five courses, the uppermost begun."""
    chance = np.random.default_rng(SEED)
    body = Body()
    _pallet(body)
    length, width, height = 0.58, 0.39, 0.12
    for course in range(5):
        for i in range(2):
            for j in range(2):
                if course == 4 and (i, j) != (0, 1):
                    continue
                bag = turned(_bag(length, width, height), "z", chance.uniform(-3, 3))
                at = ((i - 0.5) * 0.59 + chance.uniform(-0.01, 0.01),
                      (j - 0.5) * 0.40 + chance.uniform(-0.01, 0.01), 0.20 + 0.105 * course)
                body.add(paint.PAPER, moved(bag, at), crease_deg=60)
    return body


def drum():
    """A reel of cable, 1.0 m across, standing on its flanges' rims."""
    body = Body()
    radius, half = 0.50, 0.32
    across = (0, 1, 0)
    for side in (-1, 1):
        low, high = sorted((side * half, side * (half + 0.05)))
        body.add(paint.WOOD, lathe([(0, low), (radius, low), (radius, high), (0, high)],
                                   (0, 0, radius), across, 28))
    body.add(paint.BLACK, lathe([(0, -half), (0.36, -half), (0.37, -0.1), (0.36, half), (0, half)],
                                (0, 0, radius), across, 24))
    for k in range(9):  # turns of the outermost layer
        y = -half + (k + 0.5) * 2 * half / 9
        angles = np.linspace(0, 2 * math.pi, 25)[:-1]
        section = 2 * math.pi * np.arange(5) / 5
        rings = [np.column_stack([(0.365 + 0.03 * np.cos(section)) * math.cos(a),
                                  y + 0.03 * np.sin(section),
                                  radius + (0.365 + 0.03 * np.cos(section)) * math.sin(a)])
                 for a in -angles]
        body.add(paint.BLACK, loft(rings, closed=True))
    return body


def rubble():
    """Broken concrete in a low heap, 1.6 m across, with bent bars."""
    chance = np.random.default_rng([SEED, 1])
    body = Body()
    for k in range(70):
        size = chance.uniform(0.05, 0.32) * chance.uniform(0.35, 1.0, 3)
        away = 0.8 * math.sqrt(chance.uniform())
        angle = chance.uniform(0, 2 * math.pi)
        high = max(0.34 * (1 - away / 0.8), 0.0) * chance.uniform(0.3, 1.0)
        piece = box((0, 0, 0), size, 0.04 * size.min())
        for axis in "xyz":
            piece = turned(piece, axis, chance.uniform(-70, 70))
        piece = moved(piece, (away * math.cos(angle), away * math.sin(angle),
                              high + 0.3 * size.min()))
        piece = moved(piece, (0, 0, max(-0.04 - piece[..., 2].min(), 0)))  # hardly sunk in
        body.add(paint.RUBBLE if k % 4 else paint.CONCRETE, piece, crease_deg=20)
    for k in range(5):
        angle, lean = chance.uniform(0, 2 * math.pi), chance.uniform(0.3, 0.8)
        along = np.array([math.cos(angle), math.sin(angle), 0])
        path = [np.array([0, 0, 0.12]) + t * along * lean
                + np.array([0, 0, 0.34 * t - 0.30 * t * t]) for t in np.linspace(0, 1.2, 7)]
        body.add(paint.RUST, tube(path, 0.007, 6))
    return body


def rebar():
    """Reinforcing bars, 5 m long, in two bundles on laths."""
    chance = np.random.default_rng([SEED, 2])
    body = Body()
    for bundle in (-0.18, 0.18):
        for k in range(12):
            y, z = bundle + 0.075 * chance.uniform(-1, 1), 0.06 + 0.012 + 0.05 * chance.uniform()
            ends = (-2.5 + chance.uniform(-0.06, 0.06), 2.5 + chance.uniform(-0.06, 0.06))
            path = [(x, y + 0.012 * math.sin(1.3 * x + k), z) for x in np.linspace(*ends, 7)]
            body.add(paint.RUST, tube(path, 0.008, 6))
    body.add(paint.WOOD, *(box((x, 0, 0.03), (0.06, 0.7, 0.06)) for x in (-1.6, 0.0, 1.6)))
    return body


def barrels():
    """A steel drum of 200 l, 0.88 m high, and a plastic one of 60 l beside it."""
    body = Body()
    profile = [(0, 0), (0.285, 0), (0.292, 0.01)]
    for z in (0.29, 0.58):
        profile += [(0.285, z - 0.02), (0.298, z), (0.285, z + 0.02)]
    profile += [(0.285, 0.86), (0.292, 0.87), (0.292, 0.88), (0.27, 0.88), (0.27, 0.865), (0, 0.865)]
    body.add(paint.BLUE, lathe(profile, (-0.25, 0, 0), (0, 0, 1), 28))
    small = [(0, 0), (0.17, 0), (0.195, 0.03), (0.195, 0.50), (0.17, 0.56), (0.17, 0.61), (0, 0.61)]
    body.add(paint.CHARCOAL, lathe(small, (0.30, 0.12, 0), (0, 0, 1), 24))
    body.add(paint.BLACK, cylinder((-0.25, 0.17, 0.86), (-0.25, 0.17, 0.885), 0.03, 12))
    return body


def _blade(chance, reach, height, width):
    """A blade of grass: three-sided, bent outwards, ending in a point."""
    angle = chance.uniform(0, 2 * math.pi)
    along = np.array([math.cos(angle), math.sin(angle), 0.0])
    aside = np.array([-along[1], along[0], 0.0])
    foot = 0.25 * reach * math.sqrt(chance.uniform()) * along + 0.04 * chance.normal() * aside
    rings = []
    for t in (0.0, 0.4, 0.75, 1.0):
        middle = foot + reach * t ** 1.8 * along + np.array([0, 0, height * (t - 0.28 * t ** 3) - 0.01])
        half = 0.5 * width * (1 - t) ** 0.7
        rings.append([middle - half * aside, middle + half * aside, middle - 0.3 * half * along])
    return loft([np.array(ring)[::-1] for ring in rings])


def tuft():
    """A tuft of grass, 0.4 m high."""
    chance = np.random.default_rng([SEED, 3])
    body = Body()
    for k in range(56):
        blade = _blade(chance, chance.uniform(0.05, 0.32), chance.uniform(0.14, 0.44), 0.014)
        body.add((paint.FOLIAGE, paint.LIGHT_FOLIAGE, paint.DRY_GRASS)[k % 5 % 3], blade)
    return body


def weed():
    """A weed with broad leaves and a stalk, 0.5 m high."""
    chance = np.random.default_rng([SEED, 4])
    body = Body()
    for k in range(16):
        blade = _blade(chance, chance.uniform(0.16, 0.30), chance.uniform(0.06, 0.20), 0.075)
        body.add(paint.LIGHT_FOLIAGE if k % 3 else paint.FOLIAGE, blade)
    for _ in range(3):
        lean = chance.uniform(-0.12, 0.12, 2)
        path = [(t * lean[0], t * lean[1], 0.5 * t - 0.01) for t in np.linspace(0, 1, 5)]
        body.add(paint.LIGHT_FOLIAGE, tube(path, 0.007, 5))
        for t in np.linspace(0.45, 1.0, 7):
            turn = chance.uniform(0, 2 * math.pi)
            tip = np.array([t * lean[0] + 0.03 * math.cos(turn), t * lean[1] + 0.03 * math.sin(turn),
                            0.5 * t + 0.01])
            body.add(paint.DRY_GRASS, box(tip, (0.022, 0.022, 0.03)))
    return body


def nodes():
    return {"pallets": pallets(), "bags": bags(), "drum": drum(), "rubble": rubble(),
            "rebar": rebar(), "barrels": barrels(), "tuft": tuft(), "weed": weed()}
