"""Holds an export in WebDataset's format against the dataset that it was made from: archives are read by Python's tarfile, the
index as WIDS has it, points by numpy's own reader, croissant.json as its specification has it.

    python3 check_webdataset.py DATASET EXPORT SENSOR...

Prints what it has seen as JSON; the first thing that is wrong ends it with status 1.
"""

import hashlib
import io
import json
import re
import sys
import tarfile
from fnmatch import fnmatch
from pathlib import Path

import numpy as np
import yaml

from recorded import Recorded


def need(condition, *told):
    if not condition:
        sys.exit("check_webdataset: " + " ".join(str(t) for t in told))


def samples_of(archive):
    """Files that follow one another and share all up to the first point of their name are a sample."""
    samples = []
    with tarfile.open(archive, "r:") as tar:
        for member in tar:
            need(member.isfile() and member.mtime == 0, member)
            folder, _, name = member.name.rpartition("/")
            stem, _, ending = name.partition(".")
            key = f"{folder}/{stem}"
            if not samples or samples[-1][0] != key:
                need(all(key != other for other, _ in samples), key, "is in two places")
                samples.append((key, {}))
            samples[-1][1][ending] = tar.extractfile(member).read()
    return samples


def check_pose(data, sensor, about):
    X = data.sensor_poses(sensor).at(about["t_ns"])
    need(np.allclose(about["X_WS"]["p_WS_m"], X[:3, 3], atol=1e-6), "place", about)
    w, x, y, z = about["X_WS"]["q_WS_wxyz"]
    forward = [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)]
    need(np.allclose(forward, X[:3, 0], atol=1e-6), "attitude", about)


def check_croissant(folder):
    """By the specification of Croissant 1.1: what must be there, digests, and that sets of files are what they say."""
    about = json.loads((folder / "croissant.json").read_text())
    need(about["conformsTo"] == "http://mlcommons.org/croissant/1.1" and about["@type"] == "sc:Dataset", about)
    for key in ("name", "description", "license", "url", "datePublished", "creator"):
        need(about[key], key, "is missing")
    nodes = {node["@id"]: node for node in about["distribution"]}
    need(len(nodes) == len(about["distribution"]), "an @id is there twice")
    members = {}
    for node in nodes.values():
        if node["@type"] == "cr:FileObject":
            content = (folder / node["contentUrl"]).read_bytes()
            need(hashlib.sha256(content).hexdigest() == node["sha256"], node)
            need(node["contentSize"] == f"{len(content)} B", node)
            with tarfile.open(folder / node["contentUrl"]) as tar:
                members[node["@id"]] = tar.getnames()
    need(sorted(members) == sorted(p.name for p in folder.glob("*.tar")), "archives", list(members))
    matched = []
    for node in nodes.values():
        if node["@type"] == "cr:FileSet":
            names = [n for within in node["containedIn"] for n in members[within["@id"]] if fnmatch(n, node["includes"])]
            need(names, node, "has no files")
            matched += names
    need(sorted(matched) == sorted(n for names in members.values() for n in names), "files in no set, or in two")
    for records in about["recordSet"]:
        by_name = {field["name"]: field for field in records["field"]}
        need(records["key"]["@id"] == by_name["key"]["@id"], records)
        source = by_name["key"]["source"]
        node = nodes[source["fileSet"]["@id"]]
        pattern = re.compile(source["transform"]["regex"])
        for name in (n for within in node["containedIn"] for n in members[within["@id"]] if fnmatch(n, node["includes"])):
            need(pattern.search(name).group(1) == name.split(".")[0], name, source)
    card = (folder / "README.md").read_text()
    front = yaml.safe_load(card.split("---")[1])
    for config in front["configs"]:
        need(list(folder.glob(config["data_files"])), config)
    return {"record_sets": len(about["recordSet"]), "file_sets": len(nodes) - len(members)}


def main():
    data, folder = Recorded(sys.argv[1]), Path(sys.argv[2])
    seen = {"shards": 0, "samples": 0, "parts": 0}
    for sensor in sys.argv[3:]:
        name = sensor.replace("/", "_")
        index = json.loads((folder / f"{name}.json").read_text())
        need(index["__kind__"] == "wids-shard-index-v1" and index["wids_version"] == 1, index)
        shards = sorted(p.name for p in folder.glob(f"{name}-*.tar"))
        need([s["url"] for s in index["shardlist"]] == shards, shards)
        need(shards == [f"{name}-{k:06d}.tar" for k in range(len(shards))], shards)
        times = []
        for entry in index["shardlist"]:
            samples = samples_of(folder / entry["url"])
            need(len(samples) == entry["nsamples"], entry)
            need((folder / entry["url"]).stat().st_size == entry["filesize"], entry)
            for key, parts in samples:
                about = json.loads(parts.pop("json"))
                t_ns = about["t_ns"]
                times.append(t_ns)
                need(key == f"{name}/{t_ns:020d}" and about["sensor"] == sensor, key, about)
                check_pose(data, sensor, about)
                if "points.npy" in parts:
                    points, scan = np.load(io.BytesIO(parts["points.npy"]), allow_pickle=False), data.scan(sensor, t_ns)
                    need(points.dtype.names == scan.dtype.names and (points == scan).all(), key, "has other points")
                else:
                    for ending, content in parts.items():
                        kind = ending.removesuffix(".png")
                        need(content == (data.folder / sensor / kind / f"{t_ns}.png").read_bytes(), key, ending)
                    kinds = {k for k in ("rgb", "depth", "semantic", "instance", "normal")
                             if (data.folder / sensor / k / f"{t_ns}.png").exists()}
                    need({f"{k}.png" for k in kinds} == set(parts), key, sorted(parts))
                    need(about["boxes"] == data.boxes(sensor, t_ns), key, "has other boxes")
                seen["parts"] += len(parts)
        need(times == data.times(sensor), "other times than", sensor, "has")
        need((folder / f"{name}.sensor.yaml").read_bytes() == (data.folder / sensor / "sensor.yaml").read_bytes(), sensor)
        seen["shards"] += len(shards)
        seen["samples"] += len(times)
    if (folder / "croissant.json").exists():
        seen |= check_croissant(folder)
    print(json.dumps(seen))


if __name__ == "__main__":
    main()
