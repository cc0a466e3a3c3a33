"""Builds excavator20t.glb, a tracked excavator of the 20-ton class, one node for each moving part."""

import pathlib

import excavator20t_carriage
import excavator20t_front
import excavator20t_upper
from gltf_writer import write_glb


def excavator():
    """Bodies by node name, each in its link's frame."""
    bodies = {
        "undercarriage": excavator20t_carriage.undercarriage(),
        "upper": excavator20t_upper.upper(),
        "boom": excavator20t_front.boom(),
        "arm": excavator20t_front.arm(),
        "bucket": excavator20t_front.bucket(),
        "rocker": excavator20t_front.rocker(),
        "coupler": excavator20t_front.coupler(),
        "shoe": excavator20t_carriage.shoe(),
    }
    for name in ("boom", "arm", "bucket"):
        bodies[f"{name}_barrel"] = excavator20t_front.barrel(name)
        bodies[f"{name}_rod"] = excavator20t_front.rod(name)
    return bodies


if __name__ == "__main__":
    parts = excavator()
    write_glb(pathlib.Path(__file__).parent / "excavator20t.glb", parts)
    for part, body in parts.items():
        print(f"{part:14s} {body.triangle_count():6d} triangles")
