"""Holds an export in nuScenes' schema against the dataset that it was made from, by the development kit's description alone
(`docs/schema_nuscenes.md`, and what its `nuscenes.py` does when it loads). What the export has is read by nuScenes' rules, a
frame of a sensor by its row of calibration and its ego pose; what it should have is computed from the dataset's truth.

    python3 check_nuscenes.py DATASET EXPORT MACHINE HZ

HZ: the rate of key frames. Prints what it has seen as JSON; the first thing that is wrong ends it with status 1.
"""

import json
import sys
from datetime import datetime, timezone
from pathlib import Path

import cv2
import numpy as np

from recorded import OPTICAL, Recorded, pose

TEXT, WHOLE, NUMBER, FLAG, LIST = str, int, (int, float), bool, list
SCHEMA = {
    "attribute": {"token": TEXT, "name": TEXT, "description": TEXT},
    "calibrated_sensor": {"token": TEXT, "sensor_token": TEXT, "translation": 3, "rotation": 4, "camera_intrinsic": LIST},
    "category": {"token": TEXT, "name": TEXT, "description": TEXT, "index": WHOLE},
    "ego_pose": {"token": TEXT, "translation": 3, "rotation": 4, "timestamp": WHOLE},
    "instance": {"token": TEXT, "category_token": TEXT, "nbr_annotations": WHOLE, "first_annotation_token": TEXT,
                 "last_annotation_token": TEXT},
    "lidarseg": {"token": TEXT, "filename": TEXT, "sample_data_token": TEXT},
    "log": {"token": TEXT, "logfile": TEXT, "vehicle": TEXT, "date_captured": TEXT, "location": TEXT},
    "map": {"token": TEXT, "log_tokens": LIST, "category": TEXT, "filename": TEXT},
    "sample": {"token": TEXT, "timestamp": WHOLE, "scene_token": TEXT, "next": TEXT, "prev": TEXT},
    "sample_annotation": {"token": TEXT, "sample_token": TEXT, "instance_token": TEXT, "attribute_tokens": LIST,
                          "visibility_token": TEXT, "translation": 3, "size": 3, "rotation": 4, "num_lidar_pts": WHOLE,
                          "num_radar_pts": WHOLE, "next": TEXT, "prev": TEXT},
    "sample_data": {"token": TEXT, "sample_token": TEXT, "ego_pose_token": TEXT, "calibrated_sensor_token": TEXT,
                    "filename": TEXT, "fileformat": TEXT, "width": WHOLE, "height": WHOLE, "timestamp": WHOLE,
                    "is_key_frame": FLAG, "next": TEXT, "prev": TEXT},
    "scene": {"token": TEXT, "name": TEXT, "description": TEXT, "log_token": TEXT, "nbr_samples": WHOLE,
              "first_sample_token": TEXT, "last_sample_token": TEXT},
    "sensor": {"token": TEXT, "channel": TEXT, "modality": TEXT},
    "visibility": {"token": TEXT, "level": TEXT, "description": TEXT},
}
KEYS = {"log_token": "log", "scene_token": "scene", "sample_token": "sample", "ego_pose_token": "ego_pose",
        "calibrated_sensor_token": "calibrated_sensor", "sensor_token": "sensor", "category_token": "category",
        "instance_token": "instance", "visibility_token": "visibility", "first_annotation_token": "sample_annotation",
        "last_annotation_token": "sample_annotation", "first_sample_token": "sample", "last_sample_token": "sample",
        "sample_data_token": "sample_data"}
CATEGORY = {"terrain": "flat.terrain", "vehicle": "vehicle.construction", "truck": "vehicle.truck",
            "person": "human.pedestrian.construction_worker", "cone": "movable_object.trafficcone",
            "barrier": "movable_object.barrier", "rock": "movable_object.debris", "structure": "static.manmade",
            "vegetation": "static.vegetation", "soil_in_bucket": "static.other", "sky": "noise"}


def need(condition, *told):
    if not condition:
        sys.exit("check_nuscenes: " + " ".join(str(t) for t in told))


def apply(X, points):
    return points @ X[:3, :3].T + X[:3, 3]


