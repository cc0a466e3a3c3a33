"""What judges of exports read of a dataset, by docs/reference/dataset.md alone, with numpy, yaml and OpenCV's reader of PNG."""

import csv
import json
import sys
from pathlib import Path

import cv2
import numpy as np
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "python"))
from tera.data.pcd import read_pcd  # noqa: E402

# The optical frame (x right, y down, z forward) in the sensor's (x forward, y left, z up).
OPTICAL = np.array([[0, 0, 1, 0], [-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1]], dtype=float)


def rotation(q):
    """Of a unit quaternion w, x, y, z."""
    w, x, y, z = np.asarray(q) / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def pose(p, q):
    X = np.eye(4)
    X[:3, :3], X[:3, 3] = rotation(q), p
    return X


class Poses:
    """truth/.../NAME.csv; between its rows positions are linear, quaternions normalised after the same."""

    def __init__(self, file):
        with open(file, newline="") as text:
            rows = list(csv.reader(text))[1:]
        self.t_ns = np.array([int(r[0]) for r in rows])
        self.values = np.array([[float(v) for v in r[1:8]] for r in rows])
        for before, row in zip(self.values, self.values[1:]):  # one sign, so that means are between
            if before[3:] @ row[3:] < 0:
                row[3:] *= -1

    def at(self, t_ns):
        row = [np.interp(t_ns, self.t_ns, self.values[:, c]) for c in range(7)]
        return pose(row[:3], row[3:])


class Recorded:
    def __init__(self, folder):
        self.folder = Path(folder)
        self.about = yaml.safe_load((self.folder / "dataset.yaml").read_text())
        self.instances = {i["id"]: i for i in self.about["instances"]}
        self.classes = {c["id"]: c["name"] for c in self.about["classes"]}

    def sheet(self, sensor):
        return yaml.safe_load((self.folder / sensor / "sensor.yaml").read_text())

    def mount(self, sensor):
        place = self.sheet(sensor)["X_parent_sensor"]
        return pose(place["xyz_m"], place["quaternion_wxyz"])

    def lens(self, camera):
        """K and the coefficients in OpenCV's order."""
        model = self.sheet(camera)["model"]
        K = np.array([[model["fx_px"], 0, model["cx_px"]], [0, model["fy_px"], model["cy_px"]], [0, 0, 1]], dtype=float)
        names = ("k1", "k2", "p1", "p2", "k3") + (("k4", "k5", "k6") if model.get("lens") == "rational" else ())
        return K, np.array([model.get(k, 0) for k in names], dtype=float)

    def sensor_poses(self, sensor):
        machine, name = sensor.split("/")
        return Poses(self.folder / "truth" / machine / "sensors" / f"{name}.csv")

    def times(self, sensor):
        with open(self.folder / sensor / "data.csv", newline="") as text:
            return [int(row[0]) for row in list(csv.reader(text))[1:]]

    def rows(self, sensor):
        with open(self.folder / sensor / "data.csv", newline="") as text:
            return np.array([[float(v) for v in row] for row in list(csv.reader(text))[1:]])

    def picture(self, camera, kind, t_ns):
        picture = cv2.imread(str(self.folder / camera / kind / f"{t_ns}.png"), cv2.IMREAD_UNCHANGED)
        return picture[..., ::-1] if picture.ndim == 3 else picture

    def boxes(self, camera, t_ns):
        return json.loads((self.folder / camera / "boxes" / f"{t_ns}.json").read_text())["boxes"]

    def scan(self, lidar, t_ns):
        return read_pcd(self.folder / lidar / "scans" / f"{t_ns}.pcd")

    def ids_of(self, whole):
        """The object and all that are parts of it."""
        ids = {whole}
        while True:
            more = {i for i, entry in self.instances.items() if entry.get("parent", 0) in ids} - ids
            if not more:
                return ids
            ids |= more
