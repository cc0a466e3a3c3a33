"""Faults of the machine: the motion stays, and levers become those at which a faulty machine would have moved so."""

import numpy

from faults.encoders_and_poses import encoder_scale
from faults.kinds import fault
from faults.recording import FaultError


def set_levers(table, levers, values, kind):
    values = numpy.asarray(values, dtype=float).reshape(-1, len(levers))
    largest = float(numpy.max(numpy.abs(values), initial=0))
    if largest > 1:
        raise FaultError(f"{kind}: {' and '.join(levers)} would have to go to {largest:.4f}; need 1 at most, full lever. Give "
                         "a fault that makes the machine move more at the same lever, or a recording with smaller levers")
    table.set(levers, values)


@fault
def lever_dead_band(recording, _, *, lever: str, width: float):
    """u' = sgn u (|u| (1 - w) + w) where u is not 0, 0 <= w < 1: nothing moves for |u'| < w, and full lever is full rate
    (`dead_band` of width w with a `rate_gain` of 1 / (1 - w)). Exact."""
    if not 0 <= width < 1:
        raise FaultError(f"lever_dead_band: width is {width}; need 0 or more and less than 1")
    table = recording.lever(lever)
    u = table.get(lever)
    set_levers(table, [lever], numpy.sign(u) * (numpy.abs(u) * (1 - width) + width), "lever_dead_band")


@fault
def lever_gain(recording, _, *, lever: str, gain: float):
    """u' = u / g: the machine does g times what its scenario says, g > 0. Exact."""
    lever_asymmetric_gain(recording, None, lever=lever, negative=gain, positive=gain)


@fault
def lever_asymmetric_gain(recording, _, *, lever: str, negative: float = 1, positive: float = 1):
    """u' = u / g, with one g > 0 for u < 0 and one for u > 0 (`asymmetric_gain` of ratio negative where positive is 1).
    Exact."""
    if negative <= 0 or positive <= 0:
        raise FaultError(f"gain of lever '{lever}': {min(negative, positive)}; need more than 0")
    table = recording.lever(lever)
    u = table.get(lever)
    set_levers(table, [lever], u / numpy.where(u < 0, negative, positive), "gain")


@fault
def lever_delay(recording, _, *, lever: str, delay_s: float):
    """u'(t) = u(t + d), s, d >= 0: the lever was moved by d before the machine answered as it did. Rows are added where
    the lever changes between two rows. Exact, but the last d of the recording, in which it stands."""
    table = recording.lever(lever)
    t, d = table.times_ns(), round(delay_s * 1e9)
    if d < 0:
        raise FaultError(f"lever_delay: delay_s is {delay_s}; need 0 or more")
    texts = table.text[lever]
    changes = [k for k in range(1, len(texts)) if texts[k] != texts[k - 1]]
    moments = numpy.union1d(t, t[changes] - d)
    moments = moments[moments >= t[0]]
    later = numpy.searchsorted(t, moments + d, side="right") - 1
    table.take(numpy.searchsorted(t, moments, side="right") - 1)
    table.text[lever] = [texts[k] for k in later]
    table.set_times_ns(moments)


@fault
def lever_exponent(recording, _, *, lever: str, exponent: float):
    """u' = sgn u |u|^(1 / n), n > 0: the machine does sgn u' |u'|^n (`valve_curve`). Exact."""
    if exponent <= 0:
        raise FaultError(f"lever_exponent: exponent is {exponent}; need more than 0")
    table = recording.lever(lever)
    u = table.get(lever)
    set_levers(table, [lever], numpy.sign(u) * numpy.abs(u) ** (1 / exponent), "lever_exponent")


@fault
def lever_reversed(recording, _, *, lever: str):
    """u' = -u. Exact."""
    table = recording.lever(lever)
    table.set([lever], -table.get(lever))


@fault
def lever_missing(recording, _, *, lever: str):
    """u' = 0: the column is there and nothing comes in it. Exact."""
    table = recording.lever(lever)
    table.set([lever], 0 * table.get(lever))


@fault
def lever_one_sided(recording, _, *, lever: str):
    """u' = max(u, 0): a logger, or an input, that knows positive values alone. Exact."""
    table = recording.lever(lever)
    table.set([lever], numpy.maximum(table.get(lever), 0))


@fault
def track_difference(recording, _, *, difference: float, left: str = "left_track", right: str = "right_track"):
    """Shoes of the left track at V (1 - a / 2), of the right one at V (1 + a / 2), the sprockets at V (`track_asymmetry`).
    Shoes stay as they were recorded; sprockets, by lever and by encoders where the recording has them, become
    V / (1 - a / 2) and V / (1 + a / 2). |a| < 1. Exact."""
    if abs(difference) >= 1:
        raise FaultError(f"track_difference: difference is {difference}; need less than 1 either way")
    for name, shoes in ((left, 1 - difference / 2), (right, 1 + difference / 2)):
        table = recording.lever(name)
        set_levers(table, [name], table.get(name) / shoes, "track_difference")
        if recording.all_of([f"{name}_rad"]):    # The units say nothing of it, for the shoes move as they did.
            encoder_scale(recording, None, joint=name, factor=1 / shoes)
