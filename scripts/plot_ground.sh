#!/usr/bin/env bash
# A ground as a shaded map with its heights, what a camera sees of it, and sections through it with the slopes that the soil
# should have.
#
#   scripts/plot_ground.sh [--seen PNG] OUT.png RASTER LEVEL_M 'X0 X1 Y0 Y1' 'X0 Y0 X1 Y1[ DEG...]' ...
#
# PNG: a picture of a camera. RASTER: a height raster of a dataset; heights are shown over LEVEL_M, that of the undisturbed ground. Then the window in m of
# W, then up to three straight sections, each with angles in degrees that are drawn
# through the middle of its first (rising) and last (falling, negative) slope. Needs gdal-bin and gnuplot.
set -euo pipefail
seen=
if [ "$1" = --seen ]; then seen=$2; shift 2; fi
out=$1 raster=$2 level=$3
read -r x0 x1 y0 y1 <<<"$4"
shift 4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The picture's pixels, a quarter of the raster's, so that the shade is of a surface and not of steps.
pixel=$(gdalinfo "$raster" | sed -n 's/^Pixel Size = (\([0-9.]*\),.*/\1/p')
fine=$(awk -v p="$pixel" 'BEGIN {print p / 4}')
gdalwarp -q -r cubic -tr "$fine" "$fine" -te "$x0" "$y0" "$x1" "$y1" "$raster" "$work/fine.tif"
gdaldem hillshade -q -alt 40 -multidirectional -compute_edges "$work/fine.tif" "$work/shade.tif"
gdal_translate -q -of XYZ "$work/fine.tif" "$work/fine.xyz"
gdal_translate -q -of XYZ "$work/shade.tif" "$work/shade.xyz"

# What level ground looks like: the commonest shade.
flat=$(cut -d' ' -f3 "$work/shade.xyz" | sort -n | uniq -c | sort -rn | awk '$2 > 0 {print $2; exit}')

n=0
arrows=""
for section in "$@"; do
  read -r ax ay bx by angles <<<"$section"
  n=$((n + 1))
  letter=$(printf "\\$(printf '%03o' $((64 + n)))")
  awk -v ax="$ax" -v ay="$ay" -v bx="$bx" -v by="$by" -v p="$pixel" 'BEGIN {
    l = sqrt((bx - ax)^2 + (by - ay)^2); m = int(2 * l / p)
    for (k = 0; k <= m; ++k) print ax + (bx - ax) * k / m, ay + (by - ay) * k / m, l * k / m }' >"$work/at$n"
  cut -d' ' -f1,2 "$work/at$n" | gdallocationinfo -valonly -geoloc "$raster" >"$work/z$n"
  cut -d' ' -f3 "$work/at$n" | paste -d' ' - "$work/z$n" >"$work/section$n"
  arrows+="set arrow from $ax,$ay to $bx,$by nohead lw 1.2 dt 2 lc rgb '#202020' front
set label '$letter' at $ax,$ay center offset 0,0.6 front font ',13'
set label \"$letter'\" at $bx,$by center offset 0,0.6 front font ',13'
"
  echo "$angles" >"$work/angles$n"
  # Where it is half-way up, first and last: the slopes are drawn through these.
  awk '{z[NR] = $2; x[NR] = $1; if (NR == 1 || $2 > hi) hi = $2; if (NR == 1 || $2 < lo) lo = $2}
    END {m = (hi + lo) / 2
      for (k = 1; k < NR; ++k) if ((z[k] < m) != (z[k + 1] < m)) {if (!a) a = x[k]; b = x[k]}
      print a, b, m}' "$work/section$n" >"$work/middle$n"
done
rows=$n
share=1 # of the right half's height, for the sections
[ -z "$seen" ] || share=$([ "$n" -lt 3 ] && echo 0.55 || echo 0.65)
width=1500 height=900

