"""Dimensions of the dozer; the same numbers as config/machines/dozer.yaml.

Each link has its own frame (x forward, y left, z up at rest); lengths in metres, angles in degrees.
check_assets.py compares these numbers with the configuration.
"""

import math

import numpy as np

TRACK_Y, TRACK_Z, TRACK_RADIUS, TRACK_WIDTH, WHEELBASE = 0.895, 0.42, 0.42, 0.51, 2.745
SHOE_COUNT = 42
SHOE_LENGTH = (2 * WHEELBASE + 2 * math.pi * TRACK_RADIUS) / SHOE_COUNT

LIFT_PIN_B = (0.05, 0.0, 0.42)        # push frame in the chassis frame
TILT_PIN_P = (2.15, 0.0, 0.0)         # blade's ball in the push frame
LIFT_RANGE, TILT_RANGE = (-13.7, 21.5), (-7.2, 7.2)

BLADE_PROFILE = ((0.42, -0.42), (0.30, -0.25), (0.22, -0.02), (0.22, 0.22), (0.28, 0.45),
                 (0.40, 0.68))
BLADE_WIDTH = 3.045

# Pins in x, y, z: on the chassis and on the push frame (the middle of the two), on the push frame
# and on the blade.
LIFT_PINS = ((1.30, 0.0, 1.62), (1.00, 0.0, 0.10))
LIFT_SPACING = 1.16
TILT_PINS = ((1.85, 0.10, 0.30), (0.08, -0.86, 0.36))


def lift_range():
    """Shortest and longest distance between the pins of a lift cylinder."""
    angles = np.radians(np.linspace(*LIFT_RANGE, 361))
    (bx, by, bz), (rx, ry, rz) = LIFT_PINS
    x = LIFT_PIN_B[0] + np.cos(angles) * rx - np.sin(angles) * rz - bx
    z = LIFT_PIN_B[2] + np.sin(angles) * rx + np.cos(angles) * rz - bz
    distance = np.sqrt(x**2 + (ry - by)**2 + z**2)
    return float(distance.min()), float(distance.max())


def tilt_range():
    """Shortest and longest distance between the pins of the tilt cylinder."""
    angles = np.radians(np.linspace(*TILT_RANGE, 361))
    (bx, by, bz), (rx, ry, rz) = TILT_PINS
    y = np.cos(angles) * ry - np.sin(angles) * rz - by
    z = np.sin(angles) * ry + np.cos(angles) * rz - bz
    distance = np.sqrt((TILT_PIN_P[0] + rx - bx)**2 + y**2 + z**2)
    return float(distance.min()), float(distance.max())
