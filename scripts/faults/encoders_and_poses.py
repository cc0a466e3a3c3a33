"""Faults of encoders and of measured poses."""

import numpy

from faults.geometry import rotation
from faults.kinds import fault
from faults.recording import FaultError


@fault
def encoder_zero(recording, _, *, joint: str, angle_deg: float = 0, travel_m: float = 0):
    """q + b, deg, or m of a joint that slides: an encoder with another zero, whose reading alone is another. The rate
    stays. Exact."""
    table, columns = recording.axis(joint)
    slides = columns[0].endswith("_m")
    if angle_deg if slides else travel_m:
        raise FaultError(f"encoder_zero: joint '{joint}' {'slides; need travel_m' if slides else 'turns; need angle_deg'}")
    table.set(columns[:1], table.get(columns[0]) + (travel_m if slides else numpy.radians(angle_deg)))


@fault
def encoder_scale(recording, _, *, joint: str, factor: float):
    """m q, m dq/dt, about the encoder's zero. Exact; the rate's noise is scaled with it."""
    table, columns = recording.axis(joint)
    table.set(columns, factor * table.get(*columns))


@fault
def encoder_late(recording, _, *, sensor: str, late_s: float):
    """t_ns + late, s, of a whole set of encoders. Exact."""
    table = recording.sensor(sensor)[1]
    if not table.is_encoders():
        raise FaultError(f"sensor '{sensor}' is no set of encoders: its data.csv has the columns {','.join(table.header)}")
    table.delay_stamps(late_s)


@fault
def poses_late(recording, _, *, late_s: float):
    """t_ns + late, s, of the measured poses. Exact."""
    for table in recording.poses():
        table.delay_stamps(late_s)


@fault
def poses_turned(recording, _, *, yaw_deg: float):
    """p = Rz p, q = qz q, v_W = Rz v_W, deg from east towards north, about the origin: the map is turned in W. Exact."""
    R = rotation(0, 0, yaw_deg)
    c, s = numpy.cos(numpy.radians(yaw_deg) / 2), numpy.sin(numpy.radians(yaw_deg) / 2)
    for table in recording.poses():
        for triad in (("x_m", "y_m", "z_m"), ("vx_mps", "vy_mps", "vz_mps")):
            if triad[0] in table:
                table.set(triad, table.get(*triad) @ R.T)
        columns = ("qw", "qx", "qy", "qz")
        w, x, y, z = table.get(*columns).T
        q = numpy.stack([c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w], axis=1)
        table.set(columns, q * numpy.where(q[:, :1] < 0, -1, 1))


@fault
def poses_height(recording, _, *, up_m: float):
    """z + d, m, of the measured poses. Exact."""
    for table in recording.poses():
        table.set(["z_m"], table.get("z_m") + up_m)
