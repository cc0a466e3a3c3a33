#!/usr/bin/env python3
"""Whether check_labels.py notices what is wrong: it judges copies of a dataset that are broken on purpose.

    TERA_LABELS_DATASET=out/labels check_labels_test.py

The dataset needs a camera without distortion that has all labels and depth or not, on a machine with a lidar, and
record: {poses_hz: N}. TERA_LABELS_CAMERA names it (the first that has all labels); TERA_LABELS_FRAMES is how many of its pictures are
judged (8): things should move in them. Faults that the dataset has itself do not count: each test wants new ones, of the checks it names.
"""

import json
import os
import shutil
import sys
import tempfile
import unittest

import cv2
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import check_labels  # noqa: E402

DATASET = os.environ.get("TERA_LABELS_DATASET")
FRAMES = int(os.environ.get("TERA_LABELS_FRAMES", 8))


def link_or_copy(a, b):
    try:
        os.link(a, b)
    except OSError:
        shutil.copy(a, b)


@unittest.skipUnless(DATASET, "TERA_LABELS_DATASET names no dataset")
class Broken(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        data = check_labels.Dataset(DATASET)
        cls.camera = os.environ.get("TERA_LABELS_CAMERA")
        if not cls.camera:
            cls.camera = next(c for c in data.cameras() if set(check_labels.KNOWN) <= set(check_labels.Camera(data, c).labels))
        cam = check_labels.Camera(data, cls.camera)
        cls.frames = cam.frames[:FRAMES]
        cls.folder = tempfile.TemporaryDirectory(dir=os.environ.get("TERA_LABELS_TMP"))
        cls.before = cls.faults(cls.fresh("whole"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def fresh(cls, name):
        """A copy by hard links of what the judge reads, with this one camera."""
        path = os.path.join(cls.folder.name, name)
        machine = cls.camera.split("/")[0]
        shutil.copytree(os.path.join(DATASET, "truth"), os.path.join(path, "truth"), copy_function=link_or_copy)
        with open(os.path.join(DATASET, "dataset.yaml")) as f:
            lines = f.readlines()
        with open(os.path.join(path, "dataset.yaml"), "w") as f:
            f.writelines(x for x in lines if "type: camera}" not in x or f'"{cls.camera}"' in x)
        link_or_copy(os.path.join(DATASET, "scenario.yaml"), os.path.join(path, "scenario.yaml"))
        for channel in check_labels.Dataset(path).meta["channels"]:
            if channel["path"] == cls.camera or channel["path"].startswith(machine + "/") and channel["type"] == "lidar":
                shutil.copytree(os.path.join(DATASET, channel["path"]), os.path.join(path, channel["path"]), copy_function=link_or_copy)
        return path

    @staticmethod
    def faults(path):
        return {(frame, check, text.split(":")[0]) for _, frame, check, text in check_labels.judge(path, FRAMES)[0].faults}

    def moving(self):
        """The picture whose flow is largest."""
        size = []
        for t, name in self.frames[1:]:
            flow, state = check_labels.decoded_flow(check_labels.read_png(os.path.join(DATASET, self.camera, "flow_to_previous", name)))
            size.append(np.abs(flow[state > 0]).mean())
        return self.frames[1:][int(np.argmax(size))]

    def broken(self, change, *wanted):
        """Judges a copy after change(path of the camera's folder); each text of `wanted` is part of a check that newly fails."""
        path = self.fresh("broken")
        try:
            change(os.path.join(path, self.camera))
            new = self.faults(path) - self.before
        finally:
            shutil.rmtree(path)
        checks = sorted({check for _, check, _ in new})
        print(f"{self.id().split('.')[-1]}: {len(new)} new faults: {'; '.join(checks)}", file=sys.stderr)
        for text in wanted:
            self.assertTrue(any(text in check for check in checks), f"nothing about '{text}' in {checks}")

    def image(self, folder, kind, name, change):
        path = os.path.join(folder, kind, name)
        image = cv2.imread(path, cv2.IMREAD_UNCHANGED)
        rgb = image[..., ::-1] if image.ndim == 3 else image
        out = change(rgb.copy())
        os.remove(path)  # it is a hard link
        cv2.imwrite(path, out[..., ::-1] if out.ndim == 3 else out)

    def json(self, folder, name, change):
        path = os.path.join(folder, "boxes", os.path.splitext(name)[0] + ".json")
        with open(path) as f:
            boxes = json.load(f)
        change(boxes["boxes"])
        os.remove(path)
        with open(path, "w") as f:
            json.dump(boxes, f)

    def test_whole_copy_is_as_before(self):
        path = self.fresh("again")
        self.assertEqual(self.faults(path), self.before)
        shutil.rmtree(path)

    def test_instance_mask_moved_by_one_pixel(self):
        self.broken(lambda d: self.image(d, "instance", self.moving()[1], lambda i: np.roll(i, 1, 1)),
                    "bounds are the mask's", "instance and semantic agree")

    def test_both_masks_and_boxes_moved(self):
        def change(d):
            name = self.moving()[1]
            self.image(d, "instance", name, lambda i: np.roll(i, 6, 1))
            self.image(d, "semantic", name, lambda i: np.roll(i, 6, 1))
            instance = check_labels.read_png(os.path.join(d, "instance", name))
            data = check_labels.Dataset(DATASET)

            def boxes(all_):
                for b in all_:
                    mask = np.isin(instance, data.parts.get(b["instance"], [b["instance"]]))
                    rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
                    b["x_min_px"], b["x_max_px"] = int(columns[0]), int(columns[-1])
                    b["y_min_px"], b["y_max_px"] = int(rows[0]), int(rows[-1])
            self.json(d, name, boxes)
        self.broken(change, "visible points lie within", "flow_to_previous: as poses say")

    def test_flow_with_the_other_sign(self):
        def other(image):
            known = image[..., 2] > 0
            image[known, :2] = 65535 - image[known, :2] + 1
            return image
        self.broken(lambda d: self.image(d, "flow_to_previous", self.moving()[1], other), "flow_to_previous: as poses say", "cancel",
                    "scene flow: projects to flow")

    def test_forward_flow_in_place_of_backward(self):
        def change(d):
            name = self.moving()[1]
            a, b = (os.path.join(d, k, name) for k in ("flow_to_previous", "flow_to_this"))
            os.rename(a, a + ".x"); os.rename(b, a); os.rename(a + ".x", b)
        self.broken(change, "flow_to_previous: as poses say", "flow_to_this: as poses say")

    def test_flow_one_sixteenth_of_a_pixel_off(self):
        self.broken(lambda d: self.image(d, "flow_to_previous", self.moving()[1], lambda i: np.where(i[..., 2:] > 0, i + np.array([4, 0, 0], np.uint16), i)),
                    "flow_to_previous: as poses say (ground")

    def test_flow_states_exchanged(self):
        def change(image):
            image[..., 2] = np.array([0, 2, 1, 3], np.uint16)[image[..., 2]]
            return image
        self.broken(lambda d: self.image(d, "flow_to_previous", self.moving()[1], change), "flow_to_previous: 2 where hidden")

    def test_two_frames_exchanged(self):
        def change(d):
            one, two = self.frames[1][1], self.frames[-1][1]
            for kind in list(check_labels.FORM) + ["boxes"]:
                names = [os.path.splitext(n)[0] + (".json" if kind == "boxes" else ".png") for n in (one, two)]
                a, b = (os.path.join(d, kind, n) for n in names)
                if os.path.exists(a):
                    os.rename(a, a + ".x"); os.rename(b, a); os.rename(a + ".x", b)
        self.broken(change, "t_ns", "flow_to_previous: as poses say")

    def test_two_pictures_of_instances_exchanged(self):
        def change(d):
            a, b = (os.path.join(d, "instance", self.frames[k][1]) for k in (1, -1))
            os.rename(a, a + ".x"); os.rename(b, a); os.rename(a + ".x", b)
        self.broken(change, "bounds are the mask's", "instance and semantic agree")

    def test_two_pictures_of_distance_exchanged(self):
        def change(d):
            a, b = (os.path.join(d, "distance", self.frames[k][1]) for k in (1, -1))
            os.rename(a, a + ".x"); os.rename(b, a); os.rename(a + ".x", b)
        self.broken(change, "flow_to_previous: as poses say", "scene flow")

    def test_box_moved_by_a_pixel(self):
        self.broken(lambda d: self.json(d, self.moving()[1], lambda b: b[0].update(x_min_px=b[0]["x_min_px"] + 1)), "bounds are the mask's")

    def test_box_of_another_size(self):
        self.broken(lambda d: self.json(d, self.moving()[1], lambda b: b[0].update(size_O_m=[0.9 * x for x in b[0]["size_O_m"]])),
                    "visible points lie within", "size stays")

    def test_box_elsewhere(self):
        def change(b):
            b[0]["p_CO_m"][0] += 0.02
        self.broken(lambda d: self.json(d, self.moving()[1], change), "place in the body stays")

    def test_box_missing(self):
        self.broken(lambda d: self.json(d, self.moving()[1], lambda b: b.pop(0)), "each visible object")

    def test_one_pixel_more_visible(self):
        self.broken(lambda d: self.json(d, self.moving()[1], lambda b: b[-1].update(visible_px=b[-1]["visible_px"] + 1)), "visible_px is the mask's")

    def test_truncation_and_visibility(self):
        self.broken(lambda d: self.json(d, self.moving()[1], lambda b: b[0].update(truncation=b[0]["truncation"] + 0.01)), "truncation follows")
        self.broken(lambda d: self.json(d, self.moving()[1], lambda b: b[0].update(visibility=1.01)), "in 0..1")

    def test_amodal_box_inside_the_visible_one(self):
        def change(b):
            b[0]["amodal_px"][0] = b[0]["x_min_px"] + 0.6
        self.broken(lambda d: self.json(d, self.moving()[1], change), "amodal box holds")

    def test_key_point_moved(self):
        def change(boxes):
            k = next(k for b in boxes for k in b.get("keypoints", []) if "pixel_px" in k)
            k["pixel_px"][0] += 1
            k["p_C_m"][1] += 0.01
        self.broken(lambda d: self.json(d, self.moving()[1], change), "pixel is the projection", "key points")

    def test_distance_two_percent_longer(self):
        self.broken(lambda d: self.image(d, "distance", self.moving()[1], lambda i: (i * 1.02).astype(np.uint16)), "scans: points fall",
                    "scene flow")

    def test_scene_flow_two_centimetres_off(self):
        self.broken(lambda d: self.image(d, "scene_flow_to_previous", self.moving()[1],
                                         lambda i: np.where(i.any(-1, keepdims=True), i + np.array([0, 0, 20], np.uint16), i)),
                    "scene flow: as poses say")

    def test_normals_turned_and_mirrored(self):
        self.broken(lambda d: self.image(d, "normal", self.moving()[1], lambda i: np.where(i.any(-1, keepdims=True), 65534 - i, 0).astype(np.uint16)),
                    "towards the camera, cosine (objects")
        self.broken(lambda d: self.image(d, "normal", self.moving()[1], lambda i: i[..., [1, 0, 2]]), "of planes")

    def test_ground_labels(self):
        name = self.frames[-1][1]
        self.broken(lambda d: self.image(d, "ground_soil", name, lambda i: np.roll(i, 3, 1)), "ground: only where terrain is")
        self.broken(lambda d: self.image(d, "ground_soil", name, lambda i: np.where(i > 0, i + 40, 0).astype(np.uint8)), "soil is one of")
        self.broken(lambda d: self.image(d, "ground_change", name, lambda i: np.where(i > 0, i + 100, 0).astype(np.uint16)), "untouched has not changed")
        self.broken(lambda d: self.image(d, "ground_change", self.frames[0][1], lambda i: np.where(i > 0, i + 1, 0).astype(np.uint16)), "first picture")
        self.broken(lambda d: self.image(d, "ground_age", name, lambda i: np.where(i > 0, 200, 0).astype(np.uint16)), "no older than")
        self.broken(lambda d: self.image(d, "ground_state", name, lambda i: i + np.uint8(1)), "ground_state is 0")

    def test_first_picture_with_flow(self):
        self.broken(lambda d: self.image(d, "flow_to_previous", self.frames[0][1], lambda i: i + np.uint16(1)), "the first picture has none")

    def test_file_missing(self):
        self.broken(lambda d: os.remove(os.path.join(d, "normal", self.moving()[1])), "files: there")


if __name__ == "__main__":
    unittest.main(verbosity=1)
