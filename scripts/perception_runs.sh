#!/usr/bin/env bash
# Recordings of config/scenarios/survey.yaml, each diagnosed by its sensors alone (docs/reference/perception.md):
#   scripts/perception_runs.sh OUT nulls FIRST LAST    seeds of which nothing is wrong, and how many give a finding
#   scripts/perception_runs.sh OUT wrong [NAME...]     with something wrong, each by its name below or all of them
# Prints what was said of the sensors; recordings are removed again.
set -euo pipefail
tera=${TERA:-build/release/tera}
scenario=config/scenarios/survey.yaml
usage() {
  sed -n '2,5s/^# *//p' "$0" >&2
  exit 2
}

case $#:${2-} in
  4:nulls) ;;
  *:wrong) ;;
  *) usage ;;
esac
out=$1 what=$2
mkdir -p "$out"
# The scenario with levers at rest: without those of the recording, joints are left out.
sed 's#\.\./#tera:config/#; s#operator: {.*}#operator: {type: idle}#' $scenario > "$out/idle.yaml"

# record NAME SEED OPTION...: a recording without its levers.
record() {
  local name=$1 seed=$2
  shift 2
  "$tera" generate $scenario --seed "$seed" --out "$out/$name" "$@" > "$out/$name.log"
  sed -i '/commands.csv/d' "$out/$name/dataset.yaml"
}

# diagnose NAME SEED: what is said of sensors, in the report's folder NAME.why.
diagnose() {
  "$tera" diagnose "$out/idle.yaml" "$out/$1" --seed "$2" --out "$out/$1.why" > "$out/$1.txt"
  grep -E '^(Lidar|Camera) ' "$out/$1.txt" | cut -c1-330
  rm -r "${out:?}/$1"
}

# findings FOLDER: how many are of a sensor.
findings() {
  python3 -c 'import json, sys
sensors = ("lidar_roof", "camera_front", "camera_side")
print(sum(f["channel"].endswith(sensors) for f in json.load(open(sys.argv[1]))["findings"]))' "$1/diagnosis.json"
}

nulls() {
  local with=0 count=0
  for ((seed = $1; seed <= $2; ++seed)); do
    record "null_$seed" "$seed"
    echo "seed $seed"
    diagnose "null_$seed" "$seed"
    count=$((count + 1))
    if [ "$(findings "$out/null_$seed.why")" != 0 ]; then with=$((with + 1)); fi
  done
  echo "$with of $count recordings of nothing gave a finding of a sensor"
}

# What is set in the recording alone, a line each: NAME KEY=VALUE...
wrong='
lidar_range effects.excavator1.lidar_roof.range_bias.range_m=0.05
lidar_mount effects.excavator1.lidar_roof.extrinsic={roll_deg: 0.8, pitch_deg: -0.6, yaw_deg: 1.5, z_m: 0.05}
lidar_clock effects.excavator1.lidar_roof.clock_offset.offset_s=0.12
depth_range effects.excavator1.camera_front.range_bias.depth_m=0.08
depth_mount effects.excavator1.camera_front.extrinsic={pitch_deg: 0.8, yaw_deg: -1, z_m: 0.04}
depth_clock effects.excavator1.camera_front.clock_offset.offset_s=0.12
colour_mount effects.excavator1.camera_side.extrinsic={roll_deg: 0.5, pitch_deg: -0.7, yaw_deg: 1, z_m: 0.05}
colour_clock effects.excavator1.camera_side.clock_offset.offset_s=0.12
truck_moved obstacles[0].xy_m=[8, 6]
pit terrain.pits=[{outline_m: [[7, -3], [9.5, -3], [9.5, -1], [7, -1]], depth_m: 0.6}]
'

case $what in
  nulls) nulls "$3" "$4" ;;
  wrong)
    shift 2
    while read -r name set; do
      if [ -z "$name" ] || { [ $# -gt 0 ] && [[ " $* " != *" $name "* ]]; }; then continue; fi
      record "$name" 1 --set "$set" < /dev/null
      echo "$name: $set"
      diagnose "$name" 1 < /dev/null
    done <<< "$wrong" ;;
esac
