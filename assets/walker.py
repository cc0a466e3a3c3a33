"""A worker who walks: trunk and limbs apart, and how they swing over a stride of two steps.

The same body as person.py's, each limb hanging straight down in the frame of the body, x forward, so that it swings about its
joint. Swings go through four key poses: a step with the left leg ahead, the right leg passing, and the same with sides changed.
"""

import numpy as np

import people
import person
from person import Gait
from solids import Body, mirrored, turned

MOMENTS = 16  # of a stride, at equal parts
AHEAD, BEHIND = person.WALKING
KEYS = ((AHEAD, BEHIND), people.POSES["pass"].gaits, (BEHIND, AHEAD), people.POSES["pass"].gaits[::-1])
STRAIGHT = Gait(0, 0, 0, 0, 0)
OUTWARD = np.array([0.0, 0.10, 0.0])
KNEE = person.HIP + person.THIGH * person.along(0)
ANKLE = KNEE + person.SHANK * person.along(0)
ELBOW = person.SHOULDER + person.UPPER_ARM * (person.along(0) + OUTWARD)
JOINTS = {"thigh": person.HIP, "shank": KNEE, "boot": ANKLE, "upper_arm": person.SHOULDER, "forearm": ELBOW}
HANGS_ON = {"thigh": None, "shank": "thigh", "boot": "shank", "upper_arm": None, "forearm": "upper_arm"}
LIMB_OF = {"knee": "shank", "ankle": "boot", "elbow": "forearm", "wrist": "forearm"}


def _thigh_and_shank():
    hip, knee, ankle = person.HIP, KNEE, ANKLE
    down = person.along(0)
    thigh = person._limb([(*(hip - 0.03 * down), 0.098, 0.090), (*(hip + 0.12 * down), 0.092, 0.086),
                          (*(knee - 0.08 * down), 0.070, 0.068), (*(knee + 0.02 * down), 0.064, 0.062),
                          (*(knee + 0.05 * down), 0.048, 0.046)])
    shank = person._limb([(*(knee - 0.045 * down), 0.046, 0.045), (*(knee - 0.01 * down), 0.063, 0.061),
                          (*(knee + 0.06 * down), 0.065, 0.062), (*(knee + 0.16 * down), 0.068, 0.064),
                          (*(ankle - 0.06 * down), 0.058, 0.056), (*(ankle + 0.005 * down), 0.062, 0.060)])
    return thigh, shank


def _upper_arm():
    shoulder, elbow = person.SHOULDER, ELBOW
    way = elbow - shoulder
    return person._limb([(*(shoulder + [0, -0.10, 0.045]), 0.050, 0.040), (*(shoulder + [0, -0.045, 0.022]), 0.066, 0.055),
                         (*(shoulder + [0, 0.0, -0.035]), 0.068, 0.058), (*(shoulder + 0.5 * way), 0.056, 0.054),
                         (*elbow, 0.047, 0.046), (*(elbow + 0.10 * way), 0.034, 0.033)])


def _forearm_sleeve():
    lower = person.along(0)
    wrist = ELBOW + person.FOREARM * (lower + 0.3 * OUTWARD)
    way = wrist - ELBOW
    return person._limb([(*(ELBOW - 0.12 * way), 0.033, 0.032), (*ELBOW, 0.0465, 0.0455), (*(ELBOW + 0.35 * way), 0.046, 0.044),
                         (*wrist, 0.034, 0.032)])


def left_limbs():
    """{limb: [(paint, solid)]} of the left side, hanging straight down."""
    trousers, leather, rubber, band = person.leg(STRAIGHT)
    sleeve, *hand = person.arm(STRAIGHT)
    thigh, shank = _thigh_and_shank()
    return {"thigh": [(trousers[0], thigh)], "shank": [(trousers[0], shank), band], "boot": [leather, rubber],
            "upper_arm": [(sleeve[0], _upper_arm())], "forearm": [(sleeve[0], _forearm_sleeve()), *hand]}


def swings(gait):
    """Degrees of each limb of one side against what it hangs on, forwards positive."""
    return {"thigh": gait.hip_deg, "shank": -gait.knee_deg, "boot": gait.foot_deg - (gait.hip_deg - gait.knee_deg),
            "upper_arm": gait.arm_deg, "forearm": gait.elbow_deg}


def _smooth(keys):
    """MOMENTS values through the keys of a closed cycle (Catmull and Rom 1974)."""
    keys, values = np.asarray(keys, dtype=float), []
    for moment in range(MOMENTS):
        at = moment * len(keys) / MOMENTS
        k, t = int(at), at - int(at)
        a, b, c, d = (keys[(k + n) % len(keys)] for n in (-1, 0, 1, 2))
        values.append(b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a))))
    return np.array(values)


