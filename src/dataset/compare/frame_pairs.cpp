#include "dataset/compare/frame_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/quantile.h"
#include "core/units.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {
namespace {

constexpr std::size_t kWorstFrames = 4;
constexpr double kSameMount_m = 0.001, kSameMount_rad = 0.1 * kDeg;

std::vector<FramePair> PairFrames(const std::vector<TimeNs>& a_ns, const std::vector<TimeNs>& b_ns,
                                  TimeNs shift_ns, std::size_t every) {
  std::vector<TimeNs> intervals_ns;
  for (std::size_t k = 1; k < a_ns.size(); ++k) intervals_ns.push_back(a_ns[k] - a_ns[k - 1]);
  const TimeNs reach_ns = (intervals_ns.empty() ? kNsPerSecond : Median(intervals_ns)) / 2;
  std::vector<FramePair> pairs;
  std::size_t next = 0, found = 0;
  for (const TimeNs t_ns : a_ns) {
    const auto away_ns = [&](std::size_t k) { return std::abs(b_ns[k] + shift_ns - t_ns); };
    while (next + 1 < b_ns.size() && away_ns(next + 1) <= away_ns(next)) ++next;
    if (next >= b_ns.size() || away_ns(next) > reach_ns) continue;
    if (found++ % every == 0) pairs.push_back({t_ns, b_ns[next]});
  }
  return pairs;
}

std::string MountRemark(const Recording& a, const SensorInBoth& both, const Recording& b) {
  const SensorSheet sheet_a = ReadSensorSheet(a.directory() / both.folder_a);
  const SensorSheet sheet_b = ReadSensorSheet(b.directory() / both.folder_b);
  if (!sheet_a.X_PS || !sheet_b.X_PS) return "";
  const Pose X_AB = sheet_a.X_PS->inverse() * *sheet_b.X_PS;
  const double away_m = X_AB.translation().norm();
  const double turn_rad = Eigen::AngleAxisd(X_AB.rotation()).angle();
  if (away_m < kSameMount_m && turn_rad < kSameMount_rad) return "";
  return fmt::format(
      "its mounts differ by {:.3f} m and {:.2f} deg, so its views differ too; simulate it with the "
      "mount of the reference",
      away_m, turn_rad / kDeg);
}

}  // namespace

std::vector<SensorInBoth> SensorsInBoth(const RecordedMachine& a, const RecordedMachine& b,
                                        ChannelForm form, std::size_t every) {
  const std::string prefix = a.name + "/";
  std::vector<SensorInBoth> sensors;
  for (const std::string& folder : a.recording->SensorsOf(form)) {
    if (!folder.starts_with(prefix)) continue;
    SensorInBoth both{.name = folder.substr(prefix.size()), .folder_a = folder};
    both.folder_b = b.name + "/" + both.name;
    const bool is_in_b = b.recording->Has(both.folder_b) &&
                         b.recording->TypeOf(both.folder_b) == a.recording->TypeOf(folder);
    if (!is_in_b) continue;
    const std::vector<TimeNs> a_ns = a.recording->FrameTimes(folder);
    const std::vector<TimeNs> b_ns = b.recording->FrameTimes(both.folder_b);
    both.frames_a = a_ns.size();
    both.frames_b = b_ns.size();
    both.pairs = PairFrames(a_ns, b_ns, b.shift_ns - a.shift_ns, every);
    both.remark = MountRemark(*a.recording, both, *b.recording);
    sensors.push_back(std::move(both));
  }
  return sensors;
}

void KeepWorst(const WorstFrame& frame, std::vector<WorstFrame>* worst) {
  const auto place = std::find_if(worst->begin(), worst->end(), [&](const WorstFrame& other) {
    return frame.difference > other.difference;
  });
  worst->insert(place, frame);
  if (worst->size() > kWorstFrames) worst->pop_back();
}

}  // namespace tera
