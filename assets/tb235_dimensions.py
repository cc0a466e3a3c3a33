"""Dimensions of the compact excavator; the same numbers as config/machines/tb235.yaml.

Each link has its own frame (x forward, y left, z up at rest); lengths in metres, angles in degrees.
check_assets.py compares these numbers with the configuration.
"""

import math

import numpy as np

SLEW_HEIGHT = 0.56                    # upper frame above the undercarriage frame
SWING_PIN_U = (0.62, 0.0, 0.10)       # swing post in the upper frame
BOOM_PIN_S = (0.18, 0.0, 0.20)        # boom foot in the swing post frame
BOOM_LENGTH, ARM_LENGTH = 2.5, 1.545
BUCKET_TIP = 0.78
BLADE_PIN_B = (0.95, 0.0, 0.35)
BOOM_RANGE, ARM_RANGE = (-50.0, 72.0), (-155.0, -30.0)
BLADE_RANGE, SWING_RANGE = (-25.0, 25.0), (-55.0, 75.0)
BUCKET_RANGE = (math.degrees(-1.222) - 45.0, math.degrees(0.873) - 45.0)

TRACK_Y, TRACK_Z, TRACK_RADIUS, TRACK_WIDTH, WHEELBASE = 0.574, 0.25, 0.25, 0.30, 1.60
SHOE_COUNT = 44
SHOE_LENGTH = (2 * WHEELBASE + 2 * math.pi * TRACK_RADIUS) / SHOE_COUNT

BUCKET_PROFILE = ((0.78, 0.0), (0.74, 0.12), (0.64, 0.28), (0.48, 0.40), (0.30, 0.42),
                  (0.15, 0.33), (0.09, 0.18), (0.09, -0.03))
BUCKET_WIDTH, BUCKET_TEETH = 0.60, 6
BLADE_PROFILE = ((0.55, -0.30), (0.50, -0.22), (0.48, -0.10), (0.50, 0.02), (0.54, 0.08))
BLADE_WIDTH = 1.55

# Pins in x-z of the cylinders that push their link: (barrel pin, joint in the barrel's link, rod pin
# in the turning link, range of the turning link's angle in the barrel's link).
CYLINDERS = {
    "boom": ((0.30, -0.04), (BOOM_PIN_S[0], BOOM_PIN_S[2]), (1.22, 0.20), BOOM_RANGE),
    "arm": ((1.10, 0.72), (BOOM_LENGTH, 0.0), (-0.34, 0.08), ARM_RANGE),
    "blade": ((0.68, 0.46), (BLADE_PIN_B[0], BLADE_PIN_B[2]), (0.40, 0.18), BLADE_RANGE),
}
# The same in x-y of the cylinder that swings the boom: barrel in the upper frame, rod in the swing post.
SWING_CYLINDER = ((-0.10, -0.29), SWING_PIN_U[:2], (0.033, -0.157), SWING_RANGE)

# The bucket's four-bar. Its cylinder pushes where rocker and coupler meet.
BUCKET_BARREL_PIN = (0.02, 0.30)      # in the arm
ROCKER_PIN, ROCKER_LENGTH = (1.30, 0.02), 0.29           # pin in the arm
COUPLER_PIN, COUPLER_LENGTH = (-0.125, 0.165), 0.30      # pin in the bucket


def _turned(point, angles):
    """Coordinates of a point after turns from x towards z."""
    return (np.cos(angles) * point[0] - np.sin(angles) * point[1],
            np.sin(angles) * point[0] + np.cos(angles) * point[1])


def bucket_knee(angles):
    """Where rocker and coupler meet, in the arm, for the bucket's angles (radians) there."""
    x, z = _turned(COUPLER_PIN, angles)
    x, z = x + ARM_LENGTH - ROCKER_PIN[0], z - ROCKER_PIN[1]
    apart = np.hypot(x, z)
    foot = (apart ** 2 + ROCKER_LENGTH ** 2 - COUPLER_LENGTH ** 2) / (2 * apart)
    height = np.sqrt(ROCKER_LENGTH ** 2 - foot ** 2)
    return (ROCKER_PIN[0] + (foot * x - height * z) / apart,
            ROCKER_PIN[1] + (foot * z + height * x) / apart)


def pin_distance_range(name):
    """Shortest and longest distance between a cylinder's pins over its joint's travel."""
    if name == "bucket":
        barrel = BUCKET_BARREL_PIN
        x, z = bucket_knee(np.radians(np.linspace(*BUCKET_RANGE, 721)))
    else:
        barrel, joint, rod, limits = SWING_CYLINDER if name == "swing" else CYLINDERS[name]
        x, z = _turned(rod, np.radians(np.linspace(*limits, 721)))
        x, z = joint[0] + x, joint[1] + z
    distance = np.hypot(x - barrel[0], z - barrel[1])
    return float(distance.min()), float(distance.max())
