"""Dimensions of the 20-ton excavator; the same numbers as config/machines/excavator20t.yaml.

Each link has its own frame (x forward, y left, z up at rest); lengths in metres, angles in degrees.
check_assets.py compares these numbers with the configuration.
"""

import math

import numpy as np

SLEW_HEIGHT = 1.02                    # upper frame above the undercarriage frame
BOOM_PIN_U = (0.18, 0.0, 0.81)        # boom foot in the upper frame
BOOM_LENGTH, ARM_LENGTH = 5.7, 2.925
BUCKET_TIP = 1.45
BOOM_RANGE, ARM_RANGE, BUCKET_RANGE = (-46.0, 65.0), (-152.0, -33.0), (-142.0, 33.0)

TRACK_Y, TRACK_Z, TRACK_RADIUS, TRACK_WIDTH, WHEELBASE = 1.10, 0.3975, 0.3975, 0.60, 3.275
SHOE_COUNT = 45
SHOE_LENGTH = (2 * WHEELBASE + 2 * math.pi * TRACK_RADIUS) / SHOE_COUNT

TAIL_RADIUS = 2.75

BUCKET_PROFILE = ((1.45, 0.0), (1.37, 0.19), (1.18, 0.44), (0.89, 0.615), (0.55, 0.66),
                  (0.28, 0.55), (0.17, 0.32), (0.17, -0.05))
BUCKET_WIDTH, BUCKET_TEETH = 1.045, 5

# The bucket's four-bar in x-z: rocker's pin on the arm, lengths of rocker and coupler, coupler's
# pin on the bucket.
ROCKER_PIN = (2.50, 0.02)
ROCKER_LENGTH, COUPLER_LENGTH = 0.66, 0.62
COUPLER_PIN = (-0.06, 0.455)

# Pins of the cylinders in x-z: (barrel pin, joint in the barrel's link, rod pin in the turning
# link, range of the turning link's angle in the barrel's link). The bucket's rod ends where rocker
# and coupler meet.
CYLINDERS = {
    "boom": ((0.88, 0.31), (BOOM_PIN_U[0], BOOM_PIN_U[2]), (2.65, 0.76), BOOM_RANGE),
    "arm": ((3.00, 1.00), (BOOM_LENGTH, 0.0), (-0.832, 0.287), ARM_RANGE),
}
BUCKET_BARREL_PIN = (0.38, 0.50)


def _turned(pin, angles):
    return (np.cos(angles) * pin[0] - np.sin(angles) * pin[1],
            np.sin(angles) * pin[0] + np.cos(angles) * pin[1])


def rocker_end(angles):
    """Where rocker and coupler meet, in the arm's frame, for angles of the bucket in radians."""
    x, z = _turned(COUPLER_PIN, angles)
    dx, dz = ARM_LENGTH + x - ROCKER_PIN[0], z - ROCKER_PIN[1]
    reach = np.hypot(dx, dz)
    along = (ROCKER_LENGTH**2 - COUPLER_LENGTH**2 + reach**2) / (2 * reach)
    across = np.sqrt(ROCKER_LENGTH**2 - along**2)
    return (ROCKER_PIN[0] + (along * dx - across * dz) / reach,
            ROCKER_PIN[1] + (along * dz + across * dx) / reach)


def pin_distance_range(name):
    """Shortest and longest distance between a cylinder's pins over its joint's travel."""
    if name == "bucket":
        x, z = rocker_end(np.radians(np.linspace(*BUCKET_RANGE, 721)))
        distance = np.hypot(x - BUCKET_BARREL_PIN[0], z - BUCKET_BARREL_PIN[1])
    else:
        barrel, joint, rod, limits = CYLINDERS[name]
        x, z = _turned(rod, np.radians(np.linspace(*limits, 721)))
        distance = np.hypot(joint[0] + x - barrel[0], joint[1] + z - barrel[1])
    return float(distance.min()), float(distance.max())
