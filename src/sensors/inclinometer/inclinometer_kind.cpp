#include "core/units.h"
#include "sensors/sensor.h"
#include "sensors/slots/mechanism_rows.h"
#include "sensors/slots/row_slots.h"

// Inclinometer as a sensor kind.

namespace tera {
namespace {

class InclinometerSampler : public SensorSampler {
 public:
  explicit InclinometerSampler(const SensorPlace& place)
      : InclinometerSampler(place, TrueMounting(place.sensor, place.rig)) {}

  /// The first sample comes at the end of the first interval.
  void SampleStart(const SensedStep&) override {}

  void Sample(const SensedStep& step) override {
    const Vec3 gravity_W_mps2(0, 0, -kStandardGravity_mps2);
    motion_.clear();
    elements_.Advance(step.t0_ns, step.before.links[link_], step.t1_ns, step.after.links[link_],
                      gravity_W_mps2, &motion_);
    for (const ImuSample& motion : motion_) {
      RowSample row = RowOf(inclinometer_.Measure(motion));
      slots_.Apply(&row);
      output_.sink->Write(output_.channel, std::move(row));
    }
  }

  /// Writes the samples of the last step, which wait for its successor.
  void Finish(const SensedStep& step) override { Sample(step); }

 private:
  InclinometerSampler(const SensorPlace& place, const Mounting& mount)
      : elements_({}, mount.X_BT, place.sensor.clock, place.sensor.latency_ns, place.seed,
                  place.folder),
        inclinometer_(std::get<InclinometerModel>(place.sensor.model), place.seed, place.folder),
        slots_(place.sensor.effects, place.seed, place.folder),
        link_(place.machine.LinkIndex(mount.link)),
        output_(place.output) {}

  Imu elements_;  ///< error-free
  Inclinometer inclinometer_;
  RowSlots slots_;
  int link_;
  SensorOutput output_;
  std::vector<ImuSample> motion_;
};

}  // namespace

constinit const SensorKind kInclinometerKind = {
    .name = "inclinometer",
    .target = kInclinometerTarget,
    .read = ReadModelOf<InclinometerModel>,
    .model_yaml = YamlOfModel<InclinometerModel>,
    .columns = [](const SensorDescription&, const MachineModel&) { return InclinometerColumns(); },
    .sampler = [](const SensorPlace& place) -> std::unique_ptr<SensorSampler> {
      return std::make_unique<InclinometerSampler>(place);
    },
    .mechanisms =
        [] {
          return std::vector<Mechanism>{
              {"mount_rotation", Slot::kSensorGeometry, {kInclinometerTarget}, TurnParameters()}};
        },
};

}  // namespace tera
