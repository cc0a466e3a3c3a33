#!/usr/bin/env bash
# Draws docs/images/light.jpg: the quickstart's site by a June noon, under a closed sky, in December's twilight and, of
# config/scenarios/night_shift.yaml, after it under lamps.
set -euo pipefail
cd "$(dirname "$0")/../.."
tera=${TERA:-build/release/tera}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
night=config/scenarios/night_shift.yaml
draw() {
  local scenario=$1 name=$2
  shift 2
  TERA_DATA_DIR=$PWD "$tera" generate "$scenario" --out "$scratch/$name" --duration 1.3 \
    --set 'machines[1].rig.sensors[0].labels=false' --set 'machines[1].rig.sensors[0].rate_hz=1' \
    --set 'machines[1].rig.sensors[0].width_px=640' --set 'machines[1].rig.sensors[0].height_px=400' "$@" > /dev/null
}
# By day the exposure is metered: the night's is left out.
day=$scratch/day.yaml
sed -e 's/, exposure_ev100: [0-9.]*//' -e 's|\.\./|tera:config/|g' "$night" > "$day"
dark='lamps=[]'
draw "$day" noon --set "$dark" --set 'environment.time=2026-06-21T11:30:00Z'
draw "$day" overcast --set "$dark" --set 'environment.time=2026-06-21T11:30:00Z' --set environment.cloud_cover=1
draw "$day" dusk --set "$dark" --set 'environment.time=2026-12-10T15:45:00Z'
draw "$night" lamps
picture() { echo "$scratch/$1/mast1/camera_site/rgb/1000000000.png"; }
ffmpeg -y -loglevel error -i "$(picture noon)" -i "$(picture overcast)" -i "$(picture dusk)" -i "$(picture lamps)" \
  -filter_complex '[0][1]hstack[a];[2][3]hstack[b];[a][b]vstack' -q:v 4 docs/images/light.jpg
