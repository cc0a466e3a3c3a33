#include "dataset/export/kitti/steady_scan.h"

#include <bit>
#include <optional>
#include <string>

#include "dataset/export/bag/little_endian.h"

namespace tera {

std::vector<LidarPoint> SteadyScan(const LidarScan& scan, const PoseTrack& X_WS, TimeNs t_ns) {
  std::vector<LidarPoint> points = scan.points;
  const Pose X_SW = X_WS.At(t_ns).inverse();
  Pose X_SR = Pose::Identity();    // sensor pose at the time of the ray
  std::optional<TimeNs> posed_ns;  // time of the last computed pose; consecutive rays often have
                                   // equal times
  for (LidarPoint& point : points) {
    const TimeNs ray_ns = scan.t_ns + point.time_offset_ns;
    if (posed_ns != ray_ns) X_SR = X_SW * X_WS.At(ray_ns);
    posed_ns = ray_ns;
    const Vec3 p_S_m = X_SR * Vec3(point.x_m, point.y_m, point.z_m);
    point.x_m = static_cast<float>(p_S_m.x());
    point.y_m = static_cast<float>(p_S_m.y());
    point.z_m = static_cast<float>(p_S_m.z());
  }
  return points;
}

std::string VelodyneBytes(const std::vector<LidarPoint>& points) {
  std::string bytes;
  for (const LidarPoint& point : points) {
    for (const float value : {point.x_m, point.y_m, point.z_m, point.intensity}) {
      AppendNumber(std::bit_cast<std::uint32_t>(value), &bytes);
    }
  }
  return bytes;
}

}  // namespace tera
