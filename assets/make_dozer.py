"""Builds dozer.glb, a tracked dozer of the 13-ton class, one node for each moving part."""

import pathlib

import dozer_blade
import dozer_chassis
from gltf_writer import write_glb


def dozer():
    """Bodies by node name, each in its link's frame."""
    bodies = {
        "chassis": dozer_chassis.chassis(),
        "push_frame": dozer_blade.push_frame(),
        "blade": dozer_blade.blade(),
        "shoe": dozer_chassis.shoe(),
    }
    for name in ("lift", "tilt"):
        bodies[f"{name}_barrel"] = dozer_blade.barrel(name)
        bodies[f"{name}_rod"] = dozer_blade.rod(name)
    return bodies


if __name__ == "__main__":
    parts = dozer()
    write_glb(pathlib.Path(__file__).parent / "dozer.glb", parts)
    for part, body in parts.items():
        print(f"{part:14s} {body.triangle_count():6d} triangles")
