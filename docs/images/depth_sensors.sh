#!/usr/bin/env bash
# Draws docs/images/depth_sensors.jpg: what a camera on an excavator sees in colour, its depth with the noise of
# disparities, of a stereo matcher without and with a projector of dots, and by time of flight without and with multipath.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

camera='type: camera, link: upper, xyz_m: [0.7, 0.9, 2.1], rpy_deg: [0, 17, 52], rate_hz: 1, width_px: 480, height_px: 360,
       horizontal_fov_deg: 70, baseline_m: 0.1, labels: false, depth: true, depth_max_m: 12'
{
  echo "name: depth_sensors"
  echo "duration_s: 0.1"
  sed -n '/^environment:/,/^machines:/p' config/scenarios/quickstart.yaml
  cat <<YAML
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: idle}
    rig: {sensors: [
      {name: noise, $camera, disparity_noise_px: 0.08},
      {name: passive, $camera, stereo: {disparities_px: 64}},
      {name: dots, $camera, stereo: {disparities_px: 64, projector: {intensity_cd: 1000000, cell_deg: 0.7}}},
      {name: flight, $camera, time_of_flight: {multipath: false}},
      {name: multipath, $camera, time_of_flight: {}}]}
YAML
  sed -n '/^obstacles:/,$p' config/scenarios/quickstart.yaml | sed 's#\.\./obstacles#tera:config/obstacles#'
} > "$scratch/scenario.yaml"
TERA_DATA_DIR=$PWD "$tera" generate "$scratch/scenario.yaml" --out "$scratch/run" "$@"
python3 - "$scratch/run/excavator1" docs/images/depth_sensors.jpg <<'PYTHON'
import sys
import cv2
import numpy as np
folder, out = sys.argv[1:]
def depth(name):
    mm = cv2.imread(f"{folder}/{name}/depth/0.png", cv2.IMREAD_UNCHANGED).astype(float)
    near = np.clip(1 - (mm - 1000) / 9000, 0, 1)
    picture = cv2.applyColorMap((255 * near).astype(np.uint8), cv2.COLORMAP_TURBO)
    picture[mm == 0] = 0
    return picture
colour = cv2.imread(f"{folder}/noise/rgb/0.png")
rows = [[colour, depth("noise"), depth("passive")], [depth("dots"), depth("flight"), depth("multipath")]]
cv2.imwrite(out, np.vstack([np.hstack(row) for row in rows]), [cv2.IMWRITE_JPEG_QUALITY, 88])
PYTHON
