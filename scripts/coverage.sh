#!/usr/bin/env bash
# Runs the tests with gcov's counters and prints how many lines of each module they run. Arguments go to ctest; without any, the tests
# that need no minutes run (unit, program, gl).
set -euo pipefail
cd "$(dirname "$0")/.."

packages() { sed -n "s/^\($1\): //p" scripts/packages.txt; }
# shellcheck disable=SC2046
scripts/install_packages.sh $(packages build) $(packages libraries) $(packages serve) $(packages run) $(packages test) \
  $(packages ros2) $(packages survey) $(packages prove) $(packages test-ros2) $(packages coverage)

[ $# -gt 0 ] || set -- -L 'unit|program|gl'
cmake --preset coverage >/dev/null
cmake --build --preset coverage
find build/coverage -name '*.gcda' -delete
# A failed test is not this script's matter, but lowers what is counted: say so.
ctest --test-dir build/coverage --parallel "$(nproc)" --timeout 1800 "$@" >build/coverage/tests.txt ||
  echo "some tests failed: build/coverage/tests.txt"
gcovr --root . --filter 'src/' --filter 'blind/' --csv build/coverage/files.csv -j "$(nproc)" build/coverage
scripts/coverage_table.py build/coverage/files.csv
