#pragma once

#include <string>
#include <vector>

#include "core/types/label_channels.h"
#include "core/types/measurement.h"
#include "dataset/format/sensor_sheet.h"
#include "dataset/ros/messages.h"

/// Sensor measurements as ROS messages. `frame_id` is the sensor's frame, for pictures its optical
/// frame. The stamp is the time of validity.

namespace tera::ros {

/// Covariances are the variance of one sample's white noise; 0 (unknown) without noise.
Imu ImuMessage(const ImuSample& sample, const std::string& frame_id, const ImuNoise& noise,
               double period_s);

/// Status as in drivers of NMEA receivers: single is a fix, differential satellite-augmented, RTK
/// ground-augmented. Covariance is the receiver's reported variance.
NavSatFix NavSatFixMessage(const GnssSample& sample, const std::string& frame_id);

/// A row of numbers as joints by column names. An ending `_rad` or `_m` marks the position of the
/// joint named before it, `_radps` or `_mps` its velocity. Any other column is the position of a
/// joint with the column's whole name. Missing quantities are NaN. No efforts.
JointState JointStateOfRow(const RowSample& row, const std::string& frame_id,
                           const std::vector<std::string>& columns);

/// Distortion `plumb_bob`, `rational_polynomial` or `equidistant` of ROS, with the centre of pixel
/// (0, 0) at (0, 0) as here, or `f_theta`, which ROS lacks.
CameraInfo CameraInfoMessage(const Header& header, const CameraLens& lens);

/// `rgb8`.
Image ColourMessage(const CameraFrame& frame, const std::string& frame_id);
/// `32FC1`, metres; NaN without a measurement, as REP 118 requires.
Image DepthMessage(const CameraFrame& frame, const std::string& frame_id);
/// `mono8`, `mono16` or `rgb16`: the numbers of the dataset's files.
Image LabelMessage(const LabelChannel& channel, const CameraFrame& frame,
                   const std::string& frame_id);

/// Fields x, y, z, intensity (float32), ring (uint16), label (uint8), time (float32, seconds since
/// the stamp, which is the scan's first ray), instance (uint16); 28 bytes per point.
PointCloud2 PointCloudMessage(const LidarScan& scan, const std::string& frame_id);

}  // namespace tera::ros
