#!/usr/bin/env bash
# Draws docs/images/yard.jpg: the people of config/obstacles/ in their poses, material of a site, and the tipper with wheels.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat > "$scratch/yard.yaml" <<'YAML'
name: yard
duration_s: 0.1
settle_s: 0
environment: {sun_azimuth_deg: 215, sun_elevation_deg: 38, visibility_m: 4000}
terrain: {size_m: [40, 40], cell_m: 0.1, soil: dirt, relief: {amplitude_m: 0.05, wavelength_m: 7}}
machines:
  - name: mast1
    machine: tera:config/machines/mast.yaml
    start: {xy_m: [0.2, -10.2]}
    operator: {type: idle}
    rig: {sensors: [{name: camera, preset: 'tera:config/sensors/rgb_640.yaml', link: mast, xyz_m: [0, 0, 2.4], rpy_deg: [0, 10, 90],
                     width_px: 1280, height_px: 520, horizontal_fov_deg: 62, rate_hz: 5, labels: false}]}
obstacles:
  - {name: a1, preset: 'tera:config/obstacles/person.yaml', xy_m: [-4.0, -2.4], yaw_deg: -40}
  - {name: a2, preset: 'tera:config/obstacles/person_step.yaml', xy_m: [-2.9, -2.4], yaw_deg: -40}
  - {name: a3, preset: 'tera:config/obstacles/person_pass.yaml', xy_m: [-1.9, -2.4], yaw_deg: -40}
  - {name: a4, preset: 'tera:config/obstacles/person_standing.yaml', xy_m: [-1.1, -2.4], yaw_deg: -60}
  - {name: a5, preset: 'tera:config/obstacles/person_crouching.yaml', xy_m: [-0.2, -2.7], yaw_deg: -40}
  - {name: a6, preset: 'tera:config/obstacles/person_pointing.yaml', xy_m: [1.1, -2.4], yaw_deg: -30}
  - {name: a7, preset: 'tera:config/obstacles/person_lying.yaml', xy_m: [3.3, -3.0], yaw_deg: 160}
  - {name: b1, preset: 'tera:config/obstacles/pipe.yaml', xy_m: [-5.0, 0.6], yaw_deg: 40}
  - {name: b2, preset: 'tera:config/obstacles/pipes.yaml', xy_m: [-1.3, 2.0], yaw_deg: 8}
  - {name: b3, preset: 'tera:config/obstacles/planks.yaml', xy_m: [3.6, 1.0], yaw_deg: -15}
  - {name: b4, preset: 'tera:config/obstacles/blocks.yaml', xy_m: [5.9, 0.2], yaw_deg: 30}
  - {name: b5, preset: 'tera:config/obstacles/manhole.yaml', xy_m: [1.9, 0.0]}
  - {name: b6, preset: 'tera:config/obstacles/stake.yaml', xy_m: [4.9, -1.6], yaw_deg: 40}
  - {name: t1, preset: 'tera:config/obstacles/truck_driving.yaml', xy_m: [4, 6.5], path: [{t_s: 0, xy_m: [4, 6.5]}, {t_s: 9, xy_m: [-20, 6.5]}]}
YAML
TERA_DATA_DIR=$PWD "$tera" generate "$scratch/yard.yaml" --out "$scratch/yard" > /dev/null
ffmpeg -y -loglevel error -i "$scratch/yard/mast1/camera/rgb/0.png" -q:v 4 docs/images/yard.jpg
