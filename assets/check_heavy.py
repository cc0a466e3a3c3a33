"""Checks the 20-ton excavator and the dozer: dimensions against the configuration, bounds, age."""

import pathlib
import re

import numpy as np

import dozer_dimensions as dozer_dims
import excavator20t_dimensions as excavator_dims
from make_dozer import dozer
from make_excavator20t import excavator

HERE = pathlib.Path(__file__).parent
NODES = {
    "excavator20t": {"undercarriage", "upper", "boom", "arm", "bucket", "rocker", "coupler", "shoe",
                     "boom_barrel", "boom_rod", "arm_barrel", "arm_rod", "bucket_barrel",
                     "bucket_rod"},
    "dozer": {"chassis", "push_frame", "blade", "shoe", "lift_barrel", "lift_rod", "tilt_barrel",
              "tilt_rod"},
}
BUDGET, SHOE_BUDGET = 32000, 100
FIT_M = 0.004


def _in_plane(point):
    return (point[0], 0.0, point[1])


def _expected():
    """Lists of numbers that must stand in the configuration, by file and what they are."""
    e, d = excavator_dims, dozer_dims
    excavator_lists = {
        "boom pin": e.BOOM_PIN_U, "slew": (0, 0, e.SLEW_HEIGHT), "arm pin": (e.BOOM_LENGTH, 0, 0),
        "bucket pin": (e.ARM_LENGTH, 0, 0), "bucket tip": (e.BUCKET_TIP, 0, 0),
        "boom limits": e.BOOM_RANGE, "arm limits": e.ARM_RANGE, "bucket limits": e.BUCKET_RANGE,
        "track": (0, e.TRACK_Y, e.TRACK_Z), "bucket barrel": _in_plane(e.BUCKET_BARREL_PIN),
        "arm barrel": _in_plane(e.CYLINDERS["arm"][0]), "arm rod": _in_plane(e.CYLINDERS["arm"][2]),
        "boom barrel": _in_plane(e.CYLINDERS["boom"][0]),
        "boom rod": _in_plane(e.CYLINDERS["boom"][2]),
        "rocker": _in_plane(e.ROCKER_PIN), "coupler": _in_plane(e.COUPLER_PIN),
    }
    dozer_lists = {"lift pin": d.LIFT_PIN_B, "tilt pin": d.TILT_PIN_P, "lift limits": d.LIFT_RANGE,
                   "tilt limits": d.TILT_RANGE, "track": (0, d.TRACK_Y, d.TRACK_Z),
                   "lift barrel": d.LIFT_PINS[0], "lift rod": d.LIFT_PINS[1],
                   "tilt barrel": d.TILT_PINS[0], "tilt rod": d.TILT_PINS[1]}
    for name, lists, profile in (("excavator20t", excavator_lists, e.BUCKET_PROFILE),
                                 ("dozer", dozer_lists, d.BLADE_PROFILE)):
        lists.update({f"profile point {k}": point for k, point in enumerate(profile)})
    return {"excavator20t": excavator_lists, "dozer": dozer_lists}


def config_faults():
    """The constants of the dimensions must be found in the configuration."""
    faults = []
    for file, lists in _expected().items():
        text = (HERE / f"../config/machines/{file}.yaml").read_text()
        found = {tuple(float(v) for v in numbers.split(","))
                 for numbers in re.findall(r"\[([-\d., ]+)\]", text)}
        faults += [f"{file}.yaml: no list {list(values)} ({what})" for what, values in lists.items()
                   if tuple(float(v) for v in values) not in found]
    return faults


def faults_of(file, nodes):
    """Bounds of the nodes against what they are built to, budget, and age of the file."""
    triangles = {name: np.concatenate([t for _, t, _ in parts]) for name, parts in nodes.items()}
    low = {name: t.min(axis=(0, 1)) for name, t in triangles.items()}
    high = {name: t.max(axis=(0, 1)) for name, t in triangles.items()}
    faults = []

    def near(what, value, expected, tolerance=FIT_M):
        if abs(value - expected) > tolerance:
            faults.append(f"{file}: {what} is {value:.4f} m, need {expected:.4f} m")

    if file == "excavator20t":
        dims, built = excavator_dims, excavator()
        spans = {name: dims.pin_distance_range(name) for name in ("boom", "arm", "bucket")}
        near("front of the bucket's teeth", high["bucket"][0], dims.BUCKET_TIP, 0.03)
        near("width of the bucket", high["bucket"][1] - low["bucket"][1], dims.BUCKET_WIDTH, 0.09)
        near("tail radius", -low["upper"][0], dims.TAIL_RADIUS)
    else:
        dims, built = dozer_dims, dozer()
        spans = {"lift": dims.lift_range(), "tilt": dims.tilt_range()}
        near("lower edge of the blade", low["blade"][2], dims.BLADE_PROFILE[0][1], 0.01)
        near("width of the blade", high["blade"][1] - low["blade"][1], dims.BLADE_WIDTH, 0.06)
    near("length of a shoe", high["shoe"][0] - low["shoe"][0], dims.SHOE_LENGTH, 1e-3)
    near("width of a shoe", high["shoe"][1] - low["shoe"][1], dims.TRACK_WIDTH)
    near("outside of a shoe", high["shoe"][2], 0.0)
    for name, (shortest, longest) in spans.items():
        barrel, rod = high[f"{name}_barrel"][0], -low[f"{name}_rod"][0]
        if barrel > shortest or rod > shortest:
            faults.append(f"{file}: {name} cylinder is longer than its shortest {shortest:.3f} m")
        if barrel + rod < longest:
            faults.append(f"{file}: {name} cylinder falls apart at its longest {longest:.3f} m")
    if sum(len(t) for name, t in triangles.items() if name != "shoe") > BUDGET:
        faults.append(f"{file}: more than {BUDGET} triangles")
    if len(triangles["shoe"]) > SHOE_BUDGET:
        faults.append(f"{file}/shoe: more than {SHOE_BUDGET} triangles")
    return faults + [f"{file}/{name}: the file is older than its script"
                     for name, body in built.items()
                     if body.triangle_count() != len(triangles[name])]
