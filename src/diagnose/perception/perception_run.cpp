#include "diagnose/perception/perception_run.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>

#include "core/check.h"
#include "core/error.h"
#include "diagnose/perception/pictures/picture_diagnosis.h"
#include "diagnose/perception/scene/scan_diagnosis.h"
#include "resimulate/picture_caster.h"
#include "resimulate/recorded_scans.h"
#include "resimulate/recorded_sensors.h"
#include "resimulate/scan_caster.h"

namespace tera {
namespace {

std::vector<RangeScan> LoadScans(const Recording& recording, RecordedSensor* sensor) {
  std::vector<RangeScan> scans;
  for (const ScanCaster::Scan& scan : sensor->scans) {
    LoadedScan loaded = LoadRangeScan(recording, sensor->channel, *sensor->description, scan.t_ns);
    scans.push_back(std::move(loaded.scan));
    sensor->obstacle = std::move(loaded.obstacle);
    if (!sensor->obstacle.empty()) break;
  }
  return scans;
}

PerceptionDiagnosis DiagnoseRanges(const Scenario& scenario, const Recording& recording,
                                   RecordedSensor* sensor, ScanCaster* caster) {
  RangeSource source;
  source.channel = sensor->channel;
  source.target = sensor->description->name;
  source.kind = KindOf(*sensor->description).target;
  source.planar_depth = RangingOf(*sensor->description)->is_planar;
  source.X_BS = sensor->description->X_BS;
  source.present = sensor->description->effects;
  source.scans = LoadScans(recording, sensor);
  if (!sensor->obstacle.empty()) {
    return NotJudged(source.channel, source.target, sensor->obstacle);
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

/// Creates the picture renderer if a sensor takes pictures. Without OpenGL, these sensors are
/// marked as not judged.
std::unique_ptr<PictureCaster> PainterFor(
    std::vector<RecordedSensor>* sensors,
    const std::function<std::unique_ptr<PictureCaster>()>& make) {
  const auto takes = [](const RecordedSensor& sensor) {
    return TakesPictures(*sensor.description);
  };
  if (std::none_of(sensors->begin(), sensors->end(), takes)) return nullptr;
  try {
    return make();
  } catch (const InputError& error) {
    for (RecordedSensor& sensor : *sensors) {
      if (takes(sensor)) sensor.obstacle = error.what();
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
  std::vector<RecordedSensor> sensors = SeeingSensors(scenario, names, recording, options.part);
  if (sensors.empty()) return diagnoses;
  std::vector<RecordedMotion> machines;
  for (std::size_t m = 0; m < names.size(); ++m) {
    machines.emplace_back(scenario.machines[m].placement, names[m], recording);
  }
  TimeNs start_ns = std::numeric_limits<TimeNs>::max();
  for (RecordedSensor& sensor : sensors) {
    const MachineModel& model = scenario.machines[sensor.machine].placement.model;
    sensor.obstacle = ObstacleTo(sensor, machines[sensor.machine], model);
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
  for (RecordedSensor& sensor : sensors) {
    PerceptionDiagnosis diagnosis;
    if (!sensor.obstacle.empty()) {
      diagnosis = NotJudged(sensor.channel, sensor.description->name, sensor.obstacle);
    } else if (TakesPictures(*sensor.description)) {
      diagnosis = DiagnoseCamera(sensor, recording, scenario.seed, painter.get());
    } else {
      diagnosis = DiagnoseRanges(scenario, recording, &sensor, &caster);
    }
    diagnoses[sensor.machine].push_back(std::move(diagnosis));
  }
  return diagnoses;
}

}  // namespace tera
