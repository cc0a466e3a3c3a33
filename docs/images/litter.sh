#!/usr/bin/env bash
# Draws docs/images/litter.jpg: what lies about on a site and grows there, config/obstacles/.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat > "$scratch/litter.yaml" <<'YAML'
name: litter
duration_s: 0.1
settle_s: 0
environment: {sun_azimuth_deg: 215, sun_elevation_deg: 38, visibility_m: 4000}
terrain: {size_m: [40, 40], cell_m: 0.1, soil: dirt, relief: {amplitude_m: 0.05, wavelength_m: 7}}
machines:
  - name: mast1
    machine: tera:config/machines/mast.yaml
    start: {xy_m: [0.2, -8.2]}
    operator: {type: idle}
    rig: {sensors: [{name: camera, preset: 'tera:config/sensors/rgb_640.yaml', link: mast, xyz_m: [0, 0, 2.4], rpy_deg: [0, 14, 90],
                     width_px: 1280, height_px: 520, horizontal_fov_deg: 62, rate_hz: 5, labels: false}]}
obstacles:
  - {name: a1, preset: 'tera:config/obstacles/pallets.yaml', xy_m: [-3.4, -1.8], yaw_deg: -30}
  - {name: a2, preset: 'tera:config/obstacles/bags.yaml', xy_m: [-1.7, -1.6], yaw_deg: 20}
  - {name: a3, preset: 'tera:config/obstacles/drum.yaml', xy_m: [0.1, -1.2], yaw_deg: 30}
  - {name: a4, preset: 'tera:config/obstacles/rubble.yaml', xy_m: [2.0, -1.6]}
  - {name: a5, preset: 'tera:config/obstacles/barrels.yaml', xy_m: [3.6, -1.6], yaw_deg: -20}
  - {name: a6, preset: 'tera:config/obstacles/rebar.yaml', xy_m: [0.6, 2.2], yaw_deg: 16}
  - {name: p1, preset: 'tera:config/obstacles/tuft.yaml', xy_m: [-1.6, -3.2]}
  - {name: p2, preset: 'tera:config/obstacles/tuft.yaml', xy_m: [-0.9, -3.0], yaw_deg: 70}
  - {name: p3, preset: 'tera:config/obstacles/weed.yaml', xy_m: [0.5, -3.2]}
  - {name: p4, preset: 'tera:config/obstacles/weed.yaml', xy_m: [1.9, -3.1], yaw_deg: 50}
YAML
TERA_DATA_DIR=$PWD "$tera" generate "$scratch/litter.yaml" --out "$scratch/litter" > /dev/null
ffmpeg -y -loglevel error -i "$scratch/litter/mast1/camera/rgb/0.png" -vf crop=1280:440:0:80 -q:v 4 docs/images/litter.jpg
