"""Reads TERA's datasets, and steps its simulations over a socket.

    import tera
    dataset = tera.Dataset("out/quickstart")               # docs/reference/python.md
    with tera.make("config/scenarios/quickstart.yaml") as env:      # docs/reference/serve.md; needs grpcio and protobuf
        obs, info = env.reset(seed=1)
        obs, reward, terminated, truncated, info = env.step(env.action_space.sample())

Env is the environment, VectorEnv several at once, Session the requests below it, Server the program that answers them. They are imported when they
are first used: reading datasets needs NumPy and PyYAML, and OpenCV for pictures.
"""

from importlib import import_module

from tera.data import (Box, Camera, Dataset, Diagnosis, Event, Events, Flow, Frame, Keypoint, Lens, Lidar, PoseTrack, Scan, Table, diagnosis,
                       pose_matrix, transformed)

_CLIENT = {"Env": "tera.env", "Patch": "tera.machine_io", "make": "tera.env", "VectorEnv": "tera.vector",
           "make_vector": "tera.vector", "Server": "tera.server", "Refused": "tera.session", "Session": "tera.session",
           "SessionEnded": "tera.session", "messages": "tera.v1.simulation_pb2"}

__all__ = ["Box", "Camera", "Dataset", "Diagnosis", "Env", "Event", "Events", "Flow", "Frame", "Keypoint", "Lens", "Lidar", "Patch", "PoseTrack", "Refused",
           "Scan", "Server", "Session", "SessionEnded", "Table", "VectorEnv", "diagnosis", "make", "make_vector", "messages", "pose_matrix",
           "transformed"]


def __getattr__(name: str):
    if name not in _CLIENT:
        raise AttributeError(f"module 'tera' has no attribute {name!r}")
    module = import_module(_CLIENT[name])
    return module if name == "messages" else getattr(module, name)
