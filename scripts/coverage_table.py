#!/usr/bin/env python3
"""Coverage of lines by module and room, a table: scripts/coverage_table.py FILE

FILE is what `gcovr --csv FILE` writes, a row for each source."""
import collections
import csv
import sys


def main(file):
    lines = collections.defaultdict(lambda: [0, 0])
    with open(file, newline="") as rows:
        for row in csv.DictReader(rows):
            folder = row["filename"].split("/")[:-1]
            module = 2 if folder[0] == "src" else 1  # src/soil, blind
            for place in {"all", "/".join(folder[:module]), "/".join(folder[: module + 1])}:
                lines[place][0] += int(row["line_covered"])
                lines[place][1] += int(row["line_total"])
    print(f"{'folder':<32} {'run':>7} {'lines':>7} {'share':>7}")
    for place, (run, total) in sorted(lines.items()):
        print(f"{place:<32} {run:>7} {total:>7} {100 * run / max(total, 1):>6.1f}%")


main(sys.argv[1])
