#!/usr/bin/env python3
"""How the figures of docs/reference/soil.md change with the constants of soil and contact, each moved by 20 % either way.

    scripts/soil_sensitivity.py run RESULTS [--tree DIR]   # measures what RESULTS does not hold yet
    scripts/soil_sensitivity.py table RESULTS              # the table of docs/reference/soil-constants.md
    scripts/soil_sensitivity.py left                       # the table of what is left out, by rule
    scripts/soil_sensitivity.py rank RESULTS               # the most influential constants
    scripts/soil_sensitivity.py check                      # whether scripts/soil_constants.txt names every constant

scripts/soil_constants.txt says which constants there are. `run` makes a copy of the sources (build/sensitivity, or DIR, a
tree that may be spoilt) in which the environment may move a constant, builds bench/soil_figures there once, runs it with
each constant moved and appends what it prints to RESULTS, a CSV: twenty minutes on one core, after a build of ten.
JOBS says how many compilers and programs work side by side.
"""
import argparse
import collections
import concurrent.futures
import csv
import math
import os
import pathlib
import re
import shutil
import signal
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
CATALOGUE = "config/soils"
JOBS = int(os.environ.get("JOBS", os.cpu_count()))
LONGEST_S = 900  # of one run
SIGMAS, LEAST = 3, 0.01  # what changes by less is not told: scatter over seeds, share of the figure
SEEDS = {"tool": (1,), "track": (1,), "flow": (1, 2, 3), "dig": (1,)}  # a figure is the median with a constant moved
BASE_SEEDS = tuple(range(1, 9))  # and of the program as it is
UNRANKED = {"bank_fallen_m3", "track_free_slip_percent"}  # the one stands or falls, the other is next to nothing
# Groups of figures that a constant may act on, by its folder: a tool does nothing to a bare track.
GROUPS = {"src/sim": ("dig",), "src/physics": ("dig",), CATALOGUE: ("tool", "track", "flow", "dig"),
          "src/soil/tool": ("tool", "dig"), "src/soil/track": ("track", "dig"), "src/soil/flow": ("tool", "flow", "dig"),
          "src/soil/columns": ("tool", "track", "flow", "dig"), "src/soil/site": ()}  # of weather before, which none has

MOVED_BY = """#pragma once
#include <cstdlib>
#include <string>
namespace tera {
/// -1 or 1 where the environment says `NAME@FILE -1` (or 1) of this constant, else 0.
inline double MovedBy(const std::string& constant) {
  const char* moved = std::getenv("TERA_MOVED");
  if (moved == nullptr || std::string(moved).rfind(constant + ' ', 0) != 0) return 0;
  return std::atof(moved + constant.size());
}
}  // namespace tera
"""

Constant = collections.namedtuple("Constant", "file name pattern step unit origin")


def fail(message):
    sys.exit(f"soil_sensitivity: {message}")


def read_list():
    """Constants to measure, and by file the names that are left out."""
    constants, left_out, file = [], collections.defaultdict(dict), None
    for line in (ROOT / "scripts/soil_constants.txt").read_text().splitlines():
        if not line or line.startswith("#"):
            continue
        if line.startswith("["):
            file = line.strip("[]")
        elif line.startswith("not "):
            rule, names = line[4:].split(":")
            left_out[file].update(dict.fromkeys(names.split(), rule))
        else:
            head, unit, origin = line.rsplit(" | ", 2)
            name, _, pattern = head.partition(" := ")
            name, _, step = name.partition(" +- ")
            separator = r":\s+([\d.e+-]+)" if file.startswith(CATALOGUE) else " = ([^,;]+)[,;]"
            constants.append(Constant(file, name, pattern or rf"(?m)\b{name}{separator}", step, unit, origin))
    return constants, left_out


def files_of(constant, tree):
    return sorted((tree / CATALOGUE).glob("*.yaml")) if constant.file == CATALOGUE else [tree / constant.file]


def found(constant, tree):
    """Files and matches; of sources one, of the catalogue those that have the key."""
    matches = [(file, match) for file in files_of(constant, tree)
               for match in re.finditer(constant.pattern, file.read_text())]
    if not matches or (constant.file != CATALOGUE and len(matches) > 1):
        fail(f"{constant.file}: {len(matches)} places for '{constant.name}'; need one")
    return matches


def movable(constant, text):
    """C++ of a number that a run of the program may move."""
    ask = f'([] {{ static const double sign = ::tera::MovedBy("{constant.name}@{constant.file}"); return sign; }}())'
    return f"({text} + {ask} * ({constant.step}))" if constant.step else f"((1 + 0.2 * {ask}) * ({text}))"


def folder_of(constant):
    return next(folder for folder in GROUPS if constant.file.startswith(folder))


