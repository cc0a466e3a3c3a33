"""Checks the mesh files: nodes, closed surfaces, winding, normals, and fit to the configuration.

Prints triangles and bounds of each node; ends with status 1 and the faults if there are any.
"""

import pathlib
import sys

import numpy as np

import check_heavy
import tb235_dimensions as dims
from gltf_writer import read_glb
from make_tb235 import excavator

HERE = pathlib.Path(__file__).parent
NODES = {
    "tb235": {"undercarriage", "upper", "swing_post", "boom", "arm", "bucket", "blade", "shoe",
              "boom_barrel", "boom_rod", "arm_barrel", "arm_rod", "bucket_barrel", "bucket_rod",
              "swing_barrel", "swing_rod", "blade_barrel", "blade_rod",
              "bucket_rocker", "bucket_coupler"},
    "warthog": {"body", "wheel"},
    "truck": {"body"},
    "truck_wheels": {"body", "bed", "gate", "front_left", "front_right", "rear_left", "rear_right"},
    "person": {"body", "body_walk"},
    "rock": {"body", "rock2", "rock3"},
    "cone": {"body"},
    "barrier": {"body", "fence"},
    "tree": {"body", "shrub"},
    "container": {"body"},
    "people": {"step", "pass", "crouch", "point", "lie"},
    "walker": {"trunk"} | {f"{side}_{limb}" for side in ("left", "right")
                           for limb in ("thigh", "shank", "boot", "upper_arm", "forearm")},
    "yard": {"pipe", "pipes", "planks", "manhole", "blocks", "stake"},
    "litter": {"pallets", "bags", "drum", "rubble", "rebar", "barrels", "tuft", "weed"},
    "fixed_arm": {"base", "link1", "link2", "link3"},
    **check_heavy.NODES,
}
EXCAVATOR_BUDGET, SHOE_BUDGET = 27000, 60
GRID_M = 1e-5            # vertices are written on this grid
CREASE_COSINE = -0.05    # a smooth normal never turns away from its face
FIT_M = 0.004


def _triangles(parts):
    return np.concatenate([triangles for _, triangles, _ in parts])


def _surface_faults(where, parts):
    """Closedness and winding of each material's surfaces, and their normals."""
    faults = []
    for material, triangles, normals in parts:
        name = f"{where}/{material['name']}"
        grid = np.round(triangles.reshape(-1, 3) / GRID_M).astype(int)
        _, vertex = np.unique(grid, axis=0, return_inverse=True)
        vertex = vertex.reshape(-1, 3)
        edges = np.concatenate([vertex[:, [0, 1]], vertex[:, [1, 2]], vertex[:, [2, 0]]])
        order = vertex.max() + 1
        ways = edges[:, 0].astype(np.int64) * order + edges[:, 1]
        back = edges[:, 1].astype(np.int64) * order + edges[:, 0]
        if not np.array_equal(np.sort(ways), np.sort(back)):
            faults.append(f"{name}: the surface is not closed")
        for piece in _pieces(vertex):
            volume = np.einsum("ij,ij->i", triangles[piece, 0],
                               np.cross(triangles[piece, 1], triangles[piece, 2])).sum() / 6
            if volume <= 0:
                faults.append(f"{name}: a piece of {len(piece)} triangles at "
                              f"{triangles[piece].mean(axis=(0, 1)).round(3)} faces inwards")
        faces = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        length = np.linalg.norm(faces, axis=1)
        if length.min() <= 0:
            faults.append(f"{name}: {np.sum(length <= 0)} triangles without area")
        faces = faces / np.maximum(length, 1e-30)[:, None]
        if np.abs(np.linalg.norm(normals, axis=2) - 1).max() > 1e-4:
            faults.append(f"{name}: normals are not of unit length")
        turned = np.einsum("tij,tj->ti", normals, faces) < CREASE_COSINE
        if turned.any():
            faults.append(f"{name}: {turned.sum()} normals turn away from their face")
    return faults


def _pieces(vertex):
    """Groups of triangles joined through common vertices."""
    label = np.arange(vertex.max() + 1)
    while True:
        low = label[vertex].min(axis=1)
        smaller = label.copy()
        np.minimum.at(smaller, vertex.reshape(-1), np.repeat(low, 3))
        smaller = smaller[smaller]
        if np.array_equal(smaller, label):
            break
        label = smaller
    group = label[vertex[:, 0]]
    return [np.flatnonzero(group == g) for g in np.unique(group)]


def _yaml_text():
    return "".join((HERE / "../config/machines/tb235.yaml").read_text().split())


