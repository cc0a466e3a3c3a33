#!/usr/bin/env python3
"""Says in a few plain lines how a run of the tests went: scripts/summarise_tests.py FILE

FILE is what `ctest --output-junit FILE` writes. The failed tests are named, the skipped ones counted by their reason, and the last
line is always `N passed, N failed, N skipped`."""
import collections
import re
import sys
import xml.etree.ElementTree


def reason(test):
    """What a skipped test said, which GoogleTest prints below the line `FILE:LINE: Skipped`."""
    said = re.search(r": Skipped\n(.+)", test.findtext("system-out", ""))
    skipped = test.find("skipped")
    return said.group(1).strip() if said else skipped.get("message", "") if skipped is not None else ""


def main(file):
    tests = xml.etree.ElementTree.parse(file).getroot().findall("testcase")
    failed = [t for t in tests if t.get("status") == "fail"]
    skipped = [t for t in tests if t.get("status") not in ("run", "fail")]
    for test in failed:
        print(f"failed: {test.get('name')}")
    for why, count in collections.Counter(map(reason, skipped)).most_common():
        print(f"skipped {count}: {why or 'no reason was given'}")
    print(f"{len(tests) - len(failed) - len(skipped)} passed, {len(failed)} failed, {len(skipped)} skipped")


main(sys.argv[1])
