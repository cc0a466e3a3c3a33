#!/usr/bin/env bash
# Installs what is needed, builds, simulates config/scenarios/quickstart.yaml and draws an overview.
set -euo pipefail
cd "$(dirname "$0")/.."

packages() { sed -n "s/^\($1\): //p" scripts/packages.txt; }
# shellcheck disable=SC2046
scripts/install_packages.sh $(packages build) $(packages libraries) $(packages run)

cmake --preset release -DTERA_BUILD_TESTS=OFF -DTERA_BUILD_BENCH=OFF >/dev/null
cmake --build --preset release --target tera

out=out/quickstart
rm -rf "$out" "$out.incomplete"
build/release/tera generate config/scenarios/quickstart.yaml --out "$out"
build/release/tera overview "$out"

cat <<TXT

The dataset is in        $out   (docs/dataset.md says what is what)
A picture of all of it:  $out/overview.png
The cameras as a film:   $out/overview.mp4
TXT
