"""Builds tb235.glb, a compact excavator of the 3.5-ton class, one node for each moving part."""

import pathlib

import tb235_carriage
import tb235_front
import tb235_upper
from gltf_writer import write_glb


def excavator():
    """Bodies by node name, each in its link's frame."""
    bodies = {
        "undercarriage": tb235_carriage.undercarriage(),
        "upper": tb235_upper.upper(),
        "swing_post": tb235_front.swing_post(),
        "boom": tb235_front.boom(),
        "arm": tb235_front.arm(),
        "bucket": tb235_front.bucket(),
        "blade": tb235_carriage.blade(),
        "shoe": tb235_carriage.shoe(),
    }
    for name in tb235_front.BORES:
        bodies[f"{name}_barrel"] = tb235_front.barrel(name)
        bodies[f"{name}_rod"] = tb235_front.rod(name)
    bodies["bucket_rocker"] = tb235_front.bucket_rocker()
    bodies["bucket_coupler"] = tb235_front.bucket_coupler()
    return bodies


if __name__ == "__main__":
    parts = excavator()
    write_glb(pathlib.Path(__file__).parent / "tb235.glb", parts)
    for part, body in parts.items():
        print(f"{part:14s} {body.triangle_count():6d} triangles")
