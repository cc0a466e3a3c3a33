#!/usr/bin/env bash
# Static torque of the bucket joint against payload, beside m g r. Writes datasets and a picture:
#   scripts/plot_payload.sh out/payload [build/release/tera]
set -euo pipefail
cd "$(dirname "$0")/.."
out=$1
tera=${2:-build/release/tera}
mkdir -p "$out"
table=$out/torque.txt
: >"$table"
for mass_kg in 0 100 200 300 400 500; do
  rm -rf "$out/$mass_kg"
  "$tera" generate config/scenarios/payload.yaml --out "$out/$mass_kg" \
    --set 'machines[0].machine.fixed_base=true' --set "effects.excavator1.bucket.payload.mass_kg=$mass_kg"
  gnuplot -e "set datafile separator ','; \
    stats '$out/$mass_kg/truth/excavator1/joints.csv' using (column('t_ns') > 1e9 ? column('bucket_nm') : NaN) nooutput; \
    print '$mass_kg ', STATS_mean" 2>>"$table"
done
gnuplot -e "
  set terminal pngcairo size 800,500 font 'sans,11'; set output '$out/torque.png';
  stats '$table' using (\$1 == 0 ? \$2 : NaN) nooutput; empty = STATS_mean;
  do for [m = 100:500:100] {
    stats '$table' using (\$1 == m ? \$2 - empty : NaN) nooutput;
    print sprintf('%3d kg: %7.1f N m, m g r %7.1f N m, %+.2f %%', m, STATS_mean, m * 9.80665 * 0.35,
      100 * (STATS_mean / (m * 9.80665 * 0.35) - 1));
  };
  set grid; set key top left; set xlabel 'payload, kg'; set ylabel 'torque of the bucket joint, N m'; set xrange [-20:520];
  plot '$table' using 1:2 with points pt 7 ps 1.5 lc rgb '#1f5fa8' title 'simulated',
    empty + x * 9.80665 * 0.35 with lines lc rgb '#d9541e' title 'empty bucket + m g r'"
