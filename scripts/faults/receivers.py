"""Faults of satellite receivers."""

import numpy

from faults.geometry import local_line, mount, triad_of
from faults.kinds import fault
from faults.recording import FaultError, Recording

STANDARD_GRAVITY_MPS2 = 9.80665
WGS84_RADIUS_M, WGS84_ECCENTRICITY2 = 6378137.0, 6.69437999014e-3
BASELINE_WIDTH_S, TILT_WIDTH_S = 0.2, 2.0    # standard deviations of Gaussian weights


def add_place(table, offset_W):
    """Adds east, north, up to all rows with a fix, and to latitude, longitude and height what belongs to it."""
    offset_W = numpy.where(table.get("fix")[:, None] > 0, offset_W, 0.0)
    table.set(Recording.PLACE, table.get(*Recording.PLACE) + offset_W)
    geodetic = ("lat_deg", "lon_deg", "alt_m")
    if all(c in table for c in geodetic):
        lat_deg, lon_deg, alt_m = table.get(*geodetic).T
        sine, cosine = numpy.sin(numpy.radians(lat_deg)), numpy.cos(numpy.radians(lat_deg))
        normal_m = WGS84_RADIUS_M / numpy.sqrt(1 - WGS84_ECCENTRICITY2 * sine ** 2)
        meridian_m = normal_m * (1 - WGS84_ECCENTRICITY2) / (1 - WGS84_ECCENTRICITY2 * sine ** 2)
        table.set(geodetic, numpy.stack([lat_deg + numpy.degrees(offset_W[:, 1] / (meridian_m + alt_m)),
                                         lon_deg + numpy.degrees(offset_W[:, 0] / ((normal_m + alt_m) * cosine)),
                                         alt_m + offset_W[:, 2]], axis=1))


def up_in_link(recording, folder, link, times_s):
    """Direction of up in B by a unit on the link: its force in the mean, its turns in between. None without a unit."""
    for unit, table in recording.all_of(recording.GYRO + recording.ACCELEROMETER):
        if unit.parent == folder.parent and mount(unit)[0] == link:
            R_BS, t = mount(unit)[2], table.times_s()
            w, f = (table.get(*triad) @ R_BS.T for triad in (recording.GYRO, recording.ACCELEROMETER))
            slow, _ = local_line(t, f / STANDARD_GRAVITY_MPS2, TILT_WIDTH_S)
            turned = numpy.cumsum(-numpy.cross(w, slow) * numpy.gradient(t)[:, None], axis=0)
            up = slow + turned - local_line(t, turned, TILT_WIDTH_S)[0]
            return numpy.stack([numpy.interp(times_s, t, axis) for axis in up.T], axis=1)
    return None


@fault
def gnss_lever_arm(recording, _, *, sensor: str, x_m: float = 0, y_m: float = 0, z_m: float = 0):
    """p_W + R_WB d, d in B, m: the antenna is at p_BS + d. R_WB turns up in B into up, and the documented line to the other
    receiver's antenna on the same link into the plane of up and the measured line (rows of the best fix alone, lines
    with Gaussian weights of 0.2 s, interpolated elsewhere). Up in B is by an inertial unit on the link: its specific
    force over 2 s, its turns by the gyro within. Without a unit the line is met itself, and the link is taken to be
    level about it. Approximated: noise of a pair 1 m apart turns d by some 0.01 rad; a turn during a lost fix is taken to
    be even."""
    folder, table = recording.gnss(sensor)
    link, p_BS, _ = mount(folder)
    others = [(f, t) for f, t in recording.all_of((*recording.PLACE, "fix"))
              if f != folder and f.parent == folder.parent and mount(f)[0] == link]
    if len(others) != 1:
        raise FaultError(f"gnss_lever_arm: {len(others)} other receivers on link '{link}'; need one, for the heading")
    other_folder, other = others[0]
    line_B = mount(other_folder)[1] - p_BS
    best = max(table.get("fix"), key=lambda f: (f == 4, f == 5, f))
    rows, other_rows = table.get("fix") == best, other.get("fix") == best
    if best == 0 or numpy.count_nonzero(rows) < 2 or numpy.count_nonzero(other_rows) < 2 or not line_B.any():
        raise FaultError("gnss_lever_arm: the two receivers never have the same fix, or one mount; need the heading")
    t, t_other = table.times_s(), other.times_s()[other_rows]
    away = t_other[numpy.clip(numpy.searchsorted(t_other, t), 0, len(t_other) - 1)] - t
    before = t - t_other[numpy.clip(numpy.searchsorted(t_other, t) - 1, 0, len(t_other) - 1)]
    paired = rows & (away >= 0) & (before >= 0) & (away + before < 1)
    if numpy.count_nonzero(paired) < 2:
        raise FaultError("gnss_lever_arm: the two receivers have no fix at the same time; need the heading")
    line_W = numpy.stack([numpy.interp(t, t_other, axis) for axis in other.get(*recording.PLACE)[other_rows].T], axis=1)
    line_W, _ = local_line(t[paired], (line_W - table.get(*recording.PLACE))[paired], BASELINE_WIDTH_S)
    line_W = numpy.stack([numpy.interp(t, t[paired], axis) for axis in line_W.T], axis=1)
    line_B, z = numpy.tile(line_B, (len(t), 1)), numpy.tile([0.0, 0.0, 1.0], (len(t), 1))
    up_B = up_in_link(recording, folder, link, t)
    A_W, A_B = (triad_of(line_W, z), triad_of(line_B, z)) if up_B is None else (triad_of(z, line_W), triad_of(up_B, line_B))
    add_place(table, numpy.einsum("nij,nkj,k->ni", A_W, A_B, [x_m, y_m, z_m]))


@fault
def gnss_datum(recording, _, *, sensor: str, east_m: float = 0, north_m: float = 0, up_m: float = 0):
    """p_W + d, m, in rows with a fix; latitude and longitude by the radii of WGS 84 at the place. Exact to (d / 6e6)."""
    add_place(recording.gnss(sensor)[1], numpy.array([east_m, north_m, up_m]))


@fault
def gnss_late(recording, _, *, sensor: str, late_s: float):
    """t_ns + late, s. Exact."""
    recording.gnss(sensor)[1].delay_stamps(late_s)


@fault
def gnss_antennas_swapped(recording, _, *, first: str, second: str):
    """Each receiver's file is the other's: the cables are exchanged. Exact but for noise and clocks, which go with the
    antenna and not with the receiver."""
    (_, a), (_, b) = recording.gnss(first), recording.gnss(second)
    if a.header != b.header:
        raise FaultError("gnss_antennas_swapped: the two receivers have other columns")
    a.text, b.text = b.text, a.text