def swings_over_a_stride():
    """{side_limb: MOMENTS swings}."""
    return {f"{side}_{limb}": _smooth([swings(gaits[number])[limb] for gaits in KEYS])
            for number, side in enumerate(("left", "right")) for limb in JOINTS}


def _placed(points, side, limb, at):
    """Points of a limb where it hangs, swung as at one moment."""
    flip = np.array([1.0, -1.0 if side == "right" else 1.0, 1.0])
    while limb is not None:
        points = turned(points, "y", -at[f"{side}_{limb}"], flip * JOINTS[limb])
        limb = HANGS_ON[limb]
    return points


def rises():
    """How much the body is raised at each moment, for the lower boot to stand on the ground."""
    swung, boots = swings_over_a_stride(), left_limbs()["boot"]
    lowest = []
    for moment in range(MOMENTS):
        at = {name: values[moment] for name, values in swung.items()}
        low = min(_placed(mirrored(solid) if side == "right" else solid, side, "boot", at)[..., 2].min()
                  for side in ("left", "right") for _, solid in boots)
        lowest.append(-low)
    return np.array(lowest)


def stride_m():
    """Two steps: twice the way between the ankles when both feet are on the ground."""
    at = {f"{side}_{limb}": swings(KEYS[0][number])[limb]
          for number, side in enumerate(("left", "right")) for limb in JOINTS}
    left = _placed(ANKLE, "left", "shank", at)
    right = _placed(ANKLE * [1, -1, 1], "right", "shank", at)
    return 2 * (left[0] - right[0])


def nodes():
    trunk = Body()
    person.trunk(trunk)
    person.head(trunk)
    bodies = {"trunk": trunk}
    for limb, parts in left_limbs().items():
        for side in ("left", "right"):
            body = Body()
            for color, solid in parts:
                body.add(color, mirrored(solid) if side == "right" else solid, crease_deg=60)
            bodies[f"{side}_{limb}"] = body
    return bodies


def key_points():
    """{name: (limb or None, place)}, hanging straight down."""
    places = {"nose": (None, np.array(people.FACE["nose"]))}
    joints = people._joints(STRAIGHT)
    for side, sign in (("left", 1.0), ("right", -1.0)):
        flip = np.array([1.0, sign, 1.0])
        for name in ("eye", "ear"):
            places[f"{side}_{name}"] = (None, flip * people.FACE[name])
        for name, place in joints.items():
            limb = LIMB_OF.get(name)
            places[f"{side}_{name}"] = (limb and f"{side}_{limb}", flip * place)
    return {name: places[name] for name in people.KEY_POINTS}


def preset():
    def row(values, digits=3):
        return "[" + ", ".join(f"{v + 0.0:.{digits}f}" for v in values) + "]"

    swung = swings_over_a_stride()
    lines = ["# A worker who walks along his path: his limbs swing as far as he comes, and stand where it ends.", "label: person",
             "mesh: ../../assets/walker.glb", "node: trunk",
             "collision: [{xyz_m: [0.03, 0.00, 0.90], size_m: [0.44, 0.56, 1.80]}]",
             "# Over a stride of two steps, at equal parts of it; assets/walker.py writes this file.",
             "gait:", f"  stride_m: {stride_m():.3f}", f"  rise_m: {row(rises())}", "  limbs:"]
    for side in ("left", "right"):
        flip = np.array([1.0, -1.0 if side == "right" else 1.0, 1.0])
        for limb, joint in JOINTS.items():
            of = f"of: {side}_{HANGS_ON[limb]}, " if HANGS_ON[limb] else ""
            lines.append(f"    - {{name: {side}_{limb}, {of}joint_m: {row(flip * joint)},")
            lines.append(f"       swing_deg: {row(swung[f'{side}_{limb}'], 1)}}}")
    lines.append("# The 17 key points of COCO, those of limbs as they hang straight down.")
    lines.append("keypoints:")
    for name, (limb, place) in key_points().items():
        depth = people.DEPTH[name.split("_")[-1]]
        of = f", limb: {limb}" if limb else ""
        lines.append(f"  - {{name: {name}{of}, xyz_m: {row(place)}, radius_m: {depth:g}}}")
    return "\n".join(lines).replace("-0.000", "0.000").replace("-0.0,", "0.0,") + "\n"


def write_presets(folder):
    (folder / "person_walking.yaml").write_text(preset())
