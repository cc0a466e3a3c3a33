"""Undercarriage and track shoe of the 20-ton excavator."""

import heavy_parts
import paint
from excavator20t_dimensions import (SHOE_LENGTH, SLEW_HEIGHT, TRACK_RADIUS, TRACK_WIDTH, TRACK_Y,
                                     TRACK_Z, WHEELBASE)
from solids import bar, both_sides, box, extrude, lathe, loft, pipe, rounded_rectangle

TRACK = heavy_parts.Track(TRACK_Y, TRACK_Z, TRACK_RADIUS, TRACK_WIDTH, WHEELBASE, rollers=7,
                          carriers=2, belt=0.104, frame=paint.CHARCOAL)


def _leg(x_end, y_end):
    """One leg of the X frame from the middle to a track."""
    rings = []
    for t, half, low, high in ((0.0, 0.42, 0.46, 0.80), (0.55, 0.27, 0.44, 0.70),
                               (1.0, 0.25, 0.30, 0.56)):
        x, y = t * x_end, t * y_end
        rings.append([(x - half, y, low), (x + half, y, low), (x + half, y, high - 0.04),
                      (x + half - 0.04, y, high), (x - half + 0.04, y, high),
                      (x - half, y, high - 0.04)])
    return loft(rings)


def undercarriage():
    half = heavy_parts.track_side(TRACK)
    # Steps and guards on the side of the track frame.
    for x in (-0.55, 0.55):
        half.add(paint.CHARCOAL, box((x, TRACK_Y + 0.22, 0.56), (0.42, 0.16, 0.025), 0.006),
                 bar((x, TRACK_Y + 0.13, 0.46), (x, TRACK_Y + 0.28, 0.55), 0.30, 0.02, (1, 0, 0)))
    body = heavy_parts.mirrored_body(half)
    legs = [_leg(x, TRACK_Y - 0.10) for x in (0.80, -0.80)]
    body.add(paint.CHARCOAL, *both_sides(*legs))
    body.add(paint.CHARCOAL, extrude(rounded_rectangle((0, 0), (1.75, 1.15), 0.25), "z", 0.44, 0.86,
                                     0.04))
    body.add(paint.CHARCOAL, lathe([(0, 0.80), (0.66, 0.80), (0.66, 0.90), (0.60, 0.92), (0, 0.92)],
                                   (0, 0, 0), (0, 0, 1), 32))
    body.add(paint.STEEL, pipe((0, 0, 0.90), (0, 0, SLEW_HEIGHT + 0.02), 0.62, 0.48, 32))
    body.add(paint.CHARCOAL, *both_sides(box((0.9, 0.22, 0.62), (0.06, 0.20, 0.22), 0.012)))
    return body


def shoe():
    return heavy_parts.shoe(TRACK, SHOE_LENGTH)
