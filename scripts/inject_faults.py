#!/usr/bin/env python3
"""Copies a recording and changes its files as if the machine, a sensor or the logger had a fault.

    scripts/inject_faults.py RECORDING OUT --fault KIND[:key=value,...] [--fault ...] [--seed N]
    scripts/inject_faults.py RECORDING OUT --fault imu_mount:sensor=imu_boom,pitch_deg=2 --fault lever_delay:lever=arm,delay_s=0.1

Faults act in the order in which they are given. OUT must not exist; a fault that is refused, or that changes nothing,
ends with status 2 and leaves nothing. The formats are those of docs/reference/dataset.md, signs and frames those of
docs/reference/mechanisms.md: S is a sensor as documented, T as it is, B its link, W east-north-up. A `sensor` is the name of its
folder, with the machine's before it (`excavator1/imu_boom`) where several machines have one of that name; a `channel`
is a sensor, `commands`, `efforts`, `poses` or `all`. Mounts and links are read in each sensor.yaml.

What holds for all kinds: what a sensor rounds or clips is not rounded or clipped again, nor are its noise and its slow
wander made anew; both go through the fault as if they were motion. Names of pictures and scans keep their old stamps.
Faults of the machine change levers and leave the motion: a recorded lever u becomes the u' at which the faulty machine
would have moved as it did. They are exact, but where u' would be beyond full, which is refused.
"""

import argparse
import pathlib
import shutil
import sys

import numpy

from faults import encoders_and_poses, inertial, logger, machine, receivers  # noqa: F401, each makes its kinds known
from faults.kinds import KINDS, help_text, parse_fault
from faults.recording import FaultError, Recording


def inject(source, out, faults, seed):
    """Writes the recording with its faults to out, which appears when all of it is there."""
    source, out = pathlib.Path(source), pathlib.Path(out)
    parsed = [parse_fault(text) for text in faults]
    unfinished = out.with_name(out.name + ".incomplete")
    for folder in (out, unfinished):
        if folder.exists() or folder.is_symlink():
            raise FaultError(f"{folder} is there already; need a name that is not")
    recording = Recording(source)
    for number, (kind, given) in enumerate(parsed):
        before = recording.state()
        KINDS[kind](recording, numpy.random.default_rng([seed, number]), **given)
        if all(before.get(f, table.as_read) == table.text for f, table in recording.tables.items()):
            raise FaultError(f"{faults[number]} changes nothing in {source}")
    try:
        shutil.copytree(source, unfinished)
        for file, table in recording.tables.items():
            if table.text != table.as_read:
                written = unfinished / file.relative_to(source)
                written.unlink()
                table.write(written)
        unfinished.rename(out)
    except BaseException:
        shutil.rmtree(unfinished, ignore_errors=True)
        raise


def main():
    parser = argparse.ArgumentParser(description=__doc__, epilog=help_text(), formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recording", metavar="RECORDING")
    parser.add_argument("out", metavar="OUT")
    parser.add_argument("--fault", metavar="KIND[:key=value,...]", action="append", required=True, help="may be repeated")
    parser.add_argument("--seed", type=int, default=1, help="of what is random: whole number >= 0")
    given = parser.parse_args()
    try:
        if given.seed < 0:
            raise FaultError(f"--seed is {given.seed}; need 0 or more")
        inject(given.recording, given.out, given.fault, given.seed)
    except (FaultError, OSError) as error:
        print(f"inject_faults: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
