"""Holds an export in SemanticKITTI's format against the dataset that it was made from, by the README of its development kit:
scans are read as it reads them, poses turned into the lidar's frame by `Tr` as its scripts do.

    python3 check_semantickitti.py DATASET EXPORT LIDAR

Prints what it has seen as JSON; the first thing that is wrong ends it with status 1.
"""

import json
import sys
from pathlib import Path

import numpy as np
import yaml

from recorded import OPTICAL, Recorded


def need(condition, *told):
    if not condition:
        sys.exit("check_semantickitti: " + " ".join(str(t) for t in told))


def homogeneous(text):
    return np.vstack([np.array(text.split(), float).reshape(3, 4), [0, 0, 0, 1]])


def apply(X, points):
    return points @ X[:3, :3].T + X[:3, 3]


def check_classes(data, folder, counts):
    about = yaml.safe_load((folder / "semantic-kitti.yaml").read_text())
    names = dict(data.classes) | {0: "unlabeled"}
    need(about["labels"] == names, about["labels"])
    for key in ("color_map", "content", "learning_map", "learning_map_inv", "learning_ignore"):
        need(set(about[key]) == set(names), key, about[key])
    need(all(len(c) == 3 and max(c) < 256 for c in about["color_map"].values()), "colours")
    need(all(about["learning_map_inv"][train] == raw for raw, train in about["learning_map"].items()), "learning_map")
    need([k for k, ignored in about["learning_ignore"].items() if ignored] == [0], "learning_ignore")
    need(about["split"] == {"train": [0], "valid": [], "test": []}, "split")
    share = counts / counts.sum()
    need(all(abs(about["content"][k] - share[k]) < 1e-9 for k in names), "content", about["content"])


def main():
    data, folder, lidar = Recorded(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
    sequence, truth, times = folder / "sequences/00", data.sensor_poses(lidar), data.times(lidar)
    calib = dict(line.split(": ", 1) for line in (sequence / "calib.txt").read_text().splitlines())
    Tr = homogeneous(calib["Tr"])
    need(np.allclose(np.linalg.inv(Tr), OPTICAL, atol=1e-12), "Tr", Tr)
    poses = [np.linalg.inv(Tr) @ homogeneous(line) @ Tr for line in (sequence / "poses.txt").read_text().splitlines()]
    seconds = np.array((sequence / "times.txt").read_text().split(), float)
    need(len(poses) == len(seconds) == len(times), len(poses), len(seconds), len(times))
    need(np.allclose(seconds, (np.array(times) - times[0]) * 1e-9, atol=1e-9), "times")
    counts, instances, moved = np.zeros(len(data.classes), int), set(), 0.0
    for k, t_ns in enumerate(times):
        scan = data.scan(lidar, t_ns)
        points = np.fromfile(sequence / "velodyne" / f"{k:06d}.bin", dtype=np.float32).reshape(-1, 4)
        label = np.fromfile(sequence / "labels" / f"{k:06d}.label", dtype=np.uint32)
        need(len(points) == len(label) == len(scan), len(points), len(label), len(scan))
        need((label & 0xFFFF == scan["label"]).all() and (label >> 16 == scan["instance"]).all(), "labels of", k)
        need(np.allclose(points[:, 3], scan["intensity"]), "remissions of", k)
        need(np.allclose(truth.at(times[0]) @ poses[k], truth.at(t_ns), atol=1e-5), "pose", k)
        own = np.column_stack([scan["x"], scan["y"], scan["z"]]).astype(float)
        placed = apply(truth.at(times[0]) @ poses[k], points[:, :3].astype(float))
        for i in range(0, len(scan), 97):
            then = apply(truth.at(t_ns + int(scan["time"][i])), own[i:i + 1])[0]
            need(np.abs(placed[i] - then).max() < 2e-3, "point", i, "of", k, placed[i], then)
        moved = max(moved, np.abs(points[:, :3] - own).max())
        counts += np.bincount(scan["label"], minlength=len(counts))
        instances |= set(np.unique(scan["instance"]).tolist()) - {0}
    check_classes(data, folder, counts)
    print(json.dumps({"frames": len(times), "points": int(counts.sum()), "classes": int((counts > 0).sum()),
                      "instances": len(instances), "most_moved_m": round(float(moved), 4)}))


if __name__ == "__main__":
    main()
