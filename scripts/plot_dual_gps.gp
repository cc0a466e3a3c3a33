# The path of a replayed lever log as two GPS antennas saw it, and the truth:
#
#   gnuplot -c scripts/plot_dual_gps.gp DATASET PICTURE.png      # DATASET of config/scenarios/dual_gps.yaml
machine = ARG1.'/excavator1/'
pose = ARG1.'/truth/excavator1/pose.csv'
set datafile separator ','
antenna_x_m = -0.95      # on the upper structure, which stands as the undercarriage does

# Heading of the root from its quaternion.
yaw(x) = atan2(2 * (column("qw") * column("qz") + column("qx") * column("qy")), \
    1 - 2 * (column("qy")**2 + column("qz")**2))
way = 0; last_x = NaN
step(x, y) = (d = (last_x == last_x) ? sqrt((x - last_x)**2 + (y - last_y)**2) : 0, last_x = x, last_y = y, way = way + d, way)
last_y = 0
stats pose using (step(column("x_m"), column("y_m"))) nooutput
print sprintf("length of the true path: %.2f m", STATS_max)

# Middle of both antennas against the same point of the machine, at the ten times a second of both.
all = '<awk -F, ''NR == 1 || $1 % 100000000 == 0'' '.pose.' | paste -d, '.machine.'gps_left/data.csv '.machine.'gps_right/data.csv -'
east_m(x) = 0.5 * (column(5) + column(16)) - column("x_m") - antenna_x_m * cos(yaw(0))
north_m(x) = 0.5 * (column(6) + column(17)) - column("y_m") - antenna_x_m * sin(yaw(0))
stats all using (east_m(0)**2 + north_m(0)**2) nooutput
print sprintf("middle of the antennas against the truth: RMSE %.3f m over %d fixes", sqrt(STATS_mean), STATS_records)

set terminal pngcairo size 900,700 font 'sans,11'
set output ARG2
set datafile separator ','
set size ratio -1
set grid lc rgb '#dddddd'
set key top left
set xlabel 'east, m'
set ylabel 'north, m'
plot machine.'gps_left/data.csv' using "east_m":"north_m" with lines lc rgb '#5a9bd4' title 'left antenna', \
     machine.'gps_right/data.csv' using "east_m":"north_m" with lines lc rgb '#e08a4f' title 'right antenna', \
     pose using "x_m":"y_m" with lines lw 2 lc rgb '#222222' title 'truth, middle of the machine'
