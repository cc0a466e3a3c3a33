"""Builds the meshes of everything on the site but the excavator."""

import pathlib

import people
import person
import site_litter
import site_objects
import vehicles
import walker
import yard_objects
from gltf_writer import write_glb

FILES = {
    "warthog": vehicles.skid_steer,
    "truck": vehicles.truck,
    "truck_wheels": vehicles.truck_with_wheels,
    "person": person.nodes,
    "people": people.nodes,
    "walker": walker.nodes,
    "rock": site_objects.rocks,
    "cone": site_objects.cone,
    "barrier": site_objects.barrier,
    "tree": site_objects.trees,
    "container": site_objects.container,
    "fixed_arm": site_objects.fixed_arm,
    "yard": yard_objects.nodes,
    "litter": site_litter.nodes,
}

if __name__ == "__main__":
    for file, make in FILES.items():
        bodies = make()
        write_glb(pathlib.Path(__file__).parent / f"{file}.glb", bodies)
        for node, body in bodies.items():
            print(f"{file}/{node:10s} {body.triangle_count():6d} triangles")
    for poses in (people, walker):
        poses.write_presets(pathlib.Path(__file__).parent.parent / "config" / "obstacles")
