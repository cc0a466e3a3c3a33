#!/usr/bin/env bash
# Draws docs/images/task.jpg and docs/images/task_deviation.png: the small trench of docs/guide/my-task.md at the end of its run, seen from
# a mast, and the map of its deviation from the design.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
{
  sed -e 's/to_m: \[-1.6, 0\]/to_m: [2.4, 0]/' -e 's/depth_m: 1.0/depth_m: 0.4/' -e 's/duration_s: 2400/duration_s: 600/' \
    examples/tasks/trench.yaml
  cat << YAML
  - name: mast1
    machine: tera:config/machines/mast.yaml
    start: {xy_m: [7.2, -3.4], yaw_deg: 148}
    operator: {type: idle}
    rig: {sensors: [{name: camera, preset: 'tera:config/sensors/rgb_640.yaml', link: mast, xyz_m: [0, 0, 3.2], rpy_deg: [0, 22, 0],
                     width_px: 1280, height_px: 640, horizontal_fov_deg: 75, rate_hz: 0.1, labels: false}]}
YAML
} > "$scratch/trench.yaml"
TERA_DATA_DIR=$PWD "$tera" generate "$scratch/trench.yaml" --out "$scratch/trench" > /dev/null
last=$(find "$scratch/trench/mast1/camera/rgb" -name '*.png' -printf '%f\n' | sort -n | tail -1)
ffmpeg -y -loglevel error -i "$scratch/trench/mast1/camera/rgb/$last" -q:v 4 docs/images/task.jpg
scripts/plot_deviation.sh docs/images/task_deviation.png "$scratch/trench"
