"""Holds an export in KITTI's formats against the dataset that it was made from, by the published descriptions alone: the
`dataformat.txt` of the raw data and the `readme.txt` of the development kits. What the export has is read by KITTI's rules;
what it should have is computed from the dataset's truth.

    python3 check_kitti.py DATASET EXPORT CAMERA LIDAR [IMU]

IMU: a unit without noise at the origin of the lidar's link. Prints what it has seen as JSON; the first thing that is wrong
ends it with status 1.
"""

import json
import sys
from datetime import datetime
from pathlib import Path

import cv2
import numpy as np

from recorded import OPTICAL, Recorded, rotation


def need(condition, *told):
    if not condition:
        sys.exit("check_kitti: " + " ".join(str(t) for t in told))


def close(found, expected, within, *told):
    error = np.max(np.abs(np.asarray(found, float) - np.asarray(expected, float)))
    need(error <= within, *told, "found", np.asarray(found), "need", np.asarray(expected), "within", within)


def matrices(file):
    """Of "NAME: numbers" or "NAME numbers"; what is no number is left out."""
    found = {}
    for line in file.read_text().splitlines():
        name, _, rest = line.partition(" ")
        try:
            found[name.rstrip(":")] = np.array([float(v) for v in rest.split()])
        except ValueError:
            pass
    return found


def homogeneous(numbers):
    return np.vstack([np.asarray(numbers).reshape(3, 4), [0, 0, 0, 1]])


def turn_and_shift(found):
    X = np.eye(4)
    X[:3, :3], X[:3, 3] = found["R"].reshape(3, 3), found["T"]
    return X


def apply(X, points):
    return points @ X[:3, :3].T + X[:3, 3]


def projected(P, points):
    uvw = points @ P[:, :3].T + P[:, 3]
    return uvw[:, :2] / uvw[:, 2:]


def nanoseconds(line):
    whole, _, fraction = line.partition(".")
    need(len(fraction) == 9, "timestamp", line)
    since = datetime.strptime(whole, "%Y-%m-%d %H:%M:%S") - datetime(2024, 1, 1)
    return (since.days * 86400 + since.seconds) * 10**9 + int(fraction)


