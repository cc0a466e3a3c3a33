#!/usr/bin/env python3
"""Names functions of src/ and blind/ that no program calls, by what their object files ask the linker for; fails if there is one.

    scripts/uncalled_functions.py build/release     # after a build of tera and tera-prove

A function that only tests call is no part of the programs. A function that is inlined into all its callers asks for nothing: it counts as called
where the text of its object file names it once more. scripts/uncalled_functions.txt lists those that may stay, with the reason.
"""

import json
import os
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def output_of(*command: str, text: str = "") -> str:
    return subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout


def objects_of(build: Path) -> dict:
    """Object files of the programs, and the sources that each is made of."""
    objects = {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        source = Path(entry["file"])
        folder = source.relative_to(build if source.is_relative_to(build) else ROOT).parts[0]
        if folder not in ("src", "blind") or source.suffix not in (".cpp", ".cxx"):
            continue
        united = [Path(one) for one in re.findall(r'#include "([^"]+\.cpp)"', source.read_text(encoding="utf-8"))]
        if source.suffix == ".cpp" or united:  # else of generated sources, or headers that are precompiled
            objects[build / re.search(r" -o (\S+) ", entry["command"])[1]] = united or [source]
    return objects


def words_of(source: Path) -> Counter:
    text = re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', " ", source.read_text(encoding="utf-8"), flags=re.DOTALL)
    return Counter(re.findall(r"\w+", text))


def last_word(name: str) -> str:
    """The name Act of tera::Soil::Act(int) const. Operators and destructors, which are called without a word, have none."""
    head = name.replace("(anonymous namespace)::", "").split("(")[0]
    found = re.search(r"(\w+)(?:\[abi:\w+\])?$", head)
    return found[1] if found and "~" not in head and "operator" not in head else ""


def uncalled(objects: dict) -> list:
    """(source, name) of functions that no object file asks for."""
    asked, defined = set(), []
    for made, sources in objects.items():
        asked.update(re.findall(r" R_X86_64_\w+ +\w+ +(_Z\w+)", output_of("readelf", "-rW", str(made))))
        symbols = re.findall(r" T (_Z\w+)$", output_of("nm", "--defined-only", str(made)), flags=re.MULTILINE)
        defined.append((sources, dict(zip(symbols, output_of("c++filt", text="\n".join(symbols)).splitlines()))))
    faults = []
    for sources, names in defined:
        silent = set(names.values()) - {names[symbol] for symbol in names if symbol in asked}  # a constructor has several symbols
        words = {source: words_of(source) for source in sources} if silent else {}
        headers = sum((words_of(source.with_suffix(".h")) for source in words if source.with_suffix(".h").exists()), Counter())
        definitions = Counter(last_word(name) for name in set(names.values()))
        for name in silent:
            word = last_word(name)
            places = [source for source in sources if words[source][word]]
            if word and max(sum(words[source][word] for source in places), headers[word]) <= definitions[word]:
                faults.append((os.path.relpath((places or sources)[0], ROOT), name))
    return sorted(faults)


def main() -> int:
    lines = (ROOT / "scripts/uncalled_functions.txt").read_text(encoding="utf-8").splitlines()
    may_stay = {line for line in lines if line and not line.startswith("#")}
    faults = uncalled(objects_of(Path(sys.argv[1]).resolve()))
    for source, name in faults:
        if name not in may_stay:
            print(f"{source}: no program calls {name}; remove it with its tests, or say in scripts/uncalled_functions.txt why it stays")
    for name in sorted(may_stay - {name for _, name in faults}):
        print(f"scripts/uncalled_functions.txt: {name} is called, or is not there; remove its line")
    return 1 if {name for _, name in faults} != may_stay else 0


if __name__ == "__main__":
    sys.exit(main())