{
  cat <<GNUPLOT
set terminal pngcairo size $width,$height font 'sans,11' background rgb 'white'
set output '$out'
set multiplot
stats '$work/fine.xyz' using (\$3-$level) nooutput name 'H'
set size 0.5,1
set origin 0,0
set title 'height over the undisturbed ground'
set size ratio -1
set xrange [$x0:$x1]
set yrange [$y0:$y1]
set xlabel 'x, m'
set ylabel 'y, m'
set tics out nomirror
set grid front lc rgb '#60808080' lw 0.5
set cblabel 'm' offset 0,0
set palette defined (-1 '#123a6b', -0.5 '#4f8fbf', 0 '#efe6cf', 0.5 '#c08a4e', 1 '#7a3f18')
top = (abs(H_min) > abs(H_max) ? abs(H_min) : abs(H_max))
top = ceil(top * 10) / 10.0
if (H_min < -0.1) { set cbrange [-top:top] } else {
  set palette defined (0 '#efe6cf', 0.5 '#c08a4e', 1 '#7a3f18'); set cbrange [0:top] }
level = $flat  # the shade of level ground
$arrows
bar = 1.0
set object 1 rect from $x0+0.15,$y0+0.15 to $x0+0.15+bar,$y0+0.21 fc rgb 'black' front
set label '1 m' at $x0+0.15+bar/2,$y0+0.34 center front
plot '$work/fine.xyz' using 1:2:(\$3-$level) with image notitle, \
  '$work/shade.xyz' using 1:2:(0):(0):(0):(\$3 > 0 ? (\$3 < level ? 0.9 * (level - \$3) : 0) : 0) with rgbalpha notitle, \
  '$work/shade.xyz' using 1:2:(255):(255):(255):(\$3 > level ? 0.8 * (\$3 - level) : 0) with rgbalpha notitle
unset arrow
unset label
unset object
unset grid
set grid lc rgb '#d0d0d0' lw 0.5
set key top right inside horizontal samplen 2 opaque
set ylabel 'm'
unset colorbox
GNUPLOT
  if [ -n "$seen" ]; then
    cat <<GNUPLOT
unset key; unset border; unset tics; unset xlabel; unset ylabel; unset title
set autoscale xy
set lmargin 1; set rmargin 1; set tmargin 0.5; set bmargin 0.5
set size ratio -1
set size 0.5,1-$share
set origin 0.5,$share
plot '$seen' binary filetype=png with rgbimage
set border; set xtics out nomirror; set ytics out nomirror; set ylabel 'm'
set key top right inside horizontal samplen 2 opaque
GNUPLOT
  fi
  for k in $(seq "$n"); do
    letter=$(printf "\\$(printf '%03o' $((64 + k)))")
    angles=$(cat "$work/angles$k")
    read -r first last middle <"$work/middle$k"
    cat <<GNUPLOT
# As large as the section's box lets it be, upwards and along alike.
set size noratio
set title "$letter to $letter'" left offset 0,-0.8
set xlabel 'm along the section' offset 0,0.5
set autoscale xy
stats '$work/section$k' using 1:(\$2-$level) nooutput name 'S'
high = S_max_y - S_min_y + 0.4
box_px = $share * $height / $rows - 75
scale = (660 / S_max_x < box_px / high) ? 660 / S_max_x : box_px / high
low_px = $share * $height * ($rows - $k) / $rows + 50
set lmargin at screen 0.54
set rmargin at screen 0.54 + scale * S_max_x / $width
set bmargin at screen low_px / $height
set tmargin at screen (low_px + scale * high) / $height
set xrange [0:S_max_x]
set yrange [S_min_y-0.1:S_max_y+0.3]
set key $([ "$k" = 1 ] || [ -n "$angles" ] && echo on || echo off)
if (scale * S_max_x < 450) {
  set key at screen 0.98, screen (low_px + scale * high) / $height top right vertical noopaque
} else { set key top right inside horizontal opaque }
set ytics 0.2
plot '$work/section$k' using 1:(\$2-$level):(S_min_y-0.1) with filledcurves fc rgb '#e9dcc6' notitle, \
  0 lc rgb '#606060' lw 1 dt 3 title 'undisturbed', \
  '$work/section$k' using 1:(\$2-$level) with lines lw 2 lc rgb '#7a3b12' title 'at the end' $(
      i=0
      for a in $angles; do
        i=$((i + 1))
        case $a in
          -*) x=$last ;;
          *) x=$first ;;
        esac
        colour=$([ "$i" -le 2 ] && echo 1f6fb4 || echo b4301f)
        title=$([[ $((i % 2)) = 1 || $angles != *" "* ]] && echo "title '${a#-} deg'" || echo notitle)
        echo ", $middle - $level + (x - $x) * tan($a * pi / 180.) lc rgb '#$colour' dt 2 lw 1.5 $title"
      done | tr -d '\n')
GNUPLOT
  done
  echo "unset multiplot"
} >"$work/plot.gp"
gnuplot "$work/plot.gp"
