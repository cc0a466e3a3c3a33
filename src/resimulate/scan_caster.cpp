#include "resimulate/scan_caster.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/check.h"

namespace tera {
namespace {

/// Rays are this many times as long as the sensor's range, to find surfaces just beyond it.
constexpr double kBeyond = 1.5;

}  // namespace

std::vector<Surface> SurfacesOf(const Scenario& scenario, const SceneAssembly& assembly,
                                const std::vector<RecordedMotion>& machines) {
  std::vector<Surface> surfaces;
  for (const SceneInstance& instance : assembly.model().instances) {
    Surface surface = Surface::kObstacle;
    for (std::size_t m = 0; m < machines.size(); ++m) {
      const std::string& machine = scenario.machines[m].placement.name;
      if (instance.name != machine && !instance.name.starts_with(machine + "/")) continue;
      surface = machines[m].shows_whole() ? Surface::kMachine : Surface::kUnknown;
    }
    const bool has_other_shape =
        instance.label == SemanticClass::kTrack || instance.label == SemanticClass::kSoilInBucket;
    surfaces.push_back(has_other_shape ? Surface::kUnknown : surface);
  }
  surfaces.front() = Surface::kGround;
  return surfaces;
}

ScanCaster::ScanCaster(const Scenario& scenario, const SceneAssembly& assembly,
                       const RecordedStage& stage, const std::vector<RecordedMotion>& machines,
                       int threads)
    : scenario_(scenario),
      assembly_(assembly),
      stage_(stage),
      machines_(machines),
      threads_(threads),
      scene_(assembly.model()),
      surface_(SurfacesOf(scenario, assembly, machines)) {}

std::string ScanCaster::NameOf(int object) const {
  return assembly_.model().instances[static_cast<std::size_t>(object)].name;
}

void ScanCaster::ShowScene(std::size_t machine, int link, const Scan& scan, TimeNs start_ns,
                           int poses_of_span) {
  if (posed_start_ns_ == start_ns && posed_span_ns_ == scan.span_ns && posed_link_ == link &&
      posed_machine_ == machine && posed_ground_ == scan.moment.ground.get()) {
    return;
  }
  const int keys = scan.span_ns > 0 ? poses_of_span : 1;
  std::vector<std::vector<Pose>> poses;
  Shapes shapes;
  link_.clear();
  for (int k = 0; k < keys; ++k) {
    const TimeNs t_ns = start_ns + (keys > 1 ? scan.span_ns * k / (keys - 1) : 0);
    const Instant state = stage_.StateAt(t_ns, scan.moment);
    poses.push_back(assembly_.BodyPoses(state));
    if (k + 1 == keys) shapes = assembly_.ShapesOf(state);
    link_.push_back(state.machines[machine].links[static_cast<std::size_t>(link)]);
  }
  scene_.Update(poses, *scan.moment.ground, shapes);
  posed_start_ns_ = start_ns;
  posed_span_ns_ = scan.span_ns;
  posed_link_ = link;
  posed_machine_ = machine;
  posed_ground_ = scan.moment.ground.get();
}

std::vector<SimulatedReturn> ScanCaster::Cast(std::size_t machine, const SensorDescription& sensor,
                                              const Scan& scan,
                                              const SensorCalibration& calibration,
                                              const std::vector<Beam>& beams) {
  const std::optional<Ranging> ranging = RangingOf(sensor);
  TERA_CHECK(ranging, sensor.name);
  std::vector<SimulatedReturn> returns(beams.size());
  const TimeNs start_ns = scan.t_ns - FromSeconds(calibration.clock_offset_s);
  const RecordedMotion& motion = machines_[machine];
  if (!motion.IsKnownAt(start_ns) || !motion.IsKnownAt(start_ns + scan.span_ns)) return returns;
  const int link = scenario_.machines[machine].placement.model.LinkIndex(sensor.link);
  ShowScene(machine, link, scan, start_ns, ranging->scene_poses);
  const Pose& X_BT = calibration.X_BT;
  const auto last = static_cast<double>(link_.size() - 1);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const double part =
        scan.span_ns > 0
            ? std::clamp(static_cast<double>(beams[i].since_ns) / static_cast<double>(scan.span_ns),
                         0.0, 1.0)
            : 0.0;
    const double at = part * last;
    const auto a = static_cast<std::size_t>(std::min(std::floor(at), std::max(0.0, last - 1)));
    const std::size_t b = std::min(a + 1, link_.size() - 1);
    const BodyState body = Interpolate(link_[a], link_[b], at - static_cast<double>(a));
    returns[i].X_WB = body.X_WB;
    returns[i].v_WB_mps = body.v_WB_mps;
    returns[i].w_WB_radps = body.w_WB_radps;
    rays.push_back(
        {.origin_W_m = (body.X_WB * Vec3(X_BT.translation())).cast<float>(),
         .direction_W = (body.X_WB.linear() * (X_BT.linear() * beams[i].d_S)).cast<float>(),
         .max_range_m = static_cast<float>(kBeyond * ranging->max_range_m),
         .time = static_cast<float>(part)});
  }
  std::vector<RayHit> hits(rays.size());
  scene_.Trace(rays, hits, threads_);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].hit) {
      returns[i].surface = Surface::kNothing;
      continue;
    }
    returns[i].range_m = hits[i].range_m;
    returns[i].normal_W = hits[i].normal_W.cast<double>();
    returns[i].object = hits[i].instance;
    returns[i].surface = surface_[hits[i].instance];
    if (hits[i].range_m < ranging->min_range_m) returns[i].surface = Surface::kUnknown;
  }
  return returns;
}

}  // namespace tera