class Judge:
    def __init__(self, dataset, folder, camera, lidar, imu):
        self.data, self.folder, self.camera, self.lidar = Recorded(dataset), Path(folder), camera, lidar
        self.drive = self.folder / "raw/2024_01_01/2024_01_01_drive_0001_sync"
        self.cam, self.velo = self.data.sensor_poses(camera), self.data.sensor_poses(lidar)
        self.imu = self.data.rows(imu) if imu else None
        K, coefficients = self.data.lens(camera)
        model = self.data.sheet(camera)["model"]
        self.size = (model["width_px"], model["height_px"])
        self.K = K
        self.maps = cv2.initUndistortRectifyMap(K, coefficients, None, K, self.size, cv2.CV_32FC1)
        self.t_ns = [nanoseconds(t) for t in (self.drive / "image_02/timestamps.txt").read_text().splitlines()]
        machine = next(i for i, entry in self.data.instances.items() if entry["name"] == camera.split("/")[0])
        self.own = list(self.data.ids_of(machine))
        self.seen = {"frames": len(self.t_ns)}

    def rectified(self, kind, t_ns, how):
        return cv2.remap(self.data.picture(self.camera, kind, t_ns), *self.maps, how)

    def X_WC(self, t_ns):
        return self.cam.at(t_ns) @ OPTICAL

    def X_CS(self, t_ns):
        return np.linalg.inv(self.X_WC(t_ns)) @ self.velo.at(t_ns)

    # --- raw

    def check_times(self):
        read = lambda name: [nanoseconds(t) for t in (self.drive / name).read_text().splitlines()]
        starts, ends = read("velodyne_points/timestamps_start.txt"), read("velodyne_points/timestamps_end.txt")
        period = round(1e9 / self.data.sheet(self.lidar)["rate_hz"])
        scans, pictures = self.data.times(self.lidar), self.data.times(self.camera)
        need(read("velodyne_points/timestamps.txt") == self.t_ns == read("oxts/timestamps.txt"), "other times")
        need(all(e - s == period for s, e in zip(starts, ends)), "ends of scans")
        during = {s: [p for p in pictures if s <= p < s + period] for s in scans}
        need(starts == [s for s in scans if during[s]], "other scans than those with a picture")
        for start, t_ns in zip(starts, self.t_ns):
            nearest = min(abs(p - start - period // 2) for p in during[start])
            need(t_ns in during[start] and abs(t_ns - start - period // 2) == nearest, "picture", t_ns)
        self.starts = starts
        for kind, ending in (("image_02", "png"), ("velodyne_points", "bin"), ("oxts", "txt")):
            names = sorted(p.name for p in (self.drive / kind / "data").iterdir())
            need(names == [f"{k:010d}.{ending}" for k in range(len(self.t_ns))], kind, names)

    def check_pictures(self):
        for k, t_ns in enumerate(self.t_ns):
            picture = cv2.imread(str(self.drive / "image_02/data" / f"{k:010d}.png"))[..., ::-1].astype(int)
            expected = self.rectified("rgb", t_ns, cv2.INTER_LINEAR).astype(int)
            need(picture.shape == expected.shape, picture.shape)
            need(np.mean(np.abs(picture - expected) > 2) < 1e-3, "picture", k, "is not the rectified one")

    def points(self, k):
        return np.fromfile(self.drive / "velodyne_points/data" / f"{k:010d}.bin", "<f4").reshape(-1, 4)

    def check_points(self):
        moved = 0
        for k, (t_ns, start) in enumerate(zip(self.t_ns, self.starts)):
            points, scan = self.points(k).astype(float), self.data.scan(self.lidar, start)
            need(len(points) == len(scan) > 100, len(points), "points, need", len(scan))
            close(points[:, 3], scan["intensity"], 1e-6, "reflectance")
            own = np.column_stack([scan["x"], scan["y"], scan["z"]]).astype(float)
            now = apply(self.velo.at(t_ns), points[:, :3])
            for i in range(0, len(scan), 97):
                then = apply(self.velo.at(start + int(scan["time"][i])), own[i:i + 1])
                close(now[i], then[0], 2e-3, "point", i, "of frame", k)
            moved = max(moved, np.max(np.abs(points[:, :3] - own)))
        self.seen["most_moved_m"] = round(float(moved), 4)

    def check_raw_calibration(self):
        day = self.drive.parent
        cameras = matrices(day / "calib_cam_to_cam.txt")
        for c in range(4):
            P = cameras[f"P_rect_{c:02d}"].reshape(3, 4)
            close(P, np.column_stack([self.K, np.zeros(3)]), 1e-6, "P_rect")
            close(cameras[f"R_rect_{c:02d}"], np.eye(3).ravel(), 0, "R_rect")
            need(tuple(cameras[f"S_rect_{c:02d}"]) == self.size, "S_rect")
        self.P, self.Tr = P, turn_and_shift(matrices(day / "calib_velo_to_cam.txt"))
        close(self.Tr, self.X_CS(self.t_ns[0]), 1e-6, "calib_velo_to_cam")
        self.Ti = turn_and_shift(matrices(day / "calib_imu_to_velo.txt"))
        close(self.Ti, np.linalg.inv(self.data.mount(self.lidar)), 1e-9, "calib_imu_to_velo")

    def check_projection(self):
        """Points of the lidar, through the calibration, against depth: KITTI's own way from one to the other."""
        hits = near = 0
        for k, t_ns in enumerate(self.t_ns):
            depth_m = cv2.imread(str(self.folder / "depth/2024_01_01_drive_0001_sync/proj_depth/groundtruth/image_02" /
                                     f"{k:010d}.png"), cv2.IMREAD_UNCHANGED)
            need(depth_m.dtype == np.uint16, "depth", depth_m.dtype)
            expected = self.rectified("depth", t_ns, cv2.INTER_NEAREST).astype(float) * 0.256
            need(np.mean(np.abs(depth_m - expected) > 0.51) < 0.01, "depth", k, "is not the rectified one in 256ths")
            p_C = apply(self.Tr, self.points(k)[:, :3].astype(float))
            p_C = p_C[p_C[:, 2] > 0.3]
            uv = np.rint(projected(self.P, p_C)).astype(int)
            inside = (uv >= 0).all(axis=1) & (uv < self.size).all(axis=1)
            # A pixel is half a degree wide: what its neighbours have may be what the point is on.
            at = (uv[inside, 1], uv[inside, 0])
            found, z = depth_m[at] / 256, p_C[inside, 2]
            nearest, farthest = (f(depth_m, np.ones((3, 3), np.uint8))[at] / 256 for f in (cv2.erode, cv2.dilate))
            # Where its own machine is in view, lidar and camera look past it on different sides.
            instance = cv2.dilate(np.isin(self.rectified("instance", t_ns, cv2.INTER_NEAREST), self.own).astype(np.uint8),
                                  np.ones((5, 5)))
            seen = (found > 0) & (instance[uv[inside, 1], uv[inside, 0]] == 0)
            hits += seen.sum()
            near += ((z > nearest - 0.01 * z - 0.05) & (z < farthest + 0.01 * z + 0.05))[seen].sum()
        self.seen["projected"], self.seen["projected_near"] = int(hits), round(float(near / hits), 3)
        need(near / hits > 0.9, "only", near / hits, "of", hits, "points are where depth is")

    def check_oxts(self):
        origin = self.data.about["origin"]
        for k, t_ns in enumerate(self.t_ns):
            row = [float(v) for v in (self.drive / "oxts/data" / f"{k:010d}.txt").read_text().split()]
            need(len(row) == 30, len(row), "numbers of oxts")
            (lat, lon, alt, roll, pitch, yaw, vn, ve, vf, vl, vu, ax, ay, az, af, al, au, wx, wy, wz, wf, wl, wu) = row[:23]
            X_WP = self.velo.at(t_ns) @ np.linalg.inv(self.data.mount(self.lidar))
            close(enu((lat, lon, alt), (origin["lat_deg"], origin["lon_deg"], origin["height_m"])), X_WP[:3, 3], 1e-3, "oxts place")
            cr, sr, cp, sp, cy, sy = np.cos(roll), np.sin(roll), np.cos(pitch), np.sin(pitch), np.cos(yaw), np.sin(yaw)
            Rz = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
            R = Rz @ np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]]) @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
            close(R, X_WP[:3, :3], 1e-5, "oxts attitude")
            v_W = np.array([ve, vn, vu])
            close(Rz @ [vf, vl, vu], v_W, 1e-9, "forward velocity")
            close(Rz @ [af, al, au], R @ [ax, ay, az], 1e-9, "forward acceleration")
            close(Rz @ [wf, wl, wu], R @ [wx, wy, wz], 1e-9, "forward rate")
            need(row[23:25] == [0, 0] and row[25] == 4 and row[26:] == [0, 0, 0, 0], "state", row[23:])
            if 0 < k < len(self.t_ns) - 1:
                h = 20_000_000
                link = lambda t: (self.velo.at(t) @ np.linalg.inv(self.data.mount(self.lidar)))[:3, 3]
                close(v_W, (link(t_ns + h) - link(t_ns - h)) / 0.04, 0.05, "velocity of frame", k)
            if self.imu is not None:
                # A row is the mean over the interval that ends at its time.
                rows = self.imu[(self.imu[:, 0] > t_ns - 1.2e7) & (self.imu[:, 0] < t_ns + 1.2e7)]
                if len(rows) >= 2:
                    mean = rows[:, 1:].mean(axis=0)
                    close([wx, wy, wz], mean[:3], 0.05, "rate of frame", k)
                    close([ax, ay, az], mean[3:], 0.8, "specific force of frame", k)
                    self.seen["imu_frames"] = self.seen.get("imu_frames", 0) + 1

    # --- labels

    def expected_objects(self, t_ns):
        """Of each object that is part of nothing: its entry, the rectangle of its pixels, and its mask's numbers."""
        instance = self.rectified("instance", t_ns, cv2.INTER_NEAREST)
        for box in self.data.boxes(self.camera, t_ns):
            if box["parent"]:
                continue
            ids = self.data.ids_of(box["instance"])
            ys, xs = np.nonzero(np.isin(instance, list(ids)))
            if len(xs):
                yield box, [xs.min(), ys.min(), xs.max(), ys.max()], ids

    def check_label(self, line, box, bounds, ids, t_ns, k):
        kind, truncated, occluded, alpha = line[0], float(line[1]), int(line[2]), float(line[3])
        bbox, (h, w, l), location, ry = line[4:8], map(float, line[8:11]), np.array(line[11:14], float), float(line[14])
        close(bbox, bounds, 1.01, "bbox of", box["name"])
        need(kind == {"person": "Pedestrian", "truck": "Truck"}.get(box["class"], box["class"]), kind, box["class"])
        close([l, w, h], box["size_O_m"], 1e-4, "dimensions of", box["name"])
        need(occluded == (0 if box["visibility"] >= 0.9 else 1 if box["visibility"] >= 0.5 else 2), "occluded", box)
        R_CO = rotation(box["q_CO_wxyz"])
        close(location, np.array(box["p_CO_m"]) - R_CO[:, 2] * h / 2, 1e-3, "location of", box["name"])
        # KITTI's box: x = l/2 forward and z = w/2 aside, turned about y by ry; y from 0 up to -h.
        Ry = np.array([[np.cos(ry), 0, np.sin(ry)], [0, 1, 0], [-np.sin(ry), 0, np.cos(ry)]])
        close(Ry[:, 0][[0, 2]], R_CO[[0, 2], 0] / np.hypot(*R_CO[[0, 2], 0]), 1e-4, "rotation_y of", box["name"])
        bearing = np.arctan2(location[0], location[2])
        close(np.exp(1j * np.array([alpha])).view(float), np.exp(1j * np.array([ry - bearing])).view(float), 1e-4, "alpha")
        need(-np.pi <= alpha <= np.pi and -np.pi <= ry <= np.pi, "angles", line)
        inner = np.random.default_rng(k).uniform(-0.5, 0.5, (20000, 3)) * box["size_O_m"] @ R_CO.T + box["p_CO_m"]
        uv = projected(self.P, inner)
        inside = (inner[:, 2] > 0) & (uv > -0.5).all(axis=1) & (uv < np.array(self.size) - 0.5).all(axis=1)
        close(truncated, 1 - inside.mean(), 0.02, "truncated of", box["name"])
        self.seen["truncated"] = max(self.seen.get("truncated", 0), truncated)
        # Points of the lidar on the object are in its box, as far as the object leans against the camera.
        scan = self.data.scan(self.lidar, self.starts[k])
        on = np.isin(scan["instance"], list(ids))
        p = (apply(self.Tr, self.points(k)[on, :3].astype(float)) - location) @ Ry
        lean = np.hypot(R_CO[0, 2], R_CO[2, 2]) * max(h, l / 2) + 0.1
        within = (np.abs(p[:, 0]) < l / 2 + lean) & (np.abs(p[:, 2]) < w / 2 + lean) & (p[:, 1] < lean) & (p[:, 1] > -h - lean)
        need(within.all(), "points of", box["name"], "outside its box:", p[~within][:3], (h, w, l))
        self.seen["points_in_boxes"] = self.seen.get("points_in_boxes", 0) + int(on.sum())
        self.seen["labels"] = self.seen.get("labels", 0) + 1

    def check_labels(self):
        own = self.camera.split("/")[0]
        tracks = {}
        for line in (self.folder / "tracking/training/label_02/0000.txt").read_text().splitlines():
            fields = line.split()
            need(len(fields) == 17, line)
            tracks.setdefault(int(fields[0]), []).append(fields)
        need(set(tracks) <= set(range(len(self.t_ns))), "frames", tracks.keys())
        self.seen["types"] = set()
        for k, t_ns in enumerate(self.t_ns):
            calib = matrices(self.folder / "object/training/calib" / f"{k:06d}.txt")
            close(calib["P2"].reshape(3, 4), self.P, 1e-6, "P2")
            close(homogeneous(calib["Tr_velo_to_cam"]), self.X_CS(t_ns), 1e-5, "Tr_velo_to_cam of", k)
            close(homogeneous(calib["Tr_imu_to_velo"]), self.Ti, 1e-9, "Tr_imu_to_velo")
            close(calib["R0_rect"], np.eye(3).ravel(), 0, "R0_rect")
            lines = [x.split() for x in (self.folder / "object/training/label_2" / f"{k:06d}.txt").read_text().splitlines()]
            need(all(len(line) == 15 for line in lines), "fields", lines)
            expected = list(self.expected_objects(t_ns))
            need(len(lines) == len(expected) == len(tracks[k]), len(lines), "labels of frame", k, "need", len(expected))
            for line, track, (box, bounds, ids) in zip(lines, tracks[k], expected):
                need(track[2] == line[0] and track[5:] == line[3:], "other track", track, line)
                self.seen["types"].add(line[0])
                if box["name"] == own or box["name"].startswith(own + "/"):
                    need(line[0] == "DontCare" and line[8:] == "-1 -1 -1 -1000 -1000 -1000 -10".split(), line)
                    close(line[4:8], bounds, 1.01, "region")
                    need(track[1] == "-1", track)
                    continue
                need(int(track[1]) == box["instance"], track, box)
                level = 0 if float(line[1]) <= 0.15 else 1 if float(line[1]) <= 0.5 else 2
                need(int(track[3]) == level and track[4] == line[2], track, line)
                self.check_label(line, box, bounds, ids, t_ns, k)
        self.seen["types"] = sorted(self.seen["types"])
        calib = matrices(self.folder / "tracking/training/calib/0000.txt")
        close(homogeneous(calib["Tr_velo_cam"]), self.Tr, 1e-9, "Tr_velo_cam")
        close(homogeneous(calib["Tr_imu_velo"]), self.Ti, 1e-9, "Tr_imu_velo")
        close(calib["R_rect"], np.eye(3).ravel(), 0, "R_rect")
        rows = (self.folder / "tracking/training/oxts/0000.txt").read_text().splitlines()
        raw = [(self.drive / "oxts/data" / f"{k:010d}.txt").read_text().strip() for k in range(len(self.t_ns))]
        need(rows == raw, "oxts of tracking")

    # --- odometry

    def check_odometry(self):
        sequence = self.folder / "odometry/sequences/00"
        calib = matrices(sequence / "calib.txt")
        Tr = homogeneous(calib["Tr"])
        close(Tr, self.Tr, 1e-9, "Tr")
        close(calib["P2"].reshape(3, 4), self.P, 1e-6, "P2")
        lines = (self.folder / "odometry/poses/00.txt").read_text().splitlines()
        poses = [homogeneous(np.array(line.split(), float)) for line in lines]
        times = [float(t) for t in (sequence / "times.txt").read_text().split()]
        need(len(poses) == len(times) == len(self.t_ns), len(poses), len(times))
        close(times, (np.array(self.t_ns) - self.t_ns[0]) * 1e-9, 1e-9, "times")
        X_WC0 = self.X_WC(self.t_ns[0])
        for k, t_ns in enumerate(self.t_ns):
            close(X_WC0 @ poses[k], self.X_WC(t_ns), 1e-5, "pose", k)
            # The world stands still: the ground of a scan, carried by the poses, lies on that of the truth.
            scan = self.data.scan(self.lidar, self.starts[k])
            ground = self.points(k)[scan["label"] == 1][::53, :3].astype(float)
            then = apply(self.velo.at(t_ns), ground)
            close(apply(X_WC0 @ poses[k] @ Tr, ground), then, 5e-3, "ground of frame", k)
        self.seen["travelled_m"] = round(float(np.linalg.norm(poses[-1][:3, 3])), 3)

    def check_shared_files(self):
        for k in range(len(self.t_ns)):
            picture = (self.drive / "image_02/data" / f"{k:010d}.png").read_bytes()
            points = (self.drive / "velodyne_points/data" / f"{k:010d}.bin").read_bytes()
            for folder, image, velodyne in (("object/training", "image_2", "velodyne"),
                                            ("tracking/training", "image_02/0000", "velodyne/0000"),
                                            ("odometry/sequences/00", "image_2", "velodyne")):
                need((self.folder / folder / image / f"{k:06d}.png").read_bytes() == picture, folder, "picture", k)
                need((self.folder / folder / velodyne / f"{k:06d}.bin").read_bytes() == points, folder, "points", k)


def enu(place, origin):
    """East, north, up of latitude, longitude (deg) and height about an origin: WGS 84, closed form."""
    a, e2 = 6378137.0, 0.00669437999014

    def centred(lat, lon, h):
        lat, lon = np.radians([lat, lon])
        n = a / np.sqrt(1 - e2 * np.sin(lat) ** 2)
        return np.array([(n + h) * np.cos(lat) * np.cos(lon), (n + h) * np.cos(lat) * np.sin(lon), (n * (1 - e2) + h) * np.sin(lat)])

    lat, lon = np.radians(origin[:2])
    R = np.array([[-np.sin(lon), np.cos(lon), 0],
                  [-np.sin(lat) * np.cos(lon), -np.sin(lat) * np.sin(lon), np.cos(lat)],
                  [np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)]])
    return R @ (centred(*place) - centred(*origin))


def main():
    judge = Judge(*sys.argv[1:5], sys.argv[5] if len(sys.argv) > 5 else None)
    judge.check_times()
    judge.check_pictures()
    judge.check_points()
    judge.check_raw_calibration()
    judge.check_projection()
    judge.check_oxts()
    judge.check_labels()
    judge.check_odometry()
    judge.check_shared_files()
    print(json.dumps(judge.seen))


if __name__ == "__main__":
    main()
