#!/usr/bin/env bash
# Slope of a heap's flanks in eight directions from its top, in degrees: lines fitted between 20 and 80 % of its height.
#
#   scripts/flank_angles.sh RASTER LEVEL_M X Y      # height raster of a dataset, level of the ground, top of the heap in W
set -euo pipefail
raster=$1 level=$2 x=$3 y=$4
for azimuth in 0 45 90 135 180 225 270 315; do
  awk -v x="$x" -v y="$y" -v azimuth="$azimuth" 'BEGIN {
    for (k = 0; k < 120; ++k) print x + 0.025 * k * cos(azimuth * atan2(0, -1) / 180), y + 0.025 * k * sin(azimuth * atan2(0, -1) / 180) }' |
    gdallocationinfo -valonly -geoloc "$raster" | awk -v level="$level" -v azimuth="$azimuth" '
      {z = $1 - level; r = 0.025 * NR; if (NR == 1) top = z}
      z < 0.2 * top {exit}
      z < 0.8 * top {++n; sr += r; sz += z; srr += r * r; srz += r * z}
      END {printf "azimuth %3d: %.1f\n", azimuth, -atan2(srz - sr * sz / n, srr - sr * sr / n) * 180 / atan2(0, -1)}'
done
