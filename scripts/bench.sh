#!/usr/bin/env bash
# Installs what is needed, builds the benchmarks and runs them: each figure beside its target. Fails if one is not met. Arguments
# go to Google Benchmark (--benchmark_filter=Lidar). docs/evidence/speed.md has the figures.
set -euo pipefail
cd "$(dirname "$0")/.."

packages() { sed -n "s/^\($1\): //p" scripts/packages.txt; }
# shellcheck disable=SC2046
scripts/install_packages.sh $(packages build) $(packages libraries) $(packages prove) $(packages run) $(packages test)

cmake --preset release -DTERA_BUILD_TESTS=OFF -DTERA_BUILD_BENCH=ON >/dev/null
cmake --build --preset release --target tera_bench
exec build/release/tera_bench "$@"
