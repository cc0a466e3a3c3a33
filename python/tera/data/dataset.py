"""A recording as a whole."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import yaml

from tera.data.camera import Camera
from tera.data.events import Events
from tera.data.lidar import Lidar
from tera.data.pose import PoseTrack, inverse
from tera.data.table import Table

Channel = Table | Camera | Lidar | PoseTrack | Events


class Epoch(NamedTuple):
    """When the times of a recording are 0."""

    since_1970_ns: int
    clock: str  #: `utc` (Unix time), `gps` (ahead of it by the leap seconds since 1980) or `unknown`

#: Pose of the optical frame C in a camera's sensor frame S: z of C is x of S, x of C is -y of S.
X_SC = np.array([[0.0, 0, 1, 0], [-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1]])


class Dataset:
    """A recording of TERA, simulated or real (docs/reference/dataset.md).

    `dataset["excavator1/imu_boom"]` is a channel, by its path in dataset.yaml without `.csv` or with it; `for path in
    dataset` goes over all paths; `dataset.sensor(path)` is a sensor's own sensor.yaml. Nothing but dataset.yaml is read before it is
    asked for.

    Raises FileNotFoundError where there is no dataset.yaml, ValueError for a format that is newer than this reader.
    """

    def __init__(self, path: str | Path):
        self.path = Path(path)
        if not (self.path / "dataset.yaml").is_file():
            raise FileNotFoundError(f"{self.path}: is no complete recording, it has no dataset.yaml; name the folder that holds it")
        with (self.path / "dataset.yaml").open(encoding="utf-8") as text:
            self.info: dict = yaml.safe_load(text)
        if self.info.get("format") != 1:
            raise ValueError(f"{self.path / 'dataset.yaml'}: format is {self.info.get('format')}; this reader knows 1")
        self.types: dict[str, str] = {c["path"]: c["type"] for c in self.info.get("channels", [])}
        self.classes: dict[int, str] = {c["id"]: c["name"] for c in self.info.get("classes", [])}
        self.instances: dict[int, dict] = {i["id"]: i for i in self.info.get("instances", [])}
        self._channels: dict[str, Channel] = {}
        self._sensors: dict[str, dict] = {}

    @property
    def epoch(self) -> Epoch | None:
        """When t_ns 0 was, exact to the nanosecond; None where dataset.yaml does not say."""
        epoch = self.info.get("epoch")
        return Epoch(int(epoch["since_1970_ns"]), epoch.get("clock", "unknown")) if epoch else None

    def __repr__(self) -> str:
        return f"Dataset({str(self.path)!r}): {len(self.types)} channels"

    def __iter__(self) -> Iterator[str]:
        return iter(self.types)

    def __len__(self) -> int:
        return len(self.types)

    def __contains__(self, path: str) -> bool:
        return path in self.types or f"{path}.csv" in self.types

    def __getitem__(self, path: str) -> Channel:
        """A channel; one of kind `pose` is a PoseTrack, one of kind `events` Events. Raises KeyError with the paths that there are."""
        known = path if path in self.types else f"{path}.csv"
        if known not in self.types:
            raise KeyError(f"{self.path} has no channel {path!r}; it has {', '.join(self.types)}")
        if known not in self._channels:
            self._channels[known] = self._open(known)
        return self._channels[known]

    def _open(self, path: str) -> Channel:
        kind, place = self.types[path], self.path / path
        if kind == "camera":
            return Camera(place, self.sensor(path))
        if kind == "lidar":
            return Lidar(place, self.sensor(path))
        if kind == "pose":
            return PoseTrack(place)
        if kind == "events":
            return Events(place)
        return Table(place if place.suffix == ".csv" else place / "data.csv")

    def sensor(self, path: str) -> dict:
        """sensor.yaml of a sensor: type, parent_link, X_parent_sensor, rate_hz, latency_s, model."""
        if path not in self._sensors:
            with (self.path / path / "sensor.yaml").open(encoding="utf-8") as text:
                self._sensors[path] = yaml.safe_load(text)
        return self._sensors[path]

    def parts_of(self, name: str) -> list[int]:
        """Ids of the instances that make an object, as a machine's links do; itself where it has no parts."""
        ids = [i for i, one in self.instances.items() if one["name"] == name]
        if not ids:
            raise KeyError(f"{self.path} has no instance {name!r}")
        parts = [i for i, one in self.instances.items() if one.get("parent") == ids[0]]
        return parts or ids

    # Frames

    def pose(self, frame: str, t_ns: int | np.ndarray) -> np.ndarray:
        """X_W(frame) at a time, 4 x 4, or at M times, M x 4 x 4.

        Frames are `W`; `<machine>`, its root link; `<machine>/<link>`; `<machine>/<sensor>`, as it truly is where the
        recording knows, else as documented; `<machine>/<camera>/optical`; `<obstacle>`. Raises KeyError where the
        recording does not tell: links and sensors that move need `record: {poses_hz: N}` in the scenario.
        """
        if frame == "W":
            return np.broadcast_to(np.eye(4), np.shape(t_ns) + (4, 4)).copy()
        if frame.endswith("/optical"):
            return self.pose(frame.removesuffix("/optical"), t_ns) @ X_SC
        machine, _, part = frame.partition("/")
        if not part:
            return self._track(f"truth/{machine}/pose.csv", frame).at(t_ns)
        if f"truth/{machine}/sensors/{part}.csv" in self.types:
            return self._track(f"truth/{machine}/sensors/{part}.csv", frame).at(t_ns)
        if frame in self.types:
            sensor = self.sensor(frame)
            X_LS = np.array(sensor["X_parent_sensor"]["matrix"], dtype=float)
            return self.pose(f"{machine}/{sensor['parent_link']}", t_ns) @ X_LS
        return self._track(f"truth/{machine}/links/{part}.csv", frame).at(t_ns)

    def _track(self, path: str, frame: str) -> PoseTrack:
        if path not in self.types:
            raise KeyError(f"{self.path} does not tell where {frame!r} is ({path}); record it with "
                           "record: {poses_hz: N} in the scenario")
        return self[path]

    def transform(self, to: str, of: str, t_ns: int | np.ndarray) -> np.ndarray:
        """X_(to)(of): the pose of frame `of` in frame `to`, both at the same time; 4 x 4 or M x 4 x 4."""
        return inverse(self.pose(to, t_ns)) @ self.pose(of, t_ns)

    # Several channels at one time

    def synchronised(self, reference: str, *others: str) -> "Synchronised":
        """Samples at the times of one channel with what others have nearest to them: a sequence for data loaders."""
        return Synchronised(self, reference, others)


