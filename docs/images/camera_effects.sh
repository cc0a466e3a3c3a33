#!/usr/bin/env bash
# Draws docs/images/camera_effects.jpg: what a camera on the upper structure sees while it slews, of one instant, and
# with a rolling shutter and motion blur; the same place through a pinhole and through a fisheye.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

camera='link: upper, xyz_m: [0.6, 0.35, 2.1], rpy_deg: [0, 12, 0], rate_hz: 1, labels: false'
sensor='exposure_s: 0.01, f_number: 16, pixel_um: 3.45'
printf 't_s,slew\n0,1\n' > "$scratch/levers.csv"
{
  echo "name: camera_effects"
  echo "duration_s: 2.2"
  sed -n '/^environment:/,/^machines:/p' config/scenarios/quickstart.yaml
  cat <<YAML
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: lever_replay, csv: $scratch/levers.csv, time_column: t_s}
    rig: {sensors: [
      {name: instant, type: camera, $camera, width_px: 640, height_px: 480, horizontal_fov_deg: 60, image_sensor: {$sensor}},
      {name: swept, type: camera, $camera, width_px: 640, height_px: 480, horizontal_fov_deg: 60,
       image_sensor: {$sensor, shutter: {readout_s: 0.06, most_pictures: 61}}},
      {name: pinhole, type: camera, $camera, width_px: 640, height_px: 480, horizontal_fov_deg: 90, image_sensor: {$sensor}},
      {name: fisheye, preset: tera:config/sensors/rgb_fisheye.yaml, $camera, width_px: 640, height_px: 480}]}
YAML
  sed -n '/^obstacles:/,$p' config/scenarios/quickstart.yaml | sed 's#\.\./obstacles#tera:config/obstacles#'
} > "$scratch/scenario.yaml"
TERA_DATA_DIR=$PWD "$tera" generate "$scratch/scenario.yaml" --out "$scratch/run"
row() { echo "$scratch/run/excavator1/$1/rgb/2000000000.png"; }
ffmpeg -y -loglevel error -i "$(row instant)" -i "$(row swept)" -i "$(row pinhole)" -i "$(row fisheye)" \
  -filter_complex '[0][1]hstack[a];[2][3]hstack[b];[a][b]vstack' -q:v 4 docs/images/camera_effects.jpg
