#include "ros2/wire.h"

#include <algorithm>

#include "topic_types.h"

// Cyclone's structs hold pointers; here they point into the plain message, which outlives the call
// that writes them. Cyclone reads what it writes and neither changes nor frees it.

namespace tera::ros {
namespace {

char* Borrow(const std::string& text) { return const_cast<char*>(text.c_str()); }

template <typename Sequence, typename T>
Sequence Borrow(const std::vector<T>& items) {
  Sequence sequence = {};
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(items.size());
  sequence._buffer = const_cast<T*>(items.data());
  return sequence;
}

/// rclcpp::Time and rclpy's throw at negative seconds, although the type holds them.
builtin_interfaces_msg_dds__Time_ ToWire(TimeNs t_ns) {
  const TimeNs from_0_ns = std::max<TimeNs>(t_ns, 0);
  return {static_cast<std::int32_t>(from_0_ns / kNsPerSecond),
          static_cast<std::uint32_t>(from_0_ns % kNsPerSecond)};
}

std_msgs_msg_dds__Header_ ToWire(const Header& header) {
  return {ToWire(header.t_ns), Borrow(header.frame_id)};
}

geometry_msgs_msg_dds__Vector3_ ToWire(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

geometry_msgs_msg_dds__Quaternion_ Rotation(const Pose& pose) {
  const Quat q(pose.linear());
  return {q.x(), q.y(), q.z(), q.w()};
}

geometry_msgs_msg_dds__Pose_ ToWire(const Pose& pose) {
  const Vec3& p = pose.translation();
  return {{p.x(), p.y(), p.z()}, Rotation(pose)};
}

rosgraph_msgs_msg_dds__Clock_ ToWire(const Clock& m) { return {ToWire(m.t_ns)}; }

std_msgs_msg_dds__Float64_ ToWire(const Float64& m) { return {m.data}; }

geometry_msgs_msg_dds__PoseStamped_ ToWire(const PoseStamped& m) {
  return {ToWire(m.header), ToWire(m.pose)};
}

nav_msgs_msg_dds__Odometry_ ToWire(const Odometry& m) {
  nav_msgs_msg_dds__Odometry_ wire = {};
  wire.header = ToWire(m.header);
  wire.child_frame_id = Borrow(m.child_frame_id);
  wire.pose.pose = ToWire(m.pose);
  wire.twist.twist = {ToWire(m.linear_mps), ToWire(m.angular_radps)};
  return wire;
}

sensor_msgs_msg_dds__Imu_ ToWire(const Imu& m) {
  sensor_msgs_msg_dds__Imu_ wire = {};
  wire.header = ToWire(m.header);
  wire.orientation.w = 1;
  wire.orientation_covariance[0] = -1;  // ROS's sign that there is no orientation
  wire.angular_velocity = ToWire(m.angular_velocity_radps);
  std::ranges::copy(m.angular_velocity_covariance, wire.angular_velocity_covariance);
  wire.linear_acceleration = ToWire(m.linear_acceleration_mps2);
  std::ranges::copy(m.linear_acceleration_covariance, wire.linear_acceleration_covariance);
  return wire;
}

sensor_msgs_msg_dds__NavSatFix_ ToWire(const NavSatFix& m) {
  constexpr std::uint16_t kGps = 1;
  sensor_msgs_msg_dds__NavSatFix_ wire = {};
  wire.header = ToWire(m.header);
  wire.status = {m.status, kGps};
  wire.latitude = m.latitude_deg;
  wire.longitude = m.longitude_deg;
  wire.altitude = m.altitude_m;
  std::ranges::copy(m.position_covariance_m2, wire.position_covariance);
  wire.position_covariance_type = m.covariance_type;
  return wire;
}

sensor_msgs_msg_dds__Image_ ToWire(const Image& m) {
  sensor_msgs_msg_dds__Image_ wire = {};
  wire.header = ToWire(m.header);
  wire.height = m.height_px;
  wire.width = m.width_px;
  wire.encoding = Borrow(m.encoding);
  wire.step = m.step_bytes;
  wire.data = Borrow<decltype(wire.data)>(m.data);
  return wire;
}

sensor_msgs_msg_dds__CameraInfo_ ToWire(const CameraInfo& m) {
  sensor_msgs_msg_dds__CameraInfo_ wire = {};
  wire.header = ToWire(m.header);
  wire.height = m.height_px;
  wire.width = m.width_px;
  wire.distortion_model = Borrow(m.distortion_model);
  wire.d = Borrow<decltype(wire.d)>(m.d);
  std::ranges::copy(m.k, wire.k);
  wire.r[0] = wire.r[4] = wire.r[8] = 1;
  for (int row = 0; row < 3; ++row) std::copy_n(&m.k[3 * row], 3, &wire.p[4 * row]);
  return wire;
}

dds_return_t Write(dds_entity_t writer, const JointState& m) {
  std::vector<char*> names;
  for (const std::string& name : m.name) names.push_back(Borrow(name));
  sensor_msgs_msg_dds__JointState_ wire = {};
  wire.header = ToWire(m.header);
  wire.name = Borrow<decltype(wire.name)>(names);
  wire.position = Borrow<decltype(wire.position)>(m.position);
  wire.velocity = Borrow<decltype(wire.velocity)>(m.velocity);
  wire.effort = Borrow<decltype(wire.effort)>(m.effort);
  return dds_write(writer, &wire);
}

dds_return_t Write(dds_entity_t writer, const TfMessage& m) {
  std::vector<geometry_msgs_msg_dds__TransformStamped_> transforms;
  for (const TransformStamped& t : m.transforms) {
    const Vec3& p = t.pose.translation();
    transforms.push_back(
        {ToWire(t.header), Borrow(t.child_frame_id), {{p.x(), p.y(), p.z()}, Rotation(t.pose)}});
  }
  tf2_msgs_msg_dds__TFMessage_ wire = {};
  wire.transforms = Borrow<decltype(wire.transforms)>(transforms);
  return dds_write(writer, &wire);
}

dds_return_t Write(dds_entity_t writer, const PointCloud2& m) {
  std::vector<sensor_msgs_msg_dds__PointField_> fields;
  for (const PointField& f : m.fields) fields.push_back({Borrow(f.name), f.offset, f.datatype, 1});
  sensor_msgs_msg_dds__PointCloud2_ wire = {};
  wire.header = ToWire(m.header);
  wire.height = 1;
  wire.width = static_cast<std::uint32_t>(m.data.size() / m.point_step_bytes);
  wire.fields = Borrow<decltype(wire.fields)>(fields);
  wire.point_step = m.point_step_bytes;
  wire.row_step = static_cast<std::uint32_t>(m.data.size());
  wire.data = Borrow<decltype(wire.data)>(m.data);
  wire.is_dense = true;
  return dds_write(writer, &wire);
}

/// All others need nothing beside the message itself.
template <typename M>
dds_return_t Write(dds_entity_t writer, const M& message) {
  const auto wire = ToWire(message);
  return dds_write(writer, &wire);
}

DeltaCan FromWire(const tera_msgs_msg_dds__DeltaCAN_& wire) {
  DeltaCan m;
  m.stamp_sec = wire.header.stamp.sec;
  m.stamp_nanosec = wire.header.stamp.nanosec;
  m.slew = wire.slew;
  m.boom = wire.boom;
  m.arm = wire.arm;
  m.bucket = wire.bucket;
  m.left_travel = wire.left_travel;
  m.right_travel = wire.right_travel;
  m.blade = wire.blade;
  m.swing = wire.swing;
  m.enable = wire.enable;
  m.hydraulic_lock = wire.hydraulic_lock;
  m.high_speed = wire.high_speed;
  m.others.assign(wire.others._buffer, wire.others._buffer + wire.others._length);
  return m;
}

}  // namespace

const dds_topic_descriptor_t& TopicTypeOf(std::size_t index) {
  static const dds_topic_descriptor_t* const kTypes[] = {
      &rosgraph_msgs_msg_dds__Clock__desc,       &std_msgs_msg_dds__Float64__desc,
      &geometry_msgs_msg_dds__PoseStamped__desc, &tf2_msgs_msg_dds__TFMessage__desc,
      &nav_msgs_msg_dds__Odometry__desc,         &sensor_msgs_msg_dds__JointState__desc,
      &sensor_msgs_msg_dds__Imu__desc,           &sensor_msgs_msg_dds__NavSatFix__desc,
      &sensor_msgs_msg_dds__Image__desc,         &sensor_msgs_msg_dds__CameraInfo__desc,
      &sensor_msgs_msg_dds__PointCloud2__desc};
  static_assert(std::size(kTypes) == std::variant_size_v<Message>);
  return *kTypes[index];
}

const dds_topic_descriptor_t& DeltaCanTopicType() { return tera_msgs_msg_dds__DeltaCAN__desc; }

dds_return_t WriteOnWire(dds_entity_t writer, const Message& message) {
  return std::visit([&](const auto& m) { return Write(writer, m); }, message);
}

dds_return_t TakeFromWire(dds_entity_t reader, int most, std::vector<DeltaCan>* messages) {
  std::vector<void*> samples(most, nullptr);  // Cyclone lends its own
  std::vector<dds_sample_info_t> infos(most);
  const dds_return_t count = dds_take(reader, samples.data(), infos.data(), most, most);
  if (count <= 0) return count;
  for (int i = 0; i < count; ++i) {
    if (!infos[i].valid_data) continue;  // only says that a publisher has come or gone
    messages->push_back(FromWire(*static_cast<const tera_msgs_msg_dds__DeltaCAN_*>(samples[i])));
  }
  dds_return_loan(reader, samples.data(), count);
  return count;
}

}  // namespace tera::ros
