#include "diagnose/sensors/offset_receivers.h"

#include <algorithm>
#include <cmath>

#include "diagnose/blocks/sample_grid.h"
#include "diagnose/sensors/antenna_path.h"
#include "diagnose/sensors/sensor_parameters.h"
#include "diagnose/sensors/usable_fix.h"
#include "diagnose/statistics/series/robust.h"
#include "sensors/slots/effect_numbers.h"

namespace tera {
namespace {

constexpr double kEstimated_s = 0.5;  ///< the motion estimate finds delays up to this
constexpr double kAlpha = 0.01;       ///< level for all receivers together
/// Bounds of the motion of the fixes over that of the path: tracks slip, and wheels wear.
constexpr double kLeastLagShare = 0.5, kMostLagShare = 1.5;
constexpr const char* kClock = "clock_offset";
constexpr const char* kOffset = "offset_s";

/// Fixes as good as documented, at their stamps minus the documented delay. Empty where samples
/// come in bursts.
std::vector<PlanarFix> FixesOf(const SensorDescription& receiver,
                               const std::vector<GnssSample>& samples, TimeNs zero_ns) {
  const double late_s = DocumentedDelay_s(receiver.effects);
  const GnssFix documented = std::get<GnssModel>(receiver.model).fix;
  std::vector<PlanarFix> fixes;
  std::vector<TimeNs> t_ns;
  for (const GnssSample& sample : samples) {
    t_ns.push_back(sample.t_ns);
    if (!IsAsDocumented(sample.fix, documented)) continue;
    fixes.push_back(
        {ToSeconds(sample.t_ns - zero_ns) - late_s, {sample.enu_m.x(), sample.enu_m.y()}});
  }
  if (t_ns.size() < 2 || !ComeEvenly(t_ns)) return {};
  std::stable_sort(fixes.begin(), fixes.end(),
                   [](const PlanarFix& a, const PlanarFix& b) { return a.t_s < b.t_s; });
  return fixes;
}

bool IsOffset(const ReceiverLag& one, std::size_t receivers) {
  const PathLag& lag = one.lag;
  return lag.p * static_cast<double>(receivers) <= kAlpha && lag.share >= kLeastLagShare &&
         lag.share <= kMostLagShare && std::abs(lag.lag_s) - kOneSided95 * lag.sigma_s > one.near_s;
}

}  // namespace

std::vector<ReceiverLag> ReceiverLags(const DiagnosisInput& input, const Measurements& measured) {
  std::vector<ReceiverLag> lags;
  const ParameterTable table{.stated = input.tolerances};
  for (std::size_t s = 0; s < measured.gnss.size(); ++s) {
    if (measured.gnss[s].empty()) continue;
    const SensorDescription& receiver = input.sensors[s];
    const TimeNs zero_ns = measured.gnss[s].front().t_ns;
    const auto path = AntennaPath(input, measured, receiver, zero_ns);
    if (!path) continue;
    ReceiverLag one{.sensor = s};
    one.documented_s = NumberOf(receiver.effects, kClock, kOffset, 0);
    one.near_s = std::max(kEstimated_s, table.HalfWidthOf(receiver.name, kClock, kOffset));
    const auto lag = LagBehind(*path, FixesOf(receiver, measured.gnss[s], zero_ns), one.near_s);
    if (!lag) continue;
    one.lag = *lag;
    lags.push_back(one);
  }
  return lags;
}

std::vector<OffsetReceiver> OffsetReceiversOf(const DiagnosisInput& input,
                                              const Measurements& measured) {
  std::vector<OffsetReceiver> offset;
  const std::vector<ReceiverLag> lags = ReceiverLags(input, measured);
  for (const ReceiverLag& one : lags) {
    if (!IsOffset(one, lags.size())) continue;
    offset.push_back({.target = input.sensors[one.sensor].name,
                      .sensor = one.sensor,
                      .documented_s = one.documented_s,
                      .tolerance_s = one.near_s,
                      .shift_s = one.lag.lag_s,
                      .sigma_s = one.lag.sigma_s,
                      .p = std::min(1.0, one.lag.p * static_cast<double>(lags.size())),
                      .rms_before_m = one.lag.rms_before_m,
                      .rms_after_m = one.lag.rms_after_m});
  }
  return offset;
}

void StampAnew(const std::vector<OffsetReceiver>& offset, Measurements* measured) {
  for (const OffsetReceiver& one : offset) {
    const TimeNs shift_ns = FromSeconds(one.shift_s);
    for (GnssSample& sample : measured->gnss[one.sensor]) {
      sample.t_ns -= shift_ns;
      sample.t_available_ns -= shift_ns;
    }
  }
}

}  // namespace tera
