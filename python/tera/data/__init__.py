"""Reads datasets of TERA, simulated or real, and what `tera diagnose` says of them.

    import tera
    dataset = tera.Dataset("out/quickstart")
    dataset["excavator1/imu_boom"]["wy_radps"]            # a column
    frame = dataset["excavator1/camera_front"][10]        # pictures are read when they are asked for
    scan = dataset["excavator1/lidar_roof"].at(frame.t_ns)
    X_CS = dataset.transform("excavator1/camera_front/optical", "excavator1/lidar_roof", frame.t_ns)
    pixels, z_m = frame.lens.project(tera.transformed(X_CS, scan.xyz_m))

Arrays are NumPy's. Times are whole nanoseconds since the recording's zero, angles radians, lengths metres. X_AB is a
4 x 4 pose of frame B in frame A: p_A = X_AB p_B.
"""

from tera.data.camera import Box, Camera, Flow, Frame, Keypoint
from tera.data.dataset import Dataset, Epoch
from tera.data.diagnosis import Diagnosis, diagnosis
from tera.data.events import Event, Events
from tera.data.lens import Lens
from tera.data.lidar import Lidar, Scan
from tera.data.pose import PoseTrack, pose_matrix, transformed
from tera.data.table import Table

__all__ = ["Box", "Camera", "Dataset", "Diagnosis", "Epoch", "Event", "Events", "Flow", "Frame", "Keypoint", "Lens", "Lidar", "PoseTrack", "Scan", "Table", "diagnosis",
           "pose_matrix", "transformed"]
