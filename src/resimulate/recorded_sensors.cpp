#include "resimulate/recorded_sensors.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace tera {
namespace {

constexpr std::size_t kMostScans = 60, kMostPictures = 40;

/// Up to `most` of the times within a range, evenly spread.
std::vector<TimeNs> Thinned(std::vector<TimeNs> times, TimeNs from_ns, TimeNs to_ns,
                            std::size_t most) {
  std::erase_if(times, [&](TimeNs t) { return t < from_ns || t > to_ns; });
  if (times.size() <= most) return times;
  std::vector<TimeNs> chosen;
  for (std::size_t k = 0; k < most; ++k) chosen.push_back(times[k * times.size() / most]);
  return chosen;
}

}  // namespace

bool MeasuresRanges(const SensorDescription& sensor) { return RangingOf(sensor).has_value(); }

bool TakesPictures(const SensorDescription& sensor) {
  const PictureContent* pictures = PicturesOf(sensor);
  return pictures && pictures->rgb && !MeasuresRanges(sensor);
}

std::vector<RecordedSensor> SeeingSensors(const Scenario& scenario,
                                          const std::vector<std::string>& names,
                                          const Recording& recording, const RecordedPart& part) {
  std::vector<RecordedSensor> sensors;
  for (std::size_t m = 0; m < names.size(); ++m) {
    for (const SensorDescription& description : scenario.machines[m].sensors) {
      const std::string channel = names[m] + "/" + description.name;
      const bool is_compared = MeasuresRanges(description) || TakesPictures(description);
      if (!is_compared || !recording.Has(channel)) continue;
      const std::vector<TimeNs> times = recording.FrameTimes(channel);
      if (times.empty()) continue;
      const TimeNs first_ns = times.front();
      RecordedSensor sensor{m, &description, channel, {}, ""};
      const std::optional<Ranging> ranging = RangingOf(description);
      const TimeNs span_ns = ranging ? ranging->span_ns : 0;
      const TimeNs to_ns =
          part.to_s < 1e9 ? first_ns + FromSeconds(part.to_s) : std::numeric_limits<TimeNs>::max();
      const TimeNs from_ns = first_ns + FromSeconds(part.from_s);
      const std::size_t most = TakesPictures(description) ? kMostPictures : kMostScans;
      for (const TimeNs t_ns : Thinned(times, from_ns, to_ns, most)) {
        sensor.scans.push_back({t_ns, span_ns, {}});
      }
      sensors.push_back(std::move(sensor));
    }
  }
  return sensors;
}

void WorkGround(RecordedStage* stage, std::vector<RecordedSensor>* sensors) {
  std::vector<ScanCaster::Scan*> scans;
  for (RecordedSensor& sensor : *sensors) {
    for (ScanCaster::Scan& scan : sensor.scans) scans.push_back(&scan);
  }
  const auto end_ns = [](const ScanCaster::Scan* scan) { return scan->t_ns + scan->span_ns; };
  std::stable_sort(scans.begin(), scans.end(),
                   [&](const auto* a, const auto* b) { return end_ns(a) < end_ns(b); });
  for (ScanCaster::Scan* scan : scans) scan->moment = stage->AdvanceTo(end_ns(scan));
}

std::string ObstacleTo(const RecordedSensor& sensor, const RecordedMotion& motion,
                       const MachineModel& model) {
  if (!motion.obstacle().empty()) return motion.obstacle();
  if (!motion.Carries(model.LinkIndex(sensor.description->link))) {
    return fmt::format("a joint between the base and its link {} has no encoder",
                       sensor.description->link);
  }
  return "";
}

}  // namespace tera
