#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/check.h"
#include "dataset/format/site_frame.h"
#include "sensors/sensor.h"

// A sensor of any row kind, running on a link with a given motion.

namespace tera::testing {

/// Keeps the rows of one channel.
class RowKeeper : public MeasurementSink {
 public:
  ChannelId AddChannel(const ChannelInfo&) override { return 0; }
  void Write(ChannelId, Measurement measurement) override {
    rows.push_back(std::get<RowSample>(std::move(measurement)));
  }
  bool NeedsFrame(ChannelId, TimeNs, TimeNs) const override { return true; }
  void MarkPresent(ChannelId, TimeNs) override {}

  std::vector<RowSample> rows;
};

/// An empty scene.
class NoScene : public SensedScene {
 public:
  const TerrainSurface& ground() const override { return ground_; }
  Shapes ShapesNow() const override { return {}; }
  std::vector<Pose> BodiesBetween(double) const override { return {}; }
  std::vector<Pose> BodiesAt(TimeNs) const override { return {}; }
  RasterizerPool* rasterizers() const override { return nullptr; }
  RayScene* ray_scene() const override { return nullptr; }
  int threads() const override { return 1; }

 private:
  TerrainSurface ground_;
};

/// Rows of a sensor on the link "upper" while the link moves for `duration_s` along `motion`, a
/// function of time in s.
inline std::vector<RowSample> RowsOf(const SensorDescription& sensor,
                                     const std::function<BodyState(double)>& motion,
                                     double duration_s) {
  const SampleClock steps{.rate_hz = 1000};
  MachineModel machine;
  machine.links.emplace_back();
  machine.links.back().name = "upper";
  RowKeeper sink;
  const std::unique_ptr<SensorSampler> sampler =
      KindOf(sensor).sampler({sensor, {sensor}, machine, "m/" + sensor.name, 1, {&sink, 0}});
  const SiteFrame site(46.78, -71.27, 90);
  const NoScene scene;
  const auto state_at = [&](std::int64_t k) {
    MachineState state;
    state.links = {motion(ToSeconds(steps.Due(k)))};
    return state;
  };
  MachineState before = state_at(0);
  sampler->SampleStart({0, 0, before, before, site, scene});
  const auto count = static_cast<std::int64_t>(duration_s * steps.rate_hz);
  for (std::int64_t k = 1; k <= count; ++k) {
    const MachineState after = state_at(k);
    const SensedStep step{steps.Due(k - 1), steps.Due(k), before, after, site, scene};
    sampler->Sample(step);
    before = after;
  }
  const MachineState beyond = state_at(count + 1);
  sampler->Finish({steps.Due(count), steps.Due(count + 1), before, beyond, site, scene});
  return sink.rows;
}

/// A sensor by its keys, "type: imu, link: upper, rate_hz: 100".
inline SensorDescription SensorOf(const std::string& keys) {
  const Config config = Config::FromText("sensor: {name: s, " + keys + "}", "rig.yaml");
  const SensorDescription sensor = ReadSensor(config.root().Map("sensor"));
  config.Finish();
  return sensor;
}

}  // namespace tera::testing
