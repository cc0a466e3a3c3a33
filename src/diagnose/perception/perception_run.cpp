#include "diagnose/perception/perception_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>

#include "core/check.h"
#include "core/error.h"
#include "core/units.h"
#include "diagnose/perception/pictures/picture_run.h"
#include "diagnose/perception/scans/scan_diagnosis.h"
#include "resimulate/picture_caster.h"
#include "resimulate/scan_caster.h"

namespace tera {
namespace {

constexpr std::size_t kMostScans = 60, kMostPictures = 40, kPointsOfScan = 4000;

/// One sensor with scans in the recording.
struct Sensor {
  std::size_t machine = 0;
  const SensorDescription* description = nullptr;
  std::string channel;
  std::vector<ScanCaster::Scan> scans;
  std::string not_judged;
};

bool MeasuresRanges(const SensorDescription& sensor) {
  const auto* camera = std::get_if<CameraModel>(&sensor.model);
  return std::holds_alternative<LidarModel>(sensor.model) || (camera && camera->depth);
}

/// Up to `most` of the times in a range, evenly spread.
std::vector<TimeNs> Thinned(std::vector<TimeNs> times, TimeNs from_ns, TimeNs to_ns,
                            std::size_t most) {
  std::erase_if(times, [&](TimeNs t) { return t < from_ns || t > to_ns; });
  if (times.size() <= most) return times;
  std::vector<TimeNs> chosen;
  for (std::size_t k = 0; k < most; ++k) chosen.push_back(times[k * times.size() / most]);
  return chosen;
}

std::vector<Sensor> SensorsOf(const Scenario& scenario, const std::vector<std::string>& names,
                              const Recording& recording, const PerceptionOptions& options) {
  std::vector<Sensor> sensors;
  for (std::size_t m = 0; m < names.size(); ++m) {
    for (const SensorDescription& description : scenario.machines[m].sensors) {
      const std::string channel = names[m] + "/" + description.name;
      const bool is_compared = MeasuresRanges(description) || TakesPictures(description);
      if (!is_compared || !recording.Has(channel)) continue;
      const std::vector<TimeNs> times = recording.FrameTimes(channel);
      if (times.empty()) continue;
      const TimeNs first_ns = times.front();
      Sensor sensor{m, &description, channel, {}, ""};
      const bool turns = std::holds_alternative<LidarModel>(description.model);
      const TimeNs span_ns = turns ? description.clock.Period() : 0;
      const TimeNs to_ns = options.to_s < 1e9 ? first_ns + FromSeconds(options.to_s)
                                              : std::numeric_limits<TimeNs>::max();
      const TimeNs from_ns = first_ns + FromSeconds(options.from_s);
      const std::size_t most = TakesPictures(description) ? kMostPictures : kMostScans;
      for (const TimeNs t_ns : Thinned(times, from_ns, to_ns, most)) {
        sensor.scans.push_back({t_ns, span_ns, {}});
      }
      sensors.push_back(std::move(sensor));
    }
  }
  return sensors;
}

RangeScan ScanOf(const Recording& recording, const std::string& channel, const LidarModel& model,
                 TimeNs t_ns, std::string* not_judged) {
  const LidarScan recorded = recording.LoadScan(channel, t_ns);
  const std::size_t stride = recorded.points.size() / kPointsOfScan + 1;
  RangeScan scan{t_ns, {}};
  // An odd stride, so that with an even number of beams all of them come.
  for (std::size_t i = 0; i < recorded.points.size(); i += stride | 1) {
    const LidarPoint& point = recorded.points[i];
    if (point.ring >= model.elevation_rad.size()) {
      *not_judged = fmt::format(
          "a point of its scan {} is of ring {}, but the scenario's lidar has "
          "{} beams; need the lidar that was recorded",
          t_ns, point.ring, model.elevation_rad.size());
    }
    const Vec3 p_S_m(point.x_m, point.y_m, point.z_m);
    if (p_S_m.norm() < model.min_range_m) continue;
    scan.points.push_back({p_S_m, static_cast<TimeNs>(point.time_offset_ns), model.range_noise_m});
  }
  return scan;
}

RangeScan ScanOf(const Recording& recording, const std::string& channel, const CameraModel& model,
                 TimeNs t_ns, std::string* not_judged) {
  const Image<float> depth_m = recording.LoadFrame(channel, t_ns).depth_m;
  const CameraIntrinsics& lens = model.intrinsics;
  RangeScan scan{t_ns, {}};
  if (depth_m.width_px != lens.width_px || depth_m.height_px != lens.height_px) {
    *not_judged = fmt::format(
        "its depth picture {} is of {} x {} pixels, but the scenario's camera "
        "has {} x {}; need the camera that was recorded",
        t_ns, depth_m.width_px, depth_m.height_px, lens.width_px, lens.height_px);
    return scan;
  }
  const std::size_t pixels = depth_m.data.size();
  const Mat3 R_SC = OpticalInSensor().linear();
  const double noise_1pm = model.disparity_noise_px / (lens.fx_px * model.baseline_m);
  for (std::size_t i = 0; i < pixels; i += (pixels / kPointsOfScan + 1) | 1) {
    const double z_m = depth_m.data[i];
    if (!(z_m > 0)) continue;
    const auto width = static_cast<std::size_t>(lens.width_px);
    const auto ray = lens.RayOf({static_cast<double>(i % width), static_cast<double>(i / width)});
    if (!ray) continue;
    const Vec3 p_S_m = R_SC * (z_m * *ray);
    scan.points.push_back({p_S_m, 0, noise_1pm * z_m * p_S_m.norm()});
  }
  return scan;
}

std::vector<RangeScan> LoadScans(const Recording& recording, Sensor* sensor) {
  std::vector<RangeScan> scans;
  for (const ScanCaster::Scan& scan : sensor->scans) {
    const auto load = [&](const auto& model) {
      scans.push_back(ScanOf(recording, sensor->channel, model, scan.t_ns, &sensor->not_judged));
    };
    const auto& model = sensor->description->model;
    if (const auto* lidar = std::get_if<LidarModel>(&model))
      load(*lidar);
    else
      load(std::get<CameraModel>(model));
    if (!sensor->not_judged.empty()) break;
  }
  return scans;
}

/// Ground and loads at the end of every scan, in the order of time.
void WorkGround(RecordedStage* stage, std::vector<Sensor>* sensors) {
  std::vector<ScanCaster::Scan*> scans;
  for (Sensor& sensor : *sensors) {
    for (ScanCaster::Scan& scan : sensor.scans) scans.push_back(&scan);
  }
  const auto end_ns = [](const ScanCaster::Scan* scan) { return scan->t_ns + scan->span_ns; };
  std::stable_sort(scans.begin(), scans.end(),
                   [&](const auto* a, const auto* b) { return end_ns(a) < end_ns(b); });
  for (ScanCaster::Scan* scan : scans) scan->moment = stage->AdvanceTo(end_ns(scan));
}

/// Why nothing can be cast for a sensor; empty where it can.
std::string ObstacleTo(const Sensor& sensor, const RecordedMotion& motion,
                       const MachineModel& model) {
  if (!motion.obstacle().empty()) return motion.obstacle();
  if (!motion.Carries(model.LinkIndex(sensor.description->link))) {
    return fmt::format("a joint between the base and its link {} has no encoder",
                       sensor.description->link);
  }
  return "";
}

PerceptionDiagnosis DiagnoseRanges(const Scenario& scenario, const Recording& recording,
                                   Sensor* sensor, ScanCaster* caster) {
  RangeSource source;
  source.channel = sensor->channel;
  source.target = sensor->description->name;
  source.planar_depth = std::holds_alternative<CameraModel>(sensor->description->model);
  source.X_BS = sensor->description->X_BS;
  source.present = sensor->description->effects;
  source.scans = LoadScans(recording, sensor);
  if (!sensor->not_judged.empty()) {
    return NotJudged(source.channel, source.target, sensor->not_judged);
  }
  source.start_ns = source.scans.empty() ? 0 : source.scans.front().t_ns;
  source.cast = [&](std::size_t scan, const SensorCalibration& calibration,
                    const std::vector<Beam>& beams) {
    return caster->Cast(sensor->machine, *sensor->description, sensor->scans[scan], calibration,
                        beams);
  };
  source.ground_m = [&](std::size_t scan, const Vec2& xy_W_m) -> std::optional<double> {
    const TerrainSurface& ground = *sensor->scans[scan].moment.ground;
    const Vec2 last(ground.x_m(ground.nx - 1), ground.y_m(ground.ny - 1));
    if ((xy_W_m.array() < ground.origin_W_m.array()).any() ||
        (xy_W_m.array() > last.array()).any()) {
      return std::nullopt;
    }
    return ground.HeightAt(xy_W_m.x(), xy_W_m.y());
  };
  source.name_of = [&](int object) { return caster->NameOf(object); };
  return DiagnoseScans(source, scenario.seed);
}

/// What renders pictures, where some sensor takes them. Without OpenGL these are not judged.
std::unique_ptr<PictureCaster> PainterFor(
    std::vector<Sensor>* sensors, const std::function<std::unique_ptr<PictureCaster>()>& make) {
  const auto takes = [](const Sensor& sensor) { return TakesPictures(*sensor.description); };
  if (std::none_of(sensors->begin(), sensors->end(), takes)) return nullptr;
  try {
    return make();
  } catch (const InputError& error) {
    for (Sensor& sensor : *sensors) {
      if (takes(sensor)) sensor.not_judged = error.what();
    }
    return nullptr;
  }
}

}  // namespace

std::vector<std::vector<PerceptionDiagnosis>> RunPerception(const Scenario& scenario,
                                                            const std::vector<std::string>& names,
                                                            const Recording& recording,
                                                            const PerceptionOptions& options) {
  TERA_CHECK(names.size() == scenario.machines.size(), names.size());
  std::vector<std::vector<PerceptionDiagnosis>> diagnoses(names.size());
  std::vector<Sensor> sensors = SensorsOf(scenario, names, recording, options);
  if (sensors.empty()) return diagnoses;
  std::vector<RecordedMotion> machines;
  for (std::size_t m = 0; m < names.size(); ++m) {
    machines.emplace_back(scenario.machines[m].placement, names[m], recording);
  }
  TimeNs start_ns = std::numeric_limits<TimeNs>::max();
  for (Sensor& sensor : sensors) {
    const MachineModel& model = scenario.machines[sensor.machine].placement.model;
    sensor.not_judged = ObstacleTo(sensor, machines[sensor.machine], model);
    for (const ScanCaster::Scan& scan : sensor.scans) start_ns = std::min(start_ns, scan.t_ns);
  }
  for (const RecordedMotion& machine : machines) {
    start_ns = std::min(start_ns, machine.first_ns().value_or(start_ns));
  }
  const SceneAssembly assembly(scenario);
  RecordedStage stage(scenario, machines, start_ns);
  WorkGround(&stage, &sensors);
  ScanCaster caster(scenario, assembly, stage, machines, options.threads);
  const auto painter = PainterFor(&sensors, [&] {
    return std::make_unique<PictureCaster>(scenario, assembly, stage, machines);
  });
  for (Sensor& sensor : sensors) {
    PerceptionDiagnosis diagnosis;
    if (!sensor.not_judged.empty()) {
      diagnosis = NotJudged(sensor.channel, sensor.description->name, sensor.not_judged);
    } else if (TakesPictures(*sensor.description)) {
      const RecordedCamera camera{sensor.machine, sensor.description, sensor.channel,
                                  &sensor.scans};
      diagnosis = DiagnoseCamera(camera, recording, scenario.seed, painter.get());
    } else {
      diagnosis = DiagnoseRanges(scenario, recording, &sensor, &caster);
    }
    diagnoses[sensor.machine].push_back(std::move(diagnosis));
  }
  return diagnoses;
}

}  // namespace tera