def make_movable(tree, constants):
    """Edits a copy of the sources, so that one build serves all constants."""
    (tree / "src/moved_by.h").write_text(MOVED_BY)
    for file in sorted({constant.file for constant in constants}):
        if file.startswith(CATALOGUE):
            continue
        text = (ROOT / file).read_text()
        for constant in (c for c in constants if c.file == file):
            at = re.search(constant.pattern, text)
            begin = max(text.rfind(mark, 0, at.start(1)) for mark in ";{}")
            before = text[begin:at.start(1)].replace("static constexpr", "static inline const").replace("constexpr", "const")
            text = text[:begin] + before + movable(constant, at[1]) + text[at.end(1):]
        text = '#include "moved_by.h"\n' + text
        if text != (tree / file).read_text():
            (tree / file).write_text(text)


def moved_in_catalogue(constant, text, sign):
    share = float(constant.step.strip("% ")) / 100 if constant.step else 0.2
    return f"{float(text) * (1 + share * sign):.6g}"


def check():
    constants, left_out = read_list()
    for constant in constants:
        found(constant, ROOT)
    listed = collections.defaultdict(set, {file: set(names) for file, names in left_out.items()})
    for constant in constants:
        listed[constant.file].add(constant.name)
    missing = []
    for source in sorted(ROOT.glob("src/soil/**/*.[hc]*")):
        file = str(source.relative_to(ROOT))
        named = set()
        for statement in re.findall(r"\bconstexpr [^;{(]+[;{]", source.read_text()):
            named.update(re.findall(r"\b(k[A-Z]\w*)\s*=", statement))
        missing += [f"{file}: {name}" for name in sorted(named - listed[file])]
    if missing:
        fail("scripts/soil_constants.txt does not name\n  " + "\n  ".join(missing))
    print(f"{len(constants)} constants to measure, {sum(map(len, left_out.values()))} left out")


def build(tree):
    for command in (["cmake", "--preset", "release", "-DTERA_BUILD_TESTS=OFF", "-DTERA_BUILD_BENCH=ON"],
                    ["cmake", "--build", "build/release", "--target", "soil_figures", "--parallel", str(JOBS)]):
        if command[1] == "--preset" and (tree / "build/release/build.ninja").exists():
            continue
        done = subprocess.run(command, cwd=tree, capture_output=True, text=True)
        if done.returncode:
            fail(f"{' '.join(command)}:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")


def figures(tree, group, seeds, moved=""):
    """The values of each figure of a group over the seeds."""

    def run(seed):
        command = [tree / "build/release/soil_figures", str(seed), group]
        done = subprocess.run(["timeout", str(LONGEST_S), *command], capture_output=True, text=True,
                              env={**os.environ, "TERA_DATA_DIR": str(tree), "TERA_MOVED": moved})
        return done.stdout if done.returncode == 0 else ""  # a soil that its reader refuses

    values = collections.defaultdict(list)
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        for text in pool.map(run, seeds):
            for line in text.splitlines():
                name, value = line.split()
                values[name].append(float(value))
    return values


def copy_tree(tree, edited):
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True).stdout
    for name in filter(None, names.decode().split("\0")):
        target = tree / name
        target.parent.mkdir(parents=True, exist_ok=True)
        same = target.exists() and (name in edited or target.read_bytes() == (ROOT / name).read_bytes())
        if not same:
            shutil.copyfile(ROOT / name, target)


def measure(constant, sign, group, tree):
    """The figures of a group with one constant moved; the catalogue is as before afterwards."""
    if not constant.file.startswith(CATALOGUE):
        return figures(tree, group, SEEDS[group], f"{constant.name}@{constant.file} {sign}")
    before = {file: file.read_text() for file, _ in found(constant, tree)}
    try:
        for file, text in before.items():
            at = re.search(constant.pattern, text)
            file.write_text(text[:at.start(1)] + moved_in_catalogue(constant, at[1], sign) + text[at.end(1):])
        return figures(tree, group, SEEDS[group])
    finally:
        for file, text in before.items():
            file.write_text(text)


def run(results, tree):
    """The quick groups first, so that a run that is cut short has something of all constants."""
    constants, _ = read_list()
    if tree is None:
        tree = ROOT / "build/sensitivity"
        copy_tree(tree, {c.file for c in constants if not c.file.startswith(CATALOGUE)})
    make_movable(tree, constants)
    build(tree)
    done = {tuple(row[:4]) for row in csv.reader(results.open())} if results.exists() else set()
    with results.open("a", newline="") as stream:
        writer = csv.writer(stream)

        def keep(key, values):
            for figure, each in values.items():
                writer.writerow([*key, figure, *each])
            stream.flush()
            print(*key, f"{len(values)} figures", flush=True)

        for group in GROUPS[CATALOGUE]:
            if ("-", "-", "0", group) not in done:
                keep(("-", "-", "0", group), figures(tree, group, BASE_SEEDS[:1] if group == "track" else BASE_SEEDS))
            touching = [c for c in constants if group in GROUPS[folder_of(c)]]
            for constant in sorted(touching, key=lambda c: list(GROUPS).index(folder_of(c))):
                for sign in (-1, 1):
                    key = (constant.file, constant.name, str(sign), group)
                    if key not in done:
                        keep(key, measure(constant, sign, group, tree))


