#include <algorithm>
#include <cmath>
#include <numbers>

#include "blind/mujoco/sensors/measured.h"

namespace tera::blind::mujoco {
namespace {

constexpr std::size_t kEast = 3, kFix = 6;
constexpr double kFixed = 4;
constexpr long long kLongest_ns = 250'000'000;  ///< between rows that a place is drawn from

Vec3 PlaceOf(const std::vector<double>& row) {
  return {row[kEast], row[kEast + 1], row[kEast + 2]};
}

/// Where an antenna was at a time, between two fixed rows of its receiver.
std::optional<Vec3> PlaceAt(const Table& table, long long t_ns) {
  const auto next = std::upper_bound(table.t_ns.begin(), table.t_ns.end(), t_ns);
  if (next == table.t_ns.begin() || next == table.t_ns.end()) return std::nullopt;
  const auto k = static_cast<std::size_t>(next - table.t_ns.begin());
  const std::vector<double>&before = table.rows[k - 1], &after = table.rows[k];
  const long long length_ns = table.t_ns[k] - table.t_ns[k - 1];
  if (length_ns > kLongest_ns || before[kFix] != kFixed || after[kFix] != kFixed) {
    return std::nullopt;
  }
  const double share =
      static_cast<double>(t_ns - table.t_ns[k - 1]) / static_cast<double>(length_ns);
  return PlaceOf(before) + share * (PlaceOf(after) - PlaceOf(before));
}

std::vector<double> RowOf(const Vec3& p_m, const Quat& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  return {p_m.x(), p_m.y(), p_m.z(), sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z()};
}

}  // namespace

Table OwnersPoses(const MachineNumbers& numbers, const Measured& measured, const Start& start,
                  bool stands) {
  Table poses{{"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"}, {}, {}};
  const Vec3 left_B_m = numbers.antennas[0].xyz_m, right_B_m = numbers.antennas[1].xyz_m;
  const Vec3 between_B_m = left_B_m - right_B_m;
  Vec3 sum_m = Vec3::Zero();
  for (std::size_t k = 0; k < measured.receivers[0].t_ns.size(); ++k) {
    const std::vector<double>& row = measured.receivers[0].rows[k];
    const auto right_m = PlaceAt(measured.receivers[1], measured.receivers[0].t_ns[k]);
    if (row[kFix] != kFixed || !right_m) continue;
    const Vec3 between_m = PlaceOf(row) - *right_m, middle_m = (PlaceOf(row) + *right_m) / 2;
    const double yaw_rad = stands ? start.yaw_rad
                                  : std::atan2(between_m.y(), between_m.x()) -
                                        std::atan2(between_B_m.y(), between_B_m.x());
    const Quat q = start.ground.AttitudeAt(middle_m.x(), middle_m.y(), yaw_rad);
    const Vec3 p_m = middle_m - q * Vec3((left_B_m + right_B_m) / 2);
    sum_m += p_m;
    poses.t_ns.push_back(measured.receivers[0].t_ns[k]);
    poses.rows.push_back(RowOf(p_m, q));
  }
  if (!stands || poses.rows.empty()) return poses;
  const Vec3 mean_m = sum_m / static_cast<double>(poses.rows.size());
  const Quat q = start.ground.AttitudeAt(mean_m.x(), mean_m.y(), start.yaw_rad);
  for (std::vector<double>& row : poses.rows) row = RowOf(mean_m, q);
  return poses;
}

/// By way of coordinates that turn with the earth, back by Bowring's formula (1976), which is exact
/// to far below a millimetre near the ground.
Vec3 Geodetic(const Vec3& p_m) {
  constexpr double kDeg = std::numbers::pi / 180, a = 6378137, f = 1 / 298.257223563;
  constexpr double e2 = f * (2 - f), b = a * (1 - f), e2_second = e2 / (1 - e2);
  const double phi = kLatitude_deg * kDeg, lambda = kLongitude_deg * kDeg;
  const double n = a / std::sqrt(1 - e2 * std::sin(phi) * std::sin(phi));
  const Vec3 east(-std::sin(lambda), std::cos(lambda), 0);
  const Vec3 up(std::cos(phi) * std::cos(lambda), std::cos(phi) * std::sin(lambda), std::sin(phi));
  const Vec3 north = up.cross(east);
  const Vec3 origin((n + kHeight_m) * up.x(), (n + kHeight_m) * up.y(),
                    (n * (1 - e2) + kHeight_m) * up.z());
  const Vec3 x = origin + p_m.x() * east + p_m.y() * north + p_m.z() * up;
  const double r = std::hypot(x.x(), x.y());
  const double u = std::atan2(x.z() * a, r * b);
  const double latitude = std::atan2(x.z() + e2_second * b * std::pow(std::sin(u), 3),
                                     r - e2 * a * std::pow(std::cos(u), 3));
  const double there = a / std::sqrt(1 - e2 * std::sin(latitude) * std::sin(latitude));
  const double height_m = r * std::cos(latitude) + x.z() * std::sin(latitude) -
                          there * (1 - e2 * std::sin(latitude) * std::sin(latitude));
  return {latitude / kDeg, std::atan2(x.y(), x.x()) / kDeg, height_m};
}

}  // namespace tera::blind::mujoco
