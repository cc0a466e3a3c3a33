# Ruts on gravel and on loose sand of config/scenarios/drive_three_soils.yaml: maps of the change of height, and sections.
# Prints the depths. Needs gdal-bin.
#
#   gnuplot -c scripts/plot_ruts.gp DATASET PICTURE.png
dataset = ARG1
change = dataset.'/truth/terrain/change_end.tif'

# Strips of the raster as tables of x, y in m and the change in cm; x counts from the raster's middle.
table(x0, y0, x1, y1) = sprintf("< gdal_translate -q -of XYZ -projwin %g %g %g %g %s /vsistdout/", x0, y1, x1, y0, change)
track_m = 0.574                # of the tracks' middles from the machine's
gravel = table(-3.525, -1.525, 2.525, 1.525)
sand = table(7.975, -1.525, 14.025, 1.525)
cm(z) = 100 * z

along(x0, x1) = table(x0, track_m - 0.024, x1, track_m + 0.024)
across(x) = table(x - 0.024, -1.525, x + 0.024, 1.525)

print "soil        rut cm  greatest cm  ridge cm"
do for [k=1:3] {
  name = word("dirt gravel loose_sand", k)
  from = word("-9 -3.5 8", k) + 0; to = word("-6.1 2.5 14", k) + 0
  stats along(from, to) using (cm($3)) nooutput;  mean = STATS_mean; most = STATS_min
  stats table(from, track_m - 0.5, to, track_m + 0.5) using (cm($3)) nooutput
  print sprintf("%-11s %6.1f %12.1f %9.1f", name, -mean, -most, STATS_max)
}

set terminal pngcairo size 1100,1000 font 'sans,11'
set output ARG2
set multiplot
set palette defined (-1 '#2b3a8c', -0.5 '#5b8fd0', 0 '#f2f0ea', 0.5 '#e0a050', 1 '#8c3a1e')
set size ratio -1
set xlabel 'x, m' offset 0,0.5
set ylabel 'y, m'
set format cb '%g'
set cblabel 'change of height, cm'
unset key
do for [k=1:2] {
  set origin 0, k == 1 ? 0.66 : 0.33
  set size 1, 0.34
  set title (k == 1 ? 'gravel' : 'loose sand')
  set xrange [k == 1 ? -3.5 : 8 : k == 1 ? 2.5 : 14]
  set yrange [-1.5:1.5]
  if (k == 1) { set cbrange [-2:2] } else { set cbrange [-16:16] }
  x = k == 1 ? 1.2 : 12.7
  set arrow 1 from x, -1.25 to x + 1, -1.25 heads size 0.05, 90 lw 2 front
  set label 1 '1 m' at x + 0.5, -1.05 center front
  plot (k == 1 ? gravel : sand) using 1:2:(cm($3)) with image
}
unset arrow 1; unset label 1
set size noratio
set ylabel 'change of height, cm'
set grid lc rgb '#dddddd'
set key bottom right
set origin 0, 0; set size 0.5, 0.33
set title 'across'
set xlabel 'y, m'
set xrange [-1.5:1.5]; set yrange [-20:10]
plot across(0) using 2:(cm($3)) with lines lw 2 lc rgb '#707070' title 'gravel, x = 0 m', \
     across(10) using 2:(cm($3)) with lines lw 2 lc rgb '#c08030' title 'loose sand, x = 10 m'
set origin 0.5, 0
set title 'along the left rut'
set xlabel 'x - x_0, m'
set xrange [0:2]
plot along(-1, 1) using ($1 + 1):(cm($3)) with linespoints pt 7 ps 0.4 lc rgb '#707070' title 'gravel, x_0 = -1 m', \
     along(9, 11) using ($1 - 9):(cm($3)) with linespoints pt 7 ps 0.4 lc rgb '#c08030' title 'loose sand, x_0 = 9 m', \
     along(-8, -6) using ($1 + 8):(cm($3)) with linespoints pt 7 ps 0.4 lc rgb '#5a3a20' title 'dirt, x_0 = -8 m'
unset multiplot
