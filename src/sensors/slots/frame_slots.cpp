#include "sensors/slots/frame_slots.h"

#include "sensors/slots/report_clock.h"

namespace tera {

FrameSlots::FrameSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
    : errors_(effects, seed, stream_name), clock_(effects, seed, stream_name) {}

ReportClock::Times FrameSlots::Stamp(std::int64_t k, TimeNs t_ns) { return clock_.Next(k, t_ns); }

void FrameSlots::Apply(std::int64_t k, const ReportClock::Times& times, LidarScan* scan) const {
  errors_.Apply(k, scan);
  for (LidarPoint& point : scan->points) {
    point.time_offset_ns = static_cast<std::uint32_t>(clock_.Duration(point.time_offset_ns));
  }
  Restamp(times, scan);
}

void FrameSlots::Apply(std::int64_t k, const ReportClock::Times& times, CameraFrame* frame) const {
  errors_.Apply(k, frame);
  Restamp(times, frame);
}

}  // namespace tera
