#!/usr/bin/env bash
# Draws docs/images/wear.jpg: machines and things of a site as they left the factory, and worn.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat > "$scratch/wear.yaml" << 'YAML'
name: wear
duration_s: 0.1
settle_s: 0.5
environment: {sun_azimuth_deg: 205, sun_elevation_deg: 40, visibility_m: 4000}
terrain: {size_m: [40, 40], cell_m: 0.1, soil: dirt, relief: {amplitude_m: 0.05, wavelength_m: 7}}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [-3.2, -3.0], yaw_deg: -35, joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: idle}
  - name: excavator2
    machine: tera:config/machines/excavator20t.yaml
    start: {xy_m: [-4.5, 7.5], yaw_deg: -25, joints_deg: {boom: 45, arm: -110, bucket: -50}}
    operator: {type: idle}
  - name: mast1
    machine: tera:config/machines/mast.yaml
    start: {xy_m: [0.2, -11.5]}
    operator: {type: idle}
    rig: {sensors: [{name: camera, preset: 'tera:config/sensors/rgb_640.yaml', link: mast, xyz_m: [0, 0, 2.8], rpy_deg: [0, 9, 90],
                     width_px: 1280, height_px: 520, horizontal_fov_deg: 62, rate_hz: 5, labels: false}]}
obstacles:
  - {name: truck1, preset: 'tera:config/obstacles/truck.yaml', xy_m: [5.6, 1.5], yaw_deg: -150}
  - {name: barrier1, preset: 'tera:config/obstacles/barrier.yaml', xy_m: [2.2, -4.6], yaw_deg: 10}
YAML
TERA_DATA_DIR=$PWD "$tera" generate "$scratch/wear.yaml" --out "$scratch/new" > /dev/null
TERA_DATA_DIR=$PWD "$tera" generate "$scratch/wear.yaml" --out "$scratch/worn" \
  --set 'wear={dust: 0.45, mud: 0.35, scratches: 0.5, rust: 0.35}' > /dev/null
ffmpeg -y -loglevel error -i "$scratch/new/mast1/camera/rgb/0.png" -i "$scratch/worn/mast1/camera/rgb/0.png" -filter_complex vstack -q:v 4 \
  docs/images/wear.jpg
