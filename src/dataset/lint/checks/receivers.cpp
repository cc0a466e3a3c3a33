#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/types/sample_rows.h"
#include "dataset/format/site_frame.h"
#include "dataset/lint/checks/change_vote.h"
#include "dataset/lint/checks/sensor_poses.h"
#include "dataset/lint/lint_job.h"

namespace tera {
namespace {

/// Receivers output degrees with seven decimals, which is 1 cm on the ground.
constexpr double kGeodesyTolerance_m = 0.02;
/// Largest distance of an antenna from the root of its machine: on the bucket of a large excavator.
constexpr double kReach_m = 20;
/// Largest error of a receiver, in addition to an unknown lever arm: 5 standard deviations plus 10
/// m for a fix without corrections.
constexpr double kSigmas = 5, kSinglePoint_m = 10;

/// Columns as in docs/reference/dataset.md.
enum Column : std::size_t { kLat, kLon, kAlt, kEast, kNorth, kUp, kFix, kVarE, kVarN, kVarU };

Vec3 EnuOf(const ScannedRow& row) {
  return {row.values[kEast], row.values[kNorth], row.values[kUp]};
}

bool HasFix(const ScannedRow& row) { return row.values[kFix] != 0; }

void CheckValues(LintJob* job, const std::string& channel, const ScannedTable& table) {
  job->Applies("gnss.values");
  for (const ScannedRow& row : table.rows) {
    const auto find = [&](const std::string& what) {
      job->Find("gnss.values", channel, {job->RowsOf(channel), row.line, what});
    };
    const std::vector<double>& v = row.values;
    if (!FixOfQuality(v[kFix])) find(fmt::format("fix is {}, {}", v[kFix], kNeedFix));
    if (std::abs(v[kLat]) > 90) find(fmt::format("lat_deg is {}, need -90 to 90", v[kLat]));
    if (std::abs(v[kLon]) > 180) find(fmt::format("lon_deg is {}, need -180 to 180", v[kLon]));
    for (const std::size_t c : {kVarE, kVarN, kVarU}) {
      if (v[c] < 0) find(fmt::format("{} is {}, need no less than 0", table.columns[c], v[c]));
    }
  }
}

void CheckGeodesy(LintJob* job, const std::string& channel, const ScannedTable& table) {
  const DatasetInfo& info = job->recording().info();
  const SiteFrame site(info.origin_lat_deg, info.origin_lon_deg, info.origin_height_m);
  for (const ScannedRow& row : table.rows) {
    if (!HasFix(row)) continue;
    job->Applies("gnss.geodesy");
    const Vec3 place_m = site.ToEnu({row.values[kLat], row.values[kLon], row.values[kAlt]});
    const double wrong_m = (place_m - EnuOf(row)).norm();
    if (wrong_m <= kGeodesyTolerance_m) continue;
    job->Find("gnss.geodesy", channel,
              {job->RowsOf(channel), row.line,
               fmt::format("east, north and up are {:.4g} m from latitude, longitude and height",
                           wrong_m)});
  }
}

void CheckPlace(LintJob* job, const std::string& channel, const ScannedTable& table) {
  const std::optional<SensorPoses> sensor = FindSensorPoses(*job, channel);
  if (!sensor) return;
  std::vector<double> excess_m;
  for (const ScannedRow& row : table.rows) {
    const auto X_WS = PoseAt(sensor->poses, row.t_ns);
    if (!HasFix(row) || !X_WS) continue;
    const std::vector<double>& v = row.values;
    const double sigma_m = std::sqrt(std::max(0.0, v[kVarE] + v[kVarN] + v[kVarU]));
    const double bound_m = (sensor->of_root ? kReach_m : 0) + kSinglePoint_m + kSigmas * sigma_m;
    excess_m.push_back((EnuOf(row) - X_WS->translation()).norm() - bound_m);
  }
  if (excess_m.empty()) return;
  job->Applies("gnss.pose");
  std::sort(excess_m.begin(), excess_m.end());
  const double median_m = excess_m[excess_m.size() / 2];
  if (median_m <= 0) return;
  job->Find("gnss.pose", channel,
            {job->RowsOf(channel), 0,
             fmt::format("the distance from the pose exceeds noise and the machine's reach by "
                         "{:.4g} m, in the median",
                         median_m)});
}

}  // namespace

void CheckReceivers(LintJob* job) {
  for (const std::string& channel : job->recording().ChannelsOf(kGnssChannel)) {
    job->Try(channel, [&] {
      const ScannedTable table = ReadTable(*job, channel);
      CheckValues(job, channel, table);
      for (const ScannedRow& row : table.rows) {
        if (HasFix(row)) CheckNear(job, channel, row.line, EnuOf(row));
      }
      CheckGeodesy(job, channel, table);
      CheckPlace(job, channel, table);
    });
  }
}

}  // namespace tera
