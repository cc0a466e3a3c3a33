"""Pictures and their labels."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from tera.data.lens import Lens
from tera.data.pose import pose_matrix
from tera.data.table import nearest


def read_png(file: Path) -> np.ndarray:
    """A PNG of 8 or 16 bits as it is, H x W or H x W x 3 in the order red, green, blue."""
    try:
        import cv2
    except ImportError as error:
        raise ImportError("pictures are read by OpenCV: install python3-opencv or opencv-python-headless") from error
    picture = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
    if picture is None:
        raise ValueError(f"{file} is missing or no PNG")
    return np.ascontiguousarray(picture[..., ::-1]) if picture.ndim == 3 else picture


@dataclass(frozen=True)
class Keypoint:
    """A named point of an object in view."""

    OUTSIDE, HIDDEN, SEEN = 0, 1, 2

    name: str
    sight: int  #: one of the three above
    p_C_m: np.ndarray  #: in the optical frame
    pixel_px: np.ndarray | None  #: u, v, also beyond the picture; None behind the camera


@dataclass(frozen=True)
class Box:
    """A labelled object in view."""

    instance: int
    name: str
    label: str  #: class
    parent: int  #: instance that it is a part of, 0 for none
    x_min_px: int
    y_min_px: int
    x_max_px: int  #: inclusive, as all
    y_max_px: int
    visible_px: int
    visibility: float  #: over the pixels that it alone would cover
    X_CO: np.ndarray  #: 4 x 4, of the 3-D box's centre in the optical frame
    size_O_m: np.ndarray
    amodal_px: np.ndarray | None = None  #: left, top, right, bottom of all that it would cover alone
    truncation: float | None = None  #: share of that beyond the picture
    keypoints: tuple[Keypoint, ...] = ()
    light: dict | None = None  #: blur_px, most_blur_px, luminance_cdpm2, illuminance_lx, shadow, where labelled


class Flow:
    """Where another picture has the points that one picture's pixels show."""

    UNKNOWN, SEEN, HIDDEN, OUTSIDE = 0, 1, 2, 3

    def __init__(self, code: np.ndarray):
        self.state = code[..., 2]  #: H x W: one of the four above
        self.flow_px = (code[..., :2].astype(np.float32) - 32768) / 64  #: H x W x 2, right and down
        self.flow_px[self.state == self.UNKNOWN] = np.nan

    def write_flo(self, file: Path | str) -> None:
        """As Middlebury's .flo; what is not known is 1e10, which its readers take for unknown."""
        height, width = self.state.shape
        with Path(file).open("wb") as out:
            out.write(b"PIEH" + np.array([width, height], "<i4").tobytes())
            out.write(np.nan_to_num(self.flow_px, nan=1e10).astype("<f4").tobytes())