def _config_faults():
    """The constants of tb235_dimensions.py must be found in the configuration."""
    text = _yaml_text()

    def listed(values):
        return "[" + ",".join(f"{v:g}" for v in values) + "]"

    def spellings(values):
        """As it stands in the file, where 0 may be written 0.0."""
        options = [""]
        for value in values:
            forms = {f"{value:g}", f"{value:.1f}", f"{value:.2f}", f"{value:.3f}"}
            options = [f"{o},{f}" if o else f for o in options for f in forms
                       if float(f) == value]
        return ["[" + o + "]" for o in options]

    expected = {
        "swing pin": ("xyz_m:", dims.SWING_PIN_U), "boom pin": ("xyz_m:", dims.BOOM_PIN_S),
        "arm pin": ("xyz_m:", (dims.BOOM_LENGTH, 0, 0)),
        "bucket pin": ("xyz_m:", (dims.ARM_LENGTH, 0, 0)),
        "blade pin": ("xyz_m:", dims.BLADE_PIN_B), "slew": ("xyz_m:", (0, 0, dims.SLEW_HEIGHT)),
        "bucket tip": ("xyz_m:", (dims.BUCKET_TIP, 0, 0)),
        "boom limits": ("limits_deg:", dims.BOOM_RANGE),
        "arm limits": ("limits_deg:", dims.ARM_RANGE),
        "blade limits": ("limits_deg:", dims.BLADE_RANGE),
        "swing limits": ("limits_deg:", dims.SWING_RANGE),
        "swing barrel": ("pin_m:", (*dims.SWING_CYLINDER[0], dims.SWING_PIN_U[2])),
        "swing rod": ("pin_m:", (*dims.SWING_CYLINDER[2], 0)),
    }
    for name, pin in (("bucket barrel", dims.BUCKET_BARREL_PIN), ("rocker", dims.ROCKER_PIN),
                      ("coupler", dims.COUPLER_PIN)):
        expected[name] = ("pin_m:", (pin[0], 0, pin[1]))
    for name, (barrel, _, rod, _) in dims.CYLINDERS.items():
        expected[f"{name} barrel"] = ("pin_m:", (barrel[0], 0, barrel[1]))
        expected[f"{name} rod"] = ("pin_m:", (rod[0], 0, rod[1]))
    faults = [f"tb235.yaml: no {key}{listed(values)} ({what})"
              for what, (key, values) in expected.items()
              if not any(key + form in text for form in spellings(values))]
    for profile in (dims.BUCKET_PROFILE, dims.BLADE_PROFILE):
        at = 0
        for point in profile:
            found = [text.find(form, at) for form in spellings(point)]
            found = [f for f in found if f >= 0]
            if not found:
                faults.append(f"tb235.yaml: no profile point {listed(point)}")
                break
            at = min(found)
    return faults


def _fit_faults(nodes):
    """Bounds of the links against the pins and profiles they are built to."""
    low = {name: _triangles(parts).min(axis=(0, 1)) for name, parts in nodes.items()}
    high = {name: _triangles(parts).max(axis=(0, 1)) for name, parts in nodes.items()}
    faults = []

    def near(what, value, expected, tolerance=FIT_M):
        if abs(value - expected) > tolerance:
            faults.append(f"tb235: {what} is {value:.4f} m, need {expected:.4f} m")

    near("front of the bucket's teeth", high["bucket"][0], dims.BUCKET_TIP, 0.02)
    near("width of the bucket", high["bucket"][1] - low["bucket"][1], dims.BUCKET_WIDTH, 0.06)
    near("lower edge of the blade", low["blade"][2], dims.BLADE_PROFILE[0][1])
    near("width of the blade", high["blade"][1] - low["blade"][1], dims.BLADE_WIDTH)
    near("length of a shoe", high["shoe"][0] - low["shoe"][0], dims.SHOE_LENGTH, 1e-3)
    near("width of a shoe", high["shoe"][1] - low["shoe"][1], dims.TRACK_WIDTH)
    near("outside of a shoe", high["shoe"][2], 0.0)
    for name in (*dims.CYLINDERS, "bucket", "swing"):
        shortest, longest = dims.pin_distance_range(name)
        barrel, rod = high[f"{name}_barrel"][0], -low[f"{name}_rod"][0]
        if barrel > shortest or rod > shortest:
            faults.append(f"tb235: {name} cylinder is longer than its shortest {shortest:.3f} m")
        if barrel + rod < longest:
            faults.append(f"tb235: {name} cylinder falls apart at its longest {longest:.3f} m")
    for name, length in (("rocker", dims.ROCKER_LENGTH), ("coupler", dims.COUPLER_LENGTH)):
        near(f"{name}, both lugs", high[f"bucket_{name}"][0] + low[f"bucket_{name}"][0], length, 0.01)
    total = sum(len(_triangles(parts)) for name, parts in nodes.items() if name != "shoe")
    if total > EXCAVATOR_BUDGET:
        faults.append(f"tb235: {total} triangles, at most {EXCAVATOR_BUDGET}")
    if len(_triangles(nodes["shoe"])) > SHOE_BUDGET:
        faults.append(f"tb235/shoe: more than {SHOE_BUDGET} triangles")
    return faults


def _age_faults(nodes):
    """The file must be the one that the scripts build."""
    return [f"tb235/{name}: the file is older than its script"
            for name, body in excavator().items()
            if body.triangle_count() != len(_triangles(nodes[name]))]


def main():
    faults = _config_faults() + check_heavy.config_faults()
    for file, expected in NODES.items():
        nodes = read_glb(HERE / f"{file}.glb")
        if set(nodes) != expected:
            faults.append(f"{file}: nodes are {sorted(nodes)}, need {sorted(expected)}")
        for node, parts in nodes.items():
            triangles = _triangles(parts)
            low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
            print(f"{file + '/' + node:22s} {len(triangles):6d} triangles  "
                  f"{low.round(3).tolist()} to {high.round(3).tolist()}")
            faults += _surface_faults(f"{file}/{node}", parts)
        if file == "tb235":
            faults += _fit_faults(nodes) + _age_faults(nodes)
        elif file in check_heavy.NODES:
            faults += check_heavy.faults_of(file, nodes)
    for fault in faults:
        print("fault:", fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
