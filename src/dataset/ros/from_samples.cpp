#include "dataset/ros/from_samples.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/time.h"

namespace tera::ros {
namespace {

static_assert(std::endian::native == std::endian::little, "messages say that they are");

Covariance3 Diagonal(double x, double y, double z) { return {x, 0, 0, 0, y, 0, 0, 0, z}; }

double SampleVariance(double density, double sample_sigma, double period_s) {
  return density * density / period_s + sample_sigma * sample_sigma;
}

NavSatFix::Status StatusOf(GnssFix fix) {
  switch (fix) {
    case GnssFix::kNone:
      return NavSatFix::kNoFix;
    case GnssFix::kSingle:
      return NavSatFix::kFix;
    case GnssFix::kDifferential:
      return NavSatFix::kSatelliteAugmented;
    case GnssFix::kRtkFixed:
    case GnssFix::kRtkFloat:
      return NavSatFix::kGroundAugmented;
  }
  return NavSatFix::kNoFix;
}

template <typename T>
Image ImageMessage(const Header& header, const std::string& encoding,
                   const tera::Image<T>& picture) {
  Image message;
  message.header = header;
  message.height_px = static_cast<std::uint32_t>(picture.height_px);
  message.width_px = static_cast<std::uint32_t>(picture.width_px);
  message.encoding = encoding;
  message.step_bytes = static_cast<std::uint32_t>(picture.width_px * picture.channels * sizeof(T));
  message.data.resize(picture.data.size() * sizeof(T));
  if (!picture.empty()) std::memcpy(message.data.data(), picture.data.data(), message.data.size());
  return message;
}

template <typename T>
void Put(std::uint8_t* point, std::uint32_t offset, T value) {
  std::memcpy(point + offset, &value, sizeof value);
}

struct QuantityOfJoint {
  std::string joint;
  bool is_rate = false;
};

QuantityOfJoint QuantityOf(const std::string& column) {
  struct Ending {
    std::string_view text;
    bool is_rate;
  };
  for (const Ending& ending :
       {Ending{"_rad", false}, Ending{"_m", false}, Ending{"_radps", true}, Ending{"_mps", true}}) {
    if (!column.ends_with(ending.text)) continue;
    return {column.substr(0, column.size() - ending.text.size()), ending.is_rate};
  }
  return {column};
}

}  // namespace

Imu ImuMessage(const ImuSample& sample, const std::string& frame_id, const ImuNoise& noise,
               double period_s) {
  const double gyro =
      SampleVariance(noise.gyro_density_radpsrthz, noise.gyro_sample_radps, period_s);
  const double accel =
      SampleVariance(noise.accel_density_mps2rthz, noise.accel_sample_mps2, period_s);
  return {{sample.t_ns, frame_id},
          sample.w_WS_S_radps,
          sample.f_S_mps2,
          Diagonal(gyro, gyro, gyro),
          Diagonal(accel, accel, accel)};
}

NavSatFix NavSatFixMessage(const GnssSample& sample, const std::string& frame_id) {
  NavSatFix message;
  message.header = {sample.t_ns, frame_id};
  message.status = StatusOf(sample.fix);
  if (message.status == NavSatFix::kNoFix) return message;
  message.latitude_deg = sample.lat_deg;
  message.longitude_deg = sample.lon_deg;
  message.altitude_m = sample.alt_m;
  const Vec3& variance = sample.variance_enu_m2;
  message.position_covariance_m2 = Diagonal(variance.x(), variance.y(), variance.z());
  message.covariance_type = NavSatFix::kDiagonalKnown;
  return message;
}

JointState JointStateOfRow(const RowSample& row, const std::string& frame_id,
                           const std::vector<std::string>& columns) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  JointState message;
  message.header = {row.t_ns, frame_id};
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const QuantityOfJoint column = QuantityOf(columns[c]);
    const auto found = std::find(message.name.begin(), message.name.end(), column.joint);
    const auto joint = static_cast<std::size_t>(found - message.name.begin());
    if (found == message.name.end()) {
      message.name.push_back(column.joint);
      message.position.push_back(kNone);
      message.velocity.push_back(kNone);
    }
    (column.is_rate ? message.velocity : message.position)[joint] = row.values[c];
  }
  return message;
}

