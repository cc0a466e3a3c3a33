"""Mounts, turns, and what a gyro or a line of two antennas say of a turn."""

import re

import numpy

from faults.recording import FaultError


def rotation(roll_deg, pitch_deg, yaw_deg):
    """Rz(yaw) Ry(pitch) Rx(roll)."""
    (a, b, c), (sa, sb, sc) = (f(numpy.radians([roll_deg, pitch_deg, yaw_deg])) for f in (numpy.cos, numpy.sin))
    return numpy.array([[c * b, c * sb * sa - sc * a, c * sb * a + sc * sa],
                        [sc * b, sc * sb * sa + c * a, sc * sb * a - c * sa],
                        [-sb, b * sa, b * a]])


def mount(folder):
    """Link, p_BS and R_BS of a sensor.yaml."""
    text = (folder / "sensor.yaml").read_text() if (folder / "sensor.yaml").is_file() else ""
    link = re.search(r"parent_link:\s*\"?([\w-]+)", text)
    triples = {}
    for key in ("xyz_m", "rpy_deg"):
        at = re.search(key + r":\s*(.*)", text, re.DOTALL)
        numbers = re.findall(r"(?<![\w.])-?\d[\d.]*(?:[eE][+-]?\d+)?", at[1])[:3] if at else []
        if len(numbers) != 3:
            raise FaultError(f"{folder}/sensor.yaml: no three numbers {key}; need the mount")
        triples[key] = numpy.array([float(x) for x in numbers])
    if not link:
        raise FaultError(f"{folder}/sensor.yaml: no parent_link; need the mount")
    return link[1], triples["xyz_m"], rotation(*triples["rpy_deg"])


def local_line(times_s, values, width_s):
    """Value and slope at each time of the line that fits best, with Gaussian weights of standard deviation width_s."""
    reach = min(len(times_s) - 1, int(numpy.ceil(3 * width_s / numpy.median(numpy.diff(times_s)))))
    s0, s1, s2 = (numpy.zeros((len(times_s), 1)) for _ in range(3))
    y0, y1 = numpy.zeros_like(values), numpy.zeros_like(values)
    for k in range(-reach, reach + 1):
        here, there = slice(max(0, -k), len(times_s) - max(0, k)), slice(max(0, k), len(times_s) - max(0, -k))
        dt = (times_s[there] - times_s[here])[:, None]
        weight = numpy.exp(-0.5 * (dt / width_s) ** 2)
        s0[here] += weight
        s1[here] += weight * dt
        s2[here] += weight * dt * dt
        y0[here] += weight * values[there]
        y1[here] += weight * dt * values[there]
    det = s0 * s2 - s1 * s1
    known = det > 1e-9 * s0 * s0 * width_s ** 2
    safe = numpy.where(known, det, 1)
    return numpy.where(known, (s2 * y0 - s1 * y1) / safe, y0 / s0), numpy.where(known, (s0 * y1 - s1 * y0) / safe, 0)


def triad_of(first, second):
    """Columns x, y, z of a frame at each row: x along first, y across first and second."""
    x = first / numpy.linalg.norm(first, axis=1)[:, None]
    y = numpy.cross(second, x)
    y /= numpy.linalg.norm(y, axis=1)[:, None]
    return numpy.stack([x, y, numpy.cross(x, y)], axis=2)
