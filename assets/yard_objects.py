"""Material and small things on a building site; origins on the ground, x along their length, z up."""

import math

import numpy as np

import paint
from solids import (Body, box, cylinder, extrude, lathe, moved, pipe, rounded_rectangle, turned)

SEED = 31


def concrete_pipe():
    """A drain pipe of concrete, 2.0 m long and 1.0 m across, lying, between two wedges."""
    body = Body()
    outer, inner, half, collar = 0.50, 0.40, 1.0, 0.06
    z = outer + collar
    body.add(paint.CONCRETE, pipe((-half, 0, z), (half, 0, z), outer, inner, 28))
    body.add(paint.CONCRETE, pipe((half - 0.16, 0, z), (half + 0.02, 0, z), outer + collar,
                                  outer - 0.02, 28))
    for x in (-0.7, 0.6):
        for side in (-1, 1):
            wedge = extrude([(side * 0.12, 0.0), (side * 0.42, 0.0), (side * 0.42, 0.20)], "x",
                            x - 0.05, x + 0.05)
            body.add(paint.WOOD, wedge)
    return body


def pipe_bundle():
    """Ten plastic pipes of 0.16 m in a heap of rows 4, 3, 2, 1, 6 m long, on bearers."""
    body = Body()
    radius, rise = 0.08, 0.06
    for row, count in enumerate((4, 3, 2, 1)):
        for k in range(count):
            y = (k - 0.5 * (count - 1)) * 2 * radius
            z = rise + radius + row * math.sqrt(3) * radius
            shift = 0.04 * ((k + row) % 3 - 1)
            body.add(paint.PIPE_ORANGE, pipe((-3.0 + shift, y, z), (3.0 + shift, y, z), radius,
                                             radius - 0.005, 16))
    for x in (-2.0, 0.0, 2.0):
        body.add(paint.WOOD, box((x, 0, rise / 2), (0.08, 0.9, rise)))
    for side in (-1, 1):
        body.add(paint.WOOD, *(box((x, side * 0.345, rise + 0.05), (0.08, 0.05, 0.10))
                               for x in (-2.0, 0.0, 2.0)))
    return body


def planks():
    """A stack of scaffold boards, 3 m by 1 m by about 0.4 m, a little untidy, on bearers."""
    chance = np.random.default_rng(SEED)
    body = Body()
    rise, thick, wide = 0.08, 0.045, 0.24
    for row in range(7):
        for k in range(4 if row < 6 else 2):
            y = (k - 1.5) * (wide + 0.012)
            board = box((0, 0, 0), (3.0, wide, thick - 0.004), 0.003)
            board = turned(board, "z", chance.uniform(-0.6, 0.6))
            color = paint.WOOD if chance.uniform() < 0.6 else paint.OLD_WOOD
            body.add(color, moved(board, (chance.uniform(-0.06, 0.06), y,
                                          rise + (row + 0.5) * thick)))
    for x in (-1.1, 1.1):
        body.add(paint.OLD_WOOD, box((x, 0, rise / 2), (0.10, 1.0, rise)))
    return body


def manhole():
    """A manhole: a ring of concrete 1.1 m across that stands 0.14 m high, with its iron cover."""
    body = Body()
    body.add(paint.CONCRETE, lathe([(0.36, 0.0), (0.55, 0.0), (0.55, 0.12), (0.53, 0.14),
                                    (0.36, 0.14)], (0, 0, 0), (0, 0, 1), 32, closed=True))
    body.add(paint.IRON, lathe([(0.0, 0.11), (0.345, 0.11), (0.345, 0.148), (0.0, 0.148)],
                               (0, 0, 0), (0, 0, 1), 28))
    for i in range(-4, 5):
        for j in range(-4, 5):
            x, y = 0.07 * i, 0.07 * j
            if math.hypot(x, y) < 0.30:
                body.add(paint.IRON, box((x, y, 0.151), (0.035, 0.035, 0.008)))
    return body


def blocks():
    """A pallet of masonry blocks, 1.2 m by 1.0 m by 1.15 m, two courses of it gone at one end."""
    chance = np.random.default_rng([SEED, 1])
    body = Body()
    for x in (-0.5, 0.0, 0.5):
        body.add(paint.OLD_WOOD, box((x, 0, 0.055), (0.10, 1.0, 0.09)))
    for y in np.linspace(-0.45, 0.45, 6):
        body.add(paint.OLD_WOOD, box((0, y, 0.112), (1.2, 0.10, 0.022)))
    length, width, height = 0.40, 0.20, 0.20
    for course in range(5):
        for i in range(3):
            for j in range(5):
                if course >= 3 and i == 2 and j < 5 - (course - 3):
                    continue
                jitter = chance.uniform(-0.004, 0.004, 2)
                at = ((i - 1) * length + jitter[0], (j - 2) * width + jitter[1],
                      0.124 + (course + 0.5) * height)
                body.add(paint.BLOCK, box(at, (length - 0.008, width - 0.008, height - 0.003),
                                          0.006))
    return body


def stake():
    """A surveyor's stake: a lath of 1.2 m with a painted head and a ribbon."""
    body = Body()
    lath = rounded_rectangle((0, 0), (0.05, 0.025), 0.003, 1)
    body.add(paint.WOOD, extrude(lath, "z", 0.0, 1.0))
    body.add(paint.CONE_ORANGE, extrude(rounded_rectangle((0, 0), (0.052, 0.027), 0.003, 1), "z",
                                        1.0, 1.2, 0.002))
    ribbon = [(0.0, 0.86), (0.10, 0.78), (0.16, 0.64), (0.145, 0.63), (0.085, 0.765), (0.0, 0.835)]
    body.add(paint.HI_VIS, extrude(ribbon, "y", 0.013, 0.016))
    body.add(paint.HI_VIS, extrude(rounded_rectangle((0, 0), (0.056, 0.032), 0.003, 1), "z", 0.835,
                                   0.87))
    body.add(paint.WOOD, cylinder((0.30, 0.10, -0.02), (0.30, 0.10, 0.12), 0.02, 8))
    return body


def nodes():
    return {"pipe": concrete_pipe(), "pipes": pipe_bundle(), "planks": planks(),
            "manhole": manhole(), "blocks": blocks(), "stake": stake()}
