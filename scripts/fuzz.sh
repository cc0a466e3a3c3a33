#!/usr/bin/env bash
# Feeds each reader of files that anybody may have written with what libFuzzer makes of small ones, under AddressSanitizer and UBSan:
#
#   scripts/fuzz.sh [SECONDS [READER...]]    # 600 s for each reader of test/fuzz, one after the other
#
# Small files come from the program of build/release (TERA names another), which must be there. What was found to reach new code is kept in
# out/fuzz/READER and built upon by the next run; an input that ends a reader is kept there too, and makes this script fail.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-600}
shift || true
tera=$PWD/${TERA:-build/release/tera}
[ -x "$tera" ] || { echo "fuzz.sh: no program $tera; need scripts/build.sh first, or its name in TERA" >&2; exit 2; }

packages() { sed -n "s/^\($1\): //p" scripts/packages.txt; }
# shellcheck disable=SC2046
scripts/install_packages.sh $(packages build) $(packages libraries) $(packages fuzz)

readers=("$@")
if [ ${#readers[@]} -eq 0 ]; then
  mapfile -t readers < <(find test/fuzz -name '*_fuzz.cpp' -printf '%f\n' | sed 's/_fuzz.cpp//' | sort)
fi
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target "${readers[@]/%/_fuzz}"

seeds=out/fuzz/seeds
# seed READER NAME FILE: a small file for a reader to begin with.
seed() {
  mkdir -p "$seeds/$1"
  cp "$3" "$seeds/$1/$2"
}
# with_zero READER NAME FILE FILE: two files with a 0 between them.
with_zero() {
  mkdir -p "$seeds/$1"
  { cat "$3"; printf '\0'; cat "$4"; } >"$seeds/$1/$2"
}
make_seeds() {
  local run=$seeds/run form file n=0
  rm -rf $seeds
  mkdir -p $seeds
  cat >$seeds/small.yaml <<'YAML'
name: small
duration_s: 0.3
settle_s: 0.1
site: {lat_deg: 46.78, lon_deg: -71.27, height_m: 90}
terrain: {size_m: [14, 14], cell_m: 0.2, soil: dirt}
machines:
  - name: m
    machine: tera:config/machines/warthog.yaml
    operator: {type: idle}
    rig: {sensors: [
      {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: chassis, rate_hz: 20},
      {name: gnss, preset: tera:config/sensors/rtk_f9p.yaml, link: chassis},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: chassis, xyz_m: [0, 0, 1], columns: 16},
      {name: camera, preset: tera:config/sensors/rgb_640.yaml, link: chassis, width_px: 16, height_px: 12, labels: true}]}
YAML
  "$tera" generate $seeds/small.yaml --out $run >/dev/null
  # A bag of little, so that much of it is structure.
  "$tera" generate $seeds/small.yaml --duration 0.02 --set 'machines[0].rig={sensors: []}' \
    --set 'record={terrain: [height], pixel_m: 2}' --out $seeds/bare >/dev/null
  for form in "mcap_zstd rosbag2 --compression zstd" "mcap_none rosbag2 --compression none" "sqlite rosbag2 --storage sqlite3" \
    "ros1 bag"; do
    # shellcheck disable=SC2086
    set -- $form
    "$tera" export $seeds/bare --to "${@:2}" --out "$seeds/$1" >/dev/null
    for file in "$seeds/$1"/*.mcap "$seeds/$1"/*.db3 "$seeds/$1"/*.bag; do
      if [ -e "$file" ]; then
        seed bag "$1" "$file"
        seed suggest "$1" "$file"
      fi
    done
  done
  for file in "$run"/m/camera/*/*.png; do seed png "$((n += 1))" "$file"; done
  for file in "$run"/m/camera/boxes/*.json; do seed boxes "$((n += 1))" "$file"; done
  for file in "$run"/m/lidar/scans/*.pcd; do seed pcd "$((n += 1))" "$file"; done
  for file in "$run"/m/imu/data.csv "$run"/m/gnss/data.csv "$run"/m/commands.csv "$run"/truth/m/pose.csv; do
    head -n 5 "$file" >$seeds/rows
    seed csv "$((n += 1))" $seeds/rows
    seed suggest "$n" $seeds/rows
    with_zero dataset "$n" "$run/dataset.yaml" $seeds/rows
  done
  printf '\0std_msgs/Header header\nfloat64[] position\nstring[] name\nint8[3] a\n===\nMSG: std_msgs/Header\ntime stamp\n' >$seeds/text
  head -c 200 /dev/zero >$seeds/zeros
  with_zero message cdr $seeds/text $seeds/zeros
  for file in config/scenarios/*.yaml config/machines/*.yaml config/rigs/*.yaml; do seed config "$(basename "$file")" "$file"; done
  for file in config/scenarios/*.yaml; do sed 's#\.\./#tera:config/#g' "$file" >$seeds/text; seed scenario "$(basename "$file")" $seeds/text; done
  seed urdf digger.urdf examples/machines/digger.urdf
  n=0
  for file in assets/rock.glb assets/cone.glb; do { printf '\0'; cat "$file"; } >$seeds/text; seed mesh "$((n += 1))" $seeds/text; done
  printf '\2solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n' >$seeds/text
  seed mesh stl $seeds/text
  printf '\3v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >$seeds/text
  seed mesh obj $seeds/text
  # A first byte chooses the form of clouds (PCD, PLY, LAS) and of logs (ULog, RTKLIB's, NMEA 0183, KITTI's).
  n=0
  for form in pcd ply las; do
    "$tera" export $run --to $form --out $seeds/map_$form >/dev/null
    { printf '%b' "\\0$n"; cat $seeds/map_$form/map.$form; } >$seeds/text
    seed cloud $form $seeds/text
    n=$((n + 1))
  done
  for file in "$run"/m/lidar/scans/*.pcd; do { printf '\0'; cat "$file"; } >$seeds/text; seed cloud "$(basename "$file")" $seeds/text; done
  printf '\1ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n4 5 6\n' >$seeds/text
  seed cloud ascii $seeds/text
  printf '\0ULog\1\x12\x35\1\0\0\0\0\0\0\0\0\x20\0Fa:uint64_t timestamp;float v[2];' >$seeds/text
  printf '\4\0A\0\0\0a\x12\0D\0\0\x40\x42\x0f\0\0\0\0\0\0\0\x80\x3f\0\0\0\x40' >>$seeds/text
  seed log ulg $seeds/text
  for form in "1 pos" "2 nmea"; do
    # shellcheck disable=SC2086
    set -- $form
    "$tera" export $run --to "$2" --out "$seeds/gnss_$2" >/dev/null
    { printf '%b' "\\0$1"; head -n 9 "$seeds/gnss_$2/m/gnss.$2"; } >$seeds/text
    seed log "$2" $seeds/text
  done
  { printf '\3%s\n\0' "2011-09-26 13:02:25.964389445"; printf '1.5 %.0s' {1..25}; printf '1 2 3 4 5\n'; } >$seeds/text
  seed log oxts $seeds/text
  for file in "$run"/truth/terrain/*.tif; do seed raster "$(basename "$file")" "$file"; done
  printf '{"verdict": "named", "findings": [{"channel": "boom", "rmse": [2.2, 1.5], "why": null}], "tera_version": "0"}' >$seeds/text
  seed diagnosis named $seeds/text
}
make_seeds

TERA_FUZZ_FOLDER=$(mktemp -d -p /dev/shm tera_fuzz_XXXXXX)
export TERA_FUZZ_FOLDER
trap 'rm -rf "$TERA_FUZZ_FOLDER"' EXIT
status=0
for reader in "${readers[@]}"; do
  corpus=out/fuzz/$reader
  mkdir -p "$corpus" "$seeds/$reader"
  if ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 build/fuzz/test/fuzz/"${reader}"_fuzz -max_total_time="$seconds" \
    -timeout=20 -rss_limit_mb=3000 -malloc_limit_mb=2500 -print_final_stats=1 -artifact_prefix="$corpus/found-" "$corpus" \
    "$seeds/$reader" 2>"out/fuzz/$reader.log"; then
    echo "$reader: nothing found in $seconds s, $(sed -n 's/^stat::number_of_executed_units: *//p' "out/fuzz/$reader.log") inputs"
  else
    echo "$reader: $(grep -m 1 -E 'SUMMARY|terminate|ERROR' "out/fuzz/$reader.log"); input in $corpus, report in out/fuzz/$reader.log"
    status=1
  fi
done
exit "$status"
