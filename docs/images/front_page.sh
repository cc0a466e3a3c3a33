#!/usr/bin/env bash
# Draws docs/images/front_page.jpg from the quickstart scenario: a picture from its mast beside a lidar scan of the
# same instant, 4.8 s, which is the middle of this run and so what the overview shows.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$tera" generate config/scenarios/quickstart.yaml --out "$scratch/run" --duration 9.6 \
  --set 'machines[0].rig={sensors: [{name: lidar_roof, preset: tera:config/sensors/os1_128.yaml, link: upper,
         xyz_m: [0.05, 0.35, 2.10], rpy_deg: [0, 10, 0]}]}' \
  --set 'machines[1].rig.sensors[0].width_px=1280' --set 'machines[1].rig.sensors[0].height_px=960' \
  --set 'machines[1].rig.sensors[0].rate_hz=5'
"$tera" overview "$scratch/run"
# The overview's first row is the camera's, its second the scan's: from behind on the right.
ffmpeg -y -loglevel error -i "$scratch/run/mast1/camera_site/rgb/4800000000.png" -i "$scratch/run/overview.png" \
  -filter_complex '[0]crop=1160:870:60:60,scale=800:600[camera];[1]crop=800:600:800:300[scan];[camera][scan]hstack' \
  -q:v 3 docs/images/front_page.jpg
