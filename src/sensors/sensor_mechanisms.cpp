#include "sensors/sensor_mechanisms.h"

#include <algorithm>
#include <vector>

#include "core/check.h"
#include "sensors/sensor_kinds.h"
#include "sensors/slots/mechanism_rows.h"

namespace tera {
namespace {

/// Targets of all sensor kinds with one of these forms.
std::vector<EffectTarget> TargetsOf(const std::vector<ChannelForm>& forms) {
  std::vector<EffectTarget> targets;
  for (const SensorKind* kind : kSensorKinds) {
    for (const ChannelForm form : forms) {
      if (kind->form == form) targets.push_back(kind->target);
    }
  }
  return targets;
}

/// Extrinsics error, common to cameras and lidars.
Mechanism Extrinsic() {
  return {"extrinsic", Slot::kSensorGeometry,
          TargetsOf({ChannelForm::kPictures, ChannelForm::kScans}),
          Joined({ShiftParameters(), TurnParameters()})};
}

/// Timing errors: each measurement has one time stamp; row samples can pass a filter.
std::vector<Mechanism> Timing() {
  using enum ChannelForm;
  using enum Slot;
  const std::vector<EffectTarget> all = TargetsOf({kRows, kPictures, kScans});
  return {
      {"clock_offset", kSensorTiming, all, {{"offset_s", "s", -60, 60, {}}}},
      {"clock_drift", kSensorTiming, all, {{"drift_ppm", "ppm", -1e3, 1e3, {}}}},
      {"latency", kSensorTiming, all, {{"delay_s", "s", 0, 5, {}}, {"jitter_s", "s", 0, 1, 0}}},
      {"filter_delay", kSensorTiming, TargetsOf({kRows}), {{"time_constant_s", "s", 1e-4, 10, {}}}},
  };
}

std::vector<Mechanism> All() {
  std::vector<Mechanism> all = {Extrinsic()};
  for (const SensorKind* kind : kSensorKinds) {
    if (!kind->mechanisms) continue;
    for (Mechanism& mechanism : kind->mechanisms()) all.push_back(std::move(mechanism));
  }
  for (Mechanism& mechanism : Timing()) all.push_back(std::move(mechanism));
  return all;
}

}  // namespace

std::span<const Mechanism> SensorMechanisms() {
  static const std::vector<Mechanism> mechanisms = All();
  return mechanisms;
}

const Mechanism& SensorMechanism(std::string_view id, EffectTarget target) {
  const auto all = SensorMechanisms();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Mechanism& one) {
    return one.id == id && one.ActsOn(target);
  });
  TERA_CHECK(found != all.end(), id, target.name);
  return *found;
}

}  // namespace tera
