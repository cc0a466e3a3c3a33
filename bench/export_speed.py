"""How fast `tera export` writes each format, beside a copy of the bytes that it has written, which is what the disk allows.

    python3 bench/export_speed.py TERA DATASET [FORMAT ...]

TERA: the program. Formats that need more than DATASET are left out: name those that it has. Each is exported once into a
folder beside DATASET and removed again; what the system had buffered is written out in both times (`sync`). The target is
150 MB/s where copying does as much; a format that is below both is marked, and the last line counts them.
"""

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

FORMATS = {
    "rosbag2": [], "rosbag2 uncompressed": ["--compression", "none"], "rosbag2 png": ["--images", "compressed"],
    "bag": [], "pcd": [], "las": [], "coco": [], "kitti": [], "nuscenes": [], "semantickitti": [], "webdataset": [],
}
TARGET_MBPS = 150


def timed(command):
    start = time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True)
    os.sync()
    return time.perf_counter() - start, done


def size_mb(folder):
    return sum(f.stat().st_size for f in folder.rglob("*") if f.is_file()) / 1e6


def main():
    tera, dataset = sys.argv[1], Path(sys.argv[2])
    out, copy = dataset.parent / "export_speed", dataset.parent / "export_speed_copy"
    missed = 0
    print(f"{'format':<22}{'MB':>9}{'s':>8}{'MB/s':>8}{'copy MB/s':>11}{'share':>8}")
    for name in sys.argv[3:] or FORMATS:
        os.sync()
        took_s, done = timed([tera, "export", str(dataset), "--to", name.split()[0], "--out", str(out)] + FORMATS.get(name, []))
        if done.returncode != 0:
            print(f"{name:<22} {done.stderr.strip().splitlines()[-1][:100]}")
            continue
        megabytes = size_mb(out)
        copy_s, _ = timed(["cp", "-r", str(out), str(copy)])
        speed, limit = megabytes / took_s, megabytes / copy_s
        is_missed = speed < min(TARGET_MBPS, limit)
        missed += is_missed
        print(f"{name:<22}{megabytes:>9.1f}{took_s:>8.2f}{speed:>8.1f}{limit:>11.1f}{speed / limit:>8.2f}{'  below' if is_missed else ''}")
        shutil.rmtree(out)
        shutil.rmtree(copy)
    print(f"{missed} below {TARGET_MBPS} MB/s and the copy")


if __name__ == "__main__":
    main()