class Tables:
    def __init__(self, folder):
        self.folder, self.rows = folder, {}
        for name, fields in SCHEMA.items():
            self.rows[name] = json.loads((folder / "v1.0-tera" / f"{name}.json").read_text())
            for row in self.rows[name]:
                need(set(row) == set(fields), name, "has the fields", sorted(row), "need", sorted(fields))
                for field, kind in fields.items():
                    right = (len(row[field]) == kind and all(isinstance(v, NUMBER) for v in row[field])
                             if isinstance(kind, int) else isinstance(row[field], kind))
                    need(right, name, field, "is", row[field])
        self.by_token = {name: {row["token"]: row for row in rows} for name, rows in self.rows.items()}
        for name, rows in self.rows.items():
            need(len(self.by_token[name]) == len(rows), "tokens of", name, "are there twice")
            for row in rows:
                for key in set(KEYS) & set(row):
                    need(row[key] in self.by_token[KEYS[key]], name, key, row[key], "leads nowhere")
        for name in ("sample", "sample_data", "sample_annotation"):
            self.check_chain(name)

    def get(self, table, token):
        return self.by_token[table][token]

    def check_chain(self, name):
        for row in self.rows[name]:
            for way, back in (("next", "prev"), ("prev", "next")):
                if row[way]:
                    need(self.get(name, row[way])[back] == row["token"], name, "chain at", row["token"])

    def channel(self, row):
        return self.get("sensor", self.get("calibrated_sensor", row["calibrated_sensor_token"])["sensor_token"])