class Frame:
    """One exposure of a camera. Pictures are read when they are asked for; those that it has not are None."""

    def __init__(self, folder: Path, filename: str, t_ns: int, lens: Lens | None):
        self._folder, self._filename = folder, filename
        self.t_ns, self.lens = t_ns, lens

    def _picture(self, kind: str) -> np.ndarray | None:
        file = self._folder / kind / self._filename
        return read_png(file) if file.exists() else None

    @cached_property
    def rgb(self) -> np.ndarray | None:
        """H x W x 3 uint8, sRGB."""
        return self._picture("rgb")

    @cached_property
    def depth_m(self) -> np.ndarray | None:
        """H x W float32, along the optical axis; 0 without a measurement."""
        millimetres = self._picture("depth")
        return None if millimetres is None else millimetres.astype(np.float32) * np.float32(1e-3)

    @cached_property
    def semantic(self) -> np.ndarray | None:
        """H x W uint8, class ids."""
        return self._picture("semantic")

    @cached_property
    def instance(self) -> np.ndarray | None:
        """H x W uint16, instance ids, 0 for none."""
        return self._picture("instance")

    @cached_property
    def normal_C(self) -> np.ndarray | None:
        """H x W x 3 float32, unit normals in the optical frame; NaN where there is no surface."""
        code = self._picture("normal")
        if code is None:
            return None
        normal = code.astype(np.float32) / 32767 - 1
        normal[~code.any(axis=2)] = np.nan
        return normal

    @cached_property
    def distance_m(self) -> np.ndarray | None:
        """H x W float32, from the eye along the ray, without noise; 0 where nothing is within 65.535 m."""
        millimetres = self._picture("distance")
        return None if millimetres is None else millimetres.astype(np.float32) * np.float32(1e-3)

    @cached_property
    def flow_to_previous(self) -> Flow | None:
        """From this picture's pixels to the previous picture."""
        code = self._picture("flow_to_previous")
        return None if code is None else Flow(code)

    @cached_property
    def flow_to_this(self) -> Flow | None:
        """From the previous picture's pixels to this picture: that picture's forward flow."""
        code = self._picture("flow_to_this")
        return None if code is None else Flow(code)

    @cached_property
    def scene_flow_to_previous_m(self) -> np.ndarray | None:
        """H x W x 3 float32: the point's place in the optical frame at the previous picture less its place now; NaN
        where it is not known."""
        code = self._picture("scene_flow_to_previous")
        if code is None:
            return None
        shift_m = (code.astype(np.float32) - 32768) * np.float32(1e-3)
        shift_m[~code.any(axis=2)] = np.nan
        return shift_m

    @cached_property
    def ground_soil(self) -> np.ndarray | None:
        """H x W uint8, index of the soil plus 1; 0 where no ground of the site is seen."""
        return self._picture("ground_soil")

    @cached_property
    def ground_state(self) -> np.ndarray | None:
        """H x W x 3 float32: looseness, degree of saturation and freshness of a rut, 0 to 1; 0 beside ground."""
        code = self._picture("ground_state")
        return None if code is None else code.astype(np.float32) / 255

    @cached_property
    def ground_change_m(self) -> np.ndarray | None:
        """H x W float32: how far the ground has risen since the first picture; NaN beside ground."""
        code = self._picture("ground_change")
        if code is None:
            return None
        return np.where(code == 0, np.nan, (code.astype(np.float32) - 32768) * np.float32(1e-3))

    @cached_property
    def ground_age_s(self) -> np.ndarray | None:
        """H x W float32: time since the ground was touched; inf where it never was, NaN beside ground."""
        code = self._picture("ground_age")
        if code is None:
            return None
        age_s = (code.astype(np.float32) - 1) / 10
        age_s[code == 65535] = np.inf
        age_s[code == 0] = np.nan
        return age_s

    @cached_property
    def dust_optical_depth(self) -> np.ndarray | None:
        """H x W float32: of the dust before what each pixel shows; exp(-it) of the light passes."""
        code = self._picture("dust_optical_depth")
        return None if code is None else code.astype(np.float32) / 1000

    @cached_property
    def _objects(self) -> dict:
        file = self._folder / "boxes" / (self._filename.rsplit(".", 1)[0] + ".json")
        if not file.exists():
            return {"boxes": []}
        with file.open(encoding="utf-8") as text:
            return json.load(text)

    @cached_property
    def boxes(self) -> list[Box]:
        """Objects in view; empty where none were recorded."""
        return [Box(b["instance"], b["name"], b["class"], b.get("parent", 0), b["x_min_px"], b["y_min_px"],
                    b["x_max_px"], b["y_max_px"], b["visible_px"], b["visibility"],
                    pose_matrix(np.array(b["p_CO_m"]), np.array(b["q_CO_wxyz"])), np.array(b["size_O_m"]),
                    np.array(b["amodal_px"]) if "amodal_px" in b else None, b.get("truncation"),
                    tuple(_keypoint(k) for k in b.get("keypoints", [])), b.get("light"))
                for b in self._objects["boxes"]]

    @property
    def exposure(self) -> dict | None:
        """exposure_s, f_number, gain_db, ev, saturation_cdpm2, balance; None where they were not labelled."""
        return self._objects.get("exposure")

    @property
    def loads(self) -> list[dict]:
        """What each shovel carries: instance, name, visible_px, volume_m3, mass_kg, fill, released_kgps (not of
        the first frame); empty where it was not labelled."""
        return self._objects.get("loads", [])

    @cached_property
    def panoptic(self) -> np.ndarray | None:
        """H x W uint32: class + 256 instance, as COCO's panoptic pictures number segments."""
        code = self._picture("panoptic")
        return None if code is None else code.astype(np.uint32) @ np.array([1, 1 << 8, 1 << 16], np.uint32)

    @cached_property
    def soil_in_flight(self) -> np.ndarray | None:
        """H x W bool: soil in the air or on its way down a slope."""
        code = self._picture("soil_in_flight")
        return None if code is None else code > 0

    @cached_property
    def lens_soiling(self) -> np.ndarray | None:
        """H x W float32: share of the light that comes undeviated through the soiled glass."""
        code = self._picture("lens_soiling")
        return None if code is None else code.astype(np.float32) / 255


def _keypoint(k: dict) -> Keypoint:
    pixel_px = np.array(k["pixel_px"]) if "pixel_px" in k else None
    return Keypoint(k["name"], k["sight"], np.array(k["p_C_m"]), pixel_px)


class Camera:
    """The exposures of a camera, in the order of their times: a sequence of Frame."""

    def __init__(self, folder: Path, sensor: dict):
        self.folder, self.sensor = Path(folder), sensor
        model = sensor.get("model") or {}
        known = {key: model[key] for key in Lens.__dataclass_fields__ if key in model}
        needed = {"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px"}
        self.lens: Lens | None = Lens(**known) if needed <= known.keys() else None
        self.t_ns, self.filenames = read_frame_list(self.folder / "data.csv")

    def __len__(self) -> int:
        return len(self.t_ns)

    def __getitem__(self, k: int) -> Frame:
        if not -len(self) <= k < len(self):
            raise IndexError(f"{self.folder} has {len(self)} frames; asked for number {k}")
        return Frame(self.folder, self.filenames[k], int(self.t_ns[k]), self.lens)

    def at(self, t_ns: int) -> Frame:
        """The frame whose time is nearest."""
        return self[nearest(self.t_ns, t_ns, str(self.folder))]


def read_frame_list(file: Path) -> tuple[np.ndarray, list[str]]:
    """Stamps and file names of a sensor whose measurements are files."""
    with file.open(encoding="utf-8") as lines:
        rows = [line.rstrip("\n").split(",") for line in lines][1:]
    return np.array([int(row[0]) for row in rows], dtype=np.int64), [row[1] for row in rows]
