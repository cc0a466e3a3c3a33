#include "dataset/format/csv_rows.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <span>

#include "core/check.h"

namespace tera {
namespace {

void AppendNumbers(std::string* row, std::span<const double> values) {
  for (const double value : values) {
    TERA_CHECK(std::isfinite(value), *row);
    fmt::format_to(std::back_inserter(*row), ",{}", value);
  }
}

void AppendVector(std::string* row, const Vec3& v) { AppendNumbers(row, {v.data(), 3}); }

std::string StartRow(TimeNs t_ns) { return fmt::format("{}", t_ns); }

}  // namespace

std::string TableHeader(const std::vector<std::string>& columns) {
  std::string header = "t_ns";
  for (const std::string& column : columns) header += ',' + column;
  return header;
}

std::vector<std::string> EncoderColumns(const std::vector<EncoderAxis>& axes) {
  std::vector<std::string> columns;
  for (const EncoderAxis& axis : axes) columns.push_back(axis.name + (axis.linear ? "_m" : "_rad"));
  for (const EncoderAxis& axis : axes) {
    columns.push_back(axis.name + (axis.linear ? "_mps" : "_radps"));
  }
  return columns;
}

std::optional<GnssFix> FixOfQuality(double quality) {
  for (const GnssFix fix : {GnssFix::kNone, GnssFix::kSingle, GnssFix::kDifferential,
                            GnssFix::kRtkFixed, GnssFix::kRtkFloat}) {
    if (quality == static_cast<double>(fix)) return fix;
  }
  return std::nullopt;
}

std::string ImuRow(const ImuSample& sample) {
  std::string row = StartRow(sample.t_ns);
  AppendVector(&row, sample.w_WS_S_radps);
  AppendVector(&row, sample.f_S_mps2);
  return row + '\n';
}

std::string GnssRow(const GnssSample& sample) {
  std::string row = StartRow(sample.t_ns);
  const double place[] = {sample.lat_deg, sample.lon_deg, sample.alt_m};
  AppendNumbers(&row, place);
  AppendVector(&row, sample.enu_m);
  fmt::format_to(std::back_inserter(row), ",{}", static_cast<int>(sample.fix));
  AppendVector(&row, sample.variance_enu_m2);
  return row + '\n';
}

std::string EncoderRow(const EncoderSample& sample) {
  std::string row = StartRow(sample.t_ns);
  AppendNumbers(&row, sample.q_rad);
  AppendNumbers(&row, sample.qd_radps);
  return row + '\n';
}

std::string PoseRow(const TruthPose& pose, bool with_velocity) {
  Quat q(pose.X_WB.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  std::string row = StartRow(pose.t_ns);
  AppendVector(&row, pose.X_WB.translation());
  const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
  AppendNumbers(&row, wxyz);
  if (with_velocity) {
    AppendVector(&row, pose.v_WB_mps);
    AppendVector(&row, pose.w_WB_B_radps);
  }
  return row + '\n';
}

std::string FrameRow(TimeNs t_ns, std::string_view filename) {
  return fmt::format("{},{}\n", t_ns, filename);
}

std::string TableRow(TimeNs t_ns, const std::vector<double>& values) {
  std::string row = StartRow(t_ns);
  AppendNumbers(&row, values);
  return row + '\n';
}

}  // namespace tera
