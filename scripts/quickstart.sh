#!/usr/bin/env bash
# Installs what is needed, builds, simulates config/scenarios/quickstart.yaml and draws an overview. What an earlier run
# has done already is kept, as long as the program and its data are the same. Says every ten seconds what it is at, into a pipe too.
set -euo pipefail
cd "$(dirname "$0")/.."

packages() { sed -n "s/^\($1\): //p" scripts/packages.txt; }

. scripts/said.sh

# shellcheck disable=SC2046
said "installing packages" scripts/install_packages.sh $(packages build) $(packages libraries) $(packages run)

# Of the program's commands the guides need more than the quickstart; what is there already stays whole.
if [ ! -e build/release/CMakeCache.txt ]; then
  said "configuring" cmake --preset release -DTERA_BUILD_TESTS=OFF -DTERA_BUILD_BENCH=OFF -DTERA_WHOLE_PROGRAM=OFF
fi
said "compiling" cmake --build --preset release --target tera

out=out/quickstart
made_from=$(cat build/release/tera $(git ls-files config shaders assets 2>/dev/null || find config shaders assets -type f | sort) |
  sha256sum)
if [ "$(cat $out.made_from 2>/dev/null)" != "$made_from" ]; then
  rm -rf $out $out.incomplete
  mkdir -p out
  echo "$made_from" >$out.made_from
fi
if [ ! -d $out ]; then
  echo "simulating config/scenarios/quickstart.yaml: some minutes without a GPU"
  build/release/tera generate config/scenarios/quickstart.yaml --out $out --resume
fi
[ -e $out/overview.mp4 ] || said "drawing the overview" build/release/tera overview $out

cat <<TXT

The dataset is in        $out   (docs/reference/dataset.md says what is what)
A picture of all of it:  $out/overview.png
The cameras as a film:   $out/overview.mp4
TXT
if grep -q '^TERA_WHOLE_PROGRAM:BOOL=OFF' build/release/CMakeCache.txt; then
  cat <<TXT

build/release/tera has the commands of the quickstart alone. The rest (campaign, diagnose, layout, register, resense, ros2, serve, site,
sweep):
  scripts/build.sh
TXT
fi
