#!/usr/bin/env python3
"""How a simulated skid-steer drive follows a recorded one: correlations and effective gauges.

    scripts/compare_turning.py REAL SIMULATED --radius R --gauge G

REAL and SIMULATED are the folders of one machine in two datasets, each with wheels/data.csv and imu/data.csv. For
the yaw rate, the wheels of each side, and the left wheels against the right ones, it prints the greatest correlation
with the recording over delays of the simulation from 0 to 2 s, and that delay. Then, for each, the gauge b that makes
yaw rate times b equal the difference of the wheels' speeds, by least squares, over the nominal one.
"""

import argparse
import bisect
import csv
import pathlib

DELAYS_S = [0.05 * k for k in range(41)]


def read(file, columns):
    with open(file, newline="") as stream:
        rows = list(csv.DictReader(stream))
    return [int(r["t_ns"]) * 1e-9 for r in rows], [[float(r[c]) for r in rows] for c in columns]


def at(times_s, values, t_s):
    """Linear between samples, the nearest end beyond them."""
    i = bisect.bisect_right(times_s, t_s)
    if i == 0 or i == len(times_s):
        return values[min(i, len(times_s) - 1)]
    s = (t_s - times_s[i - 1]) / (times_s[i] - times_s[i - 1])
    return (1 - s) * values[i - 1] + s * values[i]


def correlation(a, b):
    mean_a, mean_b = sum(a) / len(a), sum(b) / len(b)
    covariance = sum((x - mean_a) * (y - mean_b) for x, y in zip(a, b))
    variances = sum((x - mean_a) ** 2 for x in a) * sum((y - mean_b) ** 2 for y in b)
    return covariance / variances**0.5


class Drive:
    def __init__(self, folder, radius_m):
        folder = pathlib.Path(folder)
        self.wheel_s, (self.left, self.right) = read(
            folder / "wheels/data.csv", ["left_track_radps", "right_track_radps"])
        self.imu_s, (self.yaw,) = read(folder / "imu/data.csv", ["wz_radps"])
        self.radius_m = radius_m

    def effective_gauge_m(self):
        yaw = [at(self.imu_s, self.yaw, t) for t in self.wheel_s]
        speeds = [self.radius_m * (r - l) for l, r in zip(self.left, self.right)]
        return sum(y * d for y, d in zip(yaw, speeds)) / sum(y * y for y in yaw)


def best_correlation(real_s, real, simulated_s, simulated):
    found = [(correlation(real, [at(simulated_s, simulated, t - d) for t in real_s]), d) for d in DELAYS_S]
    return max(found)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("real")
    parser.add_argument("simulated")
    parser.add_argument("--radius", type=float, required=True, help="of the wheels, m")
    parser.add_argument("--gauge", type=float, required=True, help="nominal, m")
    arguments = parser.parse_args()
    real, simulated = (Drive(f, arguments.radius) for f in (arguments.real, arguments.simulated))
    for what, real_s, a, simulated_s, b in [
            ("yaw rate", real.imu_s, real.yaw, simulated.imu_s, simulated.yaw),
            ("left wheels", real.wheel_s, real.left, simulated.wheel_s, simulated.left),
            ("right wheels", real.wheel_s, real.right, simulated.wheel_s, simulated.right),
            ("left against right", real.wheel_s, real.left, simulated.wheel_s, simulated.right)]:
        r, delay_s = best_correlation(real_s, a, simulated_s, b)
        print(f"{what:20} correlation {r:.2f} with the simulation delayed by {delay_s:.2f} s")
    for what, drive in (("recorded", real), ("simulated", simulated)):
        print(f"{what:20} effective over nominal gauge {drive.effective_gauge_m() / arguments.gauge:.2f}")


if __name__ == "__main__":
    main()
