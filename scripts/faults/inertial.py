"""Faults of inertial units."""

import numpy

from faults.geometry import local_line, mount, rotation
from faults.kinds import fault
from faults.recording import FaultError

RATE_WIDTH_S = 0.05    # standard deviation of Gaussian weights


@fault
def imu_bias(recording, _, *, sensor: str, gyro_x_radps: float = 0, gyro_y_radps: float = 0, gyro_z_radps: float = 0,
             accel_x_mps2: float = 0, accel_y_mps2: float = 0, accel_z_mps2: float = 0):
    """w + b, f + b in S, rad/s and m/s2. Exact."""
    _, table = recording.imu(sensor)
    columns = recording.GYRO + recording.ACCELEROMETER
    table.set(columns, table.get(*columns) + [gyro_x_radps, gyro_y_radps, gyro_z_radps, accel_x_mps2, accel_y_mps2, accel_z_mps2])


@fault
def imu_scale(recording, _, *, sensor: str, gyro_x: float = 1, gyro_y: float = 1, gyro_z: float = 1,
              accel_x: float = 1, accel_y: float = 1, accel_z: float = 1):
    """m w, m f in S, factors. Exact for motion and gravity; noise and bias are scaled with them."""
    _, table = recording.imu(sensor)
    columns = recording.GYRO + recording.ACCELEROMETER
    table.set(columns, table.get(*columns) * [gyro_x, gyro_y, gyro_z, accel_x, accel_y, accel_z])


@fault
def imu_mount(recording, _, *, sensor: str, roll_deg: float = 0, pitch_deg: float = 0, yaw_deg: float = 0):
    """w_T = R^T w_S, f_T = R^T f_S, R = Rz(yaw) Ry(pitch) Rx(roll), deg: the unit is turned by R in S. Exact for motion
    and gravity; biases and noise turn with them."""
    _, table = recording.imu(sensor)
    for triad in (recording.GYRO, recording.ACCELEROMETER):
        table.set(triad, table.get(*triad) @ rotation(roll_deg, pitch_deg, yaw_deg))


@fault
def imu_lever_arm(recording, _, *, sensor: str, x_m: float = 0, y_m: float = 0, z_m: float = 0):
    """f + w x (w x d) + alpha x d, d in B, m: the unit sits at p_BS + d. Approximated: w and alpha are value and slope of
    a line through the gyro's rows with Gaussian weights of 0.05 s, so that angular accelerations above some 3 Hz are
    too small, and alpha has noise (0.03 rad/s2 of a gyro with 0.01 rad/s at 100 Hz)."""
    folder, table = recording.imu(sensor)
    d_S = mount(folder)[2].T @ [x_m, y_m, z_m]
    w, alpha = local_line(table.times_s(), table.get(*recording.GYRO), RATE_WIDTH_S)
    f = table.get(*recording.ACCELEROMETER)
    table.set(recording.ACCELEROMETER, f + numpy.cross(w, numpy.cross(w, d_S)) + numpy.cross(alpha, d_S))


@fault
def imu_late(recording, _, *, sensor: str, late_s: float):
    """t_ns + late, s: the unit's clock, or a transport that its stamps know nothing of. Exact."""
    recording.imu(sensor)[1].delay_stamps(late_s)


@fault
def imu_filter(recording, _, *, sensor: str, time_constant_s: float):
    """y += (1 - e^(-T / tau)) (x - y), tau > 0 s, T from row to row, from y = x in the first row. Exact for a
    low-pass in the unit's output; approximated where rows were lost, whose x is that of the row after them."""
    if time_constant_s <= 0:
        raise FaultError(f"imu_filter: time_constant_s is {time_constant_s}; need more than 0")
    _, table = recording.imu(sensor)
    columns = recording.GYRO + recording.ACCELEROMETER
    x = table.get(*columns)
    y, gains = x.copy(), -numpy.expm1(-numpy.diff(table.times_s()) / time_constant_s)
    for k, gain in enumerate(gains, 1):
        y[k] = y[k - 1] + gain * (x[k] - y[k - 1])
    table.set(columns, y)


@fault
def imu_axis_swap(recording, _, *, sensor: str, axes: str):
    """Two axes, `xy`, `xz` or `yz`, are exchanged, of gyro and accelerometer alike. Exact; the triad is then left-handed,
    as of a driver that mixes up registers (a turn by 90 deg is imu_mount)."""
    if axes not in ("xy", "xz", "yz"):
        raise FaultError(f"imu_axis_swap: axes is '{axes}'; need xy, xz or yz")
    _, table = recording.imu(sensor)
    for triad in (recording.GYRO, recording.ACCELEROMETER):
        a, b = ("xyz".index(axis) for axis in axes)
        table.text[triad[a]], table.text[triad[b]] = table.text[triad[b]], table.text[triad[a]]
