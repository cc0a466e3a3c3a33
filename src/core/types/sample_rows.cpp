#include "core/types/sample_rows.h"

#include "core/check.h"

namespace tera {
namespace {

void Append(const Vec3& v, std::vector<double>* values) {
  values->insert(values->end(), {v.x(), v.y(), v.z()});
}

Vec3 VectorAt(const RowSample& row, std::size_t first) {
  return {row.values[first], row.values[first + 1], row.values[first + 2]};
}

void RequireSize(const RowSample& row, std::size_t size) {
  TERA_CHECK(row.values.size() == size, row.values.size(), size);
}

}  // namespace

std::vector<std::string> ImuColumns() {
  return {"wx_radps", "wy_radps", "wz_radps", "ax_mps2", "ay_mps2", "az_mps2"};
}

RowSample RowOf(const ImuSample& sample) {
  RowSample row{sample.t_ns, sample.t_available_ns, {}};
  Append(sample.w_WS_S_radps, &row.values);
  Append(sample.f_S_mps2, &row.values);
  return row;
}

ImuSample ImuSampleOf(const RowSample& row) {
  RequireSize(row, 6);
  return {row.t_ns, row.t_available_ns, VectorAt(row, 0), VectorAt(row, 3)};
}

std::vector<std::string> GnssColumns() {
  return {"lat_deg", "lon_deg", "alt_m",    "east_m",   "north_m",
          "up_m",    "fix",     "var_e_m2", "var_n_m2", "var_u_m2"};
}

RowSample RowOf(const GnssSample& sample) {
  RowSample row{sample.t_ns, sample.t_available_ns, {sample.lat_deg, sample.lon_deg, sample.alt_m}};
  Append(sample.enu_m, &row.values);
  row.values.push_back(static_cast<double>(sample.fix));
  Append(sample.variance_enu_m2, &row.values);
  return row;
}

GnssSample GnssSampleOf(const RowSample& row) {
  RequireSize(row, 10);
  const std::vector<double>& v = row.values;
  const std::optional<GnssFix> fix = FixOfQuality(v[6]);
  TERA_CHECK(fix.has_value(), v[6]);
  return {row.t_ns, row.t_available_ns, v[0], v[1], v[2], VectorAt(row, 3), *fix, VectorAt(row, 7)};
}

std::optional<GnssFix> FixOfQuality(double quality) {
  for (const GnssFix fix : {GnssFix::kNone, GnssFix::kSingle, GnssFix::kDifferential,
                            GnssFix::kRtkFixed, GnssFix::kRtkFloat}) {
    if (quality == static_cast<double>(fix)) return fix;
  }
  return std::nullopt;
}

std::vector<std::string> EncoderColumns(const std::vector<EncoderAxis>& axes) {
  std::vector<std::string> columns;
  for (const EncoderAxis& axis : axes) columns.push_back(axis.name + (axis.linear ? "_m" : "_rad"));
  for (const EncoderAxis& axis : axes) {
    columns.push_back(axis.name + (axis.linear ? "_mps" : "_radps"));
  }
  return columns;
}

RowSample RowOf(const EncoderSample& sample) {
  TERA_CHECK(sample.q_rad.size() == sample.qd_radps.size(), sample.q_rad.size());
  RowSample row{sample.t_ns, sample.t_available_ns, sample.q_rad};
  row.values.insert(row.values.end(), sample.qd_radps.begin(), sample.qd_radps.end());
  return row;
}

EncoderSample EncoderSampleOf(const RowSample& row) {
  const auto half = row.values.begin() + static_cast<std::ptrdiff_t>(row.values.size() / 2);
  return {row.t_ns, row.t_available_ns, {row.values.begin(), half}, {half, row.values.end()}};
}

std::vector<std::string> PoseColumns(bool with_velocity) {
  std::vector<std::string> columns = {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
  if (with_velocity) {
    columns.insert(columns.end(),
                   {"vx_mps", "vy_mps", "vz_mps", "wx_radps", "wy_radps", "wz_radps"});
  }
  return columns;
}

RowSample RowOf(const TruthPose& pose, bool with_velocity) {
  Quat q(pose.X_WB.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  RowSample row{pose.t_ns, pose.t_ns, {}};
  Append(pose.X_WB.translation(), &row.values);
  row.values.insert(row.values.end(), {q.w(), q.x(), q.y(), q.z()});
  if (with_velocity) {
    Append(pose.v_WB_mps, &row.values);
    Append(pose.w_WB_B_radps, &row.values);
  }
  return row;
}

}  // namespace tera
