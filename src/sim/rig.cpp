#include "sim/rig.h"

#include <algorithm>

#include "core/stopwatch.h"
#include "sensors/sensor.h"

namespace tera {

Rig::Rig(const Scenario& scenario, const SceneAssembly& assembly, const EglOptions& egl,
         int threads, MeasurementSink* sink)
    : site_(scenario.origin.lat_deg, scenario.origin.lon_deg, scenario.origin.height_m),
      scene_(assembly, threads) {
  for (std::size_t m = 0; m < scenario.machines.size(); ++m) {
    const MachinePlacement& placement = scenario.machines[m].placement;
    for (const SensorDescription& sensor : scenario.machines[m].sensors) {
      const SensorKind& kind = KindOf(sensor);
      const std::string folder = placement.name + "/" + sensor.name;
      const ChannelId channel =
          sink->AddChannel({folder, std::string(kind.name), kind.form, SensorYaml(sensor),
                            ColumnsOf(sensor, placement.model)});
      const SensorPlace place{sensor,          scenario.machines[m].sensors,
                              placement.model, folder,
                              scenario.seed,   {sink, channel}};
      units_.push_back({m, kind.form, kind.sampler(place)});
    }
  }
  if (Has(ChannelForm::kPictures) || Has(ChannelForm::kScans)) scene_.FollowAir(scenario);
  if (Has(ChannelForm::kPictures)) scene_.OpenRasterizers(egl, sink->AcceptsOutOfOrderFrames());
  if (std::any_of(units_.begin(), units_.end(),
                  [](const Unit& unit) { return unit.sampler->LooksBack(); })) {
    scene_.KeepPast();
  }
}

double Rig::camera_wall_s() const { return scene_.busy_s(); }

bool Rig::Has(ChannelForm form) const {
  return std::any_of(units_.begin(), units_.end(),
                     [&](const Unit& unit) { return unit.form == form; });
}

void Rig::SampleStart(const Instant& now, const TerrainSurface& ground) {
  SampleWithScene(&SensorSampler::SampleStart, {now, now, ground});
}

void Rig::Sample(const WorldStep& step) { SampleWithScene(&SensorSampler::Sample, step); }

void Rig::Finish(const WorldStep& step) { ForEach(&SensorSampler::Finish, step); }

void Rig::SampleWithScene(SamplerStep what, const WorldStep& step) {
  {
    const Stopwatch watch(WallOf(ChannelForm::kScans));
    scene_.Advance(step);
  }
  ForEach(what, step);
  TimeNs oldest_ns = step.after.t_ns;
  for (const Unit& unit : units_) {
    oldest_ns = std::min(oldest_ns, unit.sampler->SceneNeededSince(step.after.t_ns));
  }
  scene_.ForgetBefore(oldest_ns);
}

void Rig::ForEach(SamplerStep what, const WorldStep& step) {
  for (Unit& unit : units_) {
    const Stopwatch watch(WallOf(unit.form));
    const SensedStep sensed{step.before.t_ns,
                            step.after.t_ns,
                            step.before.machines[unit.machine],
                            step.after.machines[unit.machine],
                            site_,
                            scene_};
    (unit.sampler.get()->*what)(sensed);
  }
}

}  // namespace tera
