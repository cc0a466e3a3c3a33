"""Writes a ROS 1 bag with rosbag, which nobody of this project wrote.

    /usr/bin/python3 write_ros1_bag.py FILE none|bz2|lz4

Topics: /imu (sensor_msgs/Imu, 200 messages, 100 Hz, angular velocity (k, -k, 0.5) / 100 and acceleration (0, 0.25, 9.81)),
/joints (sensor_msgs/JointState of boom and arm, positions k / 10 and -k / 10, no velocities), /picture (bytes, large).
Time begins at 1.7e9 s; the header is 2 ms before the recorder.
"""
import sys

import genpy.dynamic
import rosbag

RULE = "\n" + 80 * "=" + "\n"
HEADER = RULE + "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id"
VECTOR = RULE + "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z"
QUATERNION = RULE + "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w"
IMU = """# This is a message to hold data from an IMU
Header header

geometry_msgs/Quaternion orientation
float64[9] orientation_covariance # Row major about x, y, z axes
geometry_msgs/Vector3 angular_velocity
float64[9] angular_velocity_covariance
geometry_msgs/Vector3 linear_acceleration
float64[9] linear_acceleration_covariance""" + HEADER + QUATERNION + VECTOR
JOINTS = "Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort" + HEADER


def made(name, text):
    return genpy.dynamic.generate_dynamic(name, text)[name]


def main():
    imu_type, joint_type = made("sensor_msgs/Imu", IMU), made("sensor_msgs/JointState", JOINTS)
    picture_type = made("mine_msgs/Picture", "uint8[] data")
    with rosbag.Bag(sys.argv[1], "w", compression=sys.argv[2], chunk_threshold=20000) as bag:
        for k in range(200):
            nanoseconds = k * 10_000_000
            stamp = genpy.Time(1_700_000_000 + nanoseconds // 10**9, nanoseconds % 10**9)
            logged = stamp + genpy.Duration(0, 2_000_000)
            imu = imu_type()
            imu.header.stamp = stamp
            imu.angular_velocity.x, imu.angular_velocity.y, imu.angular_velocity.z = k / 100, -k / 100, 0.5
            imu.linear_acceleration.y, imu.linear_acceleration.z = 0.25, 9.81
            bag.write("/imu", imu, logged)
            if k % 10 == 0:
                joints = joint_type(name=["boom", "arm"], position=[k / 10, -k / 10])
                joints.header.stamp = stamp
                bag.write("/joints", joints, logged)
                bag.write("/picture", picture_type(data=bytes(k % 256 for _ in range(50000))), logged)


main()
