"""How fast `tera export` writes each format, beside a copy of the bytes that it has written, which is what the disk allows.

    python3 bench/export_speed.py TERA DATASET [FORMAT ...] [--beside FOLDER]

TERA: the program. Formats that need more than DATASET are left out: name those that it has. Each is exported once into a
folder beside DATASET, or in FOLDER, and removed again; what the system had buffered is written out in both times (`sync`). The
target is 150 MB/s where copying does as much; a format that is below both is marked, and the last line counts them. Beside it:
processor time over time, which is how many cores it had work for, and the most memory that it held.

The 0.1 s in which the program starts weigh on small formats: `scripts/view_speed.py repeat DATASET OUT --times 15` makes a
dataset that is large.
"""

import argparse
import os
import shutil
import subprocess
import time
from pathlib import Path

FORMATS = {
    "rosbag2": [], "rosbag2 uncompressed": ["--compression", "none"], "rosbag2 png": ["--images", "compressed"],
    "bag": [], "pcd": [], "las": [], "coco": [], "kitti": [], "nuscenes": [], "semantickitti": [], "webdataset": [],
}
TARGET_MBPS = 150


def timed(command):
    """Seconds with what is written out, those of the processor, the most memory in MB, exit status, and what was said."""
    start = time.perf_counter()
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as child:
        said = child.stderr.read()
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    processor_s = used.ru_utime + used.ru_stime
    os.sync()
    return time.perf_counter() - start, processor_s, used.ru_maxrss / 1000, child.returncode, said


def size_mb(folder):
    return sum(f.stat().st_size for f in folder.rglob("*") if f.is_file()) / 1e6


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tera")
    parser.add_argument("dataset", type=Path)
    parser.add_argument("formats", nargs="*", metavar="FORMAT")
    parser.add_argument("--beside", type=Path, help="where it is written; beside the dataset")
    asked = parser.parse_args()
    beside = asked.beside or asked.dataset.parent
    out, copy = beside / "export_speed", beside / "export_speed_copy"
    missed = 0
    print(f"{'format':<22}{'MB':>9}{'s':>8}{'MB/s':>8}{'copy MB/s':>11}{'share':>8}{'cores':>7}{'memory MB':>11}")
    for name in asked.formats or FORMATS:
        os.sync()
        took_s, processor_s, memory_mb, status, said = timed(
            [asked.tera, "export", str(asked.dataset), "--to", name.split()[0], "--out", str(out)] + FORMATS.get(name, []))
        if status != 0:
            print(f"{name:<22} {said.strip().splitlines()[-1][:100]}")
            continue
        megabytes = size_mb(out)
        copy_s = timed(["cp", "-r", str(out), str(copy)])[0]
        speed, limit = megabytes / took_s, megabytes / copy_s
        is_missed = speed < min(TARGET_MBPS, limit)
        missed += is_missed
        print(f"{name:<22}{megabytes:>9.1f}{took_s:>8.2f}{speed:>8.1f}{limit:>11.1f}{speed / limit:>8.2f}{processor_s / took_s:>7.2f}"
              f"{memory_mb:>11.0f}{'  below' if is_missed else ''}")
        shutil.rmtree(out)
        shutil.rmtree(copy)
    print(f"{missed} below {TARGET_MBPS} MB/s and the copy")


if __name__ == "__main__":
    main()