class Judge:
    def __init__(self, dataset, folder, machine, hz):
        self.data, self.folder, self.machine = Recorded(dataset), Path(folder), machine
        self.t, self.period_ns = Tables(self.folder), 1e9 / hz
        self.zero_us = int(datetime(2024, 1, 1, tzinfo=timezone.utc).timestamp()) * 10**6
        own = next(i for i, entry in self.data.instances.items() if entry["name"] == machine)
        self.own = self.data.ids_of(own)
        self.frames = {}  # of each channel in order of time
        for row in self.t.rows["sample_data"]:
            self.frames.setdefault(self.t.channel(row)["channel"], []).append(row)
        self.lidar_delay_ns, self.sensors = {}, {}
        names = {p.parent.name: p.parent for p in (self.data.folder / machine).glob("*/sensor.yaml")}
        for channel in self.frames:
            kind, _, name = channel.partition("_")
            lidars = [n for n in names if self.data.sheet(f"{machine}/{n}")["type"] == "lidar"]
            name = lidars[0] if channel == "LIDAR_TOP" else name.lower()
            self.sensors[channel] = f"{machine}/{name}"
            rate = self.data.sheet(self.sensors[channel])["rate_hz"]
            self.lidar_delay_ns[channel] = round(0.5e9 / rate) if kind == "LIDAR" else 0
        self.seen = {"samples": len(self.t.rows["sample"]), "data": len(self.t.rows["sample_data"]),
                     "annotations": len(self.t.rows["sample_annotation"]), "channels": sorted(self.frames),
                     "mounts": {c: len({r["calibrated_sensor_token"] for r in rows}) for c, rows in self.frames.items()}}

    def t_ns(self, row):
        return (row["timestamp"] - self.zero_us) * 1000

    def placed(self, row):
        """X_WF of a row of sample_data, by nuScenes' way from sensor to ego to world."""
        mount = self.t.get("calibrated_sensor", row["calibrated_sensor_token"])
        ego = self.t.get("ego_pose", row["ego_pose_token"])
        need(ego["timestamp"] == row["timestamp"], "ego pose of another time", row)
        return pose(ego["translation"], ego["rotation"]) @ pose(mount["translation"], mount["rotation"])

    def check_loading(self):
        """What the development kit asserts."""
        need(self.t.rows["map"] and self.t.rows["log"], "no map, or no log")
        mapped = {token for row in self.t.rows["map"] for token in row["log_tokens"]}
        need(mapped == set(self.t.by_token["log"]), "logs without a map")
        for row in self.t.rows["map"]:
            need(cv2.imread(str(self.folder / row["filename"]), cv2.IMREAD_GRAYSCALE) is not None, row)
        files = list((self.folder / "lidarseg/v1.0-tera").iterdir())
        need(len(files) == len(self.t.rows["lidarseg"]), len(files), "files of labels")
        index = [c["index"] for c in self.t.rows["category"]]
        need(index == list(range(32)), "indices of categories", index)
        need([v["token"] for v in self.t.rows["visibility"]] == ["1", "2", "3", "4"], "visibilities")
        named = sorted(r["filename"] for r in self.t.rows["sample_data"])
        there = sorted(str(p.relative_to(self.folder)) for k in ("samples", "sweeps") for p in (self.folder / k).glob("*/*"))
        need(named == there, "files", set(named) ^ set(there))

    def check_scene(self):
        need(len(self.t.rows["scene"]) == len(self.t.rows["log"]) == 1, "scenes")
        scene, samples = self.t.rows["scene"][0], self.t.rows["sample"]
        need(self.t.rows["log"][0]["vehicle"] == self.machine, self.t.rows["log"])
        need(self.t.rows["log"][0]["date_captured"] == "2024-01-01", self.t.rows["log"])
        chain, at = [], scene["first_sample_token"]
        while at:
            chain.append(self.t.get("sample", at))
            at = chain[-1]["next"]
        need(chain == samples and scene["nbr_samples"] == len(chain), "chain of samples")
        need(scene["last_sample_token"] == chain[-1]["token"], "last sample")
        times = np.array([s["timestamp"] for s in chain])
        need((np.diff(times) * 1e3 >= self.period_ns - 2e6).all(), "samples at", times)

    def check_frames(self):
        """Of each channel all frames of the dataset, in a chain, each where its sensor truly was."""
        for channel, rows in self.frames.items():
            rows.sort(key=lambda r: r["timestamp"])
            sensor, delay_ns = self.sensors[channel], self.lidar_delay_ns[channel]
            need([self.t_ns(r) - delay_ns for r in rows] == self.data.times(sensor), "times of", channel)
            need([r["next"] for r in rows] == [r["token"] for r in rows[1:]] + [""], "chain of", channel)
            truth = self.data.sensor_poses(sensor)
            turn = np.eye(4) if channel.startswith("LIDAR") else OPTICAL
            for row in rows:
                found, expected = self.placed(row), truth.at(self.t_ns(row)) @ turn
                need(np.abs(found - expected).max() < 3e-4, channel, row["timestamp"], found, expected)
                folder = "samples" if row["is_key_frame"] else "sweeps"
                need(row["filename"].startswith(f"{folder}/{channel}/"), row["filename"])
            keys = [r["sample_token"] for r in rows if r["is_key_frame"]]
            need(len(set(keys)) == len(keys), "two key frames of", channel)
            for row in rows:
                at = self.t.get("sample", row["sample_token"])["timestamp"]
                if row["is_key_frame"]:
                    nearest = min(abs(r["timestamp"] - at) for r in rows)
                    need(abs(row["timestamp"] - at) == nearest, "key frame", row)
                else:
                    need(at >= row["timestamp"] or not self.t.get("sample", row["sample_token"])["next"], row)

    def check_pictures(self):
        for channel, rows in self.frames.items():
            if channel.startswith("LIDAR"):
                continue
            K, coefficients = self.data.lens(self.sensors[channel])
            for row in rows:
                mount = self.t.get("calibrated_sensor", row["calibrated_sensor_token"])
                need(np.allclose(mount["camera_intrinsic"], K), channel, mount["camera_intrinsic"])
                picture = cv2.imread(str(self.folder / row["filename"]))[..., ::-1].astype(int)
                need(picture.shape == (row["height"], row["width"], 3), picture.shape)
                maps = cv2.initUndistortRectifyMap(K, coefficients, None, K, (row["width"], row["height"]), cv2.CV_32FC1)
                taken = self.data.picture(self.sensors[channel], "rgb", self.t_ns(row))
                expected = cv2.remap(taken, *maps, cv2.INTER_LINEAR).astype(int)
                need(np.mean(np.abs(picture - expected) > 2) < 1e-3, row["filename"], "is not the rectified one")

    def check_points(self):
        labels = {row["sample_data_token"]: row["filename"] for row in self.t.rows["lidarseg"]}
        names = {c["index"]: c["name"] for c in self.t.rows["category"]}
        self.seen["points"] = 0
        for channel, rows in self.frames.items():
            if not channel.startswith("LIDAR"):
                continue
            truth = self.data.sensor_poses(self.sensors[channel])
            for row in rows:
                need((row["token"] in labels) == row["is_key_frame"], "labels of", row["filename"])
                points = np.fromfile(self.folder / row["filename"], "<f4").reshape(-1, 5).astype(float)
                begun_ns = self.t_ns(row) - self.lidar_delay_ns[channel]
                scan = self.data.scan(self.sensors[channel], begun_ns)
                need(len(points) == len(scan) > 0, len(points), "points, need", len(scan))
                need(np.allclose(points[:, 3], 255.0 * scan["intensity"], atol=1e-3), "intensities")
                need((points[:, 4] == scan["ring"]).all(), "rings")
                own = np.column_stack([scan["x"], scan["y"], scan["z"]]).astype(float)
                now = apply(self.placed(row), points[:, :3])
                for i in range(0, len(scan), 97):
                    then = apply(truth.at(begun_ns + int(scan["time"][i])), own[i:i + 1])[0]
                    need(np.abs(now[i] - then).max() < 2e-3, "point", i, "of", row["filename"])
                if row["is_key_frame"]:
                    self.check_categories(scan, np.fromfile(self.folder / labels[row["token"]], np.uint8), names)
                    self.seen["points"] += len(scan)

    def check_categories(self, scan, found, names):
        need(len(found) == len(scan), "labels of", len(found), "points")
        for number, label, category in set(zip(scan["instance"].tolist(), scan["label"].tolist(), found.tolist())):
            name = self.data.classes[label]
            expected = "vehicle.ego" if number in self.own else CATEGORY.get(name, "vehicle.construction")
            need(names[category] == expected, name, "is", names[category], "need", expected)

    def boxes_at(self, sample_ns):
        """Centres in W of what the nearest pictures show, between two pictures on the line from one to the other."""
        found = {}
        for channel in self.frames:
            if channel.startswith("LIDAR"):
                continue
            sensor, times = self.sensors[channel], np.array(self.data.times(self.sensors[channel]))
            truth = self.data.sensor_poses(sensor)
            near = times[np.argmin(np.abs(times - sample_ns))]
            place = lambda t: {b["instance"]: (apply(truth.at(t) @ OPTICAL, np.array([b["p_CO_m"]]))[0], b)
                               for b in self.data.boxes(sensor, t) if b["visible_px"] > 0}
            sides = [place(t) for t in (times[times <= sample_ns][-1:].tolist() + times[times > sample_ns][:1].tolist())]
            ends = times[times <= sample_ns][-1:].tolist() + times[times > sample_ns][:1].tolist()
            for number, (centre, box) in place(near).items():
                if box["parent"] or number in self.own:
                    continue
                if len(sides) == 2 and all(number in side for side in sides):
                    share = (sample_ns - ends[0]) / (ends[1] - ends[0])
                    centre = (1 - share) * sides[0][number][0] + share * sides[1][number][0]
                found.setdefault(number, []).append((centre, box))
        return found

    def check_annotations(self):
        names, of_sample = {i: e["name"] for i, e in self.data.instances.items()}, {}
        for row in self.t.rows["sample_annotation"]:
            of_sample.setdefault(row["sample_token"], []).append(row)
        categories, inside_own, in_boxes = set(), 0, 0
        for sample in self.t.rows["sample"]:
            expected = self.boxes_at(self.t_ns(sample))
            rows = of_sample.get(sample["token"], [])
            need(len(rows) == len(expected), len(rows), "annotations, need", [names[n] for n in expected])
            key = next(r for r in self.frames["LIDAR_TOP"] if r["is_key_frame"] and r["sample_token"] == sample["token"])
            points = np.fromfile(self.folder / key["filename"], "<f4").reshape(-1, 5).astype(float)
            points_W = apply(self.placed(key), points[:, :3])
            scan = self.data.scan(self.sensors["LIDAR_TOP"], self.t_ns(key) - self.lidar_delay_ns["LIDAR_TOP"])
            for row in rows:
                number = min(expected, key=lambda n: np.abs(expected[n][0][0] - row["translation"]).max())
                centre, box = expected.pop(number)[0]
                need(np.abs(centre - row["translation"]).max() < 0.02, names[number], centre, row["translation"])
                x, y, z = box["size_O_m"]
                need(np.allclose(row["size"], [y, x, z], atol=0.05), names[number], row["size"], box["size_O_m"])
                category = self.t.get("category", self.t.get("instance", row["instance_token"])["category_token"])["name"]
                need(category == CATEGORY[self.data.instances[number]["class"]], names[number], category)
                categories.add(category)
                # nuScenes' own way to ask which points are in a box: its axes are length, width, height.
                within = apply(np.linalg.inv(pose(row["translation"], row["rotation"])), points_W)
                half = np.array(row["size"])[[1, 0, 2]] / 2
                inside = (np.abs(within) <= half).all(axis=1)
                need(abs(int(inside.sum()) - row["num_lidar_pts"]) <= 2, names[number], inside.sum(), row["num_lidar_pts"])
                is_its = np.isin(scan["instance"], list(self.data.ids_of(number)))
                inside_own += int((np.abs(within[is_its]) <= half + 0.05).all(axis=1).sum())
                in_boxes += int(is_its.sum())
                level = int(row["visibility_token"])
                need((0, 0.4, 0.6, 0.8)[level - 1] <= max(b["visibility"] for _, b in self.boxes_at(self.t_ns(sample))[number])
                     <= (0.4, 0.6, 0.8, 1)[level - 1], names[number], "visibility", level)
        need(inside_own >= 0.97 * in_boxes > 0, inside_own, "of", in_boxes, "points of objects are in their boxes")
        counts = {}
        for row in self.t.rows["sample_annotation"]:
            counts[row["instance_token"]] = counts.get(row["instance_token"], 0) + 1
        for row in self.t.rows["instance"]:
            need(counts[row["token"]] == row["nbr_annotations"], row)
            need(not self.t.get("sample_annotation", row["first_annotation_token"])["prev"], row)
            need(not self.t.get("sample_annotation", row["last_annotation_token"])["next"], row)
        self.seen |= {"categories": sorted(categories), "points_in_boxes": inside_own}


def main():
    judge = Judge(sys.argv[1], sys.argv[2], sys.argv[3], float(sys.argv[4]))
    judge.check_loading()
    judge.check_scene()
    judge.check_frames()
    judge.check_pictures()
    judge.check_points()
    judge.check_annotations()
    print(json.dumps(judge.seen))


if __name__ == "__main__":
    main()
