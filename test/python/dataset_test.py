"""The reader of datasets against the geometry of a scene, against OpenCV, and against files written by hand."""

import csv
import json
import os
import pickle
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import cv2
import numpy as np

import tera
from tera.data import pcd
from tera.data.camera import Frame
from tera.data.pose import inverse, slerp

PROGRAM = os.environ.get("TERA_PROGRAM", "tera")
ROOT = Path(__file__).resolve().parents[2]


def setUpModule():
    """A second of the quickstart with poses; the depth of its front camera has no noise."""
    global _folder, RUN
    _folder = tempfile.TemporaryDirectory()
    RUN = Path(_folder.name) / "run"
    subprocess.run([PROGRAM, "generate", str(ROOT / "config/scenarios/quickstart.yaml"), "--duration", "1", "--out", str(RUN),
                    "--set", "record.poses_hz=200", "--set", "machines[0].rig.sensors[6].disparity_noise_px=0"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def tearDownModule():
    _folder.cleanup()


class Tables(unittest.TestCase):
    def test_columns_are_those_of_the_file(self):
        imu = tera.Dataset(RUN)["excavator1/imu_boom"]
        with (RUN / "excavator1/imu_boom/data.csv").open() as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(imu), len(rows))
        self.assertEqual([int(row["t_ns"]) for row in rows], list(imu.t_ns))
        for name in imu.columns:
            np.testing.assert_array_equal(imu[name], [float(row[name]) for row in rows])

    def test_events_are_rows_of_words_and_numbers(self):
        dataset = tera.Dataset(RUN)
        with (RUN / "truth/events.csv").open() as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([tuple(map(str, event[:6])) for event in dataset["truth/events"]], [tuple(row.values())[:6] for row in rows])
        file = Path(_folder.name) / "events.csv"
        header = "t_ns,end_ns,kind,machine,part,other,value,unit\n"
        file.write_text(header + "10,30,contact,m,blade,cone,812.5,N\n20,25,drop,,,box,1.5,m\n")
        events = tera.Events(file)
        self.assertEqual(events.of("contact"), [tera.Event(10, 30, "contact", "m", "blade", "cone", 812.5, "N")])
        self.assertEqual([event.kind for event in events.at(22)], ["contact", "drop"])
        self.assertEqual([event.kind for event in events.at(30)], ["contact"])
        self.assertEqual(list(events.t_ns), [10, 20])
        file.write_text(header + "10,30,contact\n")
        with self.assertRaisesRegex(ValueError, "events.csv:2: "):
            tera.Events(file)
        file.write_text("t_ns,kind\n")
        with self.assertRaisesRegex(ValueError, "events.csv:1: found"):
            tera.Events(file)

    def test_events_that_cannot_be_are_refused(self):
        file = Path(_folder.name) / "events.csv"
        rows = ("30,10,contact,m,blade,cone,812.5,N", "10,30,kiss,m,blade,cone,812.5,N", "10,30,contact,m,blade,cone,nan,N",
                "10,30,contact,m,blade,cone,inf,N", "10,30,contact,m,blade,cone,-1,N", "10,30,contact,m,blade,cone,812.5,kg")
        for row in rows:
            file.write_text(f"t_ns,end_ns,kind,machine,part,other,value,unit\n5,5,drop,,,box,1.5,m\n{row}\n")
            with self.subTest(row), self.assertRaisesRegex(ValueError, "events.csv:3: "):
                tera.Events(file)

    def test_the_last_row_that_is_not_later_holds(self):
        levers = tera.Dataset(RUN)["excavator1/commands"]
        second = int(levers.t_ns[1])
        self.assertEqual(levers.at(second - 1), dict(zip(levers.columns, levers.values[0])))
        self.assertEqual(levers.at(second), dict(zip(levers.columns, levers.values[1])))
        with self.assertRaisesRegex(ValueError, "begins at"):
            levers.at(int(levers.t_ns[0]) - 1)

    def test_unknown_names_are_told_with_those_that_there_are(self):
        dataset = tera.Dataset(RUN)
        with self.assertRaisesRegex(KeyError, "imu_boom"):
            dataset["excavator1/imu_bom"]
        with self.assertRaisesRegex(KeyError, "wx_radps"):
            dataset["excavator1/imu_boom"]["wx"]

    def test_a_table_of_one_row_and_one_of_none_keep_their_shape(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "data.csv"
            file.write_text("t_ns,a,b\n5,1,2\n")
            self.assertEqual(tera.Table(file).values.shape, (1, 2))
            file.write_text("t_ns,a,b\n")
            self.assertEqual(tera.Table(file).values.shape, (0, 2))


class Poses(unittest.TestCase):
    def test_a_quarter_turn_is_half_done_half_way(self):
        c, s = np.cos(np.pi / 4), np.sin(np.pi / 4)
        half = slerp(np.array([[1.0, 0, 0, 0]]), np.array([[c, 0, 0, s]]), np.array([[0.5]]))
        np.testing.assert_allclose(half[0], [np.cos(np.pi / 8), 0, 0, np.sin(np.pi / 8)], atol=1e-12)
        other = slerp(np.array([[1.0, 0, 0, 0]]), -np.array([[c, 0, 0, s]]), np.array([[0.5]]))
        np.testing.assert_allclose(other, half, atol=1e-12)

    def test_matrices_turn_as_their_quaternions(self):
        X = tera.pose_matrix(np.array([1.0, 2, 3]), np.array([np.sqrt(0.5), 0, 0, np.sqrt(0.5)]))
        np.testing.assert_allclose(tera.transformed(X, np.array([[1.0, 0, 0]])), [[1, 3, 3]], atol=1e-12)
        np.testing.assert_allclose(inverse(X) @ X, np.eye(4), atol=1e-12)

    def test_a_sensor_sits_on_its_link(self):
        dataset = tera.Dataset(RUN)
        t_ns = 400_000_000
        X_LS = np.array(dataset.sensor("excavator1/imu_boom")["X_parent_sensor"]["matrix"])
        expected = dataset.pose("excavator1/boom", t_ns) @ X_LS
        np.testing.assert_allclose(dataset.pose("excavator1/imu_boom", t_ns), expected, atol=1e-6)

    def test_several_times_at_once_are_each_of_them(self):
        dataset = tera.Dataset(RUN)
        times = np.array([100_000_000, 333_333_333, 900_000_001])
        several = dataset.transform("excavator1/lidar_roof", "excavator1/bucket", times)
        for k, t_ns in enumerate(times):
            np.testing.assert_allclose(
                several[k], dataset.transform("excavator1/lidar_roof", "excavator1/bucket", int(t_ns)), atol=1e-12)

    def test_nothing_is_told_beyond_the_recording(self):
        with self.assertRaisesRegex(ValueError, "asked for 5000000000"):
            tera.Dataset(RUN).pose("excavator1", 5_000_000_000)
        with self.assertRaisesRegex(KeyError, "poses_hz"):
            tera.Dataset(RUN).pose("excavator1/no_such_link", 0)


class Cameras(unittest.TestCase):
    def test_dataset_goes_to_the_workers_of_a_loader(self):
        dataset = tera.Dataset(RUN)
        dataset["excavator1/imu_boom"]
        self.assertEqual(list(pickle.loads(pickle.dumps(dataset))), list(dataset))

    def test_pictures_lie_in_memory_as_loaders_need_them(self):
        self.assertTrue(tera.Dataset(RUN)["excavator1/camera_front"][0].rgb.flags["C_CONTIGUOUS"])

    def test_lenses_are_opencvs(self):
        lens = tera.Lens(640, 480, 500, 510, 310, 250, k1=-0.2, k2=0.05, p1=0.003, p2=-0.002, k3=0.01)
        points = np.random.default_rng(1).uniform([-1, -1, 2], [1, 1, 6], (200, 3))
        expected, _ = cv2.projectPoints(points, np.zeros(3), np.zeros(3), lens.K, lens.distortion)
        pixels, z = lens.project(points)
        np.testing.assert_allclose(pixels, expected[:, 0], atol=1e-9)
        np.testing.assert_allclose(lens.rays(pixels), points / points[:, 2:], atol=1e-9)
        self.assertTrue(np.isnan(lens.project(np.array([[0.0, 0, -1]]))[0]).all())

    def test_rays_undo_strong_lenses(self):
        across = np.array([[x, y, 1.0] for x in np.linspace(-1.4, 1.4, 9) for y in np.linspace(-1.1, 1.1, 7)])
        for k1, k2, reach in ((0.5, 0.0, 1.0), (0.2, 0.0, 1.6), (-0.3, 0.1, 0.7)):
            lens = tera.Lens(640, 480, 150, 150, 319.5, 239.5, k1=k1, k2=k2)
            points = across * [reach, reach, 1]
            np.testing.assert_allclose(lens.rays(lens.project(points)[0]), points, atol=1e-9)

    def test_pixel_that_a_lens_folds_over_has_no_ray(self):
        lens = tera.Lens(640, 480, 150, 150, 319.5, 239.5, k1=-0.3)  # x (1 - 0.3 x2) ends at 0.70 of x = 1.05
        self.assertTrue(np.isnan(lens.rays(np.array([[319.5 + 150 * 0.8, 239.5]]))[0, :2]).all())

    def test_lenses_of_other_laws_are_opencvs(self):
        points = np.random.default_rng(2).uniform([-1, -1, 2], [1, 1, 6], (200, 3))
        rational = tera.Lens(640, 480, 330, 328, 310, 250, k1=0.62, k2=0.05, p1=0.001, p2=-0.0007, k3=0.002,
                             lens="rational", k4=0.93, k5=0.19, k6=0.01)
        expected, _ = cv2.projectPoints(points, np.zeros(3), np.zeros(3), rational.K, rational.distortion)
        pixels, _ = rational.project(points)
        np.testing.assert_allclose(pixels, expected[:, 0], atol=1e-9)
        np.testing.assert_allclose(rational.rays(pixels), points / points[:, 2:], atol=1e-9)
        fisheye = tera.Lens(640, 480, 181, 180, 322, 236, k1=0.031, k2=-0.012, k3=0.004, k4=-0.0007,
                            lens="kannala_brandt", field_of_view_deg=200)
        points = np.random.default_rng(3).uniform([-4, -4, 0.3], [4, 4, 2], (200, 3))
        expected, _ = cv2.fisheye.projectPoints(points[:, None], np.zeros(3), np.zeros(3), fisheye.K, fisheye.distortion)
        pixels, depth = fisheye.project(points)
        np.testing.assert_allclose(pixels, expected[:, 0], atol=1e-9)
        np.testing.assert_allclose(depth, np.linalg.norm(points, axis=1))
        np.testing.assert_allclose(fisheye.rays(pixels) * depth[:, None], points, atol=1e-9)
        beside = fisheye.rays(fisheye.project(np.array([[3.0, 1, -0.2]]))[0])  # behind the eye's own plane
        np.testing.assert_allclose(beside * np.sqrt(10.04), [[3, 1, -0.2]], atol=1e-9)
        self.assertTrue(np.isnan(fisheye.project(np.array([[0.0, 0, -1]]))[0]).all())
        with self.assertRaisesRegex(ValueError, "need brown_conrady"):
            tera.Lens(640, 480, 330, 328, 310, 250, lens="fish")

    def test_pictures_are_those_of_the_files(self):
        frame = tera.Dataset(RUN)["excavator1/camera_front"].at(520_000_000)
        self.assertEqual(frame.t_ns, 500_000_000)
        folder = RUN / "excavator1/camera_front"
        rgb = cv2.cvtColor(cv2.imread(str(folder / "rgb/500000000.png")), cv2.COLOR_BGR2RGB)
        np.testing.assert_array_equal(frame.rgb, rgb)
        raw = cv2.imread(str(folder / "depth/500000000.png"), cv2.IMREAD_UNCHANGED)
        np.testing.assert_allclose(frame.depth_m, raw * 1e-3, atol=1e-6)
        self.assertIsNone(frame.normal_C)

    def test_panoptic_numbers_are_those_of_class_and_instance(self):
        with tempfile.TemporaryDirectory() as folder:
            for kind, pixel in (("panoptic", (1, 44, 10)), ("soil_in_flight", 255)):  # OpenCV writes blue first
                (Path(folder) / kind).mkdir()
                picture = np.zeros((2, 3) + np.shape(pixel), np.uint8)
                picture[1, 2] = pixel
                cv2.imwrite(f"{folder}/{kind}/0.png", picture)
            frame = Frame(Path(folder), "0.png", 0, None)
            np.testing.assert_array_equal(frame.panoptic, [[0, 0, 0], [0, 0, 10 + 256 * 300]])
            np.testing.assert_array_equal(frame.soil_in_flight, [[False] * 3, [False, False, True]])

    def test_the_depth_of_an_object_lies_in_its_box(self):
        frame = tera.Dataset(RUN)["excavator1/camera_front"][5]
        seen = 0
        for box in frame.boxes:
            part = np.where(frame.instance == box.instance, frame.depth_m, 0)
            points = tera.transformed(inverse(box.X_CO), frame.lens.points(part))
            if len(points) < 500:
                continue
            seen += 1
            within = np.all(np.abs(points) <= box.size_O_m / 2 + 0.05, axis=1)
            self.assertGreater(within.mean(), 0.97, box.name)
        self.assertGreaterEqual(seen, 2)

    def test_parts_of_a_machine_name_it(self):
        dataset = tera.Dataset(RUN)
        names = {dataset.instances[i]["name"] for i in dataset.parts_of("excavator1")}
        self.assertLessEqual({"excavator1/boom", "excavator1/arm", "excavator1/bucket"}, names)
        self.assertEqual(len(dataset.parts_of("truck1")), 1)


class Lidars(unittest.TestCase):
    def test_points_fall_on_the_pixels_of_their_own_instance(self):
        dataset = tera.Dataset(RUN)
        frame, scan = dataset["excavator1/camera_front"][5], dataset["excavator1/lidar_roof"].at(500_000_000)
        X_WS = dataset.pose("excavator1/lidar_roof", scan.point_t_ns)
        p_W = (X_WS[:, :3, :3] @ scan.xyz_m[:, :, None])[:, :, 0] + X_WS[:, :3, 3]
        X_CW = inverse(dataset.pose("excavator1/camera_front/optical", frame.t_ns))
        pixels, z_m = frame.lens.project(tera.transformed(X_CW, p_W))
        inside = np.all((pixels >= 0) & (pixels <= [frame.lens.width_px - 1, frame.lens.height_px - 1]), axis=1)
        u, v = np.round(pixels[inside]).astype(int).T
        depth_m = frame.depth_m[v, u]
        # What the camera sees nearer hides the point, or moved since.
        same = np.abs(depth_m - z_m[inside]) < 0.02 * z_m[inside]
        self.assertGreater(same.sum(), 1000)
        agree = frame.instance[v, u][same] == scan.points["instance"][inside][same]
        self.assertGreater(agree.mean(), 0.98)

    def test_library_and_python_unpack_alike(self):
        data = (RUN / "excavator1/lidar_roof/scans/0.pcd").read_bytes()
        _, body = pcd._header_of(data, Path("0.pcd"))
        size, unpacked = struct.unpack_from("<II", data, body)
        packed = data[body + 8:body + 8 + size]
        slowly = pcd._lzf_unpacked_slowly(packed)
        self.assertEqual(len(slowly), unpacked)
        self.assertEqual(slowly, pcd.lzf_unpacked(packed, unpacked))

    def test_other_forms_of_clouds(self):
        head = "VERSION 0.7\nFIELDS x ring\nSIZE 4 2\nTYPE F U\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA "
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "a.pcd"
            file.write_text(head + "ascii\n1.5 3\n-2 65535\n")
            written = pcd.read_pcd(file)
            file.write_bytes((head + "binary\n").encode() + struct.pack("<fHfH", 1.5, 3, -2, 65535))
            packed = pcd.read_pcd(file)
            for cloud in (written, packed):
                np.testing.assert_array_equal(cloud["x"], [1.5, -2])
                np.testing.assert_array_equal(cloud["ring"], [3, 65535])
            file.write_bytes((head + "binary\n").encode() + struct.pack("<fH", 1.5, 3))
            with self.assertRaisesRegex(ValueError, "need 12"):
                pcd.read_pcd(file)
            file.write_bytes(b"\x00" * 8192)
            with self.assertRaisesRegex(ValueError, "no DATA line"):
                pcd.read_pcd(file)

    def test_a_scan_that_was_cut_off_is_no_scan(self):
        data = (RUN / "excavator1/lidar_roof/scans/0.pcd").read_bytes()
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "cut.pcd"
            file.write_bytes(data[:len(data) // 2])
            with self.assertRaisesRegex(ValueError, "cut.pcd"):
                pcd.read_pcd(file)


class WholeDatasets(unittest.TestCase):
    def test_samples_go_together(self):
        dataset = tera.Dataset(RUN)
        samples = dataset.synchronised("excavator1/camera_front", "excavator1/lidar_roof", "excavator1/encoders",
                                       "truth/excavator1/pose")
        self.assertEqual(len(samples), len(list(samples)))
        sample = samples[3]
        self.assertEqual(sample["excavator1/camera_front"].t_ns, sample["t_ns"])
        self.assertLessEqual(abs(sample["excavator1/lidar_roof"].t_ns - sample["t_ns"]), 50_000_000)
        np.testing.assert_allclose(sample["truth/excavator1/pose"], dataset.pose("excavator1", sample["t_ns"]))
        encoders = dataset["excavator1/encoders"]
        row = np.flatnonzero(encoders.t_ns <= sample["t_ns"])[-1]
        self.assertEqual(sample["excavator1/encoders"]["boom_rad"], encoders["boom_rad"][row])
        with self.assertRaises(IndexError):
            samples[len(samples)]

    def test_no_dataset_and_a_newer_one_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(FileNotFoundError, "is no complete recording, it has no dataset.yaml"):
                tera.Dataset(folder)
            (Path(folder) / "dataset.yaml").write_text("format: 7\n")
            with self.assertRaisesRegex(ValueError, "format is 7"):
                tera.Dataset(folder)

    def test_the_epoch_is_exact_and_a_simulation_has_none(self):
        self.assertIsNone(tera.Dataset(RUN).epoch)
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "dataset.yaml").write_text('format: 1\nepoch: {since_1970_ns: "1700000003000000001", clock: gps}\n')
            self.assertEqual(tera.Dataset(folder).epoch, (1_700_000_003_000_000_001, "gps"))

    def test_the_example_colours_what_the_camera_sees(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "cloud.ply"
            subprocess.run([sys.executable, "-B", str(ROOT / "examples/python/colour_cloud.py"), str(RUN), str(file)],
                           check=True, stdout=subprocess.DEVNULL)
            lines = file.read_text().splitlines()
            points = int(next(line for line in lines if line.startswith("element vertex")).split()[2])
            self.assertEqual(len(lines) - lines.index("end_header") - 1, points)
            self.assertGreater(points, 5000)

    def test_reading_needs_no_client(self):
        code = "import sys; sys.modules['grpc'] = None; import tera; tera.Dataset(sys.argv[1])"
        subprocess.run([sys.executable, "-B", "-c", code, str(RUN)], check=True)

    def test_a_diagnosis_is_read_from_its_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "diagnosis.json"
            findings = [{"target": "boom", "mechanism": "dead_band"}, {"channel": "x", "mechanism": None}]
            file.write_text(json.dumps({"verdict": ["named"], "findings": findings}))
            found = tera.diagnosis(folder)
            self.assertEqual(found.named("boom"), findings[:1])
            self.assertEqual(found.named("arm"), [])
            file.write_text("{}")
            with self.assertRaisesRegex(ValueError, "no findings"):
                tera.diagnosis(file)


if __name__ == "__main__":
    unittest.main()
