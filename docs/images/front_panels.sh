#!/usr/bin/env bash
# Draws the three pictures at the head of README.md: a part of front_page.jpg, and parts of what two guides show.
# Needs chromium.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${BUILD:-build/release}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for guide in my-recording sensor-layouts; do
  python3 -B test/docs/run_guide.py docs/guide/$guide.md --build "$build" --keep "$scratch/$guide" >/dev/null
done
(cd "$scratch/my-recording/out" && chromium --headless --no-sandbox --window-size=1100,1180 --screenshot=report.png why/report.html)
maps=$scratch/sensor-layouts/out/seen
ffmpeg -y -loglevel error -i docs/images/front_page.jpg -vf 'crop=800:520:0:40,scale=560:-1' -q:v 3 docs/images/front_scene.jpg
ffmpeg -y -loglevel error -i "$scratch/my-recording/out/report.png" -vf 'crop=480:312:48:428' docs/images/front_diagnosis.png
ffmpeg -y -loglevel error -i "$maps/excavator/maps/seen_0.9_m.png" -i "$maps/wide/maps/seen_0.9_m.png" \
  -filter_complex '[0]crop=480:474:0:58[a];[1]crop=480:474:0:58[b];[a][b]hstack,scale=560:-1' docs/images/front_layout.png
