#include "sensors/sensor.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/config/config_faults.h"
#include "core/config/plain_name.h"
#include "core/types/mounting.h"
#include "sensors/slots/true_mount.h"

namespace tera {
namespace {

/// Exceeds the rate of any real sensor and keeps the period far above a nanosecond.
constexpr double kFastest_hz = 1e5;

/// Reads the name of a sensor kind.
template <std::size_t... kinds>
std::string ReadType(const ConfigMap& config, std::index_sequence<kinds...>) {
  return ChoiceOfKeys(config, "type", {kSensorKinds[kinds]->name...});
}

}  // namespace

std::string TypeOf(const SensorDescription& sensor) { return std::string(KindOf(sensor).name); }

SensorDescription ReadSensor(const ConfigMap& config) {
  SensorDescription s;
  s.name = config.Text("name");
  RequirePlainName(config, "name", s.name);
  config.ApplyPreset("preset");
  const std::string type = ReadType(config, std::make_index_sequence<kSensorKinds.size()>());
  if (IsUnread(config)) return s;
  const SensorKind& kind = **std::find_if(kSensorKinds.begin(), kSensorKinds.end(),
                                          [&](const SensorKind* k) { return k->name == type; });
  if (kind.on_link) {
    s.link = config.Text("link");
    s.X_BS = config.PoseXyzRpy();
  }
  s.clock.rate_hz = config.Number("rate_hz", {.min = kind.slowest_hz,
                                              .max = kFastest_hz,
                                              .min_excluded = kind.slowest_hz == 0,
                                              .unit = "Hz"});
  s.latency_ns = FromSeconds(config.Number("latency_s", AtLeast(0, "s"), 0));
  s.cost = config.OptionalNumber("cost", AtLeast(0, "")).value_or(s.cost);
  s.power_w = config.OptionalNumber("power_w", AtLeast(0, "W")).value_or(s.power_w);
  kind.read(config, &s);
  return s;
}

Mounting TrueMounting(const SensorDescription& sensor,
                      const std::vector<SensorDescription>& sensors) {
  const SensorKind& kind = KindOf(sensor);
  if (kind.true_mounting) return kind.true_mounting(sensor, sensors);
  return {sensor.link, TrueMount(sensor.X_BS, sensor.effects)};
}

std::string SensorYaml(const SensorDescription& sensor) {
  std::string text = fmt::format("type: {}\nname: {}\n", TypeOf(sensor), sensor.name);
  if (!sensor.link.empty()) text += MountingYaml(sensor.link, sensor.X_BS);
  text += fmt::format("rate_hz: {}\nlatency_s: {:.12g}\nmodel:\n", sensor.clock.rate_hz,
                      ToSeconds(sensor.latency_ns));
  return text + KindOf(sensor).model_yaml(sensor);
}

const PictureContent* PicturesOf(const SensorDescription& sensor) {
  const SensorKind& kind = KindOf(sensor);
  return kind.pictures ? kind.pictures(sensor) : nullptr;
}

std::optional<Ranging> RangingOf(const SensorDescription& sensor) {
  const SensorKind& kind = KindOf(sensor);
  return kind.ranging ? kind.ranging(sensor) : std::nullopt;
}

std::optional<ViewField> ViewOf(const SensorDescription& sensor) {
  const SensorKind& kind = KindOf(sensor);
  if (!kind.view) return std::nullopt;
  return kind.view(sensor);
}

std::vector<std::string> ColumnsOf(const SensorDescription& sensor, const MachineModel& machine) {
  const SensorKind& kind = KindOf(sensor);
  return kind.columns ? kind.columns(sensor, machine) : std::vector<std::string>{};
}

}  // namespace tera
