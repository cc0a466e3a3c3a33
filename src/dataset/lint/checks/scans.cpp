#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "core/error.h"
#include "dataset/format/pcd.h"
#include "dataset/lint/checks/frames.h"
#include "dataset/lint/lint_job.h"

// Checks the scans of lidars. Memory holds one scan.

namespace tera {
namespace fs = std::filesystem;
namespace {

/// Reports findings in one scan.
struct ScanPlace {
  LintJob* job;
  const std::string& lidar;
  std::string file;

  void Find(RuleId rule, const std::string& what) const { job->Find(rule, lidar, {file, 0, what}); }
};

void CheckValues(const ScanPlace& place, const std::vector<LidarPoint>& points, double rate_hz) {
  place.job->Applies("scans.values");
  std::int64_t endless = 0, bright = 0, late = 0;
  for (const LidarPoint& p : points) {
    endless += std::isfinite(p.x_m) && std::isfinite(p.y_m) && std::isfinite(p.z_m) ? 0 : 1;
    bright += p.intensity >= 0 && p.intensity <= 1 ? 0 : 1;
    late += rate_hz > 0 && 1e-9 * p.time_offset_ns * rate_hz > 1 ? 1 : 0;
  }
  const auto find = [&](std::int64_t count, const char* what) {
    if (count > 0) {
      place.Find("scans.values", fmt::format("{} of {} points {}", count, points.size(), what));
    }
  };
  find(endless, "have coordinates that are not finite");
  find(bright, "have intensities beyond 0 to 1");
  find(late, "have times after the end of the revolution");
}

void CheckPointLabels(const ScanPlace& place, const std::vector<LidarPoint>& points) {
  LintJob* const job = place.job;
  job->Applies("scans.classes");
  job->Applies("scans.instances");
  std::map<std::pair<std::uint16_t, int>, std::int64_t> counts;
  for (const LidarPoint& p : points) ++counts[{p.instance, p.label}];
  for (const auto& [pair, count] : counts) {
    const auto& [instance, label] = pair;
    if (!job->HasClass(label)) {
      place.Find("scans.classes", fmt::format("{} points of class {}", count, label));
      continue;
    }
    const std::string name = job->ClassName(label);
    job->statistics().classes[name].points += count;
    const DatasetInfo::Instance* listed = job->InstanceOf(instance);
    if (instance == 0 || (listed != nullptr && listed->label == name)) continue;
    place.Find("scans.instances",
               listed == nullptr
                   ? fmt::format("{} points of instance {}", count, instance)
                   : fmt::format("{} points have class {} but instance {} ({}) of class {}", count,
                                 name, instance, listed->name, listed->label));
  }
}

void Tell(DatasetStatistics* statistics, const std::vector<LidarPoint>& points) {
  ++statistics->scans;
  statistics->points += static_cast<std::int64_t>(points.size());
  const double last = static_cast<double>(statistics->range_m.size() - 1);
  for (const LidarPoint& p : points) {
    const double range_m = Vec3(p.x_m, p.y_m, p.z_m).norm();
    if (!std::isfinite(range_m)) continue;
    ++statistics->range_m[static_cast<std::size_t>(std::min(range_m, last))];
  }
}

void CheckScan(const ScanPlace& place, double rate_hz) {
  std::error_code ignored;
  const fs::path path = place.job->Path(place.file);
  if (!fs::is_regular_file(path, ignored)) return;  // reported by files.missing
  place.job->Applies("scans.readable");
  std::vector<LidarPoint> points;
  try {
    points = ReadPcd(path);
  } catch (const InputError& e) {
    place.Find("scans.readable", e.what());
    return;
  }
  Tell(&place.job->statistics(), points);
  CheckValues(place, points, rate_hz);
  CheckPointLabels(place, points);
}

void CheckLidar(LintJob* job, const std::string& lidar) {
  const std::optional<SensorSheet> sheet = job->SheetOf(lidar);
  const std::vector<FrameRow> frames = FramesOf(*job, lidar);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i % static_cast<std::size_t>(job->options().every_frame) != 0) continue;
    CheckScan({job, lidar, FrameFile(lidar, kScanFolder, frames[i].t_ns)},
              sheet ? sheet->rate_hz : 0);
  }
}

}  // namespace

void CheckLidars(LintJob* job) {
  for (const std::string& lidar : job->recording().SensorsOf(ChannelForm::kScans)) {
    job->Try(lidar, [&] { CheckLidar(job, lidar); });
  }
}

}  // namespace tera
