#!/usr/bin/env python3
"""An independent judge of the labels of a simulated dataset.

    check_labels.py DATASET [--frames N] [--max-shown N] [--json FILE]

It decodes every file itself, from docs/reference/dataset.md and docs/reference/scenario.md alone, and holds the labels of every frame of every
camera against each other, against the recorded poses and scans, and against the ground as it was left. Prints a table with the
worst number of each check; exits 0 when all agree, 1 with a list of what does not (path, frame, what, number), 2 when DATASET
is none. Poses of links, sensors and obstacles are needed for motion: `record: {poses_hz: N}` with frames at whole multiples.

Limits are derived where they stand. They come from: millimetres that are rounded (half a millimetre), flow that is rounded
(1/128 px), and pixels: a label behind a lens that distorts is that of the nearest pixel of a finer picture, so that its point may
lie up to RAY_PX from the ray through the pixel's middle. Where a limit holds for a share of pixels only, it says why.
"""

import argparse
import ctypes
import ctypes.util
import json
import math
import os
import struct
import subprocess
import sys
import tempfile

import cv2
import numpy as np
import yaml

COCO = ["nose", "left_eye", "right_eye", "left_ear", "right_ear", "left_shoulder", "right_shoulder", "left_elbow", "right_elbow",
        "left_wrist", "right_wrist", "left_hip", "right_hip", "left_knee", "right_knee", "left_ankle", "right_ankle"]
KNOWN = ["semantic", "instance", "normal", "distance", "flow_to_previous", "flow_to_this", "scene_flow_to_previous",
         "ground_soil", "ground_state", "ground_change", "ground_age", "dust_optical_depth", "panoptic", "soil_in_flight"]
FORM = {"rgb": (np.uint8, 3), "depth": (np.uint16, 1), "semantic": (np.uint8, 1), "instance": (np.uint16, 1),
        "normal": (np.uint16, 3), "distance": (np.uint16, 1), "flow_to_previous": (np.uint16, 3), "flow_to_this": (np.uint16, 3),
        "scene_flow_to_previous": (np.uint16, 3), "ground_soil": (np.uint8, 1), "ground_state": (np.uint8, 3),
        "ground_change": (np.uint16, 1), "ground_age": (np.uint16, 1),
        "dust_optical_depth": (np.uint16, 1), "panoptic": (np.uint8, 3), "soil_in_flight": (np.uint8, 1)}

# C (x right, y down, z forward) in S (x forward, y left, z up).
R_SC = np.array([[0.0, 0, 1], [-1, 0, 0], [0, -1, 0]])


# ---------------------------------------------------------------------------------------------------------------- what is judged

class Judge:
    """Collects what each check found: how many numbers, the worst of them, the limit, and what was beyond it."""

    def __init__(self):
        self.rows = {}
        self.faults = []

    def _row(self, check, limit, unit):
        return self.rows.setdefault(check, {"n": 0, "worst": None, "limit": limit, "unit": unit, "faults": 0})

    def all_within(self, check, values, limit, path, frame, what, unit="", places=None):
        """Every value is at most `limit` (a number, or as many as there are values; the worst is then value / limit)."""
        values = np.asarray(values, float).reshape(-1)
        relative = np.ndim(limit) > 0
        row = self._row(check, 1.0 if relative else limit, "of limit" if relative else unit)
        if values.size == 0:
            return
        if relative:
            values = values / np.asarray(limit, float).reshape(-1)
        shown = 1.0 if relative else limit
        values = np.where(np.isfinite(values), values, np.inf)
        k = int(values.argmax())
        row["n"] += values.size
        row["worst"] = values[k] if row["worst"] is None else max(row["worst"], values[k])
        bad = int((values > shown).sum())
        if bad:
            row["faults"] += 1
            place = "" if places is None else f" at {tuple(np.round(np.asarray(places[k], float), 3).tolist())}"
            self.faults.append((path, frame, check, f"{what}: {values[k]:.6g} > {shown:g} {row['unit']}{place}, {bad} of {values.size}"))

    def share(self, check, good, least, path, frame, what, least_n=50, places=None):
        """At least a share `least` of the truth values holds; fewer than least_n say nothing. The worst is the least share."""
        good = np.asarray(good, bool).reshape(-1)
        row = self._row(check, least, "share, least")
        if good.size < least_n:
            return
        value = good.mean()
        row["n"] += good.size
        row["worst"] = value if row["worst"] is None else min(row["worst"], value)
        if value < least:
            row["faults"] += 1
            place = ""
            if places is not None:
                wrong = np.flatnonzero(~good)
                place = f", e.g. {tuple(int(x) for x in places[wrong[len(wrong) // 2]])}"
            self.faults.append((path, frame, check, f"{what}: only {value:.4f} of {good.size}, need {least}{place}"))

    def holds(self, check, ok, path, frame, what):
        row = self._row(check, 0, "wrong")
        row["n"] += 1
        row["worst"] = row["worst"] or 0
        if not ok:
            row["worst"] += 1
            row["faults"] += 1
            self.faults.append((path, frame, check, what))


# --------------------------------------------------------------------------------------------------------------------- files

def read_csv(path):
    with open(path) as f:
        names = f.readline().strip().split(",")
        rows = [line.strip().split(",") for line in f if line.strip()]
    return names, rows


def read_png(path):
    image = cv2.imread(path, cv2.IMREAD_UNCHANGED)
    if image is not None and image.ndim == 3:
        image = image[..., ::-1]  # BGR as OpenCV has it
    return image


def lzf(data, size):
    name = ctypes.util.find_library("lzf")
    if name:
        out = ctypes.create_string_buffer(size)
        if ctypes.CDLL(name).lzf_decompress(data, len(data), out, size) != size:
            raise ValueError("LZF: wrong size")
        return out.raw
    out = bytearray()
    i = 0
    while i < len(data):
        control = data[i]
        i += 1
        if control < 32:
            out += data[i:i + control + 1]
            i += control + 1
            continue
        length = control >> 5
        if length == 7:
            length += data[i]
            i += 1
        start = len(out) - ((control & 31) << 8) - data[i] - 1
        i += 1
        for k in range(length + 2):
            out.append(out[start + k])
    return bytes(out)


def read_pcd(path):
    with open(path, "rb") as f:
        header = {}
        while True:
            line = f.readline().decode("ascii").strip()
            if not line.startswith("#"):
                key, *values = line.split()
                header[key] = values
                if key == "DATA":
                    break
        count = int(header["POINTS"][0])
        if count == 0:
            return {}
        packed, size = struct.unpack("<II", f.read(8))
        data = lzf(f.read(packed), size)
    kinds = {"F4": "<f4", "U4": "<u4", "U2": "<u2", "U1": "u1"}
    fields, at = {}, 0
    for name, width, kind in zip(header["FIELDS"], header["SIZE"], header["TYPE"]):
        fields[name] = np.frombuffer(data, kinds[kind + width], count, at)
        at += count * int(width)
    return fields


class Raster:
    """A GeoTIFF of the site, by way of gdal_translate to a bare file of floats."""

    known = {}

    @classmethod
    def of(cls, path):
        """The same file, also by another hard link, is read once."""
        at = os.stat(path)
        key = (at.st_dev, at.st_ino, at.st_mtime_ns, at.st_size)
        if key not in cls.known:
            cls.known[key] = cls(path)
        return cls.known[key]

    def __init__(self, path):
        info = json.loads(subprocess.run(["gdalinfo", "-json", path], check=True, capture_output=True, text=True).stdout)
        self.width, self.height = info["size"]
        self.geo = info["geoTransform"]
        self.metadata = {}
        for block in [info.get("metadata", {}).get("", {})] + [b.get("metadata", {}).get("", {}) for b in info["bands"]]:
            self.metadata.update(block)
        with tempfile.TemporaryDirectory() as folder:
            raw = os.path.join(folder, "raw")
            subprocess.run(["gdal_translate", "-q", "-of", "ENVI", "-ot", "Float32", path, raw], check=True, capture_output=True)
            self.values = np.fromfile(raw, "<f4").reshape(self.height, self.width).astype(float)
        kernel = np.ones((3, 3), np.uint8)
        self.low, self.high = cv2.erode(self.values, kernel), cv2.dilate(self.values, kernel)

    def around(self, xy):
        """(low, high, inside): the least and the greatest of the 3 x 3 pixels about each place."""
        column = np.floor((xy[:, 0] - self.geo[0]) / self.geo[1]).astype(int)
        row = np.floor((xy[:, 1] - self.geo[3]) / self.geo[5]).astype(int)
        inside = (column >= 1) & (row >= 1) & (column < self.width - 1) & (row < self.height - 1)
        column, row = np.clip(column, 0, self.width - 1), np.clip(row, 0, self.height - 1)
        return self.low[row, column], self.high[row, column], inside


# --------------------------------------------------------------------------------------------------------------------- poses

def rotation(q):
    w, x, y, z = np.moveaxis(np.asarray(q, float), -1, 0)
    return np.stack([np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], -1),
                     np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], -1),
                     np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], -1)], -2)


def inverse(x):
    out = np.zeros_like(x)
    r = np.swapaxes(x[..., :3, :3], -1, -2)
    out[..., :3, :3] = r
    out[..., :3, 3] = -(r @ x[..., :3, 3:])[..., 0]
    out[..., 3, 3] = 1
    return out


def moved(x, p):
    return p @ x[:3, :3].T + x[:3, 3]


class Track:
    """Poses over time from t_ns,x,y,z,qw,qx,qy,qz; straight between rows, turns by normalised interpolation (rows are dense)."""

    def __init__(self, path):
        names, rows = read_csv(path)
        self.t = np.array([int(r[0]) for r in rows], np.int64)
        self.v = np.array([[float(x) for x in r[1:8]] for r in rows])

    def at(self, t):
        t = np.atleast_1d(np.asarray(t, np.int64))
        if len(self.t) == 1:
            v = np.repeat(self.v, len(t), 0)
        else:
            k = np.clip(np.searchsorted(self.t, t, side="right") - 1, 0, len(self.t) - 2)
            a = np.clip((t - self.t[k]) / (self.t[k + 1] - self.t[k]), 0, 1)[:, None]
            one, two = self.v[k], self.v[k + 1].copy()
            flip = (one[:, 3:] * two[:, 3:]).sum(1) < 0
            two[flip, 3:] *= -1
            v = one * (1 - a) + two * a
            v[:, 3:] /= np.linalg.norm(v[:, 3:], axis=1, keepdims=True)
        x = np.zeros((len(t), 4, 4))
        x[:, :3, :3] = rotation(v[:, 3:])
        x[:, :3, 3] = v[:, :3]
        x[:, 3, 3] = 1
        return x


