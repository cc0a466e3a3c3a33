#!/usr/bin/env bash
# Recordings of config/scenarios/receivers.yaml, each diagnosed by its receivers alone (docs/reference/diagnose.md):
#   scripts/receiver_runs.sh OUT [NAME...]    each by its name below, or all of them
# Prints what was said of them; recordings are removed again.
set -euo pipefail
if [ $# -lt 1 ]; then
  sed -n '2,4s/^# *//p' "$0" >&2
  exit 2
fi
tera=${TERA:-build/release/tera}
scenario=config/scenarios/receivers.yaml
out=$1
shift
mkdir -p "$out"
# Slew and boom are left out of the search.
echo 'only: [gnss_lever_arm, position_datum, height_datum, multipath, clock_offset, latency, filter_delay,
       antenna_swap, antenna_yaw]' > "$out/receivers_only.yaml"

# What is set in the recording alone, a line each: NAME [KEY=VALUE].
cases='
nothing
ahead gnss_left.clock_offset.offset_s=18
late gnss_right.latency.delay_s=0.3
lever_arm gnss_right.gnss_lever_arm={x_m: 0.25, y_m: 0, z_m: 0.1}
swap gnss_left.antenna_swap={}
yaw gnss_left.antenna_yaw.yaw_deg=6
height gnss_left.height_datum.offset_m=0.35
place gnss_left.position_datum={east_m: 0.4, north_m: -0.7}
reflections gnss_left.multipath={horizontal_m: 0.1, vertical_m: 0.2, azimuth_deg: 40}
lost_fix gnss_left.float_jump={interval_s: 15, duration_s: 8}
'

while read -r name set; do
  if [ -z "$name" ] || { [ $# -gt 0 ] && [[ " $* " != *" $name "* ]]; }; then continue; fi
  options=()
  if [ -n "$set" ]; then options=(--set "effects.excavator1.$set"); fi
  echo "$name: ${set:-nothing}"
  "$tera" generate $scenario --out "$out/$name" "${options[@]}" > "$out/$name.log" < /dev/null
  "$tera" diagnose $scenario "$out/$name" --library "$out/receivers_only.yaml" --no-simulation \
    --out "$out/$name.why" > "$out/$name.txt" < /dev/null
  grep -iE '^(Gnss|Nothing|Not compared)|beyond tolerance' "$out/$name.txt" | cut -c1-400 || true
  rm -r "${out:?}/$name"
done <<< "$cases"
