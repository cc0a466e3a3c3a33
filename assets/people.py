"""Workers in other poses than person.py's, and where the 17 key points of COCO are in each.

The same limbs, bent at the same joints; the trunk leans about the hips and takes arms and head with
it. Frames: origin on the ground below the hips, x the way the trunk faces when it is upright.
"""

from typing import NamedTuple, Tuple

import numpy as np

import person
from person import Gait
from solids import Body, mirrored, moved, turned

HIPS = (0.0, 0.0, float(person.HIP[2]))
FACE = {"nose": (0.110, 0.0, 1.640), "eye": (0.098, 0.031, 1.668), "ear": (0.0, 0.085, 1.645)}
# How deep below the skin a joint may lie and still be seen.
DEPTH = {"nose": 0.03, "eye": 0.03, "ear": 0.03, "shoulder": 0.08, "elbow": 0.06, "wrist": 0.05,
         "hip": 0.12, "knee": 0.08, "ankle": 0.08}
KEY_POINTS = ("nose",) + tuple(f"{side}_{joint}" for joint in
                               ("eye", "ear", "shoulder", "elbow", "wrist", "hip", "knee", "ankle")
                               for side in ("left", "right"))


class Pose(NamedTuple):
    gaits: Tuple[Gait, Gait]     # left, right
    lean_deg: float = 0.0        # of the trunk about the hips, forwards
    tip_deg: float = 0.0         # of all about the hips: -90 lies on the back


POSES = {
    "step": Pose(person.WALKING[::-1]),
    "pass": Pose((Gait(4, 8, 0, -4, 16), Gait(10, 48, -22, 8, 22))),
    "crouch": Pose((Gait(98, 128, 0, 42, 30), Gait(84, 122, -14, 30, 44)), lean_deg=28),
    "point": Pose((Gait(2, 4, 0, 86, 3), Gait(-3, 4, 0, -4, 16)), lean_deg=2),
    "lie": Pose((Gait(8, 16, 8, 10, 18), Gait(2, 6, 10, -4, 22)), tip_deg=-90),
}


def _bent(points, pose, leans):
    """Points or a solid of the upright body, where the pose has them."""
    shaped = np.asarray(points, dtype=float)
    if leans:
        shaped = turned(shaped, "y", pose.lean_deg, HIPS)
    return turned(shaped, "y", pose.tip_deg, HIPS)


def _parts(pose):
    """(paint, solid) of limbs, and the upright trunk's by paint with normals."""
    limbs = []
    for number, gait in enumerate(pose.gaits):
        for make, leans in ((person.leg, False), (person.arm, True)):
            for color, solid in make(gait):
                solid = mirrored(solid) if number else solid
                limbs.append((color, _bent(solid, pose, leans)))
    upright = Body()
    person.trunk(upright)
    person.head(upright)
    trunk = {color: (_bent(triangles, pose, True), _turned_normals(normals, pose))
             for color, (triangles, normals) in upright.by_paint().items()}
    return limbs, trunk


def _turned_normals(normals, pose):
    return turned(turned(normals, "y", pose.lean_deg), "y", pose.tip_deg)


def _lowest(limbs, trunk):
    return min(min(solid[..., 2].min() for _, solid in limbs),
               min(triangles[..., 2].min() for triangles, _ in trunk.values()))


def worker(pose):
    """The body of a pose, its lowest point on the ground."""
    limbs, trunk = _parts(pose)
    drop = (0, 0, -_lowest(limbs, trunk))
    body = Body()
    for color, (triangles, normals) in trunk.items():
        body.add_shaded(color, moved(triangles, drop), normals)
    for color, solid in limbs:
        body.add(color, moved(solid, drop), crease_deg=60)
    return body


def _joints(gait):
    """Joints of the left side, upright: those of person.leg and person.arm."""
    along = person.along
    knee = person.HIP + person.THIGH * along(gait.hip_deg)
    ankle = knee + person.SHANK * along(gait.hip_deg - gait.knee_deg)
    outward = np.array([0.0, 0.10, 0.0])
    upper, lower = along(gait.arm_deg), along(gait.arm_deg + gait.elbow_deg)
    elbow = person.SHOULDER + person.UPPER_ARM * (upper + outward)
    wrist = elbow + person.FOREARM * (lower + 0.3 * outward)
    return {"shoulder": person.SHOULDER, "elbow": elbow, "wrist": wrist, "hip": person.HIP,
            "knee": knee, "ankle": ankle}


def key_points(pose):
    """{name: place} of the 17 key points of a pose, in the frame of its body."""
    drop = -_lowest(*_parts(pose))
    places = {"nose": _bent(FACE["nose"], pose, True)}
    for number, (side, gait) in enumerate(zip(("left", "right"), pose.gaits)):
        flip = np.array([1.0, -1.0 if number else 1.0, 1.0])
        for name in ("eye", "ear"):
            places[f"{side}_{name}"] = _bent(flip * FACE[name], pose, True)
        for name, place in _joints(gait).items():
            leans = name in ("shoulder", "elbow", "wrist")
            places[f"{side}_{name}"] = _bent(flip * place, pose, leans)
    return {name: places[name] + [0, 0, drop] for name in KEY_POINTS}


def box_of(pose):
    """Middle and size of a box around the body."""
    limbs, trunk = _parts(pose)
    drop = -_lowest(limbs, trunk)
    corners = np.concatenate([solid.reshape(-1, 3) for _, solid in limbs]
                             + [triangles.reshape(-1, 3) for triangles, _ in trunk.values()])
    low, high = corners.min(axis=0), corners.max(axis=0)
    return (low + high) / 2 + [0, 0, drop], high - low


def preset(node, comment):
    """The text of config/obstacles/ for a pose."""
    pose = POSES[node]
    middle, size = box_of(pose)

    def numbers(values, digits=3):
        return "[" + ", ".join(f"{v + 0.0:.{digits}f}" for v in values) + "]"

    lines = [f"# {comment}", "label: person", "mesh: ../../assets/people.glb", f"node: {node}",
             f"collision: [{{xyz_m: {numbers(middle, 2)}, size_m: {numbers(size, 2)}}}]",
             "# The 17 key points of COCO; assets/people.py has the same joints and writes this file.",
             "keypoints:"]
    for name, place in key_points(pose).items():
        depth = DEPTH[name.split("_")[-1]]
        lines.append(f"  - {{name: {name}, xyz_m: {numbers(place)}, radius_m: {depth:g}}}")
    return "\n".join(lines).replace("-0.000", "0.000") + "\n"


PRESETS = {
    "person_step": ("step", "A worker in mid-stride, the other leg ahead than in person.yaml."),
    "person_pass": ("pass", "A worker in the middle of a step, one leg passing the other."),
    "person_crouching": ("crouch", "A worker who crouches and reaches for something before him."),
    "person_pointing": ("point", "A worker who points ahead with his left arm."),
    "person_lying": ("lie", "A worker who lies on his back, his head towards -x."),
}


def nodes():
    return {name: worker(pose) for name, pose in POSES.items()}


def write_presets(folder):
    for file, (node, comment) in PRESETS.items():
        (folder / f"{file}.yaml").write_text(preset(node, comment))
