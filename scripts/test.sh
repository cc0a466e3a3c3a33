#!/usr/bin/env bash
# Installs what is needed, builds everything and runs every test; the last lines say how many passed, failed and were skipped, and why.
# Arguments go to ctest (-L unit, -R name). With TERA_WERROR=ON in the environment a compiler's warning is an error.
set -euo pipefail
cd "$(dirname "$0")/.."

packages() { sed -n "s/^\($1\): //p" scripts/packages.txt; }
# shellcheck disable=SC2046
scripts/install_packages.sh $(packages build) $(packages libraries) $(packages serve) $(packages run) $(packages test) \
  $(packages ros2) $(packages survey) $(packages prove) $(packages test-ros2)

cmake --preset release -DTERA_BUILD_TESTS=ON -DTERA_BUILD_BENCH=ON -DTERA_WERROR="${TERA_WERROR:-OFF}" >/dev/null
cmake --build --preset release
results=$PWD/build/release/tests.xml
rm -f "$results"
status=0
ctest --test-dir build/release --output-on-failure --parallel "$(nproc)" --output-junit "$results" "$@" || status=$?
if [ -e "$results" ]; then scripts/summarise_tests.py "$results"; fi
exit "$status"
