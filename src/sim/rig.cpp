#include "sim/rig.h"

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "core/stopwatch.h"
#include "core/types/sample_rows.h"
#include "core/units.h"

namespace tera {
namespace {

/// Fraction of the way from `before` to `after` at `t_ns`.
double FractionAt(const WorldState& before, const WorldState& after, TimeNs t_ns) {
  if (after.t_ns == before.t_ns) return 1.0;
  return std::clamp(
      static_cast<double>(t_ns - before.t_ns) / static_cast<double>(after.t_ns - before.t_ns), 0.0,
      1.0);
}

double Mix(double a, double b, double s) { return a + (b - a) * s; }

/// Where the part beside an antenna points between two states.
RaisedBoom BoomAt(const MachineState& a, const MachineState& b,
                  const std::optional<GnssReflector>& reflector, double s) {
  if (!reflector) return {};
  const Pose X_WB = Interpolate(a.links[reflector->link].X_WB, b.links[reflector->link].X_WB, s);
  return {X_WB.linear() * reflector->direction_B};
}

}  // namespace

EncodedAxes AxesOf(const EncoderModel& encoder, const MachineModel& machine) {
  EncodedAxes axes;
  if (encoder.joints.empty()) {
    for (std::size_t j = 0; j < machine.joints.size(); ++j) {
      if (machine.joints[j].type != JointType::kFixed) axes.joints.push_back(static_cast<int>(j));
    }
  }
  for (const std::string& name : encoder.joints) {
    const auto& gears = machine.ground_tools.gears;
    const auto gear = std::find_if(gears.begin(), gears.end(),
                                   [&](const RunningGear& g) { return g.name == name; });
    if (const int joint = machine.JointIndex(name); joint >= 0) {
      axes.joints.push_back(joint);
    } else if (gear != gears.end()) {
      axes.gears.push_back(static_cast<int>(gear - gears.begin()));
    } else {
      axes.unknown.push_back(name);
    }
  }
  return axes;
}

std::vector<EncoderAxis> NamesOf(const EncodedAxes& axes, const MachineModel& machine) {
  std::vector<EncoderAxis> names;
  for (const int j : axes.joints) {
    names.push_back({machine.joints[j].name, machine.joints[j].type == JointType::kPrismatic});
  }
  for (const int g : axes.gears) names.push_back({machine.ground_tools.gears[g].name});
  return names;
}

Rig::Rig(const Scenario& scenario, const SceneAssembly& assembly, const EglOptions& egl,
         int threads, MeasurementSink* sink)
    : seed_(scenario.seed),
      threads_(threads),
      sink_(sink),
      site_(scenario.origin.lat_deg, scenario.origin.lon_deg, scenario.origin.height_m),
      assembly_(assembly) {
  for (std::size_t m = 0; m < scenario.machines.size(); ++m) {
    for (const SensorDescription& sensor : scenario.machines[m].sensors) Add(scenario, m, sensor);
  }
  if (!cameras_.empty()) rasterizer_ = std::make_unique<Rasterizer>(assembly_.model(), egl);
  if (!lidars_.empty()) ray_scene_ = std::make_unique<RayScene>(assembly_.model());
}

Rig::~Rig() = default;

void Rig::Add(const Scenario& scenario, std::size_t machine, const SensorDescription& sensor) {
  const MachinePlacement& placement = scenario.machines[machine].placement;
  const MachineModel& model = placement.model;
  const std::string folder = placement.name + "/" + sensor.name;
  const std::string yaml = SensorYaml(sensor);
  const Mounting mount = TrueMounting(sensor, scenario.machines[machine].sensors);
  const int link = model.LinkIndex(mount.link);
  if (const auto* imu = std::get_if<ImuModel>(&sensor.model)) {
    imus_.push_back({Imu(*imu, mount.X_BT, sensor.clock, sensor.latency_ns, seed_, folder),
                     ImuSlots(sensor.effects, seed_, folder), machine, link,
                     sink_->AddChannel(ImuChannel(folder, yaml))});
  } else if (const auto* gnss = std::get_if<GnssModel>(&sensor.model)) {
    gnss_.push_back({Gnss(*gnss, sensor.clock, sensor.latency_ns, seed_, folder),
                     GnssSlots(sensor.effects, seed_, folder), sensor.clock, machine, link,
                     mount.X_BT, GnssReflectorOf(model, link),
                     sink_->AddChannel(GnssChannel(folder, yaml))});
  } else if (const auto* camera = std::get_if<CameraModel>(&sensor.model)) {
    cameras_.push_back({Camera(*camera, sensor.clock, sensor.latency_ns, seed_, folder),
                        FrameSlots(sensor.effects, seed_, folder), sensor.clock, machine, link,
                        mount.X_BT, sink_->AddChannel(CameraChannel(folder, yaml))});
  } else if (const auto* lidar = std::get_if<LidarModel>(&sensor.model)) {
    lidars_.push_back({Lidar(*lidar, sensor.clock, sensor.latency_ns, seed_, folder),
                       FrameSlots(sensor.effects, seed_, folder),
                       sensor.clock,
                       machine,
                       link,
                       mount.X_BT,
                       sink_->AddChannel(LidarChannel(folder, yaml)),
                       {}});
  } else {
    AddEncoder(model, machine, sensor, folder);
  }
}

void Rig::AddEncoder(const MachineModel& model, std::size_t machine,
                     const SensorDescription& sensor, const std::string& folder) {
  const auto& encoder = std::get<EncoderModel>(sensor.model);
  const EncodedAxes axes = AxesOf(encoder, model);
  const std::vector<EncoderAxis> written = NamesOf(axes, model);
  std::vector<bool> linear;
  std::vector<std::string> names;
  std::vector<Effects> axis_effects;
  for (const EncoderAxis& axis : written) {
    linear.push_back(axis.linear);
    names.push_back(axis.name);
    const auto own = sensor.axis_effects.find(axis.name);
    axis_effects.push_back(own == sensor.axis_effects.end() ? Effects{} : own->second);
  }
  encoders_.push_back({Encoder(encoder, sensor.clock, sensor.latency_ns, seed_, folder, linear),
                       EncoderSlots(sensor.effects, axis_effects, linear, names, seed_, folder),
                       sensor.clock, machine, axes.joints, axes.gears,
                       sink_->AddChannel(EncoderChannel(folder, SensorYaml(sensor), written))});
}

void Rig::SampleStart(const Simulation& simulation) {
  const WorldState& now = simulation.state();
  SampleGnss(now, now);
  SampleEncoders(now, now);
  SampleCameras(now, now, simulation.ground());
  SampleLidars(now, simulation.ground());
}

void Rig::Sample(const Simulation& simulation) {
  const WorldState &before = simulation.previous(), &after = simulation.state();
  SampleImus(before, after);
  SampleGnss(before, after);
  SampleEncoders(before, after);
  SampleCameras(before, after, simulation.ground());
  SampleLidars(after, simulation.ground());
}

void Rig::SampleImus(const WorldState& before, const WorldState& after) {
  const Vec3 gravity_W_mps2(0, 0, -kStandardGravity_mps2);
  std::vector<ImuSample> samples;
  for (ImuUnit& unit : imus_) {
    samples.clear();
    unit.imu.Advance(before.t_ns, before.machines[unit.machine].links[unit.link], after.t_ns,
                     after.machines[unit.machine].links[unit.link], gravity_W_mps2, &samples);
    Report(&unit, &samples);
  }
}

void Rig::Finish(const Simulation& simulation) {
  SampleImus(simulation.previous(), simulation.state());
}

void Rig::Report(ImuUnit* unit, std::vector<ImuSample>* samples) {
  for (ImuSample& sample : *samples) {
    unit->slots.Apply(&sample);
    sink_->Write(unit->channel, RowOf(sample));
  }
}

void Rig::SampleGnss(const WorldState& before, const WorldState& after) {
  for (GnssUnit& unit : gnss_) {
    for (; unit.clock.Due(unit.next) <= after.t_ns; ++unit.next) {
      const double s = FractionAt(before, after, unit.clock.Due(unit.next));
      const MachineState &a = before.machines[unit.machine], &b = after.machines[unit.machine];
      const Pose X_WB = Interpolate(a.links[unit.link].X_WB, b.links[unit.link].X_WB, s);
      GnssSample sample = unit.gnss.Measure(unit.next, X_WB * unit.X_BT.translation(), site_);
      unit.slots.Apply(BoomAt(a, b, unit.reflector, s), site_, &sample);
      sink_->Write(unit.channel, RowOf(sample));
    }
  }
}

void Rig::SampleEncoders(const WorldState& before, const WorldState& after) {
  for (EncoderUnit& unit : encoders_) {
    const MachineState &a = before.machines[unit.machine], &b = after.machines[unit.machine];
    for (; unit.clock.Due(unit.next) <= after.t_ns; ++unit.next) {
      const double s = FractionAt(before, after, unit.clock.Due(unit.next));
      std::vector<double> q_rad, qd_radps;
      for (const int j : unit.joints) {
        q_rad.push_back(Mix(a.q_rad[j], b.q_rad[j], s));
        qd_radps.push_back(Mix(a.qd_radps[j], b.qd_radps[j], s));
      }
      for (const int g : unit.gears) {
        q_rad.push_back(Mix(a.gear_angle_rad[g], b.gear_angle_rad[g], s));
        qd_radps.push_back(Mix(a.gear_rate_radps[g], b.gear_rate_radps[g], s));
      }
      EncoderSample sample = unit.encoder.Measure(unit.next, q_rad, qd_radps);
      unit.slots.Apply(&sample);
      sink_->Write(unit.channel, RowOf(sample));
    }
  }
}

void Rig::SampleCameras(const WorldState& before, const WorldState& after,
                        const TerrainSurface& ground) {
  const Stopwatch watch(&camera_wall_s_);
  for (CameraUnit& unit : cameras_) {
    for (; unit.clock.Due(unit.next) <= after.t_ns; ++unit.next) {
      const TimeNs t_ns = unit.clock.Due(unit.next);
      const ReportClock::Times times = unit.slots.Stamp(unit.next, t_ns);
      if (!sink_->NeedsFrame(unit.channel, times.t_ns, unit.clock.Due(unit.next + 1))) {
        sink_->MarkPresent(unit.channel, times.t_ns);
        continue;
      }
      const double s = FractionAt(before, after, t_ns);
      SceneState scene;
      scene.t_ns = t_ns;
      scene.terrain = &ground;
      scene.body_scale = assembly_.BodyScales(after);
      const std::vector<Pose> from = assembly_.BodyPoses(before), to = assembly_.BodyPoses(after);
      for (std::size_t b = 0; b < to.size(); ++b) {
        scene.X_WB.push_back(Interpolate(from[b], to[b], s));
      }
      const Pose X_WB = Interpolate(before.machines[unit.machine].links[unit.link].X_WB,
                                    after.machines[unit.machine].links[unit.link].X_WB, s);
      CameraFrame frame =
          unit.camera.Measure(unit.next, X_WB * unit.X_BT, scene, rasterizer_.get());
      unit.slots.Apply(unit.next, times, &frame);
      sink_->Write(unit.channel, std::move(frame));
    }
  }
}

void Rig::SampleLidars(const WorldState& now, const TerrainSurface& ground) {
  if (lidars_.empty()) return;
  const Stopwatch watch(&lidar_wall_s_);
  RememberScene(now);
  TimeNs oldest_ns = now.t_ns;
  for (LidarUnit& unit : lidars_) {
    const Pose X_WB = now.machines[unit.machine].links[unit.link].X_WB;
    unit.X_WS.Append(now.t_ns, X_WB * unit.X_BT);
    for (; unit.clock.Due(unit.next + 1) <= now.t_ns; ++unit.next) {
      const TimeNs start_ns = unit.clock.Due(unit.next), end_ns = unit.clock.Due(unit.next + 1);
      const ReportClock::Times times = unit.slots.Stamp(unit.next, start_ns);
      if (!sink_->NeedsFrame(unit.channel, times.t_ns, unit.clock.Due(unit.next + 2))) {
        sink_->MarkPresent(unit.channel, times.t_ns);
        continue;
      }
      std::vector<std::vector<Pose>> poses;
      for (int k = 0; k < Lidar::kScenePoses; ++k) {
        poses.push_back(BodiesAt(start_ns + (end_ns - start_ns) * k / (Lidar::kScenePoses - 1)));
      }
      ray_scene_->Update(poses, ground, assembly_.BodyScales(now));
      LidarScan scan = unit.lidar.Measure(unit.next, unit.X_WS, *ray_scene_, threads_);
      unit.slots.Apply(unit.next, times, &scan);
      sink_->Write(unit.channel, std::move(scan));
    }
    unit.X_WS.DropBefore(unit.clock.Due(unit.next));
    oldest_ns = std::min(oldest_ns, unit.clock.Due(unit.next));
  }
  while (history_.size() > 1 && history_[1].t_ns <= oldest_ns) history_.pop_front();
}

void Rig::RememberScene(const WorldState& state) {
  TERA_CHECK(history_.empty() || state.t_ns > history_.back().t_ns, state.t_ns);
  history_.push_back({state.t_ns, assembly_.BodyPoses(state)});
}

std::vector<Pose> Rig::BodiesAt(TimeNs t_ns) const {
  const auto after = std::lower_bound(history_.begin(), history_.end(), t_ns,
                                      [](const SceneMoment& m, TimeNs t) { return m.t_ns < t; });
  if (after == history_.end()) return history_.back().X_WB;
  if (after == history_.begin() || after->t_ns == t_ns) return after->X_WB;
  const auto before = after - 1;
  const double s =
      static_cast<double>(t_ns - before->t_ns) / static_cast<double>(after->t_ns - before->t_ns);
  std::vector<Pose> poses;
  poses.reserve(after->X_WB.size());
  for (std::size_t b = 0; b < after->X_WB.size(); ++b) {
    poses.push_back(Interpolate(before->X_WB[b], after->X_WB[b], s));
  }
  return poses;
}

}  // namespace tera
