#!/usr/bin/env bash
# Installs what is needed, builds everything and runs every test. Arguments go to ctest (-L unit, -R name).
set -euo pipefail
cd "$(dirname "$0")/.."

packages() { sed -n "s/^\($1\): //p" scripts/packages.txt; }
# shellcheck disable=SC2046
scripts/install_packages.sh $(packages build) $(packages libraries) $(packages serve) $(packages run) $(packages test) \
  $(packages ros2) $(packages test-ros2)

cmake --preset release -DTERA_BUILD_TESTS=ON -DTERA_BUILD_BENCH=ON >/dev/null
cmake --build --preset release
ctest --test-dir build/release --output-on-failure --parallel "$(nproc)" "$@"
