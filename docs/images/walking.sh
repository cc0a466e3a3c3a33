#!/usr/bin/env bash
# Draws docs/images/walking.jpg: config/obstacles/person_walking.yaml at eight moments of his way, 1/6 s apart.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat > "$scratch/walk.yaml" << 'YAML'
name: walk
duration_s: 1.2
settle_s: 0
environment: {sun_azimuth_deg: 215, sun_elevation_deg: 38, visibility_m: 4000}
terrain: {size_m: [30, 30], cell_m: 0.1, soil: dirt}
machines:
  - name: mast1
    machine: tera:config/machines/mast.yaml
    start: {xy_m: [0, -5.5]}
    operator: {type: idle}
    rig: {sensors: [{name: camera, preset: 'tera:config/sensors/rgb_640.yaml', link: mast, xyz_m: [0, 0, 1.4], rpy_deg: [0, 4, 90],
                     width_px: 900, height_px: 520, horizontal_fov_deg: 50, rate_hz: 6, labels: false}]}
obstacles:
  - {name: p1, preset: 'tera:config/obstacles/person_walking.yaml', xy_m: [-1, 0], path: [{t_s: 0, xy_m: [-0.9, 0]}, {t_s: 2, xy_m: [1.6, 0]}]}
YAML
TERA_DATA_DIR=$PWD "$tera" generate "$scratch/walk.yaml" --out "$scratch/walk" > /dev/null
inputs=() crops= stack= k=0
while read -r picture; do
  inputs+=(-i "$picture")
  crops+="[$k]crop=230:390:$((175 + 36 * k)):65[c$k];"
  stack+="[c$k]"
  k=$((k + 1))
done < <(find "$scratch/walk/mast1/camera/rgb" -name '*.png' -printf '%f %p\n' | sort -n | cut -d' ' -f2)
ffmpeg -y -loglevel error "${inputs[@]}" -filter_complex "$crops${stack}hstack=$k" -q:v 4 docs/images/walking.jpg
