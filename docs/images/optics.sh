#!/usr/bin/env bash
# Draws docs/images/optics.jpg: what a camera on an excavator sees through an ideal lens, one that is focused on 2 m,
# and with glare and ghosts of a low sun; through dust and specks, and through drops, beside the label of both.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

camera='type: camera, link: upper, xyz_m: [0.6, 0.35, 2.1], rpy_deg: [0, 8, 0], rate_hz: 1, width_px: 640, height_px: 480,
       horizontal_fov_deg: 60'
sensor() { echo "image_sensor: {exposure_s: $1, f_number: $2, pixel_um: 6}"; }
dust='film: 0.15, specks: 60, speck_mm: 0.7' drops='drops: 14, drop_mm: 3'
{
  echo "name: optics"
  echo "duration_s: 0.1"
  echo "environment: {sun_azimuth_deg: 106, sun_elevation_deg: 11, visibility_m: 1500}"
  sed -n '/^terrain:/,/^machines:/p' config/scenarios/quickstart.yaml
  cat <<YAML
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: idle}
    rig: {sensors: [
      {name: ideal, $camera, labels: false, $(sensor 0.002 8)},
      {name: focused, $camera, labels: false, $(sensor 0.00006 1.4), optics: {focus_m: 2}},
      {name: glare, $camera, labels: false, $(sensor 0.002 8), optics: {glare: {scattered: 0.03}, flare: {ghosts: 9, reflectance: 0.02}}},
      {name: dust, $camera, labels: [lens_soiling], $(sensor 0.002 8), optics: {soiling: {distance_mm: 30, $dust}}},
      {name: drops, $camera, labels: [lens_soiling], $(sensor 0.002 8), optics: {soiling: {distance_mm: 30, $drops}}},
      {name: both, $camera, labels: [lens_soiling], $(sensor 0.002 8), optics: {soiling: {distance_mm: 30, $dust, $drops}}}]}
YAML
  sed -n '/^obstacles:/,$p' config/scenarios/quickstart.yaml | sed 's#\.\./obstacles#tera:config/obstacles#'
} > "$scratch/scenario.yaml"
TERA_DATA_DIR=$PWD "$tera" generate "$scratch/scenario.yaml" --out "$scratch/run" "$@"
picture() { echo "$scratch/run/excavator1/$1/$2/0.png"; }
ffmpeg -y -loglevel error -i "$(picture ideal rgb)" -i "$(picture focused rgb)" -i "$(picture glare rgb)" \
  -i "$(picture dust rgb)" -i "$(picture drops rgb)" -i "$(picture both lens_soiling)" \
  -filter_complex '[5]format=rgb24[l];[0][1][2]hstack=3[a];[3][4][l]hstack=3[b];[a][b]vstack,scale=1440:-1' -q:v 4 docs/images/optics.jpg
