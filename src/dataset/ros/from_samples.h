#pragma once

#include <string>
#include <vector>

#include "core/types/label_channels.h"
#include "core/types/measurement.h"
#include "dataset/format/sensor_sheet.h"
#include "dataset/ros/messages.h"

/// Convert sensor measurements to ROS messages. `frame_id` is the sensor frame; for images it is
/// the optical frame. The stamp is t_ns.

namespace tera::ros {

/// Covariances are the white noise variance of a single sample. They are 0 (unknown) for a sensor
/// without noise.
Imu ImuMessage(const ImuSample& sample, const std::string& frame_id, const ImuNoise& noise,
               double period_s);

/// Status as NMEA drivers set it: single is a fix, differential is satellite-augmented, RTK is
/// ground-augmented. The covariance is the variance that the receiver reports.
NavSatFix NavSatFixMessage(const GnssSample& sample, const std::string& frame_id);

/// Converts a row to joints by column names. A column that ends in `_rad` or `_m` is the position
/// of the joint named in front of it; `_radps` or `_mps` is its velocity. Any other column is the
/// position of a joint with the full column name. Missing quantities are NaN; efforts are absent.
JointState JointStateOfRow(const RowSample& row, const std::string& frame_id,
                           const std::vector<std::string>& columns);

/// Distortion model `plumb_bob`, `rational_polynomial` or `equidistant`. The model `f_theta` does
/// not exist in ROS. As in datasets, the centre of pixel (0, 0) has the coordinates (0, 0).
CameraInfo CameraInfoMessage(const Header& header, const CameraLens& lens);

/// Encoding `rgb8`.
Image ColourMessage(const CameraFrame& frame, const std::string& frame_id);
/// Encoding `32FC1` in metres. A pixel without a measurement is NaN, as REP 118 requires.
Image DepthMessage(const CameraFrame& frame, const std::string& frame_id);
/// Encoding `mono8`, `mono16` or `rgb16`, with the values of the dataset's files.
Image LabelMessage(const LabelChannel& channel, const CameraFrame& frame,
                   const std::string& frame_id);

/// Fields x, y, z, intensity (float32), ring (uint16), label (uint8), time (float32), instance
/// (uint16); 28 bytes per point. The stamp is the time of the first ray, and time is in seconds
/// since the stamp.
PointCloud2 PointCloudMessage(const LidarScan& scan, const std::string& frame_id);

}  // namespace tera::ros
