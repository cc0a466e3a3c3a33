#!/usr/bin/env bash
# Installs what is needed and builds the whole program, build/release/tera, without tests and benchmarks.
set -euo pipefail
cd "$(dirname "$0")/.."

packages() { sed -n "s/^\($1\): //p" scripts/packages.txt; }
# shellcheck disable=SC2046
scripts/install_packages.sh $(packages build) $(packages libraries) $(packages serve) $(packages run) $(packages ros2) $(packages survey)

cmake --preset release -DTERA_BUILD_TESTS=OFF -DTERA_BUILD_BENCH=OFF >/dev/null
cmake --build --preset release --target tera
