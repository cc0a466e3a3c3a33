# Rates of arm, boom and bucket after steps of 60 % lever, beside eq. (1) of the TERA paper:
#
#   gnuplot -c scripts/plot_steps.gp DATASET PICTURE.png      # DATASET of config/scenarios/step_60.yaml
joints = ARG1.'/truth/excavator1/joints.csv'
set datafile separator ','
set terminal pngcairo size 1000,900 font 'sans,11'
set output ARG2

eta_radps = 20; beta_1ps = 6; phi_rad = 0
equation(t, w) = t < 0 ? NaN : w * (1 + sin(eta_radps * t + phi_rad) * exp(-beta_1ps * t))
names = "arm boom bucket"
step_s = "1 4 7"
full_degps = "43.3 25.8 43.3"
array worst_degps[3]

set multiplot layout 3,1
set grid lc rgb '#dddddd'
set key top right
set samples 2000
set ylabel 'rate, deg/s'
do for [k=1:3] {
  name = word(names, k)
  t0 = word(step_s, k) + 0
  w = 0.6 * word(full_degps, k)
  set xrange [t0 - 0.2:t0 + 1.4]
  if (k == 3) { set xlabel 'time, s' }
  # From a tenth of a second on: before, eq. (1) asks for a jump.
  stats joints using (column("t_ns") * 1e-9 > t0 + 0.1 && column("t_ns") * 1e-9 < t0 + 1.4 ? \
      abs(column(name."_radps") * 180 / pi - equation(column("t_ns") * 1e-9 - t0, w)) : NaN) nooutput
  print sprintf("%-7s steady %5.2f deg/s, differs from eq. (1) by at most %.2f deg/s after 0.1 s", name, w, STATS_max)
  plot joints using (column("t_ns") * 1e-9):(column(name."_radps") * 180 / pi) with lines lw 2 \
      lc rgb '#1f5fa8' title name.', simulated', \
    equation(x - t0, w) with lines dt 2 lw 2 lc rgb '#d9541e' title 'eq. (1)'
}
unset multiplot
