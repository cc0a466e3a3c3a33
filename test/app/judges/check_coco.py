"""Holds an export in COCO's format against the dataset that it was made from, by COCO's published description alone
(cocodataset.org, "Data format"; run lengths: maskApi of the COCO API). Uses numpy, yaml and OpenCV's reader of PNG.

    python3 check_coco.py DATASET EXPORT

Prints what it has seen as JSON; the first thing that is wrong ends it with status 1.
"""

import json
import sys
from pathlib import Path

import cv2
import numpy as np
import yaml


def need(condition, *told):
    if not condition:
        sys.exit("check_coco: " + " ".join(str(t) for t in told))


def decoded(segmentation):
    """The mask of compressed run lengths: LEB128-like groups of 5 bits from character 48 on, signed, columns first."""
    height, width = segmentation["size"]
    runs, value, shift = [], 0, 0
    for character in segmentation["counts"]:
        group = ord(character) - 48
        need(0 <= group < 64, "character", repr(character), "in counts")
        value |= (group & 31) << shift
        shift += 5
        if group & 32:
            continue
        if group & 16:
            value -= 1 << shift
        runs.append(value + (runs[-2] if len(runs) > 2 else 0))
        value, shift = 0, 0
    need(shift == 0, "counts end within a number")
    need(sum(runs) == height * width and min(runs) >= 0, "runs", runs, "of", height, "x", width)
    flat = np.repeat(np.arange(len(runs)) % 2 == 1, runs)
    return flat.reshape(width, height).T


def bounds(mask):
    ys, xs = np.nonzero(mask)
    return [xs.min(), ys.min(), xs.max() - xs.min() + 1, ys.max() - ys.min() + 1]


def read(path):
    picture = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    need(picture is not None, path, "is no picture")
    return picture[..., ::-1].astype(int) if picture.ndim == 3 else picture.astype(int)


class Dataset:
    def __init__(self, folder):
        self.folder = folder
        about = yaml.safe_load((folder / "dataset.yaml").read_text())
        self.classes = {c["name"]: c["id"] for c in about["classes"]}
        self.instances = {i["id"]: i for i in about["instances"]}

    def ids_of(self, whole):
        """The object and all that are parts of it."""
        ids = {whole}
        while True:
            more = {i for i, entry in self.instances.items() if entry.get("parent", 0) in ids} - ids
            if not more:
                return ids
            ids |= more

    def picture(self, image, kind):
        return read(self.folder / image["camera"] / kind / f"{image['t_ns']}.png")

    def boxes(self, image):
        text = (self.folder / image["camera"] / "boxes" / f"{image['t_ns']}.json").read_text()
        return {b["instance"]: b for b in json.loads(text)["boxes"]}


def check_head(document, dataset, with_stuff):
    ids = [c["id"] for c in document["categories"]]
    need(len(set(ids)) == len(ids) and min(ids) > 0, "ids of categories", ids)
    for category in document["categories"]:
        need(dataset.classes[category["name"]] == category["class_id"], category)
        need(category["supercategory"], category)
        need(not with_stuff or category["isthing"] in (0, 1), category)
    if with_stuff:
        need({c["name"] for c in document["categories"]} == set(dataset.classes), "classes that are missing")
    images = {i["id"]: i for i in document["images"]}
    need(len(images) == len(document["images"]), "ids of images are there twice")
    need(len({i["file_name"] for i in images.values()}) == len(images), "names of images are there twice")
    need("info" in document and "licenses" in document, "info or licenses are missing")
    return images, {c["id"]: c for c in document["categories"]}


def check_images(images, dataset, folder):
    for image in images.values():
        picture = read(folder / "images" / image["file_name"])
        need(picture.shape == (image["height"], image["width"], 3), image["file_name"], picture.shape)
        need((picture == dataset.picture(image, "rgb")).all(), image["file_name"], "has other pixels")


def check_instances(dataset, folder):
    document = json.loads((folder / "annotations/instances.json").read_text())
    images, categories = check_head(document, dataset, with_stuff=False)
    check_images(images, dataset, folder)
    annotations = document["annotations"]
    need(len({a["id"] for a in annotations}) == len(annotations), "ids of annotations are there twice")
    of_image = {i: [] for i in images}
    for annotation in annotations:
        of_image[annotation["image_id"]].append(annotation)
    wholes = 0
    for number, image in images.items():
        instance, boxes = dataset.picture(image, "instance"), dataset.boxes(image)
        seen = set()
        for a in of_image[number]:
            ids = dataset.ids_of(a["instance_id"])
            wholes += len(ids) > 1
            mask = np.isin(instance, list(ids))
            need((decoded(a["segmentation"]) == mask).all(), "another mask in", image["file_name"], a["name"])
            need(a["area"] == mask.sum() and a["bbox"] == bounds(mask) and a["iscrowd"] == 0, a)
            entry = dataset.instances[a["instance_id"]]
            need(categories[a["category_id"]]["name"] == entry["class"] and a["name"] == entry["name"], a)
            box = boxes[a["instance_id"]]
            need(box["visible_px"] == a["area"] and box["visibility"] == a["visibility"], a, box)
            for key in ("p_CO_m", "q_CO_wxyz", "size_O_m"):
                need(np.allclose(a["box_3d"][key], box[key], atol=1e-12), a, box)
            seen.add(a["instance_id"])
        need(len(seen) == len(of_image[number]), "an object is there twice in", image["file_name"])
        need(seen == {i for i in dataset.instances if np.isin(instance, list(dataset.ids_of(i))).any()} - {0},
             "other objects in", image["file_name"])
    return {"images": len(images), "annotations": len(annotations), "wholes": wholes,
            "cameras": len({i["camera"] for i in images.values()})}