class Synchronised:
    """`len`, `[k]` and iteration over samples: a dict of channel paths, with `t_ns`.

    Frames and scans are those whose time is nearest, however far off; of tables the last row that is not later, of poses the pose at the
    time. What PyTorch's and TensorFlow's loaders take as a dataset by index.
    """

    def __init__(self, dataset: Dataset, reference: str, others: tuple[str, ...]):
        self._reference = dataset[reference]
        self._channels = {path: dataset[path] for path in (reference, *others)}
        self.t_ns = self._common(self._reference.t_ns)

    def _common(self, stamps_ns: np.ndarray) -> np.ndarray:
        """Times of the reference at which tables and poses have begun, and poses have not ended."""
        keep = np.ones(len(stamps_ns), dtype=bool)
        for channel in self._channels.values():
            if isinstance(channel, (Table, PoseTrack)) and len(channel):
                keep &= stamps_ns >= channel.t_ns[0]
            if isinstance(channel, PoseTrack) and len(channel):
                keep &= stamps_ns <= channel.t_ns[-1]
        return stamps_ns[keep]

    def __len__(self) -> int:
        return len(self.t_ns)

    def __getitem__(self, k: int) -> dict:
        if not -len(self) <= k < len(self):
            raise IndexError(f"{len(self)} samples; asked for number {k}")
        t_ns = int(self.t_ns[k])
        return {"t_ns": t_ns, **{path: channel.at(t_ns) for path, channel in self._channels.items()}}

    def __iter__(self) -> Iterator[dict]:
        return (self[k] for k in range(len(self)))
