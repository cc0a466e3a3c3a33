#include "dataset/ros/serialize_messages.h"

#include <algorithm>

#include "core/time.h"

namespace tera::ros {
namespace {

constexpr int kSixBySix = 36;
constexpr std::uint32_t kOneOfEach = 1;

void PutStamp(TimeNs t_ns, Serializer* out) {
  const TimeNs known_ns = std::max<TimeNs>(0, t_ns);
  out->Put(static_cast<std::uint32_t>(known_ns / kNsPerSecond));
  out->Put(static_cast<std::uint32_t>(known_ns % kNsPerSecond));
}

void PutHeader(const Header& header, Serializer* out) {
  if (out->form() == WireForm::kRos1) out->Put(std::uint32_t{0});
  PutStamp(header.t_ns, out);
  out->Put(header.frame_id);
}

void PutVector(const Vec3& v, Serializer* out) {
  out->Put(v.x());
  out->Put(v.y());
  out->Put(v.z());
}

void PutQuaternion(const Quat& q, Serializer* out) {
  out->Put(q.x());
  out->Put(q.y());
  out->Put(q.z());
  out->Put(q.w());
}

/// A Pose or a Transform, which have the same layout.
void PutPose(const Pose& pose, Serializer* out) {
  PutVector(pose.translation(), out);
  PutQuaternion(Quat(pose.linear()).normalized(), out);
}

/// A std_msgs/MultiArrayDimension.
void PutDimension(const std::string& label, std::uint32_t size, std::uint32_t stride,
                  Serializer* out) {
  out->Put(label);
  out->Put(size);
  out->Put(stride);
}

void PutUnknownCovariance(Serializer* out) { out->Put(std::array<double, kSixBySix>{}); }

}  // namespace

void Put(const Clock& message, Serializer* out) { PutStamp(message.t_ns, out); }

void Put(const Float64& message, Serializer* out) { out->Put(message.data); }

void Put(const PoseStamped& message, Serializer* out) {
  PutHeader(message.header, out);
  PutPose(message.pose, out);
}

void Put(const TfMessage& message, Serializer* out) {
  out->PutLength(message.transforms.size());
  for (const TransformStamped& transform : message.transforms) {
    PutHeader(transform.header, out);
    out->Put(transform.child_frame_id);
    PutPose(transform.pose, out);
  }
}

void Put(const Odometry& message, Serializer* out) {
  PutHeader(message.header, out);
  out->Put(message.child_frame_id);
  PutPose(message.pose, out);
  PutUnknownCovariance(out);
  PutVector(message.linear_mps, out);
  PutVector(message.angular_radps, out);
  PutUnknownCovariance(out);
}

void Put(const JointState& message, Serializer* out) {
  PutHeader(message.header, out);
  out->PutLength(message.name.size());
  for (const std::string& name : message.name) out->Put(name);
  out->Put(message.position);
  out->Put(message.velocity);
  out->Put(message.effort);
}

void Put(const Imu& message, Serializer* out) {
  PutHeader(message.header, out);
  PutQuaternion(Quat::Identity(), out);
  Covariance3 no_orientation = {};
  no_orientation[0] = -1;
  out->Put(no_orientation);
  PutVector(message.angular_velocity_radps, out);
  out->Put(message.angular_velocity_covariance);
  PutVector(message.linear_acceleration_mps2, out);
  out->Put(message.linear_acceleration_covariance);
}

void Put(const NavSatFix& message, Serializer* out) {
  constexpr std::uint16_t kGps = 1;
  PutHeader(message.header, out);
  out->Put(message.status);
  out->Put(kGps);
  out->Put(message.latitude_deg);
  out->Put(message.longitude_deg);
  out->Put(message.altitude_m);
  out->Put(message.position_covariance_m2);
  out->Put(message.covariance_type);
}

void Put(const Image& message, Serializer* out) {
  PutHeader(message.header, out);
  out->Put(message.height_px);
  out->Put(message.width_px);
  out->Put(message.encoding);
  out->Put(false);  // big-endian
  out->Put(message.step_bytes);
  out->Put(message.data);
}

void Put(const CompressedImage& message, Serializer* out) {
  PutHeader(message.header, out);
  out->Put(message.format);
  out->PutBytes(message.data);
}

void Put(const CameraInfo& message, Serializer* out) {
  PutHeader(message.header, out);
  out->Put(message.height_px);
  out->Put(message.width_px);
  out->Put(message.distortion_model);
  out->Put(message.d);
  out->Put(message.k);
  out->Put(std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  const auto& k = message.k;
  out->Put(std::array<double, 12>{k[0], k[1], k[2], 0, k[3], k[4], k[5], 0, k[6], k[7], k[8], 0});
  // No binning, and the whole picture as the region of interest, are zeros.
  for (int field = 0; field < 6; ++field) out->Put(std::uint32_t{0});
  out->Put(false);
}

void Put(const PointCloud2& message, Serializer* out) {
  const std::size_t points =
      message.point_step_bytes > 0 ? message.data.size() / message.point_step_bytes : 0;
  PutHeader(message.header, out);
  out->Put(std::uint32_t{1});  // height: one row
  out->Put(static_cast<std::uint32_t>(points));
  out->PutLength(message.fields.size());
  for (const PointField& field : message.fields) {
    out->Put(field.name);
    out->Put(field.offset);
    out->Put(field.datatype);
    out->Put(kOneOfEach);
  }
  out->Put(false);  // big-endian
  out->Put(message.point_step_bytes);
  out->Put(static_cast<std::uint32_t>(message.data.size()));
  out->Put(message.data);
  out->Put(true);  // dense: no point is missing
}

void Put(const GridMap& message, Serializer* out) {
  const std::uint32_t size = message.rows * message.columns;
  PutHeader(message.header, out);
  out->Put(message.resolution_m);
  out->Put(message.resolution_m * message.rows);
  out->Put(message.resolution_m * message.columns);
  PutPose(message.middle, out);
  out->PutLength(message.layers.size());
  for (const GridMap::Layer& layer : message.layers) out->Put(layer.name);
  std::vector<std::string> basic;
  for (const GridMap::Layer& layer : message.layers) {
    if (layer.name == "elevation") basic.push_back(layer.name);
  }
  out->PutLength(basic.size());
  for (const std::string& name : basic) out->Put(name);
  out->PutLength(message.layers.size());
  for (const GridMap::Layer& layer : message.layers) {
    out->PutLength(2);
    PutDimension("column_index", message.columns, size, out);
    PutDimension("row_index", message.rows, message.rows, out);
    out->Put(std::uint32_t{0});  // where the numbers begin
    out->Put(layer.values);
  }
  // The buffer of a map that moves may begin elsewhere; this one does not.
  for (int start = 0; start < 2; ++start) out->Put(std::uint16_t{0});
}

void Put(const DeltaCan& message, Serializer* out) {
  PutHeader({message.stamp_sec * kNsPerSecond + message.stamp_nanosec, ""}, out);
  for (const float lever :
       {message.slew, message.boom, message.arm, message.bucket, message.left_travel,
        message.right_travel, message.blade, message.swing}) {
    out->Put(lever);
  }
  out->Put(message.enable);
  out->Put(message.hydraulic_lock);
  out->Put(message.high_speed);
  out->Put(message.others);
}

}  // namespace tera::ros
