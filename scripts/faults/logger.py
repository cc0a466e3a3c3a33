"""Faults of whatever writes the rows and stamps them."""

import numpy

from faults.kinds import fault
from faults.recording import FaultError

SHORTEST_INTERVAL_NS = 1000


@fault
def clock_of_all_sensors_but_encoders(recording, _, *, late_s: float):
    """t_ns + late, s, of all sensors and poses; encoders, levers and efforts keep the logger's own clock. Exact."""
    poses = [recording.table(f) for f in sorted(recording.folder.glob("truth/*/pose.csv"))]
    for table in poses + [t for _, t in recording.all_of(["t_ns"]) if not t.is_encoders()]:
        table.delay_stamps(late_s)


@fault
def rows_lost(recording, random, *, share: float, channel: str = "all"):
    """Each row but the first and the last of a channel is missing with this probability (0 to 1), whatever the others.
    Of levers too: the one before then stands for longer. Exact."""
    if not 0 < share < 1:
        raise FaultError(f"rows_lost: share is {share}; need more than 0 and less than 1")
    for table in recording.channel(channel):
        kept = random.random(len(table.text["t_ns"])) >= share
        kept[:1] = kept[-1:] = True
        table.take(numpy.flatnonzero(kept))


@fault
def jitter(recording, random, *, deviation_s: float, channel: str = "all"):
    """t_ns + N(0, deviation^2), s. Approximated where that would be less than 1 us after the row before: it is then 1 us
    after it, since stamps grow."""
    if deviation_s < 0:
        raise FaultError(f"jitter: deviation_s is {deviation_s}; need 0 or more")
    for table in recording.channel(channel):
        stamps = table.times_ns() + numpy.rint(random.normal(0, deviation_s * 1e9, len(table.text["t_ns"]))).astype(numpy.int64)
        steps = SHORTEST_INTERVAL_NS * numpy.arange(len(stamps))
        table.set_times_ns(numpy.maximum.accumulate(stamps - steps) + steps)


@fault
def shift_stamps(recording, _, *, channel: str, late_s: float):
    """t_ns + late, s, of one channel, or of `all`. Exact."""
    for table in recording.channel(channel):
        table.delay_stamps(late_s)


@fault
def burst_loss(recording, random, *, bursts: float, duration_s: float, channel: str = "all"):
    """No rows, but the first and the last of a channel, for this many times of duration_s: the logger stands still, in
    all its channels at the same times, which are equally likely over the recording. Exact."""
    tables = recording.channel(channel)
    if bursts < 1 or bursts != int(bursts) or duration_s <= 0:
        raise FaultError(f"burst_loss: bursts is {bursts:g}, duration_s {duration_s:g}; need a whole number and a time above 0")
    first, last = min(t.times_s()[0] for t in tables), max(t.times_s()[-1] for t in tables)
    starts = random.uniform(first, max(first, last - duration_s), int(bursts))
    for table in tables:
        t = table.times_s()
        kept = ~numpy.any([(start <= t) & (t < start + duration_s) for start in starts], axis=0)
        kept[:1] = kept[-1:] = True
        table.take(numpy.flatnonzero(kept))