def read_results(results):
    """By figure its median and how it scatters over seeds; by constant and figure the values at less and at more."""
    base, scatter, after = {}, {}, collections.defaultdict(lambda: collections.defaultdict(dict))
    with results.open() as stream:
        for file, name, sign, _, figure, *values in csv.reader(stream):
            values = [float(value) for value in values]
            if file == "-":
                base[figure] = statistics.median(values)
                scatter[figure] = statistics.stdev(values) if len(values) > 1 else 0.0
            else:
                after[file, name][figure][int(sign)] = values
    return base, scatter, after


def changes(results):
    """By constant and figure the changes at less and at more that stand out from the scatter, as shares."""
    base, scatter, after = read_results(results)
    told = collections.defaultdict(dict)
    for key, by_figure in after.items():
        for figure, values in by_figure.items():
            share = {sign: statistics.median(each) / base[figure] - 1 for sign, each in values.items()}
            fewest = min(map(len, values.values()))
            noise = scatter[figure] / base[figure] * math.sqrt(1 / fewest + 1 / len(BASE_SEEDS))
            if max(map(abs, share.values())) > max(LEAST, SIGMAS * noise):
                told[key][figure] = share
    return told


def label(figure):
    return re.sub(r"_(n|m|mm|kpa|l|kg|deg|m3|nm|percent)$", "", figure).replace("_", " ")


def signed(share):
    if share is None:
        return "–"  # no such soil
    return f"{100 * share:+.0f}".replace("-", "−") if abs(share) > 0.005 else "0"


def shown(by_figure, missing=()):
    largest_first = sorted(by_figure.items(), key=lambda item: -max(map(abs, item[1].values())))
    parts = [f"{label(figure)} {signed(share.get(-1))}, {signed(share.get(1))}" for figure, share in largest_first]
    return "; ".join((parts or ["none"]) + [f"{group} not tried" for group in missing])


def value_of(constant):
    """The number as a reader would write it, with its unit."""
    values = [match[1] for _, match in found(constant, ROOT)]
    if constant.file.startswith(CATALOGUE):
        numbers = sorted(map(float, values))
        value = " to ".join(f"{number:g}" for number in sorted({numbers[0], numbers[-1]}))
    elif "(" in values[0]:
        value = "1"  # a factor that does not stand there
    else:
        value = values[0].replace(" * kStandardGravity_mps2", " * 9.81")
    if "* kDeg" in value:
        return value.replace(" * kDeg", " deg")
    return value if constant.unit == "-" else f"{value} {constant.unit}"


def tried(results):
    """By constant the groups of figures that RESULTS has."""
    groups = collections.defaultdict(set)
    with results.open() as stream:
        for file, name, _, group, *_ in csv.reader(stream):
            groups[file, name].add(group)
    return groups


def table(results):
    told, groups = changes(results), tried(results)
    constants, _ = read_list()
    print("| constant | value | from | change in %, at less and at more |\n| --- | --- | --- | --- |")
    heading = None
    for constant in constants:
        if constant.file != heading:
            heading = constant.file
            print(f"| **{heading}** | | | |")
        name = f"`{constant.name}`" if " " not in constant.name else f"literal: {constant.name}"
        step = f" (± {constant.step})".replace(" * kDeg", " deg") if constant.step else ""
        key = (constant.file, constant.name)
        missing = [group for group in GROUPS[folder_of(constant)] if group not in groups[key]]
        print(f"| {name}{step} | {value_of(constant)} | {constant.origin} | {shown(told[key], missing)} |")


def left():
    _, left_out = read_list()
    by_rule = collections.defaultdict(list)
    for file, names in left_out.items():
        of_rule = collections.defaultdict(list)
        for name, rule in names.items():
            of_rule[rule].append(f"`{name}`")
        for rule, some in of_rule.items():
            by_rule[rule].append(f"{pathlib.Path(file).name}: {', '.join(some)}")
    print("| rule | constants |\n| --- | --- |")
    for rule in sorted(by_rule):
        print(f"| {rule} | {'; '.join(by_rule[rule])} |")


def rank(results):
    base, scatter, _ = read_results(results)
    for figure, value in base.items():
        print(f"{figure} {value:.4g}, scatter {100 * scatter[figure] / value:.1f} %")
    told = changes(results)
    ranked = len(base.keys() - UNRANKED)
    total = {key: math.sqrt(sum(max(map(abs, share.values())) ** 2 for figure, share in by.items() if figure not in UNRANKED)
                            / ranked) for key, by in told.items()}
    for key in sorted(total, key=total.get, reverse=True)[:20]:
        print(f"{100 * total[key]:5.1f} % {key[0]} {key[1]}: {shown(told[key])}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("run", "table", "left", "rank", "check"))
    parser.add_argument("results", nargs="?", type=pathlib.Path)
    parser.add_argument("--tree", type=pathlib.Path, help="a copy of the sources that may be spoilt")
    arguments = parser.parse_args()
    if arguments.what in ("check", "left"):
        return {"check": check, "left": left}[arguments.what]()
    if arguments.results is None:
        parser.error("RESULTS is missing")
    if arguments.what == "run":
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # not without putting the tree back
        return run(arguments.results, arguments.tree and arguments.tree.resolve())
    return {"table": table, "rank": rank}[arguments.what](arguments.results)


if __name__ == "__main__":
    main()
