"""Every page of the project leads its reader to what is there: links and their anchors, files, and constants of the sources."""

import functools
import re
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LINK = re.compile(r"\]\(([^)\s]+)\)")
PATH = re.compile(r"(?:^|[^\w/.\-])((?:src|test|blind|scripts|config|docs|shaders|assets|examples|cmake|proto|bench|web|python)/[\w./\-]*\w)(?!\w|\*[.\w])")
CONSTANT = re.compile(r"\bk[A-Z]\w*")
WRITTEN_BY_THE_READER = {"config/scenarios/replay.yaml"}
THRESHOLDS = "docs/reference/diagnose-thresholds.md"


@functools.cache
def tracked() -> list:
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False).stdout.split()
    if listed:
        return [name for name in listed if (ROOT / name).exists()]
    skipped = ("build", "out", ".git", "node_modules")  # without git: an archive
    return sorted(str(f.relative_to(ROOT)) for f in ROOT.rglob("*") if f.is_file() and f.relative_to(ROOT).parts[0] not in skipped)


@functools.cache
def text_of(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def pages() -> list:
    return [name for name in tracked() if name.endswith(".md")]


def prose(page: str) -> str:
    """A page without its blocks of code."""
    return re.sub(r"^```.*?^```", "", page, flags=re.DOTALL | re.MULTILINE)


def anchors(page: str) -> set:
    """The anchors of the headings, as GitHub makes them."""
    found, count = set(), {}
    for heading in re.findall(r"^#{1,6} +(.+)$", prose(page), flags=re.MULTILINE):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        anchor = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        count[anchor] = count.get(anchor, 0) + 1
        found.add(anchor if count[anchor] == 1 else f"{anchor}-{count[anchor] - 1}")
    return found


def broken_links(name: str, page: str) -> list:
    broken = []
    for link in LINK.findall(re.sub(r"`[^`\n]*`", "", prose(page))):
        if re.match(r"[a-z]+:", link):
            continue
        file, _, anchor = link.partition("#")
        target = (ROOT / name).parent / file
        if file and not target.exists():
            broken.append(f"{name}: {link} leads nowhere")
        elif anchor and anchor not in anchors(page if not file else target.read_text(encoding="utf-8")):
            broken.append(f"{name}: {link} names no heading there")
    return broken


def absent_files(name: str, page: str) -> list:
    """Paths from the project's root; with a word in capitals they are patterns. A source may go without its ending."""
    paths = {path for path in PATH.findall(page) if not re.search("[A-Z]{4}", path)} - WRITTEN_BY_THE_READER
    places = (ROOT, (ROOT / name).parent)
    return [f"{name} names {path}" for path in sorted(paths)
            if not any(Path(f"{place / path}{ending}").exists() for place in places for ending in ("", ".h", ".cpp"))]


@functools.cache
def identifiers(*names: str) -> set:
    return {word for name in names for word in re.findall(r"\b[A-Za-z_]\w*", text_of(name))}


@functools.cache
def sources() -> tuple:
    return tuple(n for n in tracked() if n.endswith((".h", ".cpp", ".frag", ".vert", ".comp", ".glsl", ".py", ".js", ".mjs")) and n != "test/docs/pages_test.py")


def absent_constants(name: str, page: str) -> list:
    code = " ".join(re.findall(r"`[^`\n]+`", page))
    return [f"{name}: {constant} is in no source" for constant in sorted(set(CONSTANT.findall(code)) - identifiers(*sources()))]


def threshold_faults(page: str, of_source=sources) -> list:
    """Names of the table's first column that are in none of the files which follow them there, or in the folder of their group."""
    candidates = [n for n in of_source() if n.startswith("src/") and not n.endswith(".py")]
    group, faults = (), []
    for row in re.findall(r"^\| ([^|]+) \|", page, flags=re.MULTILINE):
        if row.startswith("**"):
            folders = [folder.strip("/") for folder in re.findall(r"`([\w/]+)`", row)]
            group = tuple(n for n in candidates for f in folders if n.startswith((f"src/diagnose/{f}/", f"src/diagnose/{f}.", f"src/{f}/", f"{f}/")))
            continue
        names, files = [], ()
        for part in [*filter(None, re.split(r"(`[^`]+`)|[\s,;:]+", row)), "`end`"]:
            if part.startswith("`"):
                if files:  # of what stood before
                    faults += [f"{name} is not in {files[0]}" for name in names if name not in identifiers(*files)]
                    names, files = [], ()
                names += re.findall(r"[A-Za-z_]\w*", part)
            else:
                files += tuple(n for n in candidates if n.rsplit(".", 1)[0].endswith(f"/{re.sub(r'[.](h|cpp)$', '', part)}"))
        faults += [f"{name} is in no file of its group" for name in names[:-1] if name not in identifiers(*group)]
    return faults


class PagesTest(unittest.TestCase):
    def test_links_lead_to_files_and_headings(self):
        self.assertGreater(sum(len(LINK.findall(text_of(page))) for page in pages()), 300)
        self.assertEqual([fault for page in pages() for fault in broken_links(page, text_of(page))], [])
        page = "# The `first` of two\n[a](b.md) [b](#the-first-of-two) [c](#second) [d](../README.md#commands) [e](../README.md#none)\n"
        self.assertEqual(broken_links("docs/page.md", page), ["docs/page.md: b.md leads nowhere", "docs/page.md: #second names no heading there",
                                                              "docs/page.md: ../README.md#none names no heading there"])

    def test_files_that_are_named_are_there(self):
        self.assertEqual([fault for page in pages() for fault in absent_files(page, text_of(page))], [])
        page = "(src/soil/soil.h), src/soil/track/tread, config/soils/NAME.yaml, build/release/test/sim/sim_test, src/soil/nothing.h"
        self.assertEqual(absent_files("README.md", page), ["README.md names src/soil/nothing.h"])

    def test_constants_that_are_named_are_in_the_sources(self):
        self.assertEqual([fault for page in pages() for fault in absent_constants(page, text_of(page))], [])
        self.assertEqual(absent_constants("page.md", "`kExportFormats`, `kNobodyHasThis`"), ["page.md: kNobodyHasThis is in no source"])

    def test_thresholds_of_the_diagnosis_are_where_their_table_says(self):
        self.assertEqual(threshold_faults(text_of(THRESHOLDS)), [])
        table = "| **A** (`search/block/`) | |\n| `kFewestSeen`, testable; literal, `alpha`, judge_groups.h |\n| `kFewestSeen`, judge_groups |\n" \
                "| `kFewestFinal` | 3 |\n| `kRivalOdds` | 3 |\n"
        self.assertEqual(threshold_faults(table), ["kFewestSeen is not in src/diagnose/sensors/judge_groups.cpp", "kRivalOdds is in no file of its group"])


if __name__ == "__main__":
    unittest.main()
