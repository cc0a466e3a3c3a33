# Speed, acceleration, sinkage and torque of config/scenarios/drive_three_soils.yaml, and their means on each soil:
#
#   gnuplot -c scripts/plot_soils.gp DATASET PICTURE.png
#
# Means are taken where the whole machine is on one soil, after it has set off and before it stops.
dataset = ARG1
machine = 'excavator1'
pose = dataset.'/truth/'.machine.'/pose.csv'
joints = dataset.'/truth/'.machine.'/joints.csv'
imu = dataset.'/'.machine.'/imu_chassis/data.csv'
both = '<paste -d, '.pose.' '.joints
set datafile separator ','

radius_m = 0.25                # of the sprocket
border = "-20 -5 5 20"         # of the strips, m along x
soils = "dirt gravel loose_sand"
half_m = 1.1                   # of the tracks: farther from a border, the machine is on one soil
start_m = 3                    # in which it sets off, or stops

seconds(x) = column("t_ns") * 1e-9
speed(x) = sqrt(column("vx_mps")**2 + column("vy_mps")**2)
shoes(x) = radius_m * 0.5 * (column("left_track_radps") + column("right_track_radps"))
sinkage_cm(x) = 50 * (column("left_track_sinkage_m") + column("right_track_sinkage_m"))
slip_percent(x) = 50 * (column("left_track_slip") + column("right_track_slip"))
torque_nm(x) = 0.5 * (column("left_track_nm") + column("right_track_nm"))

from(k) = k == 1 ? -15 + start_m : word(border, k) + half_m
to(k) = k == 3 ? 16 - start_m : word(border, k + 1) - half_m
on(k, v) = (column("x_m") > from(k) && column("x_m") < to(k)) ? v : NaN

array enter_s[3]
print "soil        speed m/s  least m/s  variation %  shoes m/s  slip %  sinkage cm  torque N m a track  acceleration RMS m/s2"
do for [k=1:3] {
  stats both using (on(k, seconds(0))) nooutput
  enter_s[k] = STATS_min
  t0 = STATS_min; t1 = STATS_max
  stats both using (on(k, speed(0))) nooutput;          v = STATS_mean; l = STATS_min; c = 100 * STATS_stddev / STATS_mean
  stats both using (on(k, shoes(0))) nooutput;          s = STATS_mean
  stats both using (on(k, slip_percent(0))) nooutput;   i = STATS_mean
  stats both using (on(k, sinkage_cm(0))) nooutput;     z = STATS_mean
  stats both using (on(k, torque_nm(0))) nooutput;      m = STATS_mean
  stats imu using (seconds(0) > t0 && seconds(0) < t1 ? column("ax_mps2") : NaN) nooutput
  print sprintf("%-11s %9.3f %10.3f %12.1f %10.3f %7.2f %11.2f %19.0f %22.3f", word(soils, k), v, l, c, s, i, z, m, STATS_stddev)
}

set terminal pngcairo size 1000,900 font 'sans,11'
set output ARG2
set multiplot layout 4,1
set grid lc rgb '#dddddd'
set lmargin 10
set rmargin 4
set key top right
set xrange [0:40]
do for [k=2:3] {
  t = enter_s[k] - half_m / 1.0
  set arrow k from t, graph 0 to t, graph 1 nohead dt 2 lc rgb '#888888'
}
do for [k=1:3] {
  set label k word(soils, k) noenhanced at (k == 1 ? 3 : enter_s[k] + 3), graph (k == 3 ? 0.15 : 0.5)
}
set ylabel 'speed, m/s'
plot both using (seconds(0)):(shoes(0)) with lines lc rgb '#d9541e' title 'shoes', \
     both using (seconds(0)):(speed(0)) with lines lc rgb '#1f5fa8' title 'machine'
unset label 1; unset label 2; unset label 3
set ylabel 'acceleration, m/s^2'
set yrange [-4:4]
plot imu using (seconds(0)):(column("ax_mps2")) with lines lc rgb '#1f5fa8' title 'IMU, forward'
set yrange [*:*]
set ylabel 'sinkage, cm'
set yrange [0:25]
plot both using (seconds(0)):(sinkage_cm(0)) with lines lc rgb '#1f5fa8' title 'deepest patch, mean of both tracks'
set ylabel 'torque, N m'
set yrange [-1000:3500]
set xlabel 'time, s'
plot both using (seconds(0)):(torque_nm(0)) with lines lc rgb '#1f5fa8' title 'of one track'
unset multiplot
