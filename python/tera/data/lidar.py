"""Scans."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tera.data.camera import read_frame_list
from tera.data.pcd import read_pcd
from tera.data.table import nearest


class Scan:
    """One revolution: a structured array of its points and views on it."""

    def __init__(self, t_ns: int, points: np.ndarray):
        self.t_ns, self.points = t_ns, points

    def __len__(self) -> int:
        return len(self.points)

    @property
    def xyz_m(self) -> np.ndarray:
        """N x 3 float32 in the sensor frame, each at the time of its own ray."""
        return np.column_stack([self.points["x"], self.points["y"], self.points["z"]])

    @property
    def point_t_ns(self) -> np.ndarray:
        """N int64, the time of each point's own ray."""
        return self.t_ns + self.points["time"].astype(np.int64)


class Lidar:
    """The scans of a lidar, in the order of their times: a sequence of Scan, read when they are asked for."""

    def __init__(self, folder: Path, sensor: dict):
        self.folder, self.sensor = Path(folder), sensor
        self.t_ns, self.filenames = read_frame_list(self.folder / "data.csv")

    def __len__(self) -> int:
        return len(self.t_ns)

    def __getitem__(self, k: int) -> Scan:
        if not -len(self) <= k < len(self):
            raise IndexError(f"{self.folder} has {len(self)} scans; asked for number {k}")
        return Scan(int(self.t_ns[k]), read_pcd(self.folder / "scans" / self.filenames[k]))

    def at(self, t_ns: int) -> Scan:
        """The scan whose first ray is nearest to a time."""
        return self[nearest(self.t_ns, t_ns, str(self.folder))]