# ---------------------------------------------------------------------------------------------------------------------- lens

class Lens:
    """docs/reference/scenario.md, Lenses: OpenCV's five and eight coefficients, Kannala and Brandt's and the f-theta law."""

    def __init__(self, model):
        self.law = model.get("lens", "brown_conrady")
        self.w, self.h = model["width_px"], model["height_px"]
        self.f = np.array([model["fx_px"], model["fy_px"]], float)
        self.c = np.array([model["cx_px"], model["cy_px"]], float)
        self.k = [float(model.get(f"k{i}", 0)) for i in range(1, 7)]
        self.p = [float(model.get("p1", 0)), float(model.get("p2", 0))]
        self.by_angle = self.law in ("kannala_brandt", "f_theta")
        self.distorts = self.by_angle or any(self.k) or any(self.p)
        self.theta_max = math.radians(model.get("field_of_view_deg", 180)) / 2 if self.by_angle else math.pi / 2
        v, u = np.mgrid[0:self.h, 0:self.w].astype(float)
        self.pixels = np.stack([u, v], -1)
        # Where the picture's ends are: a perspective law is only good up to the largest radius that the picture shows.
        if not self.by_angle:
            corner = self._perspective_rays(np.array([[-1, -1], [self.w, -1], [-1, self.h], [self.w, self.h]], float))
            self.r_max = 1.05 * np.sqrt((corner[:, :2] ** 2).sum(1)).max()
            outer = np.array([[-0.5, -0.5], [self.w - 0.5, -0.5], [-0.5, self.h - 0.5], [self.w - 0.5, self.h - 0.5]])
            self.r_corner = np.sqrt((self._perspective_rays(outer)[:, :2] ** 2).sum(1)).max()
        self.unit, self.seen = self.rays(self.pixels.reshape(-1, 2))
        self.unit = self.unit.reshape(self.h, self.w, 3)
        self.seen = self.seen.reshape(self.h, self.w)

    def _distorted(self, x, y):
        k1, k2, k3, k4, k5, k6 = self.k
        p1, p2 = self.p
        r2 = x * x + y * y
        a = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
        if self.law == "rational":
            a = a / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)))
        return a * x + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), a * y + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y

    def _radius(self, theta):
        k = self.k
        if self.law == "kannala_brandt":
            t2 = theta * theta
            return theta * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))))
        return theta * (1 + theta * (k[0] + theta * (k[1] + theta * (k[2] + theta * k[3]))))

    def _perspective_rays(self, pixels):
        target = (pixels - self.c) / self.f
        x, y = target[:, 0].copy(), target[:, 1].copy()
        for _ in range(50):  # Newton with differences
            fx, fy = self._distorted(x, y)
            ex, ey = target[:, 0] - fx, target[:, 1] - fy
            if max(np.abs(ex).max(initial=0), np.abs(ey).max(initial=0)) < 1e-13:
                break
            d = 1e-7
            ax, ay = self._distorted(x + d, y)
            bx, by = self._distorted(x, y + d)
            j11, j21, j12, j22 = (ax - fx) / d, (ay - fy) / d, (bx - fx) / d, (by - fy) / d
            det = j11 * j22 - j12 * j21
            x, y = x + (j22 * ex - j12 * ey) / det, y + (j11 * ey - j21 * ex) / det
        return np.stack([x, y, np.ones_like(x)], 1)

    def rays(self, pixels):
        """Unit vectors, and whether the pixel lies within the image circle."""
        if not self.by_angle:
            r = self._perspective_rays(pixels)
            return r / np.linalg.norm(r, axis=1, keepdims=True), np.ones(len(r), bool)
        m = (pixels - self.c) / self.f
        rho = np.linalg.norm(m, axis=1)
        low, high = np.zeros_like(rho), np.full_like(rho, self.theta_max + 0.2)
        beyond = rho > self._radius(np.array(self.theta_max))
        for _ in range(60):
            middle = (low + high) / 2
            less = self._radius(middle) < rho
            low, high = np.where(less, middle, low), np.where(less, high, middle)
        theta = (low + high) / 2
        s = np.where(rho > 1e-12, np.sin(theta) / np.maximum(rho, 1e-12), 1.0)
        return np.stack([m[:, 0] * s, m[:, 1] * s, np.cos(theta)], 1), ~beyond

    def project(self, p):
        """(pixels, whether the law gives one)."""
        n = np.linalg.norm(p, axis=-1)
        if self.by_angle:
            xy = np.linalg.norm(p[..., :2], axis=-1)
            theta = np.arctan2(xy, p[..., 2])
            s = np.where(xy > 1e-12, self._radius(theta) / np.maximum(xy, 1e-12), 1 / np.maximum(n, 1e-9))
            return self.c + self.f * p[..., :2] * s[..., None], theta <= self.theta_max
        ok = p[..., 2] > 1e-6
        z = np.where(ok, p[..., 2], 1)
        x, y = p[..., 0] / z, p[..., 1] / z
        ok &= x * x + y * y < self.r_max ** 2 if self.distorts else True
        x, y = np.where(ok, x, 0), np.where(ok, y, 0)
        u, v = self._distorted(x, y)
        return self.c + self.f * np.stack([u, v], -1), ok

    def within_corners(self, p):
        """Whether a point lies no further from the axis than what the picture's corners see."""
        return self.by_angle or not self.distorts or np.hypot(p[0], p[1]) <= self.r_corner * p[2]

    def inside(self, q, margin=0.0):
        return ((q[..., 0] >= -0.5 - margin) & (q[..., 0] <= self.w - 0.5 + margin) &
                (q[..., 1] >= -0.5 - margin) & (q[..., 1] <= self.h - 0.5 + margin))


# ------------------------------------------------------------------------------------------------------------------- dataset