def check_panoptic(dataset, folder):
    document = json.loads((folder / "annotations/panoptic.json").read_text())
    images, categories = check_head(document, dataset, with_stuff=True)
    need(sorted(a["image_id"] for a in document["annotations"]) == sorted(images), "not one entry for each image")
    count = 0
    for annotation in document["annotations"]:
        image = images[annotation["image_id"]]
        rgb = read(folder / "annotations/panoptic" / annotation["file_name"])
        ids = rgb[..., 0] + 256 * rgb[..., 1] + 256**2 * rgb[..., 2]
        instance, semantic = dataset.picture(image, "instance"), dataset.picture(image, "semantic")
        segments = annotation["segments_info"]
        need(len({s["id"] for s in segments}) == len(segments), "segments are there twice in", image["file_name"])
        need(set(np.unique(ids)) - {0} == {s["id"] for s in segments}, "other segments in", image["file_name"])
        for s in segments:
            mask = ids == s["id"]
            category = categories[s["category_id"]]
            need(s["area"] == mask.sum() and s["bbox"] == bounds(mask) and s["iscrowd"] == 0, s)
            need((semantic[mask] == category["class_id"]).all(), s, "has pixels of other classes")
            need((instance[mask] == s["instance_id"]).all(), s, "has pixels of other instances")
            same = (instance == s["instance_id"]) & (semantic == category["class_id"])
            need((same == mask).all(), s, "lacks pixels")
        count += len(segments)
    return {"segments": count}


PERSON = ("nose left_eye right_eye left_ear right_ear left_shoulder right_shoulder left_elbow right_elbow left_wrist right_wrist "
          "left_hip right_hip left_knee right_knee left_ankle right_ankle").split()


def check_keypoints(dataset, folder):
    """Every annotation that has key points, and no other, with COCO's members, and points that are the dataset's."""
    document = json.loads((folder / "annotations/keypoints.json").read_text())
    instances = json.loads((folder / "annotations/instances.json").read_text())
    need(document["images"] == instances["images"], "other images than instances.json has")
    images, plain = {i["id"]: i for i in document["images"]}, {a["id"]: a for a in instances["annotations"]}
    categories = {c["id"]: c for c in document["categories"]}
    need(len(categories) == len(document["categories"]), "ids of categories")
    need(len({c["name"] for c in categories.values()}) == len(categories), "names of categories")
    for c in categories.values():
        need(len(set(c["keypoints"])) == len(c["keypoints"]) > 0, c)
        need(all(1 <= end <= len(c["keypoints"]) for bone in c["skeleton"] for end in bone), c)
        need(c["name"] != "person" or c["keypoints"] == PERSON and len(c["skeleton"]) == 19, c)
    found, seen, kinds = 0, 0, set()
    for a in document["annotations"]:
        need({k: v for k, v in plain[a["id"]].items() if k != "category_id"}.items() <= a.items(), a)
        category, image = categories[a["category_id"]], images[a["image_id"]]
        points = {p["name"]: p for p in dataset.boxes(image)[a["instance_id"]]["keypoints"]}
        need(set(points) == set(category["keypoints"]), a["name"], category)
        need(category["class_id"] == dataset.classes[dataset.instances[a["instance_id"]]["class"]], a["name"], category)
        numbers = np.array(a["keypoints"]).reshape(-1, 3)
        for name, (x, y, v) in zip(category["keypoints"], numbers):
            point = points[name]
            need(v == point["sight"], a["name"], name, v)
            need((x, y) == (tuple(point["pixel_px"]) if v else (0, 0)), a["name"], name, x, y)
            need(not v or -0.5 <= x <= image["width"] - 0.5 and -0.5 <= y <= image["height"] - 0.5, name, x, y)
        need(a["num_keypoints"] == np.count_nonzero(numbers[:, 2]), a["name"], a["num_keypoints"])
        found, seen = found + a["num_keypoints"], seen + np.count_nonzero(numbers[:, 2] == 2)
        kinds.add(category["name"])
    with_points = sum(1 for a in instances["annotations"]
                      if dataset.boxes(images[a["image_id"]])[a["instance_id"]].get("keypoints"))
    need(with_points == len(document["annotations"]), with_points, "objects with key points")
    return {"keypoints": int(found), "seen_keypoints": int(seen), "keypoint_categories": sorted(kinds)}


def main():
    dataset, folder = Dataset(Path(sys.argv[1])), Path(sys.argv[2])
    print(json.dumps(check_instances(dataset, folder) | check_panoptic(dataset, folder) | check_keypoints(dataset, folder)))


if __name__ == "__main__":
    main()
