#!/usr/bin/env bash
# Installs what is needed, builds the program and its libraries, and makes Debian packages of them in build/package:
# tera-sim, the program with its data, tera-sim-dev, the libraries, and tera-prove. `apt install ./build/package/tera-sim_*.deb` installs the first.
set -euo pipefail
cd "$(dirname "$0")/.."

packages() { sed -n "s/^\($1\): //p" scripts/packages.txt; }
# shellcheck disable=SC2046
scripts/install_packages.sh $(packages build) $(packages libraries) $(packages serve) $(packages run) $(packages ros2) \
  $(packages survey) $(packages prove) $(packages package)

cmake --preset package >/dev/null
cmake --build --preset package
[ -e build/package/web/tera-view.html ] || {
  echo "package: the page of tera view was not built, see above; need it in the package" >&2
  exit 1
}
(cd build/package && cpack)
