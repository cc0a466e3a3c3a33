#!/usr/bin/env bash
# Two pits of config/scenarios/walls.yaml in clay and in sand: what the camera sees at the end, and sections through both pits.
#
#   scripts/plot_walls.sh OUT.png CLAY SAND      # datasets of the scenario. Needs gdal-bin and gnuplot.
set -euo pipefail
out=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
level=460 # of the ground, height_m of the scenario

n=0
for dataset in "$2" "$3"; do
  n=$((n + 1))
  cp "$(find "$dataset/mast1/camera_site/rgb" -name '*.png' | sort -V | tail -1)" "$work/seen$n.png"
  seq -6 0.025 6 | awk '{print $1, 0}' >"$work/at"
  gdallocationinfo -valonly -geoloc "$dataset/truth/terrain/height_end.tif" <"$work/at" |
    paste -d' ' <(seq -6 0.025 6) - | awk -v level="$level" '{print $1, $2 - level}' >"$work/section$n"
done

gnuplot <<GNUPLOT
set terminal pngcairo size 1500,640 font 'sans,11' background rgb 'white'
set output '$out'
set multiplot
do for [n=1:2] {
  name = n == 1 ? 'clay' : 'sand'
  left = 0.5 * (n - 1)
  unset key; unset grid; unset border; unset tics; unset xlabel; unset ylabel; unset arrow; unset label
  set lmargin 1; set rmargin 1; set tmargin 2; set bmargin 0.5
  set size ratio -1
  set size 0.5,0.6
  set origin left,0.4
  set title sprintf('%s: pits dug upright, 1.0 m (left) and 1.4 m deep, 8 s later', name) offset 0,-0.5
  set autoscale xy
  plot sprintf('$work/seen%d.png', n) binary filetype=png with rgbimage
  set border; set tics out nomirror; set grid lc rgb '#d0d0d0' lw 0.5
  set lmargin 7; set rmargin 2; set tmargin 1.5; set bmargin 3
  set size noratio
  set size 0.5,0.4
  set origin left,0
  set title 'section through both at y = 0' offset 0,-0.6
  set xlabel 'x, m' offset 0,0.5
  set ylabel 'm'
  set xrange [-6:6]
  set yrange [-1.6:0.9]
  set samples 2401
  set ytics 0.4
  set key top center horizontal samplen 2
  set size ratio -1
  f(x) = abs(abs(x) - 2.7) > 1.2 ? 0 : (x < 0 ? -1 : -1.4)
  plot sprintf('$work/section%d', n) using 1:2:(-1.6) with filledcurves fc rgb '#e9dcc6' notitle, \
    f(x) with lines lc rgb '#606060' dt 3 title 'as dug', \
    n == 1 ? -1.19 : NaN lc rgb '#b4301f' dt 2 title (n == 1 ? 'clay stands 1.19 m upright' : ''), \
    sprintf('$work/section%d', n) with lines lw 2 lc rgb '#7a3b12' title 'at the end'
}
unset multiplot
GNUPLOT
