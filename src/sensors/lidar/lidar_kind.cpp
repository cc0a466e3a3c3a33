#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sensors/lidar/lidar_view.h"
#include "sensors/sensor.h"
#include "sensors/slots/frame_slots.h"
#include "sensors/slots/mechanism_rows.h"

// Lidar as a sensor kind.

namespace tera {
namespace {

/// Traces each revolution at its end, over the ground at that time.
class LidarSampler : public SensorSampler {
 public:
  explicit LidarSampler(const SensorPlace& place)
      : lidar_(std::get<LidarModel>(place.sensor.model), place.sensor.clock,
               place.sensor.latency_ns, place.seed, place.folder),
        slots_(place.sensor.effects, place.seed, place.folder),
        clock_(place.sensor.clock),
        output_(place.output) {
    const Mounting mount = TrueMounting(place.sensor, place.rig);
    link_ = place.machine.LinkIndex(mount.link);
    X_BT_ = mount.X_BT;
  }

  void Sample(const SensedStep& step) override {
    X_WS_.Append(step.t1_ns, step.after.links[link_].X_WB * X_BT_);
    for (; clock_.Due(next_ + 1) <= step.t1_ns; ++next_) Revolve(step.scene);
    X_WS_.DropBefore(clock_.Due(next_));
  }

  bool LooksBack() const override { return true; }
  TimeNs SceneNeededSince(TimeNs) const override { return clock_.Due(next_); }

 private:
  void Revolve(const SensedScene& scene) {
    const TimeNs start_ns = clock_.Due(next_), end_ns = clock_.Due(next_ + 1);
    const ReportClock::Times times = slots_.Stamp(next_, start_ns);
    if (!output_.sink->NeedsFrame(output_.channel, times.t_ns, clock_.Due(next_ + 2))) {
      output_.sink->MarkPresent(output_.channel, times.t_ns);
      return;
    }
    std::vector<std::vector<Pose>> poses;
    for (int k = 0; k < Lidar::kScenePoses; ++k) {
      poses.push_back(
          scene.BodiesAt(start_ns + (end_ns - start_ns) * k / (Lidar::kScenePoses - 1)));
    }
    scene.ray_scene()->Update(poses, scene.ground(), scene.ShapesNow());
    LidarScan scan = lidar_.Measure(next_, X_WS_, *scene.ray_scene(), scene.threads(), scene.air());
    slots_.Apply(next_, times, &scan);
    output_.sink->Write(output_.channel, std::move(scan));
  }