namespace {

/// ROS name of the distortion model and its coefficients. ROS has no name for f-theta.
std::pair<std::string, std::vector<double>> DistortionOf(const CameraLens& c) {
  if (c.law == "rational") {
    return {"rational_polynomial", {c.k1, c.k2, c.p1, c.p2, c.k3, c.k4, c.k5, c.k6}};
  }
  if (c.law == "kannala_brandt") return {"equidistant", {c.k1, c.k2, c.k3, c.k4}};
  if (c.law == "f_theta") return {"f_theta", {c.k1, c.k2, c.k3, c.k4}};
  return {"plumb_bob", {c.k1, c.k2, c.p1, c.p2, c.k3}};
}

}  // namespace

CameraInfo CameraInfoMessage(const Header& header, const CameraLens& c) {
  CameraInfo message;
  message.header = header;
  message.height_px = static_cast<std::uint32_t>(c.height_px);
  message.width_px = static_cast<std::uint32_t>(c.width_px);
  std::tie(message.distortion_model, message.d) = DistortionOf(c);
  message.k = {c.fx_px, 0, c.cx_px, 0, c.fy_px, c.cy_px, 0, 0, 1};
  return message;
}

Image ColourMessage(const CameraFrame& frame, const std::string& frame_id) {
  return ImageMessage({frame.t_ns, frame_id}, "rgb8", frame.rgb);
}

Image DepthMessage(const CameraFrame& frame, const std::string& frame_id) {
  tera::Image<float> depth_m = frame.depth_m;
  for (float& z_m : depth_m.data) {
    if (z_m == 0) z_m = std::numeric_limits<float>::quiet_NaN();
  }
  return ImageMessage({frame.t_ns, frame_id}, "32FC1", depth_m);
}

Image LabelMessage(const LabelChannel& channel, const CameraFrame& frame,
                   const std::string& frame_id) {
  const std::string bits = std::to_string(8 * ComponentBytes(channel));
  const std::string encoding = (channel.components == 3 ? "rgb" : "mono") + bits;
  return std::visit(
      [&](const auto picture) {
        return ImageMessage({frame.t_ns, frame_id}, encoding, frame.*picture);
      },
      channel.picture);
}

PointCloud2 PointCloudMessage(const LidarScan& scan, const std::string& frame_id) {
  enum : std::uint32_t {
    kX = 0,
    kY = 4,
    kZ = 8,
    kIntensity = 12,
    kRing = 16,
    kLabel = 18,
    kTime = 20,
    kInstance = 24,
    kStep = 28
  };
  PointCloud2 message;
  message.header = {scan.t_ns, frame_id};
  message.fields = {
      {"x", kX, PointField::kFloat32},       {"y", kY, PointField::kFloat32},
      {"z", kZ, PointField::kFloat32},       {"intensity", kIntensity, PointField::kFloat32},
      {"ring", kRing, PointField::kUint16},  {"label", kLabel, PointField::kUint8},
      {"time", kTime, PointField::kFloat32}, {"instance", kInstance, PointField::kUint16}};
  message.point_step_bytes = kStep;
  message.data.resize(scan.points.size() * kStep);
  std::uint8_t* at = message.data.data();
  for (const LidarPoint& point : scan.points) {
    Put(at, kX, point.x_m);
    Put(at, kY, point.y_m);
    Put(at, kZ, point.z_m);
    Put(at, kIntensity, point.intensity);
    Put(at, kRing, point.ring);
    Put(at, kLabel, point.label);
    Put(at, kTime, static_cast<float>(ToSeconds(point.time_offset_ns)));
    Put(at, kInstance, point.instance);
    at += kStep;
  }
  return message;
}

}  // namespace tera::ros
