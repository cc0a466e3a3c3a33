#!/usr/bin/env bash
# Draws docs/images/weather.jpg: of config/scenarios/dusty_site.yaml, work without dust and with it, an excavator that drives over
# dry ground, and the same site dry, in rain with puddles, and under snow.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
site=config/scenarios/dusty_site.yaml
draw() {
  local name=$1 scenario=$2
  shift 2
  TERA_DATA_DIR=$PWD "$tera" generate "$scenario" --out "$scratch/$name" \
    --set 'machines[1].rig.sensors[0]={labels: false, rate_hz: 0.2, width_px: 800, height_px: 500}' \
    --set 'machines[1].rig.sensors[1].columns=16' "$@" > /dev/null
}
driving=$scratch/driving.yaml
{
  sed '/^machines:/,$d' "$site"
  cat << YAML
machines:
  - {name: excavator1, machine: $PWD/config/machines/excavator20t.yaml, start: {xy_m: [-2, -9], yaw_deg: 80, joints_deg: {boom: 50, arm: -110, bucket: -60}},
     operator: {type: waypoints, waypoints: [{xy_m: [1, 14]}], speed_mps: 1.4}}
$(sed -n '/  - name: mast1/,$p' "$site" | sed "s#\.\./#$PWD/config/#")
YAML
} | sed "s#\.\./#$PWD/config/#" > "$driving"
clear='environment.dust.emission_factor=0'
draw off "$site" --duration 15 --set "$clear"
draw dump "$site" --duration 15
draw drive "$driving" --duration 8 --set 'machines[1].rig.sensors[0].rate_hz=0.25'
draw dry "$site" --duration 0.1 --set "$clear"
draw rain "$site" --duration 0.1 --set "$clear" --set environment.cloud_cover=1 --set environment.rain_mmph=18 --set environment.puddle_depth_m=0.015 \
  --set environment.exposure_ev100=13
draw snow "$site" --duration 0.1 --set "$clear" --set environment.cloud_cover=0.6 --set environment.snow_depth_m=0.15 --set environment.exposure_ev100=15.6
picture() { echo "$scratch/$1/mast1/camera_site/rgb/$2.png"; }
ffmpeg -y -loglevel error -i "$(picture off 15000000000)" -i "$(picture dump 15000000000)" -i "$(picture drive 8000000000)" \
  -i "$(picture dry 0)" -i "$(picture rain 0)" -i "$(picture snow 0)" \
  -filter_complex '[0][1][2]hstack=3[a];[3][4][5]hstack=3[b];[a][b]vstack,scale=1920:-2' -q:v 4 docs/images/weather.jpg