class Dataset:
    def __init__(self, path):
        self.path = path
        with open(os.path.join(path, "dataset.yaml")) as f:
            self.meta = yaml.load(f, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
        with open(os.path.join(path, "scenario.yaml")) as f:
            self.scenario = yaml.load(f, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
        self.class_id = {c["name"]: c["id"] for c in self.meta["classes"]}
        self.instances = {i["id"]: i for i in self.meta.get("instances", [])}
        self.parts = {}
        for i in self.instances.values():
            if i.get("parent"):
                self.parts.setdefault(i["parent"], []).append(i["id"])
        self.tracks = {}
        self.cell_m = self.scenario["terrain"].get("cell_m", 0.05)
        self.machines = {m["name"]: m for m in self.scenario.get("machines", [])}
        self.obstacles = {o["name"]: o for o in self.scenario.get("obstacles", [])}
        self.body = {i: self._body(v["name"]) for i, v in self.instances.items()}
        self.scans = {}

    def file(self, *names):
        return os.path.join(self.path, *names)

    def track(self, *names):
        key = os.path.join(*names)
        if key not in self.tracks:
            path = self.file(key)
            self.tracks[key] = Track(path) if os.path.exists(path) else None
        return self.tracks[key]

    def _body(self, name):
        """What moves an instance: ("still", None), (kind, Track) or ("unknown", None)."""
        if "/" in name:
            machine, part = name.split("/", 1)
            track = self.track("truth", machine, "links", part + ".csv")
            if track:
                return "link", track
            if part.endswith("_soil"):
                shovel = self.machines.get(machine, {}).get("machine", {}).get("shovels", {}).get(part[:-5])
                track = self.track("truth", machine, "links", shovel["link"] + ".csv") if shovel else None
                if track:
                    return "soil", track
            return "unknown", None
        if name in self.machines:
            return "unknown", None
        track = self.track("truth", name, "pose.csv")
        if track:
            return "moving obstacle", track
        if self.obstacles.get(name, {}).get("path"):
            return "unknown", None  # it moves, but nobody wrote how
        return "still", None

    def cameras(self):
        return [c["path"] for c in self.meta["channels"] if c["type"] == "camera"]

    def lidars(self, machine):
        return [c["path"] for c in self.meta["channels"] if c["type"] == "lidar" and c["path"].split("/")[0] == machine]


class Frame:
    pass


class Camera:
    def __init__(self, data, path):
        self.data, self.path = data, path
        self.machine, self.name = path.split("/")
        with open(data.file(path, "sensor.yaml")) as f:
            self.sensor = yaml.safe_load(f)
        self.model = self.sensor["model"]
        self.lens = Lens(self.model)
        labels = self.model.get("labels", False)
        self.labels = ["semantic", "instance", "boxes"] if labels is True else list(labels or [])
        _, rows = read_csv(data.file(path, "data.csv"))
        self.frames = [(int(r[0]), r[1]) for r in rows]
        self.truth = data.track("truth", self.machine, "sensors", self.name + ".csv")
        # How far the point of a pixel may lie from the ray through its middle. A pinhole's is on it, to the precision of
        # float32 in a renderer (1/256 px of rasterisation grid, taken twice). Behind a lens that distorts, labels are those of
        # the nearest pixel of a finer picture: half of its diagonal, 0.71 px where that picture is not finer at all.
        self.ray_px = 0.71 if self.lens.distorts else 0.01

    def pose(self, t):
        x = self.truth.at(t)[0].copy()
        x[:3, :3] = x[:3, :3] @ R_SC
        return x  # X_WC

    def load(self, t, filename):
        f = Frame()
        f.t, f.image = t, {}
        stem = os.path.splitext(filename)[0]
        for kind in FORM:
            path = self.data.file(self.path, kind, filename)
            if os.path.exists(path):
                f.image[kind] = read_png(path)
        f.boxes = None
        path = self.data.file(self.path, "boxes", stem + ".json")
        if os.path.exists(path):
            with open(path) as g:
                f.boxes = json.load(g)
        if f.image.get("distance") is not None:
            f.d = f.image["distance"].astype(float) / 1000
            f.p = f.d[..., None] * self.lens.unit
        f.x_wc = self.pose(t) if self.truth else None
        # Soil in the air: of the terrain's class, but no ground of the site, within the site. It has no flow, and hides what it is before.
        f.clod = np.zeros((self.lens.h, self.lens.w), bool)
        half = site_extent(self.data)
        soil, semantic = f.image.get("ground_soil"), f.image.get("semantic")
        if f.x_wc is not None and half is not None and hasattr(f, "p") and soil is not None and semantic is not None and \
                soil.shape == semantic.shape == f.d.shape:
            p_w = f.p.reshape(-1, 3) @ f.x_wc[:3, :3].T + f.x_wc[:3, 3]
            within = (np.abs(p_w[:, :2]) < half - 0.5).all(1).reshape(f.d.shape)
            f.clod = (semantic == self.data.class_id["terrain"]) & (f.image["instance"] == 0) & (soil == 0) & (f.d > 0) & within
            for name in ("flow_to_previous", "scene_flow_to_previous"):
                if f.image.get(name) is not None and t != self.frames[0][0]:
                    f.clod &= (f.image[name] == 0).all(-1)
            if t == self.frames[0][0]:
                f.clod[:] = False
        # Ground that was touched since the picture before is taken to stand still where it is now.
        f.fresh = np.zeros(f.clod.shape, bool)
        if f.image.get("ground_age") is not None and f.image["ground_age"].shape == f.fresh.shape:
            f.fresh = (f.image["ground_age"] > 0) & (f.image["ground_age"] - 1.0 <= 1e1 / self.sensor["rate_hz"] + 1.01)
        return f


def decoded_flow(image):
    return (image[..., :2].astype(float) - 32768) / 64, image[..., 2]


def spread(values, size=3):
    kernel = np.ones((size, size), np.uint8)
    values = np.ascontiguousarray(values, dtype=np.float32)
    return cv2.erode(values, kernel), cv2.dilate(values, kernel)


def same_around(instance, semantic, size=3):
    """Whether all pixels about one show its own instance and class."""
    key = instance.astype(np.float32) * 256 + semantic
    low, high = spread(key, size)
    return low == high


# -------------------------------------------------------------------------------------------------------------------- checks

def check_files(j, cam, f, where):
    expected = [k for k in cam.labels if k in KNOWN]
    if cam.model.get("rgb"):
        expected.append("rgb")
    if cam.model.get("depth"):
        expected.append("depth")
    for kind in expected:
        image = f.image.get(kind)
        dtype, channels = FORM[kind]
        shape = (cam.lens.h, cam.lens.w) + ((channels,) if channels > 1 else ())
        j.holds("files: there, size and bits", image is not None and image.shape == shape and image.dtype == dtype, where, f.t,
                f"{kind}: {None if image is None else (image.shape, image.dtype)}, need {shape} {dtype.__name__}")
    for kind in FORM:
        if kind in f.image and kind not in expected:
            j.holds("files: none that was not asked for", False, where, f.t, kind)


def check_classes(j, data, cam, f, where):
    instance, semantic = f.image["instance"], f.image["semantic"]
    pairs, counts = np.unique(instance.astype(np.int64) * 256 + semantic, return_counts=True)
    bad = 0
    for pair, count in zip(pairs.tolist(), counts.tolist()):
        i, s = divmod(pair, 256)
        if i == 0:
            ok = s in (data.class_id["sky"], data.class_id["terrain"])
        else:
            ok = i in data.instances and data.class_id.get(data.instances[i]["class"]) == s and i not in data.parts
        bad += 0 if ok else count
        if not ok:
            j.faults.append((where, f.t, "instance and semantic agree", f"instance {i} with class {s}: {count} px"))
    row = j._row("instance and semantic agree", 0, "px")
    row["n"] += instance.size
    row["worst"] = max(row["worst"] or 0, bad)
    row["faults"] += bad > 0
    if f.image.get("panoptic") is not None:
        number = f.image["panoptic"].astype(np.int64) @ np.array([1, 1 << 8, 1 << 16])
        j.all_within("panoptic: class + 256 instance", number != semantic + 256 * instance.astype(np.int64), 0, where, f.t, "px")
    flying = f.image.get("soil_in_flight")
    if flying is not None:
        j.all_within("soil in flight: 0 or 255, of the terrain's class, of no instance",
                     (flying != 0) & ((flying != 255) | (semantic != data.class_id["terrain"]) | (instance != 0)), 0, where, f.t, "px")
        if f.image.get("ground_soil") is not None:
            j.all_within("soil in flight: no ground of the site", (flying != 0) & (f.image["ground_soil"] != 0), 0, where, f.t, "px")
            # Within the site, what is terrain and no ground of it is in the air; f.clod is empty in the first picture.
            j.all_within("soil in flight: wherever terrain is no ground", f.clod & (flying == 0), 0, where, f.t, "px")
    dark = ~cam.lens.seen
    # Half a pixel on either side of the image circle may go either way.
    dark = spread(dark, 3)[0] > 0
    j.all_within("beyond a fisheye's field: nothing", ((instance != 0) | (semantic != 0))[dark], 0, where, f.t, "labelled px")


def box_corners(b):
    return np.array(b["p_CO_m"]), rotation(b["q_CO_wxyz"]), np.array(b["size_O_m"])


def check_boxes(j, data, cam, f, where):
    instance = f.image["instance"]
    lens = cam.lens
    boxes = {b["instance"]: b for b in f.boxes["boxes"]}
    j.holds("boxes: t_ns, no object twice", f.boxes["t_ns"] == f.t and len(boxes) == len(f.boxes["boxes"]), where, f.t, "t_ns or twice")
    visible = set(np.unique(instance).tolist()) - {0}
    wholes = {data.instances[i]["parent"] for i in visible if i in data.instances and data.instances[i].get("parent")}
    j.holds("boxes: each visible object, no other", set(boxes) == visible | wholes, where, f.t,
            f"missing {sorted((visible | wholes) - set(boxes))}, too many {sorted(set(boxes) - visible - wholes)}")
    for i, b in boxes.items():
        what = f"{b['name']} ({i})"
        known = data.instances.get(i)
        j.holds("boxes: name, class, parent as in dataset.yaml",
                known is not None and b["name"] == known["name"] and b["class"] == known["class"] and
                b["parent"] == known.get("parent", 0), where, f.t, what)
        mask = np.isin(instance, data.parts[i]) if i in data.parts else instance == i
        if mask.any():
            rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
            bounds = [columns[0], rows[0], columns[-1], rows[-1]]
            found = [b["x_min_px"], b["y_min_px"], b["x_max_px"], b["y_max_px"]]
            j.all_within("boxes: bounds are the mask's", [np.abs(np.subtract(bounds, found)).max()], 0, where, f.t,
                         f"{what} {found}, mask {list(map(int, bounds))}", "px")
            j.all_within("boxes: visible_px is the mask's", [abs(int(mask.sum()) - b["visible_px"])], 0, where, f.t,
                         f"{what} {b['visible_px']}, mask {int(mask.sum())}", "px")
        v, t = b["visibility"], b["truncation"]
        j.all_within("boxes: visibility, truncation in 0..1", [max(-v, v - 1, -t, t - 1)], 0, where, f.t, what)
        if v > 0 and not lens.distorts:
            # What it would cover alone is a whole number of pixels, no less than what is visible (behind a lens that distorts, of
            # pixels of the finer picture, which the dataset does not have).
            alone = b["visible_px"] / v
            j.all_within("boxes: visibility is of whole pixels", [abs(alone - round(alone))], 1e-6 * alone + 1e-9, where, f.t, what, "px")
        if i in data.parts and v > 0 and not lens.distorts:
            alone = b["visible_px"] / v
            # What the parts cover together is no less than what any of them covers.
            most = max((boxes[p]["visible_px"] / boxes[p]["visibility"] for p in data.parts[i] if p in boxes), default=0)
            j.all_within("boxes: a whole covers what its parts do", [most - b["visible_px"] / v], 1e-6 * most, where, f.t, what, "px")
        left, top, right, bottom = b["amodal_px"]
        # A visible pixel's middle lies on the object; behind a lens the object is that of the nearest pixel: half a pixel.
        slack = 0.5 if lens.distorts else 0.02
        excess = max(left - b["x_min_px"], top - b["y_min_px"], b["x_max_px"] - right, b["y_max_px"] - bottom)
        j.all_within("boxes: amodal box holds the visible one (pinhole)" if not lens.distorts else
                     "boxes: amodal box holds the visible one (lens)", [excess], slack, where, f.t,
                     f"{what} amodal {np.round(b['amodal_px'], 2).tolist()}, visible "
                     f"{[b['x_min_px'], b['y_min_px'], b['x_max_px'], b['y_max_px']]}", "px")
        if not lens.by_angle:
            area = (right - left) * (bottom - top)
            within = max(0, min(right, lens.w - 0.5) - max(left, -0.5)) * max(0, min(bottom, lens.h - 0.5) - max(top, -0.5))
            if area > 0:
                j.all_within("boxes: truncation follows from amodal_px", [abs(1 - within / area - t)], 1e-6, where, f.t, what)
        if v == 1 and t == 0 and i not in data.parts and b["visible_px"] > 200:
            # Nothing hides it: its extreme middles of pixels lie within a pixel of its ends, unless these are thinner than a
            # pixel (a tip), so that pixels miss them; then by more. Hence a share, over all boxes of a camera.
            cam.tight.append(max(b["x_min_px"] - left, b["y_min_px"] - top, right - b["x_max_px"], bottom - b["y_max_px"]) <= 1.0 + slack)
        p, r, size = box_corners(b)
        j.all_within("3-D boxes: quaternion is a unit one", [abs(np.linalg.norm(b["q_CO_wxyz"]) - 1)], 1e-9, where, f.t, what)
        j.holds("3-D boxes: sizes are positive", bool((size > 0).all()), where, f.t, what)
        if hasattr(f, "p") and mask.any():
            use = mask & (f.d > 0)
            points = f.p[use]
            q = np.abs((points - p) @ r)
            # Half a millimetre along the ray, float32 of the renderer and of the box (1 mm at sites of some tens of metres),
            # and the pixel's own ray.
            slack = 0.0015 + cam.ray_px * f.d[use] / lens.f.min() * 1.5
            beyond = (q - size / 2).max(1)
            places = np.argwhere(use)[:, ::-1]
            j.all_within("3-D boxes: visible points lie within (pinhole)" if not lens.distorts else
                         "3-D boxes: visible points lie within (lens)", np.maximum(beyond, 0), slack, where, f.t, what, places=places)
        # Where nothing is hidden or cut, the box is no larger than the object: see Watch.
        cam.watch.box(f, b)
    # Amodal boxes of wholes hold those of their parts.
    for i in data.parts:
        if i in boxes:
            for p in data.parts[i]:
                if p in boxes:
                    a, b = boxes[i]["amodal_px"], boxes[p]["amodal_px"]
                    j.all_within("boxes: a whole's amodal box holds its parts'", [max(a[0] - b[0], a[1] - b[1], b[2] - a[2], b[3] - a[3])],
                                 1e-3, where, f.t, f"{boxes[i]['name']}, {boxes[p]['name']}", "px")


class Watch:
    """What stays the same through all frames: places of key points in their links, sizes and places of boxes."""

    def __init__(self, data, cam):
        self.data, self.cam = data, cam
        self.points, self.sizes, self.places, self.pairs = {}, {}, {}, {}

    def box(self, f, b):
        name = b["name"]
        kind, track = self.data.body[b["instance"]]
        # The box of a machine's part holds cylinders and shoes as they stand, which move in it.
        if b["instance"] in self.data.parts or b["parent"] or kind == "soil" or f.x_wc is None:
            return
        if kind != "unknown":
            self.sizes.setdefault(name, []).append(b["size_O_m"])
            x_wb = track.at(f.t)[0] if track else np.eye(4)
            p_w = moved(f.x_wc, np.array(b["p_CO_m"])[None])
            r = inverse(x_wb)[:3, :3] @ f.x_wc[:3, :3] @ rotation(b["q_CO_wxyz"])
            self.places.setdefault(name, []).append(np.concatenate([moved(inverse(x_wb), p_w)[0], r.reshape(-1)]))

    def keypoint(self, f, b, k):
        if f.x_wc is None:
            return
        names = [x["name"] for x in b["keypoints"]]
        number = [x for x, y in zip(b["keypoints"], names) if y == k["name"]].index(k)  # of points of one name
        self.points.setdefault((b["name"], k["name"], number), []).append((f.t, moved(f.x_wc, np.array(k["p_C_m"])[None])[0]))

    def finish(self, j, where):
        # Doubles through poses that are written as doubles: 1e-6 m. A camera's recorded pose is the one its pictures have.
        for name, sizes in self.sizes.items():
            j.all_within("3-D boxes: size stays", [np.ptp(np.array(sizes), 0).max()], 1e-6, where, "all", name, "m")
        for name, places in self.places.items():
            j.all_within("3-D boxes: place in the body stays", [np.ptp(np.array(places), 0).max()], 1e-5, where, "all", name, "m")
        for (name, point, _), seen in self.points.items():
            times = np.array([t for t, _ in seen])
            p_w = np.array([p for _, p in seen])
            if name in self.data.machines:
                folder = self.data.file("truth", name, "links")
                links = sorted(os.listdir(folder)) if os.path.isdir(folder) else []
                machine = self.data.machines[name].get("machine", {})
                if point.endswith("_rod_pin"):
                    # A rod that pushes a linkage's rocker turns with it: as far from the rocker's pin as ever.
                    child = machine.get("joints", {}).get(point[:-len("_rod_pin")], {}).get("child")
                    rocker = [l["rocker"] for l in machine.get("linkages", {}).values() if l["coupler"]["link"] == child]
                    if rocker:
                        x = inverse(self.data.track("truth", name, "links", rocker[0]["link"] + ".csv").at(times))
                        local = (x[:, :3, :3] @ p_w[..., None])[..., 0] + x[:, :3, 3]
                        far = np.linalg.norm(local - np.array(rocker[0]["pin_m"]), axis=1)
                        j.all_within("key points: a rocker's turn about its pin", [np.ptp(far)], 1e-5, where, "all", f"{name} {point}", "m")
                        continue
                best, of = math.inf, ""
                for link in links:
                    x = inverse(self.data.track("truth", name, "links", link).at(times))
                    local = (x[:, :3, :3] @ p_w[..., None])[..., 0] + x[:, :3, 3]
                    if np.ptp(local, 0).max() < best:
                        best, of = np.ptp(local, 0).max(), link
                if links:
                    j.all_within("key points: stay in one link", [best], 1e-5, where, "all", f"{name} {point} (best in {of})", "m")
            else:
                ids = [i for i, v in self.data.instances.items() if v["name"] == name]
                kind, track = self.data.body[ids[0]]
                if kind != "unknown":
                    x = inverse(track.at(times)) if track else np.repeat(np.eye(4)[None], len(times), 0)
                    local = (x[:, :3, :3] @ p_w[..., None])[..., 0] + x[:, :3, 3]
                    j.all_within("key points: stay in their obstacle", [np.ptp(local, 0).max()], 1e-5, where, "all", f"{name} {point}", "m")
                    wanted = {k["name"]: k["xyz_m"] for k in self.data.obstacles.get(name, {}).get("keypoints", [])}
                    if track and point in wanted:
                        j.all_within("key points: are those of the scenario", [np.abs(local[0] - wanted[point]).max()], 1e-5, where, "all",
                                     f"{name} {point}", "m")


def check_keypoints(j, data, cam, f, where):
    lens, instance = cam.lens, f.image["instance"]
    for b in f.boxes["boxes"]:
        points = b.get("keypoints", [])
        name = b["name"]
        what = f"{name}"
        if name in data.obstacles:
            wanted = [k["name"] for k in data.obstacles[name].get("keypoints") or []]
            radius = {k["name"]: k["radius_m"] for k in data.obstacles[name].get("keypoints") or []}
            j.holds("key points: as many as the scenario has", [k["name"] for k in points] == wanted, where, f.t, what)
        else:
            radius = {k["name"]: 0.05 if "_edge_" in k["name"] else 0.35 for k in points}
        if b["class"] == "person":
            j.holds("key points: persons have COCO's 17", [k["name"] for k in points] == COCO, where, f.t, what)
        if b["instance"] not in data.parts and "/" in name:
            j.holds("key points: of wholes, not of parts", not points, where, f.t, what)
        found = {k["name"]: np.array(k["p_C_m"]) for k in points}
        for left in found:
            right = left.replace("left", "right")
            if left.endswith("_edge_left"):
                shovel = data.machines.get(name, {}).get("machine", {}).get("shovels", {}).get(left[:-len("_edge_left")])
                if shovel:
                    j.all_within("key points: edges lie a shovel's width apart",
                                 [abs(np.linalg.norm(found[left] - found[right]) - shovel["width_m"])], 1e-5, where, f.t, what, "m")
        if b["class"] == "person" and len(found) == 17:
            p = np.array([found[n] for n in COCO])
            d = np.linalg.norm(p[:, None] - p[None], axis=-1)
            if name in cam.watch.pairs:
                j.all_within("key points: distances within a person stay", [np.abs(d - cam.watch.pairs[name]).max()], 1e-6, where, f.t, what, "m")
            cam.watch.pairs.setdefault(name, d)
        ids = data.parts.get(b["instance"], [b["instance"]])
        if points:
            j.holds("key points: each name once in a box", len({k["name"] for k in points}) == len(points), where, f.t,
                    f"{name}: {len(points)} points, {len({k['name'] for k in points})} names")
        for k in points:
            cam.watch.keypoint(f, b, k)
            p = np.array(k["p_C_m"])
            at, ok = lens.project(p[None])
            at, ok = at[0], bool(ok[0])
            what = f"{name} {k['name']}"
            pixel = k.get("pixel_px")
            if pixel is None:
                # Also where it lies nearer than near_m, beyond which the lens draws nothing.
                behind = not ok or (not lens.by_angle and p[2] <= cam.model.get("near_m", 0) + 1e-9)
                j.holds("key points: pixel missing only behind near_m", behind and k["sight"] == 0, where, f.t,
                        f"{what} p_C {np.round(p, 3).tolist()} sight {k['sight']}")
                continue
            if ok and lens.within_corners(p):
                # Both are the same formulas in doubles. Beyond the picture's corners the law is continued straight on.
                j.all_within("key points: pixel is the projection of p_C", [np.abs(at - pixel).max()], 1e-3, where, f.t,
                             f"{what} {pixel}, need {at.tolist()}", "px")
            border = min(pixel[0] + 0.5, lens.w - 0.5 - pixel[0], pixel[1] + 0.5, lens.h - 0.5 - pixel[1])
            if abs(border) > 1e-6:
                j.holds("key points: sight 0 just beyond the picture", (k["sight"] == 0) == (border < 0 or not ok), where, f.t,
                        f"{what} {pixel} sight {k['sight']}")
            if k["sight"] in (1, 2) and border > 0 and hasattr(f, "d"):
                u, v = min(max(int(round(pixel[0])), 0), lens.w - 1), min(max(int(round(pixel[1])), 0), lens.h - 1)
                fraction = np.abs(np.array(pixel) - np.floor(pixel) - 0.5).min()
                gap = np.linalg.norm(p) - f.d[v, u]  # how far the pixel's surface lies before the point
                own = instance[v, u] in ids
                room = gap - radius[k["name"]]
                # Distances are rounded, the pixel's ray is not the point's (up to 0.7 px): leave undecided what is within 2 cm.
                # "No further before it" may be along the ray or along the axis: undecided between the two.
                along = gap if lens.by_angle else gap * lens.unit[v, u, 2]
                other = along - radius[k["name"]]
                if fraction < 0.02 or (own and (abs(room) < 0.02 or abs(other) < 0.02 or (room < 0) != (other < 0))):
                    continue
                seen = own and room < 0
                j.holds("key points: sight 2 just where its object is seen", (k["sight"] == 2) == seen, where, f.t,
                        f"{what} {np.round(pixel, 2).tolist()} sight {k['sight']}: pixel shows {instance[v, u]} {gap:.3f} m before it, radius {radius[k['name']]}")
        for k in points:
            if k["sight"] not in (0, 1, 2):
                j.holds("key points: sight is 0, 1 or 2", False, where, f.t, f"{name} {k['name']}")


def check_distance(j, data, cam, f, where):
    lens, d, semantic = cam.lens, f.d, f.image["semantic"]
    sky = semantic == data.class_id["sky"]
    j.all_within("distance: none in the sky", (d > 0)[sky], 0, where, f.t, "px")
    # 0 only in the sky and beyond 65.535 m, which no object of a site of some tens of metres is.
    near = (d == 0) & (f.image["instance"] > 0)
    j.all_within("distance: each object has one", near.reshape(-1), 0, where, f.t, "px", places=np.argwhere(np.ones_like(near))[:, ::-1])
    depth = f.image.get("depth")
    if depth is not None and cam.model.get("depth"):
        z = d if lens.by_angle else d * lens.unit[..., 2]
        measured = depth.astype(float) / 1000
        low, high = cam.model.get("depth_min_m", 0), cam.model.get("depth_max_m", 65.535)
        noise, baseline = cam.model.get("disparity_noise_px", 0), cam.model.get("baseline_m", 0)
        both = (depth > 0) & (d > 0)
        j.share("depth: only where there is a surface", (d > 0)[depth > 0], 1.0, where, f.t, "depth without distance")
        if noise and baseline:
            # z = f b / disparity, and disparity has white noise: residuals of disparity over the noise are N(0, 1).
            within = both & (z > low * 1.2) & (z < high * 0.6) & (measured > low) & (measured < high)
            zz, mm = z[within], measured[within]
            n = lens.f[0] * baseline * (1 / np.maximum(mm, 1e-3) - 1 / zz) / noise
            if n.size > 2000:
                j.all_within("depth: noise has its size (median / 0.6745 - 1)", [abs(np.median(np.abs(n)) / 0.6745 - 1)], 0.1, where, f.t, "median")
                j.all_within("depth: noise has no bias (mean)", [abs(n.mean())], 0.1, where, f.t, "mean", "sigma")
                # 76800 pixels and the rounding of near millimetres: 7 sigma and more are not chance.
                j.all_within("depth: noise has no outliers", np.abs(n), 7, where, f.t, "residual", "sigma", np.argwhere(within)[:, ::-1])
            # Wherever there is a measurement, near or far, it is one that this noise can make.
            n = np.abs(lens.f[0] * baseline * (1 / np.maximum(measured, 1e-3) - 1 / np.maximum(z, 1e-3)) / noise)[both]
            j.all_within("depth: noise could make each measurement", n, 9, where, f.t, "residual", "sigma", np.argwhere(both)[:, ::-1])
        else:
            # Half a millimetre of either, and the depth of another ray behind a lens: d (dz/z) = tan(angle) * ray_px / f.
            tangent = np.sqrt(np.maximum(1 - lens.unit[..., 2] ** 2, 0)) / np.maximum(lens.unit[..., 2], 0.05)
            limit = 0.00102 + (0 if lens.by_angle else 1) * z * tangent * cam.ray_px / lens.f.min()
            j.all_within("depth: distance * cosine of the ray", np.abs(measured - z)[both], limit[both], where, f.t, "px",
                         places=np.argwhere(both)[:, ::-1])
            ought = (d > 0) & (z > low + 0.01) & (z < high - 0.01)
            j.all_within("depth: each surface in range has one", (depth == 0)[ought], 0, where, f.t, "px")
            off = (d > 0) & ((z < low - 0.01) | (z > high + 0.01))
            j.all_within("depth: none out of range", (depth > 0)[off], 0, where, f.t, "px")


def motion(data, cam, one, two):
    """Of each pixel of frame `one`: where its point is in frame `two` (p_C there, pixel, lawful) and the kind of its body:
    0 not known, 1 ground and standing things, 2 moving obstacle, 3 link, 4 soil in a shovel, 5 sky."""
    instance, semantic = one.image["instance"], one.image["semantic"]
    p = np.full(one.p.shape, np.nan)
    kind = np.zeros(instance.shape, np.uint8)
    names = {"still": 1, "moving obstacle": 2, "link": 3, "soil": 4}
    x_c = inverse(two.x_wc)
    still = x_c @ one.x_wc
    for i in np.unique(instance).tolist():
        mask = (instance == i) & (one.d > 0)
        if i == 0:
            mask &= semantic == data.class_id["terrain"]
            mask &= ~one.clod
            body, track = "still", None
        else:
            body, track = data.body.get(i, ("unknown", None))
        if body == "unknown" or not mask.any():
            continue
        x = still if track is None else x_c @ track.at(two.t)[0] @ inverse(track.at(one.t)[0]) @ one.x_wc
        p[mask] = moved(x, one.p[mask])
        kind[mask] = names[body]
    sky = (semantic == data.class_id["sky"]) & cam.lens.seen & (instance == 0)
    p[sky] = cam.lens.unit[sky] @ still[:3, :3].T * 1e6
    kind[sky] = 5
    q, ok = cam.lens.project(np.where(np.isfinite(p), p, 1.0))
    return p, q, ok & (kind > 0), kind


def check_flow(j, data, cam, one, two, image, name, where, frame):
    """Flow on the pixels of `one` to where frame `two` has their points."""
    lens = cam.lens
    flow, state = decoded_flow(image)
    at = lens.pixels + flow
    p, q, ok, kind = motion(data, cam, one, two)
    known = state > 0
    j.all_within(f"{name}: state is 0 to 3", (state > 3).reshape(-1), 0, where, frame, "px")
    j.all_within(f"{name}: not known is 0 0 0", image[~known].max(initial=0), 0, where, frame, "value")
    instance, semantic = one.image["instance"], one.image["semantic"]
    # Known where a body is known and its point has a place; clods in the air have none, and so has what leaves the format's 512 px.
    ought = ok & (np.abs(q - lens.pixels).max(-1) < 500) & (kind < 4) & ((p[..., 2] > 0.1) | lens.by_angle)
    j.share(f"{name}: known where a point has a place", known[ought], 0.995, where, frame, "known", places=np.argwhere(ought)[:, ::-1])
    # Limit: rounding 1/128 px on each axis; half a millimetre of distance; the ray's own offset, which moves with what is about it:
    # flow's change to the neighbours times ray_px.
    grain = np.zeros(flow.shape[:2])
    for axis in range(2):
        low, high = spread(np.where(ok, (q - lens.pixels)[..., axis], 0), 3)
        grain = np.maximum(grain, (high - low) / 2)
    shift = np.linalg.norm(p - one.p, axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        millimetre = 0.0005 * lens.f.max() * np.minimum(shift / np.maximum(one.d, 0.05) ** 2, 10)
    limit = 1 / 128 + 0.002 + np.nan_to_num(millimetre) + (grain * cam.ray_px if lens.distorts else 0.01 * grain)
    error = np.abs(at - q).max(-1)
    uniform = same_around(instance, semantic)
    for code, text, least in ((1, "ground and standing things", 0.999), (2, "moving obstacles", 0.999), (5, "sky", 0.999),
                              (3, "links", 0.0), (4, "soil in shovels", 0.0)):
        mask = known & ok & (kind == code) & (np.abs(q - lens.pixels).max(-1) < 500)
        if lens.distorts:
            mask &= uniform  # at edges the nearest pixel may be of the other side
        if least:
            # A share, as pixels at the edge of an object show, behind multisampling or a finer picture, a point of another one.
            j.share(f"{name}: as poses say ({text})", (error <= limit)[mask], least, where, frame, text, places=np.argwhere(mask)[:, ::-1])
        else:
            cam.tally.setdefault(f"{name}: as poses say ({text})", []).append((frame, (error <= 2 * limit)[mask]))
            for i in np.unique(instance[mask]).tolist():
                m = mask & (instance == i)
                cam.tally.setdefault(f"{name}: {data.instances[i]['name']}", []).append((frame, (error <= 2 * limit)[m]))
    # States. Beyond the picture: its border, to 1/64 px.
    inside = lens.inside(at, -0.02)
    outside = ~lens.inside(at, 0.02)
    j.all_within(f"{name}: 3 only beyond the picture", (known & inside & (state == 3) & (ok if lens.by_angle else True)).reshape(-1), 0,
                 where, frame, "px", places=lens.pixels.reshape(-1, 2))
    j.all_within(f"{name}: 3 wherever beyond the picture", (known & outside & (state != 3)).reshape(-1), 0, where, frame, "px",
                 places=lens.pixels.reshape(-1, 2))
    # Seen or hidden: one of the four pixels about the place shows the same body at no less than its depth by 1 %. 0.3 % and 2 mm
    # either way are left undecided, and pixels that come in or drop out with 0.02 px of the place.
    far = np.linalg.norm(p, axis=-1)
    key_one = instance.astype(np.int64) * 256 + semantic
    key_two = np.where(two.clod, -1, two.image["instance"].astype(np.int64) * 256 + two.image["semantic"])
    d_two = np.where(two.image["semantic"] == data.class_id["sky"], np.inf, np.where(two.d > 0, two.d, 70.0))
    loose, strict = np.zeros(state.shape, bool), np.zeros(state.shape, bool)
    reach = 0.52 if lens.distorts else 0.02
    depth = np.where(kind == 5, 0, np.nan_to_num(far))  # the sky is as far as the sky

    def look(which, rows, columns, steps):
        """Adds to loose and strict, at the pixels `which`, what those `steps` from the place's floor show."""
        for dv, du in steps:
            v, u = rows + dv, columns + du
            inner = (u >= 0) & (v >= 0) & (u < lens.w) & (v < lens.h)
            cu, cv = np.clip(u, 0, lens.w - 1), np.clip(v, 0, lens.h - 1)
            same = inner & (key_two[cv, cu] == key_one[which])
            gap = np.maximum(np.abs(u - at[..., 0][which]), np.abs(v - at[..., 1][which]))
            d = d_two[cv, cu]
            loose[which] |= same & (gap < 1 + reach) & (d >= 0.987 * depth[which] - 0.002)
            strict[which] |= same & (gap < 1 - reach) & (d >= 0.993 * depth[which] + 0.002)

    four = [(0, 0), (0, 1), (1, 0), (1, 1)]
    floor = np.floor(at).astype(int)
    everywhere = np.ones(state.shape, bool)
    look(np.nonzero(everywhere), floor[..., 1].reshape(-1), floor[..., 0].reshape(-1), four)
    rest = np.nonzero(known & (state == 1) & ~loose)
    look(rest, floor[..., 1][rest], floor[..., 0][rest], [(dv, du) for dv in (-1, 0, 1, 2) for du in (-1, 0, 1, 2) if (dv, du) not in four])
    sure = known & ok & ((kind == 1) | (kind == 2) | (kind == 5)) & lens.inside(at, -0.02) & (np.nan_to_num(error) < 1)
    if lens.distorts:
        sure &= uniform
    # A share: behind a lens seen and hidden are told on the finer picture.
    least = 0.98 if lens.distorts else 0.9995
    places = lens.pixels
    m = sure & (state == 1)
    j.share(f"{name}: 1 where seen ({'lens' if lens.distorts else 'pinhole'})", loose[m], least, where, frame, "no such pixel about it", places=places[m])
    m = sure & (state == 2)
    j.share(f"{name}: 2 where hidden ({'lens' if lens.distorts else 'pinhole'})", ~strict[m], 0.90 if lens.distorts else 0.995, where, frame,
            "the body is seen there", places=places[m])
    return flow, state, uniform


def bilinear(image, q):
    return cv2.remap(np.ascontiguousarray(image, np.float32), q[..., 0].astype(np.float32), q[..., 1].astype(np.float32), cv2.INTER_LINEAR,
                     borderMode=cv2.BORDER_REPLICATE)


def check_motion(j, data, cam, f, before, where):
    lens = cam.lens
    if before is None:
        for name in ("flow_to_previous", "flow_to_this", "scene_flow_to_previous"):
            if name in f.image:
                j.all_within("motion: the first picture has none", [f.image[name].max()], 0, where, f.t, name)
        return
    flow = forward = None
    if "flow_to_previous" in f.image:
        flow, state, uniform = check_flow(j, data, cam, f, before, f.image["flow_to_previous"], "flow_to_previous", where, f.t)
    if "flow_to_this" in f.image:
        forward, forward_state, _ = check_flow(j, data, cam, before, f, f.image["flow_to_this"], "flow_to_this", where, f.t)
    if flow is None:
        return
    at = lens.pixels + flow
    instance, semantic = f.image["instance"], f.image["semantic"]
    seen = (state == 1) & lens.inside(at, -1)
    # Soil in a shovel goes with the shovel, and lies otherwise in each picture while it is filled or emptied.
    shifting = np.isin(instance, [i for i in data.body if data.body[i][0] == "soil"])
    # Composition of the two flows, where nothing about the place interferes: the four pixels are of the same thing and within 2 % of
    # depth. Flow is interpolated between pixels, so half of what it changes by from pixel to pixel is allowed for, and the roundings.
    if forward is not None:
        clean = same_around(before.image["instance"], before.image["semantic"]) & (forward_state == 1)
        low, high = spread(np.where(before.d > 0, before.d, 0))
        clean &= (high - low) < 0.02 * high
        clean &= cv2.erode(clean.astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
        iu, iv = np.clip(np.round(at[..., 0]).astype(int), 0, lens.w - 1), np.clip(np.round(at[..., 1]).astype(int), 0, lens.h - 1)
        same = (before.image["instance"][iv, iu] == instance) & (before.image["semantic"][iv, iu] == semantic)
        still = ~f.fresh & ~shifting & (spread(before.clod)[1][iv, iu] == 0)
        use = seen & clean[iv, iu] & same & uniform & still
        back = np.stack([bilinear(forward[..., 0], at), bilinear(forward[..., 1], at)], -1)
        grain = np.zeros(use.shape)
        for axis in range(2):
            low, high = spread(forward[..., axis])
            grain = np.maximum(grain, ((high - low) / 2)[iv, iu])
        total = np.abs(flow + back).max(-1)
        limit = 1 / 32 + 0.01 + grain * (1.0 if lens.distorts else 0.5)
        j.share("flow: back and forth cancel", (total <= limit)[use], 0.99, where, f.t, "cancel", places=lens.pixels[use])
    # Warping the picture before by the flow gives this one where it is seen. Of smooth areas, the median: light and noise alone
    # (rgb_noise of both pictures, 2 grey levels) differ; shadows move.
    if "rgb" in f.image and "rgb" in before.image:
        grey, grey_before = f.image["rgb"].mean(-1), before.image["rgb"].mean(-1)
        warped = bilinear(grey_before, at)
        low, high = spread(cv2.GaussianBlur(grey.astype(np.float32), (0, 0), 1), 5)
        smooth = seen & uniform & ((high - low) < 12) & (semantic != data.class_id["sky"])
        if smooth.sum() > 500:
            sigma = cam.model.get("rgb_noise", 0) if not cam.model.get("image_sensor") else 6
            j.all_within("flow: warped picture before is this one (median)", [np.median(np.abs(warped - grey)[smooth])],
                         2.5 + 1.0 * sigma, where, f.t, "grey levels", "grey")
        # And by all edges: warped, the picture before correlates better than unwarped, where things moved.
        edges = seen & uniform & (np.hypot(flow[..., 0], flow[..., 1]) > 2) & (semantic != data.class_id["sky"])
        if edges.sum() > 3000 and grey[edges].std() > 5:
            warped_error = np.abs(warped - grey)[edges].mean()
            j.all_within("flow: warping betters the picture (ratio)", [warped_error / max(np.abs(grey_before - grey)[edges].mean(), 1e-3)], 0.9,
                         where, f.t, "warped over unwarped")
    if "scene_flow_to_previous" in f.image:
        raw = f.image["scene_flow_to_previous"]
        none = (raw == 0).all(-1)
        sf = (raw.astype(float) - 32768) / 1000
        have = ~none & (f.d > 0)
        clipped = ((raw <= 1) | (raw >= 65534)).any(-1)
        have &= ~clipped
        # A point that has flow has scene flow (but for the sky); not the other way round, as it may come from beyond a fisheye's field.
        both = (f.d > 0) & ((f.p[..., 2] > 0.2) | lens.by_angle)
        j.share("scene flow: known where flow is", ~none[both & (state > 0)], 0.999, where, f.t, "px", places=lens.pixels[both & (state > 0)])
        p_before = f.p + sf
        q, ok = lens.project(p_before)
        use = have & ok & (state > 0) & ((p_before[..., 2] > 0.2) | lens.by_angle)
        n = np.linalg.norm(p_before, axis=-1)
        # Half a millimetre of distance and of each component of scene flow (sqrt 3 of it at worst), seen from n; and the pixel.
        grain = np.zeros(use.shape)
        for axis in range(2):
            low, high = spread(flow[..., axis])
            grain = np.maximum(grain, (high - low) / 2)
        z = n if lens.by_angle else np.maximum(p_before[..., 2], 0.05)
        stretch = 1.0 if not lens.distorts else 1.6
        limit = (1 / 128 + 0.002 + 0.0015 * lens.f.max() * stretch / z * (n / z) + (grain * cam.ray_px if lens.distorts else 0))
        error = np.abs(q - at).max(-1)
        if lens.distorts:
            use &= uniform
        j.share("scene flow: projects to flow", (error <= limit)[use], 0.999, where, f.t, "px", places=lens.pixels[use])
        # Of what poses tell: the same in space.
        p, _, known, kind = motion(data, cam, f, before)
        for code, text in ((1, "ground and standing things"), (2, "moving obstacles")):
            m = have & known & (kind == code)
            if lens.distorts:
                m &= uniform
            # Half a millimetre each, times the turn (p turns with the camera: the same millimetre), and the ray's offset.
            angle = np.linalg.norm(before.x_wc[:3, :3].T @ f.x_wc[:3, :3] - np.eye(3))
            limit3 = 0.0022 + angle * f.d * cam.ray_px / lens.f.min()
            j.share(f"scene flow: as poses say ({text})", (np.abs(p - p_before).max(-1) <= limit3)[m], 0.999, where, f.t, "px", places=lens.pixels[m])
        # Distance in the picture before, where it is seen: within what the four pixels about the place have.
        low, high = spread(before.d)
        alike = same_around(before.image["instance"], before.image["semantic"])
        iu, iv = np.clip(np.round(at[..., 0]).astype(int), 0, lens.w - 1), np.clip(np.round(at[..., 1]).astype(int), 0, lens.h - 1)
        same = alike & (low > 0)
        lo, hi = low[iv, iu], high[iv, iu]
        m = use & seen & uniform & same[iv, iu] & (before.image["instance"][iv, iu] == instance) & (before.image["semantic"][iv, iu] == semantic)
        m &= ~f.fresh & ~shifting & ~before.clod[iv, iu]
        m &= (hi - lo) < 0.1 * hi
        # Ground that is dug stands still by definition; 1 % (docs), and the spread once more for places between pixels.
        slack = 0.002 + 0.011 * n + (hi - lo)
        j.share("scene flow: ends at the distance seen before", ((n <= hi + slack) & (n >= lo - slack))[m], 0.99, where, f.t, "px", places=lens.pixels[m])


def _facing(j, cam, f, where, facing, use, text):
    # Towards the camera: a smooth normal at the edge of a round part could look away; the documentation says that none of an object's does;
    # ground is smooth over its crests.
    # Behind a lens the ray is the nearest pixel's.
    lens = cam.lens
    slack = 1e-4 if not lens.distorts else cam.ray_px / lens.f.min() * 1.5 + 1e-4
    j.all_within(f"normals: towards the camera, cosine ({text}; {'lens' if lens.distorts else 'pinhole'})", facing[use], slack, where, f.t, "px",
                 places=lens.pixels[use])


def check_normals(j, data, cam, f, where):
    if "normal" not in f.image:
        return
    lens = cam.lens
    raw = f.image["normal"]
    none = (raw == 0).all(-1)
    n = raw.astype(float) / 32767 - 1
    semantic, instance = f.image["semantic"], f.image["instance"]
    sky = semantic == data.class_id["sky"]
    j.all_within("normals: none just in the sky", (none != sky).reshape(-1), 0, where, f.t, "px", places=lens.pixels.reshape(-1, 2))
    use = ~none
    # Rounding by half of 1/32767 on each axis: sqrt(3) / 2 / 32767.
    j.all_within("normals: unit length", np.abs(np.linalg.norm(n[use], axis=1) - 1), 4e-5, where, f.t, "px", places=lens.pixels[use])
    facing = (n * lens.unit).sum(-1)
    _facing(j, cam, f, where, facing, use & (instance > 0), "objects")
    # Planes of machines (obstacles may be smooth over their edges, as the barrier is): a plane through the points of 5 x 5 pixels of one instance, where it fits them to a
    # millimetre and is not seen at a glance, has the normal. Rounding of distance over 4 pixels of some millimetres makes some
    # degrees at near ones, so medians and a share. Round parts, such as a bucket's back, are smoothed over flat facets of up to
    # some 20 deg: the median may be a quarter of that.
    if not hasattr(f, "p") or "instance" not in f.image:
        return
    uniform = same_around(instance, semantic, 5) & (f.d > 0) & np.isin(instance, [i for i in data.body if data.body[i][0] == "link"])
    uniform[:2], uniform[-2:], uniform[:, :2], uniform[:, -2:] = False, False, False, False
    mean, second = [], []
    p = f.p
    for a in range(3):
        mean.append(cv2.blur(p[..., a], (5, 5)))
    for a in range(3):
        for b in range(a, 3):
            second.append(((a, b), cv2.blur(p[..., a] * p[..., b], (5, 5)) - mean[a] * mean[b]))
    where_ = np.argwhere(uniform)
    if len(where_) < 100:
        return
    m = np.zeros((len(where_), 3, 3))
    for (a, b), s in second:
        m[:, a, b] = m[:, b, a] = s[where_[:, 0], where_[:, 1]]
    values, vectors = np.linalg.eigh(m)
    normal = vectors[:, :, 0]
    ray = lens.unit[where_[:, 0], where_[:, 1]]
    normal *= -np.sign((normal * ray).sum(1, keepdims=True))
    thick, wide = np.sqrt(np.maximum(values[:, 0], 0)), np.sqrt(np.maximum(values[:, 1], 0))
    good = (thick < 0.0012) & (thick < 0.03 * wide) & (np.abs((normal * ray).sum(1)) > 0.3) & (wide > 0.006)
    if good.sum() < 300:
        return
    label = n[where_[:, 0], where_[:, 1]]
    angle = np.degrees(np.arccos(np.clip((label * normal).sum(1), -1, 1)))[good]
    j.all_within("normals: of planes, against points (median)", [np.median(angle)], 6.0, where, f.t, "median", "deg")
    j.share("normals: of planes within 15 deg", angle < 15, 0.9, where, f.t, "px", places=where_[good][:, ::-1])


def site_extent(data):
    terrain = data.scenario["terrain"]
    size = terrain.get("size_m")
    if not size or terrain.get("geotiff") or terrain.get("center_m"):
        return None
    return np.array(size, float) / 2


def near_on_ground(p_w, mask, reach_m):
    """Pixels that show a place within `reach_m`, seen from above, of one that a pixel of the mask shows."""
    if not mask.any():
        return mask
    low = p_w[mask][:, :2].min(0) - 2 * reach_m
    squares = np.floor((p_w[..., :2] - low) / (reach_m / 4)).astype(int)
    extent = squares[mask].max(0) + 9
    grid = np.zeros(extent[::-1], np.uint8)
    grid[squares[mask][:, 1], squares[mask][:, 0]] = 1
    grid = cv2.dilate(grid, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (9, 9)))
    inside = ((squares >= 0) & (squares < extent)).all(-1)
    near = np.zeros(mask.shape, bool)
    near[inside] = grid[squares[inside][:, 1], squares[inside][:, 0]] > 0
    return near


def check_ground(j, data, cam, f, before, first_t, where):
    lens, semantic = cam.lens, f.image["semantic"]
    soil = f.image.get("ground_soil")
    if soil is None:
        return
    ground = soil > 0
    terrain = semantic == data.class_id["terrain"]
    j.all_within("ground: only where terrain is", (ground & ~terrain).reshape(-1), 0, where, f.t, "px", places=lens.pixels.reshape(-1, 2))
    half = site_extent(data)
    p_w = None
    if f.x_wc is not None and hasattr(f, "p"):
        p_w = (f.p.reshape(-1, 3) @ f.x_wc[:3, :3].T + f.x_wc[:3, 3]).reshape(f.p.shape)
        if half is not None:
            # The site ends at +- half its size; a column (0.05 m) and the pixel's ray on flat ground are left undecided.
            grazing = np.abs((f.p.reshape(-1, 3) @ f.x_wc[2, :3]).reshape(f.d.shape)) / np.maximum(f.d, 0.1)
            unsure = 0.1 + f.d / lens.f.min() * cam.ray_px / np.maximum(grazing, 0.02)
            beyond = (np.abs(p_w[..., :2]) - half).max(-1)
            seen = terrain & (f.d > 0)
            j.all_within("ground: each terrain of the site, none beyond",
                         np.where(seen & (beyond < -unsure), ~ground & ~f.clod, np.where(seen & (beyond > unsure), ground, False)).reshape(-1), 0, where, f.t,
                         "px", places=lens.pixels.reshape(-1, 2))
    count = len(data.soils) if data.soils else None
    if count:
        j.all_within("ground: soil is one of the scenario's", [int(soil.max())], count, where, f.t, "index + 1")
    for name in ("ground_state", "ground_change", "ground_age"):
        image = f.image.get(name)
        if image is not None:
            zero = (image == 0).all(-1) if image.ndim == 3 else image == 0
            j.all_within(f"ground: {name} is 0 where soil is", image[~ground].max(initial=0), 0, where, f.t, "value")
            if name != "ground_state":
                j.all_within(f"ground: {name} is not 0 elsewhere", zero[ground], 0, where, f.t, "px")
    change = f.image.get("ground_change")
    age = f.image.get("ground_age")
    if change is not None:
        rise = (change.astype(float) - 32768) / 1000
        if before is None:
            j.all_within("ground: change is 0 in the first picture", np.abs(rise[ground]), 0, where, f.t, "change", "m")
            if age is not None:
                j.all_within("ground: nothing is touched in the first picture", (age[ground] != 65535), 0, where, f.t, "px")
    if age is not None:
        touched = ground & (age != 65535)
        seconds = (age.astype(float) - 1) / 10
        # Rounding by a tenth of a second.
        if touched.any():
            j.all_within("ground: no older than the first picture", (seconds - (f.t - first_t) / 1e9)[touched], 0.1001, where, f.t, "age", "s",
                         lens.pixels[touched])
        if change is not None:
            # What was never touched has not risen: but the grain of interpolation (1 mm) at columns beside such as were.
            # Ground is drawn through the middles of columns, and age is that of the nearest: beside a dug column its slope
            # reaches half into one that is not. Left out within two columns of touched ground in view; some of it is hidden.
            calm = ground & (age == 65535)
            if p_w is not None:
                calm &= ~near_on_ground(p_w, touched, 2 * data.cell_m)
            j.share("ground: untouched has not changed", (np.abs(rise) <= 0.0015)[calm], 0.99, where, f.t, "px", places=lens.pixels[calm])
    if before is not None and "flow_to_previous" in f.image and age is not None and before.image.get("ground_age") is not None:
        flow, state = decoded_flow(f.image["flow_to_previous"])
        at = lens.pixels + flow
        use = ground & (state == 1) & lens.inside(at, -1.5)
        old = before.image["ground_age"].astype(float)
        old_change = before.image["ground_change"].astype(float) if change is not None else None
        was = before.image["ground_soil"] > 0
        iu, iv = np.clip(np.round(at[..., 0]).astype(int), 0, lens.w - 1), np.clip(np.round(at[..., 1]).astype(int), 0, lens.h - 1)
        lo, hi = (x[iv, iu] for x in spread(old))
        use &= (spread(was)[0] > 0)[iv, iu]
        if change is not None:
            clo, chi = (x[iv, iu] for x in spread(old_change))
        step = (f.t - before.t) / 1e8  # tenths
        now = age.astype(float)
        # Touched since: no older than the step. Untouched: as much older, both rounded (1 tenth each). Never: was never.
        fresh = now - 1 <= step + 1.01
        aged = (now >= lo + step - 2.01) & (now <= hi + step + 2.01) & (now < 65535)
        never = (now == 65535) & (hi == 65535)
        # A share: interpolation between columns of different age.
        j.share("ground: age grows by the time, or anew", (fresh | aged | never)[use], 0.99, where, f.t, "px", places=lens.pixels[use])
        if change is not None:
            c = change.astype(float)
            moved_ = np.maximum(c - chi, clo - c)
            # What rose or fell by more than 2 cm between two pictures was touched since. Seen at a glance, a pixel is some columns wide,
            # hence a share.
            # At a wall the pixel before shows another column: only where change is alike about the pixel, in both pictures.
            low, high = spread(np.where(ground, c, 0))
            m = use & (moved_ > 20) & (chi - clo < 20) & (high - low < 20)
            if p_w is not None:  # the slope beside a column that was touched reaches half into the next, as above
                fresh |= near_on_ground(p_w, fresh & ground, data.cell_m)
            j.share("ground: what rises or falls is touched", fresh[m], 0.9, where, f.t, "px", least_n=20, places=lens.pixels[m])
    # Against the rasters of the ground at the end.
    if change is not None and p_w is not None and f.t == data.end_ns:
        for what in ("change", "height"):
            raster = data.raster(what + "_end")
            if raster is None or (what == "change" and first_t != 0):
                continue
            m = ground & (f.d > 0)
            xy = p_w[m][:, :2]
            low, high, inside = raster.around(xy)
            value = (change[m].astype(float) - 32768) / 1000 if what == "change" else p_w[m][:, 2] + data.height
            # Between the least and the greatest of the columns about the place (0.1 m either way); 3 mm of rounding and of the ray.
            slack = 0.003 + f.d[m] / lens.f.min() * cam.ray_px
            if what == "height":
                slack += 0.01  # "fine relief of its grain", of which the documents do not say that it is in the rasters
            near = inside & (f.d[m] < 25)
            j.share(f"ground: {what} as the raster of the end", ((value >= low - slack) & (value <= high + slack))[near], 0.99, where, f.t, "px",
                    places=lens.pixels[m][near])
    if f.t == 0 and p_w is not None and data.raster("height_start") is not None:
        m = ground & (f.d > 0)
        low, high, inside = data.raster("height_start").around(p_w[m][:, :2])
        value = p_w[m][:, 2] + data.height
        slack = 0.013 + f.d[m] / lens.f.min() * cam.ray_px
        near = inside & (f.d[m] < 25)
        j.share("ground: height as the raster of the start", ((value >= low - slack) & (value <= high + slack))[near], 0.99, where, f.t, "px",
                places=lens.pixels[m][near])
    if data.raster("soil_class_end") is not None and p_w is not None and f.t == data.end_ns:
        m = ground & (f.d > 0) & (f.d < 25)
        raster = data.raster("soil_class_end")
        low, high, inside = raster.around(p_w[m][:, :2])
        flat = inside & (low == high)
        # Surface soil of columns that are alike all about.
        j.share("ground: soil as the raster of the end", (soil[m] - 1 == low)[flat], 0.99, where, f.t, "px", places=lens.pixels[m][flat])


def check_scans(j, data, cam, f, where):
    """Points of the machine's lidars that were taken within 60 ms of the picture, carried to its time with the bodies they lie on."""
    lens, instance = cam.lens, f.image["instance"]
    for path in data.lidars(cam.machine):
        track = data.track("truth", cam.machine, "sensors", path.split("/")[1] + ".csv")
        if track is None:
            continue
        if path not in data.scans:
            _, rows = read_csv(data.file(path, "data.csv"))
            with open(data.file(path, "sensor.yaml")) as g:
                data.scans[path] = {"rows": [(int(r[0]), r[1]) for r in rows], "sensor": yaml.safe_load(g), "kept": {}}
        scans = data.scans[path]
        period = 1e9 / scans["sensor"]["rate_hz"]
        points, times, ids, labels = [], [], [], []
        for t, name in scans["rows"]:
            if t > f.t + 6e7 or t + period < f.t - 6e7:
                continue
            if name not in scans["kept"]:
                if len(scans["kept"]) > 6:
                    scans["kept"].pop(next(iter(scans["kept"])))
                scans["kept"][name] = read_pcd(data.file(path, "scans", name))
            scan = scans["kept"][name]
            if not scan:
                continue
            when = t + scan["time"].astype(np.int64)
            use = np.abs(when - f.t) <= 6e7
            points.append(np.stack([scan["x"], scan["y"], scan["z"]], 1).astype(float)[use])
            times.append(when[use]); ids.append(scan["instance"][use].astype(int)); labels.append(scan["label"][use].astype(int))
        if not points:
            continue
        points, times, ids, labels = map(np.concatenate, (points, times, ids, labels))
        if not len(points):
            continue
        wrong = [(i, l) for i, l in {(int(a), int(b)) for a, b in zip(ids, labels)}
                 if (i == 0 and l != data.class_id["terrain"]) or (i and (i not in data.instances or data.class_id[data.instances[i]["class"]] != l))]
        j.holds("scans: instance and label agree", not wrong, where, f.t, f"{path}: (instance, label) {wrong}")
        x = track.at(times)
        p = (x[:, :3, :3] @ points[..., None])[..., 0] + x[:, :3, 3]
        known = np.zeros(len(p), bool)
        for i in np.unique(ids).tolist():
            body, moving = data.body.get(i, ("unknown", None)) if i else ("still", None)
            m = ids == i
            known[m] = body != "unknown"
            if moving is not None:
                back = inverse(moving.at(times[m]))
                local = (back[:, :3, :3] @ p[m][..., None])[..., 0] + back[:, :3, 3]
                p[m] = moved(moving.at(f.t)[0], local)
        p_c = moved(inverse(f.x_wc), p)
        q, ok = lens.project(p_c)
        d = np.linalg.norm(p_c, axis=1)
        use = known & ok & lens.inside(q, -1.5) & (d > cam.model.get("near_m", 0.05) + 0.1) & (d < 60)
        if lens.by_angle:
            use &= np.arctan2(np.linalg.norm(p_c[:, :2], axis=1), p_c[:, 2]) < lens.theta_max - 0.02
        q, d, ids_, labels_ = q[use], d[use], ids[use], labels[use]
        u, v = np.round(q[:, 0]).astype(int), np.round(q[:, 1]).astype(int)
        # Within the 3 x 3 pixels about its place, pixels of its own instance have its distance: between the least and the greatest of
        # them, give or take five sigma of range noise and 2 cm (rounding, motion of soil and cylinders within 60 ms).
        slack = 5 * scans["sensor"]["model"].get("range_noise_m", 0) + 0.02
        own_low, own_high = np.full(len(d), np.inf), np.full(len(d), -np.inf)
        least = np.full(len(d), np.inf)
        like = np.zeros(len(d), bool)
        # Soil that falls is of the terrain's class for the lidar too, and falls 0.1 m and more in 60 ms: nothing is said about points
        # within some 20 pixels of it.
        soil_falls = cv2.dilate(f.clod.astype(np.uint8), np.ones((41, 41), np.uint8))[v, u] > 0
        reach = 1
        for dv in range(-reach, reach + 1):
            for du in range(-reach, reach + 1):
                c = v + dv, u + du
                dist = np.where(f.d[c] > 0, f.d[c], 70.0)
                same = (instance[c] == ids_) & (f.image["semantic"][c] == labels_)
                own_low = np.where(same, np.minimum(own_low, dist), own_low)
                own_high = np.where(same, np.maximum(own_high, dist), own_high)
                least = np.minimum(least, dist)
                like |= np.abs(dist - d) < 0.03 + 0.003 * d
        match = (d >= own_low - slack) & (d <= own_high + slack)
        # Something stands before it for the camera: lidar and camera are not in one place.
        hidden = ~match & (least < d - slack) & ~like
        judged = ~hidden & ~soil_falls
        j.share("scans: points fall on their instance and distance", match[judged], 0.98, where, f.t, path,
                places=np.stack([u, v], 1)[judged])
        cam.met += int(match.sum())
        # Moving bodies by themselves, so that much ground does not drown them.
        moving_ids = [i for i in data.instances if data.body[i][0] in ("link", "moving obstacle")]
        m = judged & np.isin(ids_, moving_ids)
        j.share("scans: points of moving bodies fall on them", match[m], 0.90, where, f.t, path, places=np.stack([u, v], 1)[m])


def check_camera(j, data, cam, limit):
    where = cam.path
    cam.watch, cam.tight, cam.tally, cam.met = Watch(data, cam), [], {}, 0
    before, first_t = None, cam.frames[0][0] if cam.frames else 0
    names = sorted(os.listdir(data.file(cam.path, "rgb"))) if cam.model.get("rgb") else None
    if names is not None:
        j.holds("files: as many pictures as rows", sorted(n for _, n in cam.frames) == names, where, "all", f"{len(names)} of {len(cam.frames)}")
    times = [t for t, _ in cam.frames]
    j.holds("files: stamps increase", all(b > a for a, b in zip(times, times[1:])), where, "all", "data.csv")
    if cam.truth is not None:
        # The recorded pose is the parent link's times the mount (without effects that put the sensor elsewhere).
        link = data.track("truth", cam.machine, "links", cam.sensor["parent_link"] + ".csv")
        elsewhere = data.track("truth", cam.machine, "sensors", cam.name + ".documented.csv")
        if link is not None and elsewhere is None and times:
            mount = np.array(cam.sensor["X_parent_sensor"]["matrix"])
            error = np.abs(link.at(times) @ mount - cam.truth.at(times)).max()
            j.all_within("poses: sensor is its link times its mount", [error], 1e-6, where, "all", "pose", "m")
        on = np.isin(np.array(times), cam.truth.t)
        j.holds("poses: there is one at each picture", bool(on.all()), where, "all", f"{int((~on).sum())} without; poses_hz is no multiple of rate_hz?")
    count = 0
    for t, filename in cam.frames:
        if limit and count >= limit:
            break
        f = cam.load(t, filename)
        check_files(j, cam, f, where)
        image = f.image
        whole = {k for k in image if image[k] is not None and image[k].shape[:2] == (cam.lens.h, cam.lens.w)}
        f.image = {k: image[k] for k in whole}
        if {"instance", "semantic"} <= whole:
            check_classes(j, data, cam, f, where)
            if f.boxes is not None:
                check_boxes(j, data, cam, f, where)
                check_keypoints(j, data, cam, f, where)
            if "distance" in whole:
                check_distance(j, data, cam, f, where)
                if f.x_wc is not None:
                    if before is None or {"instance", "semantic", "distance"} <= set(before.image):
                        check_motion(j, data, cam, f, before, where)
                    check_scans(j, data, cam, f, where)
                check_normals(j, data, cam, f, where)
            check_ground(j, data, cam, f, before, first_t, where)
        before = f
        count += 1
    cam.watch.finish(j, where)
    j.share("boxes: amodal box is tight where nothing hides", cam.tight, 0.9, where, "all", "within a pixel", least_n=10)
    # Links: cylinders and rockers go by the name of a link but move on their own, so of all of a link's pixels, over all frames, most.
    for name, found in cam.tally.items():
        good = np.concatenate([g for _, g in found]) if found else np.zeros(0, bool)
        if "as poses say" in name:
            j.share(name, good, 0.85, where, "all", "px", least_n=2000)
        else:
            cam.detail.append((name, good.mean() if good.size else 1.0, good.size))
    return count


def judge(path, frames=None, detail=False):
    data = Dataset(path)
    data.end_ns = int(round(float(data.meta["duration_s"]) * 1e9))
    data.height = data.meta["origin"]["height_m"]
    rasters = {}

    def raster(name):
        if name not in rasters:
            file = data.file("truth", "terrain", name + ".tif")
            rasters[name] = Raster.of(file) if os.path.exists(file) else None
        return rasters[name]
    data.raster = raster
    soils = raster("soil_class_end") or raster("soil_class_start")
    data.soils = [soils.metadata[f"SOIL_{k}"] for k in range(256) if f"SOIL_{k}" in soils.metadata] if soils else None
    j = Judge()
    total, met, details = 0, {}, []
    for c in data.cameras():
        cam = Camera(data, c)
        cam.detail = []
        total += check_camera(j, data, cam, frames)
        met[c] = cam.met
        details += [(c,) + d for d in cam.detail]
    j.met, j.details = met, details
    return j, total


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("dataset")
    parser.add_argument("--frames", type=int, help="no more than so many of each camera")
    parser.add_argument("--max-shown", type=int, default=40, help="faults that are listed (40)")
    parser.add_argument("--json", help="write the table there, too")
    parser.add_argument("--links", action="store_true", help="also list how much of each link moves with it")
    args = parser.parse_args()
    if not os.path.exists(os.path.join(args.dataset, "dataset.yaml")):
        print(f"{args.dataset}: no dataset.yaml", file=sys.stderr)
        return 2
    j, total = judge(args.dataset, args.frames)
    width = max(map(len, j.rows), default=10)
    print(f"{args.dataset}: {total} frames, points of scans met {j.met}")
    print(f"{'check':{width}}  {'numbers':>10}  {'worst':>10}  {'limit':>10}  unit             faults")
    for name, r in sorted(j.rows.items()):
        worst = "-" if r["worst"] is None else f"{r['worst']:.4g}"
        limit = f"{r['limit']:.4g}" if not isinstance(r["limit"], np.ndarray) else "1"
        print(f"{name:{width}}  {r['n']:>10}  {worst:>10}  {limit:>10}  {r['unit']:15}  {r['faults'] or ''}")
    if args.links:
        for d in j.details:
            print(*d)
    if args.json:
        with open(args.json, "w") as f:
            json.dump({"frames": total, "rows": j.rows, "faults": j.faults}, f, default=float)
    for path, frame, what, text in j.faults[:args.max_shown]:
        print(f"WRONG {path} {frame} {what}: {text}")
    if len(j.faults) > args.max_shown:
        print(f"... and {len(j.faults) - args.max_shown} more")
    print(f"{len(j.faults)} faults" if j.faults else "all agree")
    return 1 if j.faults else 0


if __name__ == "__main__":
    sys.exit(main())
