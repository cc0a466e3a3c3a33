#!/usr/bin/env bash
# The deviation of a ground from its design as a map, and its mean and extremes along the map's longer side.
#
#   scripts/plot_deviation.sh OUT.png DATASET [TOLERANCE_M]
#
# DATASET: a recording of a scenario with a task. Needs gdal-bin and gnuplot.
set -euo pipefail
out=$1 raster=$2/truth/terrain/deviation_end.tif tolerance=${3:-0.05}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

gdal_translate -q -of XYZ "$raster" "$work/all.xyz"
awk '$3 == $3 && tolower($3) !~ /nan/' "$work/all.xyz" >"$work/map.xyz"
read -r x0 x1 y0 y1 <<<"$(awk 'NR == 1 {a = b = $1; c = d = $2} {if ($1 < a) a = $1; if ($1 > b) b = $1; if ($2 < c) c = $2; if ($2 > d) d = $2}
  END {print a, b, c, d}' "$work/map.xyz")"
along=$(awk -v w="$x0 $x1 $y0 $y1" 'BEGIN {split(w, v, " "); print (v[2] - v[1] >= v[4] - v[3]) ? 1 : 2}')
sort -g -k"$along,$along" "$work/map.xyz" | awk -v k="$along" '
  function show() {if (n) print at, sum / n, low, high}
  $k != at {show(); at = $k; n = sum = 0; low = high = $3}
  {++n; sum += $3; if ($3 < low) low = $3; if ($3 > high) high = $3}
  END {show()}' >"$work/profile"

gnuplot <<GP
set terminal pngcairo size 1100,620 font "sans,11"
set output "$out"
set multiplot layout 2,1
set size ratio -1
set lmargin at screen 0.08; set rmargin at screen 0.84
set palette defined (-3 "#2166ac", -1 "#d1e5f0", 0 "#f7f7f7", 1 "#fddbc7", 3 "#b2182b")
set cbrange [-3 * $tolerance : 3 * $tolerance]
set cblabel "ground minus design, m" offset 1,0
set xlabel "x, m"; set ylabel "y, m"
set xrange [$x0 : $x1]; set yrange [$y0 : $y1]
plot "$work/map.xyz" using 1:2:3 with image notitle
set size noratio
set ylabel "ground minus design, m"
set xlabel "along the longer side, m"
set autoscale x; set autoscale y; set yrange [-4 * $tolerance : 4 * $tolerance]
set grid
plot "$work/profile" using 1:3:4 with filledcurves fillcolor "#d0d0d0" title "lowest to highest", \
     "" using 1:2 with lines linecolor "#202020" linewidth 2 title "mean", \
     $tolerance with lines linecolor "#b2182b" dashtype 2 title "tolerance", -$tolerance with lines linecolor "#b2182b" dashtype 2 notitle
unset multiplot
GP
