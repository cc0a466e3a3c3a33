#include "dataset/export/record_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/types/sample_rows.h"

namespace tera {
namespace {

Vec3 Vector3(const Record& record, std::size_t first) {
  return {record.values[first], record.values[first + 1], record.values[first + 2]};
}

}  // namespace

RowSample RowOf(const Record& record) {
  return {record.t_ns, record.t_available_ns, record.values};
}

ImuSample ImuOf(const RecordStream& stream, const Record& record) {
  stream.RequireColumns(record.channel, ImuColumns());
  return ImuSampleOf(RowOf(record));
}

GnssSample GnssOf(const RecordStream& stream, const Record& record) {
  const std::vector<std::string> columns = GnssColumns();
  stream.RequireColumns(record.channel, columns);
  const auto fix = std::find(columns.begin(), columns.end(), "fix") - columns.begin();
  const double quality = record.values[static_cast<std::size_t>(fix)];
  if (!FixOfQuality(quality)) {
    stream.Fail(fmt::format("column 'fix': found '{}', {}", quality, kNeedFix));
  }
  const GnssSample sample = GnssSampleOf(RowOf(record));
  if (std::abs(sample.lat_deg) > 90 || std::abs(sample.lon_deg) > 180 ||
      sample.variance_enu_m2.minCoeff() < 0) {
    stream.Fail(
        "a latitude, longitude or variance is out of range; need -90 to 90 deg, -180 to 180 deg, "
        "and variances from 0");
  }
  return sample;
}

bool HasVelocity(const RecordStream& stream, std::size_t channel) {
  return stream.columns(channel) == PoseColumns(/*with_velocity=*/true);
}

TruthPose PoseOf(const RecordStream& stream, const Record& record) {
  const bool has_velocity = HasVelocity(stream, record.channel);
  if (!has_velocity) stream.RequireColumns(record.channel, PoseColumns(false));
  TruthPose pose;
  pose.t_ns = record.t_ns;
  const Quat q(record.values[3], record.values[4], record.values[5], record.values[6]);
  if (std::abs(q.norm() - 1) > kQuaternionTolerance) {
    stream.Fail(fmt::format("a quaternion of norm {}; need norm 1", q.norm()));
  }
  pose.X_WB = MakePose(Vector3(record, 0), q.normalized().toRotationMatrix());
  if (has_velocity) {
    pose.v_WB_mps = Vector3(record, 7);
    pose.w_WB_B_radps = Vector3(record, 10);
  }
  return pose;
}

std::string NameOfBody(const std::string& pose_file) {
  std::filesystem::path name(pose_file);
  if (*name.begin() == "truth") name = name.lexically_relative("truth");
  return name.filename() == "pose.csv" ? name.parent_path().string()
                                       : name.replace_extension().string();
}

Quat UnitQuaternion(const Pose& pose) {
  Quat q(pose.linear());
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return q;
}

}  // namespace tera
