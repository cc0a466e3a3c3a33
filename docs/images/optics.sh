#!/usr/bin/env bash
# Draws docs/images/optics.jpg: what a camera on an excavator sees through an ideal lens, with glare and ghosts of a low
# sun, through dust and specks, and through drops; a longer lens that is ideal, one focused near and one focused far, and
# the label of dust, specks and drops together.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

camera='type: camera, link: upper, xyz_m: [0.6, 0.35, 2.1], rpy_deg: [0, 8, 0], rate_hz: 1, width_px: 640, height_px: 480'
wide="$camera, horizontal_fov_deg: 60, image_sensor: {exposure_s: 0.001, f_number: 8, pixel_um: 6}"
long="$camera, horizontal_fov_deg: 30, image_sensor: {exposure_s: 0.00001, f_number: 1.4, pixel_um: 20, full_well_e: 90000}, labels: false"
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
      {name: ideal, $wide, labels: false},
      {name: glare, $wide, labels: false, optics: {glare: {scattered: 0.03}, flare: {ghosts: 9, reflectance: 0.02}}},
      {name: dust, $wide, labels: false, optics: {soiling: {distance_mm: 30, $dust}}},
      {name: drops, $wide, labels: false, optics: {soiling: {distance_mm: 30, $drops}}},
      {name: sharp, $long},
      {name: near, $long, optics: {focus_m: 3}},
      {name: far, $long, optics: {focus_m: 12}},
      {name: both, $wide, labels: [lens_soiling], optics: {soiling: {distance_mm: 30, $dust, $drops}}}]}
YAML
  sed -n '/^obstacles:/,$p' config/scenarios/quickstart.yaml | sed 's#\.\./obstacles#tera:config/obstacles#'
} > "$scratch/scenario.yaml"
TERA_DATA_DIR=$PWD "$tera" generate "$scratch/scenario.yaml" --out "$scratch/run" "$@"
picture() { echo "$scratch/run/excavator1/$1/${2:-rgb}/0.png"; }
ffmpeg -y -loglevel error -i "$(picture ideal)" -i "$(picture glare)" -i "$(picture dust)" -i "$(picture drops)" \
  -i "$(picture sharp)" -i "$(picture near)" -i "$(picture far)" -i "$(picture both lens_soiling)" \
  -filter_complex '[7]format=rgb24[l];[0][1][2][3]hstack=4[a];[4][5][6][l]hstack=4[b];[a][b]vstack,scale=1800:-1' -q:v 4 docs/images/optics.jpg
