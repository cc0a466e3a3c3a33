"""Writes bodies of triangles as binary glTF 2.0.

Frames: vertices are given with x forward, y left, z up and are stored on glTF's y-up axes as
(x, z, -y). Nodes carry no transform. The same bodies give the same bytes.
Source: Khronos glTF 2.0 specification, sections 3.7 (meshes), 3.9 (materials) and 4.4 (GLB).
"""

import json
import struct

import numpy as np

GLB_MAGIC, GLB_VERSION = 0x46546C67, 2
CHUNK_JSON, CHUNK_BIN = 0x4E4F534A, 0x004E4942
FLOAT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
LARGEST_SHORT_INDEX = 65534
DECIMALS = 5  # vertices on a grid of 10 um, so that equal corners are equal


class _Buffer:
    """The binary chunk with its views and accessors."""

    def __init__(self):
        self.data = bytearray()
        self.views = []
        self.accessors = []

    def add(self, array, component, kind, target, with_bounds=False):
        self.data.extend(b"\0" * (-len(self.data) % 4))
        raw = np.ascontiguousarray(array).tobytes()
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw),
                           "target": target})
        self.data.extend(raw)
        accessor = {"bufferView": len(self.views) - 1, "componentType": component,
                    "count": len(array), "type": kind}
        if with_bounds:
            accessor["min"] = [float(v) for v in array.min(axis=0)]
            accessor["max"] = [float(v) for v in array.max(axis=0)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def to_y_up(vectors):
    """Our axes (x forward, y left, z up) to glTF's."""
    return np.stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]], axis=1)


def from_y_up(vectors):
    """glTF's axes to ours."""
    return np.stack([vectors[:, 0], -vectors[:, 2], vectors[:, 1]], axis=1)


def _material_json(paint):
    entry = {
        "name": paint.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [*paint.color, paint.opacity],
            "metallicFactor": paint.metallic,
            "roughnessFactor": paint.roughness,
        },
    }
    if paint.opacity < 1:
        entry["alphaMode"] = "BLEND"
    return entry


def _primitive(buffer, triangles, normals, material):
    """One primitive; corners with the same place and normal share a vertex."""
    corners = np.concatenate([triangles.reshape(-1, 3), normals.reshape(-1, 3)], axis=1)
    _, first, index = np.unique(np.round(corners, DECIMALS) + 0.0, axis=0, return_index=True,
                                return_inverse=True)
    index = index.reshape(-1)
    vertices = np.round(corners[first, :3], DECIMALS) + 0.0
    unit = corners[first, 3:]
    short = len(vertices) <= LARGEST_SHORT_INDEX
    return {
        "attributes": {
            "POSITION": buffer.add(to_y_up(vertices).astype("<f4"), FLOAT, "VEC3", ARRAY_BUFFER,
                                   with_bounds=True),
            "NORMAL": buffer.add(to_y_up(unit).astype("<f4"), FLOAT, "VEC3", ARRAY_BUFFER),
        },
        "indices": buffer.add(index.astype("<u2" if short else "<u4"),
                              UNSIGNED_SHORT if short else UNSIGNED_INT, "SCALAR",
                              ELEMENT_ARRAY_BUFFER),
        "material": material,
        "mode": 4,
    }


def write_glb(path, bodies):
    """Writes `bodies` (solids.Body by node name) to the file `path`."""
    buffer = _Buffer()
    materials, meshes, nodes = [], [], []
    material_index = {}
    for name, body in bodies.items():
        primitives = []
        for paint, (triangles, normals) in body.by_paint().items():
            if paint not in material_index:
                material_index[paint] = len(materials)
                materials.append(_material_json(paint))
            primitives.append(_primitive(buffer, triangles, normals, material_index[paint]))
        nodes.append({"name": name, "mesh": len(meshes)})
        meshes.append({"name": name, "primitives": primitives})
    buffer.data.extend(b"\0" * (-len(buffer.data) % 4))
    document = {
        "asset": {"version": "2.0", "generator": "assets/gltf_writer.py",
                  "copyright": "Apache-2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": len(buffer.data)}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(buffer.data)
    with open(path, "wb") as file:
        file.write(struct.pack("<III", GLB_MAGIC, GLB_VERSION, total))
        file.write(struct.pack("<II", len(text), CHUNK_JSON) + text)
        file.write(struct.pack("<II", len(buffer.data), CHUNK_BIN) + bytes(buffer.data))


def read_glb(path):
    """Reads a file of write_glb back: {node: [(material name, triangles, normals), ...]}.

    Triangles and normals are (n, 3, 3) on our axes.
    """
    with open(path, "rb") as file:
        raw = file.read()
    text_length = struct.unpack_from("<I", raw, 12)[0]
    document = json.loads(raw[20:20 + text_length])
    start = 20 + text_length + 8

    def accessor(number):
        entry = document["accessors"][number]
        view = document["bufferViews"][entry["bufferView"]]
        kind = {FLOAT: "<f4", UNSIGNED_SHORT: "<u2", UNSIGNED_INT: "<u4"}[entry["componentType"]]
        width = {"SCALAR": 1, "VEC3": 3}[entry["type"]]
        flat = np.frombuffer(raw, kind, entry["count"] * width, start + view["byteOffset"])
        return flat.reshape(-1, width) if width > 1 else flat

    result = {}
    for node in document["nodes"]:
        parts = []
        for primitive in document["meshes"][node["mesh"]]["primitives"]:
            index = accessor(primitive["indices"])
            places = from_y_up(accessor(primitive["attributes"]["POSITION"]).astype(float))
            normals = from_y_up(accessor(primitive["attributes"]["NORMAL"]).astype(float))
            material = document["materials"][primitive["material"]]
            parts.append((material, places[index].reshape(-1, 3, 3),
                          normals[index].reshape(-1, 3, 3)))
        result[node["name"]] = parts
    return result
