#pragma once

#include <string>
#include <vector>

#include "core/types/label_channels.h"
#include "core/types/measurement.h"
#include "dataset/format/sensor_sheet.h"
#include "dataset/ros/messages.h"

/// What sensors measured, as ROS messages. `frame_id` is the sensor's frame, for pictures its
/// optical frame. The stamp is the time at which a measurement was valid.

namespace tera::ros {

/// Covariances are the variance of the white noise of one sample; 0, not known, without a noise.
Imu ImuMessage(const ImuSample& sample, const std::string& frame_id, const ImuNoise& noise,
               double period_s);

/// Status as drivers of NMEA receivers have it: single is a fix, differential satellite-augmented,
/// RTK ground-augmented. Covariance is the variance that the receiver reports.
NavSatFix NavSatFixMessage(const GnssSample& sample, const std::string& frame_id);

/// A row of numbers by the names of its columns. A column that ends in `_rad` or `_m` is the
/// position of a joint of the name before that ending, one that ends in `_radps` or `_mps` its
/// velocity; any other column is a joint of its whole name, its number the position. What a joint
/// has no column for is NaN. No efforts.
JointState JointStateOfRow(const RowSample& row, const std::string& frame_id,
                           const std::vector<std::string>& columns);

/// Distortion `plumb_bob`, `rational_polynomial` or `equidistant` as ROS has them, whose pixel
/// (0, 0) has its centre at (0, 0) like ours, or `f_theta`, which ROS has not.
CameraInfo CameraInfoMessage(const Header& header, const CameraLens& lens);

/// `rgb8`.
Image ColourMessage(const CameraFrame& frame, const std::string& frame_id);
/// `32FC1`, metres; NaN, as REP 118 asks, where there is no measurement.
Image DepthMessage(const CameraFrame& frame, const std::string& frame_id);
/// `mono8`, `mono16` or `rgb16`: the numbers of the dataset's files.
Image LabelMessage(const LabelChannel& channel, const CameraFrame& frame,
                   const std::string& frame_id);

/// Fields x, y, z, intensity (float32), ring (uint16), label (uint8), time (float32, seconds since
/// the stamp, which is the scan's first ray), instance (uint16); 28 bytes a point.
PointCloud2 PointCloudMessage(const LidarScan& scan, const std::string& frame_id);

}  // namespace tera::ros
