#!/usr/bin/env python3
"""How unlike the two sides of a skid-steer vehicle are, by its gyroscope and its wheels alone.

    scripts/gyro_asymmetry.py MACHINE

MACHINE is the folder of one machine in a dataset, with wheels/data.csv and imu/data.csv. Means over a second of the
yaw rate are fitted, by least squares, by those of the wheels' rates and by a bias,

    w_z = p (right - left) + s (right + left) / 2 + b,

for each delay of the wheels from -0.5 to 0.5 s, the best of which is kept. Wheels of one circumference have s = 0;
the difference of `track_asymmetry` is s / p. Its deviation is that of independent seconds. No poses are used.
"""

import argparse
import csv
import pathlib

import numpy

WINDOW_S = 1.0


def read(file, columns):
    with open(file, newline="") as stream:
        rows = list(csv.DictReader(stream))
    return numpy.array([[float(row[c]) for c in ("t_ns", *columns)] for row in rows]).T


def means(times_s, values, starts_s):
    ends = numpy.searchsorted(times_s, starts_s + WINDOW_S)
    begins = numpy.searchsorted(times_s, starts_s)
    total = numpy.concatenate([[0], numpy.cumsum(values)])
    return (total[ends] - total[begins]) / numpy.maximum(ends - begins, 1)


def fit(wheels, imu, delay_s):
    starts_s = numpy.arange(imu[0][0] * 1e-9 + 1, imu[0][-1] * 1e-9 - 2, WINDOW_S)
    w_z = means(imu[0] * 1e-9, imu[1], starts_s)
    left, right = (means(wheels[0] * 1e-9, side, starts_s + delay_s) for side in wheels[1:])
    columns = numpy.stack([right - left, (right + left) / 2, numpy.ones_like(w_z)], axis=1)
    found, *_ = numpy.linalg.lstsq(columns, w_z, rcond=None)
    left_over = numpy.std(w_z - columns @ found)
    deviation = left_over * numpy.sqrt(numpy.diag(numpy.linalg.inv(columns.T @ columns)))
    return left_over, delay_s, found, deviation


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machine", type=pathlib.Path)
    machine = parser.parse_args().machine
    wheels = read(machine / "wheels/data.csv", ["left_track_radps", "right_track_radps"])
    imu = read(machine / "imu/data.csv", ["wz_radps"])
    left_over, delay_s, (p, s, _), deviation = min(
        (fit(wheels, imu, d) for d in numpy.arange(-0.5, 0.51, 0.05)), key=lambda one: one[0])
    print(f"difference {s / p:.4f} +- {abs(deviation[1] / p):.4f}, wheels late by {delay_s:.2f} s, "
          f"left {numpy.degrees(left_over):.2f} deg/s")


if __name__ == "__main__":
    main()
