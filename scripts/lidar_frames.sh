#!/usr/bin/env bash
# Usage: scripts/lidar_frames.sh RECORDINGS OUT
# Compares frames of real lidars (RECORDINGS/lidar_ouster, lidar_velodyne, lidar_hesai) with scans of the presets in
# config/scenarios/lidar_plane.yaml: the figures of docs/evidence/lidar.md, "Held against real frames". Another program
# than build/release/tera is named by TERA.
set -euo pipefail
recordings=$(realpath "$1")
out=$2
source_dir=$(cd "$(dirname "$0")/.." && pwd)
tera=${TERA:-$source_dir/build/release/tera}
mkdir -p "$out"

# compare NAME PRESET SOURCE: SOURCE is the lidar's keys in a mapping.
compare() {
  local name=$1 preset=$2 source=$3
  printf 'name: %s\nmachine: mast1\nzero: start\nlidars: [{name: lidar, %s}]\n' "$name" "$source" > "$out/$name.yaml"
  echo "== $name, preset $preset"
  "$tera" import "$out/$name.yaml" --out "$out/real_$name" | grep -E '% of the rays|second returns' || true
  "$tera" generate "$source_dir/config/scenarios/lidar_plane.yaml" --out "$out/sim_$name" \
    --set "machines[0].rig.sensors[0].preset=tera:config/sensors/$preset.yaml" > "$out/sim_$name.log"
  "$tera" compare "$out/real_$name" "$out/sim_$name" --json "$out/$name.json" |
    sed -n '/points a scan/p; /range, %/p; /deviation on planes/,/quantiles/p'
}

ouster=$recordings/lidar_ouster
compare os0_32 os0_128 "file: $ouster/OS-0-32-U1_v2.2.0_1024x10.pcap, metadata: $ouster/OS-0-32-U1_v2.2.0_1024x10.json, returns: all"
compare os1_128 os1_128 "file: $ouster/OS-1-128_v2.3.0_1024x10_lb_n3.pcap, metadata: $ouster/OS-1-128_v2.3.0_1024x10.json, returns: all"
velodyne=$recordings/lidar_velodyne
compare vlp16 vlp16 "file: $velodyne/1673400471837873222_0.db3, topic: /velodyne_packets, unit: vlp16, returns: all"
compare vlp32c vlp32c "file: $velodyne/vlp32_1713492677464078412_0.db3, topic: /sensing/lidar/front/velodyne_packets, unit: vlp32c, returns: all"
compare qt64 qt64 "file: $recordings/lidar_hesai/1673401195788312575_0.db3, topic: /pandar_packets, unit: qt64, returns: all"