  Lidar lidar_;
  FrameSlots slots_;
  SampleClock clock_;
  int link_ = 0;
  Pose X_BT_;  ///< true mounting
  SensorOutput output_;
  PoseTrack X_WS_;
  std::int64_t next_ = 0;
};

std::vector<Mechanism> LidarMechanisms() {
  using enum Slot;
  const std::vector<EffectTarget> lidar = {EffectTarget::kLidar};
  return {
      {"range_bias", kSensorStatic, lidar, {{"range_m", "m", -5, 5, {}}}},
      {"scale", kSensorStatic, lidar, {{"range_factor", "1", 0.5, 2, {}}}},
      {"quantisation", kSensorStatic, lidar, {{"range_step_m", "m", 0, 1, 0.004}}},
      {"outliers", kSensorStatic, lidar,
       Joined({ProbabilityParameter(), {{"range_m", "m", 0, 100, 5}}})},
      {"temperature_drift", kSensorStatic, lidar,
       Joined({WarmUpParameters(), {{"range_mpk", "m/K", -0.01, 0.01, {}}}})},
  };
}

constexpr int kMostPulsesPerScan = 1'000'000;

/// Pulses of a pattern per scan, a whole number.
int PulsesPerScan(const ConfigMap& config, const ScanPattern& pattern, const SampleClock& clock) {
  const double pulses = pattern.pulses_per_s / clock.rate_hz;
  const double whole = std::clamp<double>(std::round(pulses), 1, kMostPulsesPerScan);
  constexpr double kRounding = 1e-6;
  if (std::abs(pulses - whole) > kRounding) {
    config.Fault(
        "pattern",
        fmt::format("{:.12g} pulses a scan at rate_hz {}; need a whole number from 1 to {}, "
                    "such as pulses_per_s: {:.12g}",
                    pulses, clock.rate_hz, kMostPulsesPerScan, whole * clock.rate_hz));
  }
  return static_cast<int>(whole);
}

void CheckFirings(const ConfigMap& config, const LidarModel& lidar, const SampleClock& clock) {
  const double column_s = 1.0 / (clock.rate_hz * lidar.columns);
  const double last_s =
      *std::max_element(lidar.firing_offset_s.begin(), lidar.firing_offset_s.end());
  if (last_s < column_s) return;
  config.Fault("firing_offset_us",
               fmt::format("last firing at {} us but a column at rate_hz {} with {} columns lasts "
                           "{} us; need a shorter offset, fewer columns or a lower rate",
                           last_s * 1e6, clock.rate_hz, lidar.columns, column_s * 1e6));
}

void ReadLidar(const ConfigMap& config, SensorDescription* sensor) {
  auto model = ReadModel<LidarModel>(config);
  if (model.pattern) model.columns = PulsesPerScan(config, *model.pattern, sensor->clock);
  CheckFirings(config, model, sensor->clock);
  sensor->model = model;
}

/// Points of the scan beyond the minimum range. An odd stride ensures that an even number of beams
/// all contribute.
LoadedScan ScanPointsOf(const SensorDescription& sensor, const Measurement& recorded,
                        std::size_t most) {
  const auto& model = std::get<LidarModel>(sensor.model);
  const auto& scan = std::get<LidarScan>(recorded);
  const std::size_t stride = scan.points.size() / most + 1;
  LoadedScan loaded{{scan.t_ns, {}}, ""};
  for (std::size_t i = 0; i < scan.points.size(); i += stride | 1) {
    const LidarPoint& point = scan.points[i];
    if (point.ring >= model.elevation_rad.size()) {
      loaded.obstacle = fmt::format(
          "a point of its scan {} is of ring {}, but the scenario's lidar has "
          "{} beams; need the lidar that was recorded",
          scan.t_ns, point.ring, model.elevation_rad.size());
    }
    const Vec3 p_S_m(point.x_m, point.y_m, point.z_m);
    if (p_S_m.norm() < model.min_range_m) continue;
    loaded.scan.points.push_back(
        {p_S_m, static_cast<TimeNs>(point.time_offset_ns), model.range_noise_m});
  }
  return loaded;
}

std::optional<Ranging> LidarRanging(const SensorDescription& sensor) {
  const auto& lidar = std::get<LidarModel>(sensor.model);
  return Ranging{.min_range_m = lidar.min_range_m,
                 .max_range_m = lidar.max_range_m,
                 .span_ns = sensor.clock.Period(),
                 .scene_poses = Lidar::kScenePoses,
                 .points = ScanPointsOf};
}

ScanContent LidarScans(const SensorDescription& sensor) {
  const auto& lidar = std::get<LidarModel>(sensor.model);
  return {static_cast<int>(lidar.elevation_rad.size()), lidar.columns,
          lidar.beam ? lidar.beam->returns : 1};
}

}  // namespace

constinit const SensorKind kLidarKind = {
    .name = kLidarChannel,
    .target = EffectTarget::kLidar,
    .form = ChannelForm::kScans,
    .slowest_hz = Lidar::kSlowest_hz,
    .read = ReadLidar,
    .model_yaml = YamlOfModel<LidarModel>,
    .scans = LidarScans,
    .ranging = LidarRanging,
    .view =
        [](const SensorDescription& s) {
          return ViewOf(std::get<LidarModel>(s.model), s.clock.rate_hz);
        },
    .sampler = [](const SensorPlace& place) -> std::unique_ptr<SensorSampler> {
      return std::make_unique<LidarSampler>(place);
    },
    .mechanisms = LidarMechanisms,
};

}  // namespace tera
