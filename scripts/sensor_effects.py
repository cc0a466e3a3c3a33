#!/usr/bin/env python3
"""What each mechanism did to its sensor, in a dataset of examples/effects/sensor_rig.yaml.

    tera generate config/scenarios/quickstart.yaml --duration 3 --out out/effects \\
      --set machines[0].rig=examples/effects/sensor_rig.yaml --effects examples/effects/sensor_effects.yaml
    scripts/sensor_effects.py out/effects/excavator1

Prints for each sensor the largest change of its time stamps and, row by row, of the column that changed most; of cameras and
lidars how many of their files differ from those of the sensor that is as documented.
"""
import csv
import pathlib
import sys

FOLDERS = ("depth", "scans")


def rows(folder):
    with open(folder / "data.csv", newline="") as file:
        table = list(csv.reader(file))
    return table[0], table[1:]


def largest_change(ideal, other):
    """Column and largest difference over all rows, the one that is largest beside its own spread first."""
    columns, a = rows(ideal)
    _, b = rows(other)
    best = ("-", 0.0, 0.0)
    for i, name in enumerate(columns):
        if i == 0 or name.startswith("var_") or name == "filename":
            continue
        x = [float(row[i]) for row in a]
        change = max(abs(float(q[i]) - p) for p, q in zip(x, b))
        share = change / (max(x) - min(x) + 1e-12)
        if change > 0 and share > best[2]:
            best = (name, change, share)
    return best[:2]


def main(machine):
    print(f"{'sensor':<32}{'rows':>6}{'stamp s':>11}  change")
    for ideal in sorted(machine.glob("*_ideal")):
        kind = ideal.name.removesuffix("_ideal")
        for other in sorted(machine.glob(kind + "_*")):
            if other == ideal:
                continue
            (_, a), (_, b) = rows(ideal), rows(other)
            stamp = max((int(q[0]) - int(p[0]) for p, q in zip(a, b)), key=abs) * 1e-9
            if kind in ("camera", "lidar"):
                names = [(p[1], q[1]) for p, q in zip(a, b)]
                folder = next(f for f in FOLDERS if (ideal / f).is_dir())
                differ = sum((ideal / folder / p).read_bytes() != (other / folder / q).read_bytes() for p, q in names)
                text = f"{differ} of {len(names)} files in {folder}/"
            else:
                column, change = largest_change(ideal, other)
                text = f"{column} {change:.4g}" if change else "-"
            print(f"{other.name:<32}{len(b):>6}{stamp:>11.6f}  {text}")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
