#include <fmt/format.h>

#include <optional>

#include "core/types/sample_rows.h"
#include "sensors/gnss/antenna_pair.h"
#include "sensors/gnss/gnss_reflector.h"
#include "sensors/gnss/gnss_slots.h"
#include "sensors/sensor.h"
#include "sensors/slots/mechanism_rows.h"
#include "sensors/slots/true_mount.h"

namespace tera {
namespace {

class GnssSampler : public InstantSampler {
 public:
  explicit GnssSampler(const SensorPlace& place)
      : InstantSampler(place.sensor.clock),
        gnss_(std::get<GnssModel>(place.sensor.model), place.sensor.clock, place.sensor.latency_ns,
              place.seed, place.folder),
        slots_(place.sensor.effects, place.seed, place.folder),
        output_(place.output) {
    const Mounting mount = TrueMounting(place.sensor, place.rig);
    link_ = place.machine.LinkIndex(mount.link);
    X_BT_ = mount.X_BT;
    reflector_ = GnssReflectorOf(place.machine, link_);
  }

 private:
  void MeasureAt(std::int64_t k, TimeNs t_ns, const SensedStep& step) override {
    const double s = step.FractionAt(t_ns);
    GnssSample sample = gnss_.Measure(k, step.LinkAt(link_, s) * X_BT_.translation(), step.site);
    slots_.Apply(BoomAt(step, s), step.site, &sample);
    output_.sink->Write(output_.channel, RowOf(sample));
  }

  /// Direction of the reflecting part near the antenna.
  RaisedBoom BoomAt(const SensedStep& step, double s) const {
    if (!reflector_) return {};
    return {step.LinkAt(reflector_->link, s).linear() * reflector_->direction_B};
  }

  Gnss gnss_;
  GnssSlots slots_;
  int link_ = 0;
  Pose X_BT_;  ///< true mounting
  std::optional<GnssReflector> reflector_;
  SensorOutput output_;
};

std::vector<Mechanism> GnssMechanisms() {
  using enum Slot;
  const std::vector<EffectTarget> gnss = {EffectTarget::kGnss};
  return {
      {"gnss_lever_arm", kSensorGeometry, gnss, ShiftParameters()},
      {"antenna_swap", kSensorGeometry, gnss, {}},
      {"antenna_yaw", kSensorGeometry, gnss, {{"yaw_deg", "deg", -180, 180, {}}}},
      {"quantisation", kSensorStatic, gnss,
       Alike({"horizontal_step_m", "vertical_step_m"}, "m", 0, 10, 0)},
      {"outliers", kSensorStatic, gnss,
       Joined({ProbabilityParameter(),
               {{"horizontal_m", "m", 0, 1e3, 5}, {"vertical_m", "m", 0, 1e3, 10}}})},
      // EGM96 lies 107 m below to 85 m above the ellipsoid.
      {"height_datum", kSensorStatic, gnss, {{"offset_m", "m", -120, 120, {}}}},
      {"position_datum", kSensorStatic, gnss, Alike({"east_m", "north_m"}, "m", -1e3, 1e3, 0)},
      {"float_jump",
       kSensorStatic,
       gnss,
       {{"interval_s", "s", 0.1, 1e5, 60},
        {"duration_s", "s", 0.1, 1e4, 10},
        {"horizontal_m", "m", 0, 10, 0.3},
        {"vertical_m", "m", 0, 10, 0.5}}},
      {"multipath",
       kSensorStatic,
       gnss,
       {{"horizontal_m", "m", 0, 5, 0.02},
        {"vertical_m", "m", 0, 5, 0.05},
        {"azimuth_deg", "deg", -180, 180, 0}}},
  };
}

/// Reports effects that need a second antenna, and conflicts between the two antennas.
void CheckPair(const ConfigMap& config, const SensorDescription& antenna, const SensorList& rig) {
  const SensorDescription* other = OtherAntenna(antenna, rig);
  for (const std::string_view id : {"antenna_swap", "antenna_yaw"}) {
    if (!FindEffect(antenna.effects, id)) continue;
    if (!other) {
      config.Fault(id,
                   fmt::format("'{}' acts on a pair; need exactly two gnss on this machine", id));
    } else if (FindEffect(other->effects, id)) {
      config.Fault(
          id, fmt::format("acts on both antennas and stands at '{}' too; keep one", other->name));
    }
  }
  if (other && FindEffect(antenna.effects, "antenna_yaw") && other->link != antenna.link) {
    config.Fault("antenna_yaw", fmt::format("turns two antennas on one link, but '{}' is on '{}' "
                                            "and '{}' on '{}'; need both on one link",
                                            antenna.name, antenna.link, other->name, other->link));
  }
}

void CheckGnssEffects(const ConfigMap& effects, const MachineModel& model,
                      const SensorDescription& gnss, const SensorList& rig) {
  if (gnss.effects.empty()) return;
  const ConfigMap config = effects.Map(gnss.name);
  CheckPair(config, gnss, rig);
  const int link = model.LinkIndex(gnss.link);
  if (FindEffect(gnss.effects, "multipath") && link >= 0 && !GnssReflectorOf(model, link)) {
    config.Fault(
        "multipath",
        fmt::format("comes from a part that a joint raises, a boom or a lift arm, but none "
                    "is beyond link '{}' or those below it; need such a joint",
                    gnss.link));
  }
  const GnssFix fix = std::get<GnssModel>(gnss.model).fix;
  for (const Effect& effect : gnss.effects) {
    const Mechanism& mechanism = *effect.mechanism;
    const bool of_time = mechanism.slot == Slot::kSensorTiming && mechanism.id != "filter_delay";
    if (fix == GnssFix::kNone && !of_time) {
      config.Fault(mechanism.id,
                   "changes positions, of which a receiver with fix: none gives "
                   "none; need another fix");
    } else if (fix != GnssFix::kRtkFixed && mechanism.id == "float_jump") {
      config.Fault("float_jump", fmt::format("loses a fixed solution, but this receiver has {}; "
                                             "need fix: rtk_fixed",
                                             NameOf(fix)));
    }
  }
}

Mounting TrueGnssMounting(const SensorDescription& sensor, const SensorList& rig) {
  const auto antenna = [](const SensorDescription& s) {
    return Antenna{s.link, s.X_BS, s.effects};
  };
  const SensorDescription* other = OtherAntenna(sensor, rig);
  if (!other) return {sensor.link, TrueMount(sensor.X_BS, sensor.effects)};
  const AntennaPlace place = TrueAntenna(antenna(sensor), antenna(*other));
  return {place.link, place.X_BT};
}

}  // namespace

constinit const SensorKind kGnssKind = {
    .name = kGnssChannel,
    .target = EffectTarget::kGnss,
    .read = ReadModelOf<GnssModel>,
    .model_yaml = YamlOfModel<GnssModel>,
    .columns = [](const SensorDescription&, const MachineModel&) { return GnssColumns(); },
    .sampler = [](const SensorPlace& place) -> std::unique_ptr<SensorSampler> {
      return std::make_unique<GnssSampler>(place);
    },
    .mechanisms = GnssMechanisms,
    .check_effects = CheckGnssEffects,
    .true_mounting = TrueGnssMounting,
};

}  // namespace tera
