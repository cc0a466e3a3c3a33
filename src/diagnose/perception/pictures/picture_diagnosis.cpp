#include "diagnose/perception/pictures/picture_diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "diagnose/perception/pictures/picture_registration.h"
#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/statistics/series/robust.h"
#include "resimulate/recorded_scans.h"
#include "sensors/camera/camera.h"

namespace tera {
namespace {

/// Standard deviation of brightness on a scale of 0 to 1: three of 255.
constexpr double kLeastContrast = 0.012;
constexpr double kFewestLandmarks = 40;    ///< mean per picture
constexpr double kLeastCorrelation = 0.5;  ///< least correlation of brightness at the edges
constexpr double kFurthest_px = 1;         ///< RMS distance of the edges under the best calibration
constexpr int kRounds = 2;  ///< repetitions with pictures rendered under the findings

/// Standard deviation of a picture's values.
double ContrastOf(const Image<float>& grey) {
  double sum = 0, square = 0;
  for (const float value : grey.data) {
    sum += value;
    square += value * value;
  }
  const auto n = static_cast<double>(grey.data.size());
  return std::sqrt(std::max(0.0, square / n - sum / n * sum / n));
}

/// Reason why the pictures cannot be compared; empty if they can.
std::string ObstacleTo(const PictureSource& source, const ScanSplit& split) {
  for (const Image<float>& grey : source.grey) {
    if (std::min(grey.width_px, grey.height_px) >= PictureLevels::kSmallest_px) continue;
    return fmt::format("its pictures are compared at {} x {} pixels; need {} either way",
                       grey.width_px, grey.height_px, PictureLevels::kSmallest_px);
  }
  if (split.blocks < kFewestBlocks) {
    return fmt::format("its {} pictures are spread over {} blocks of a second; need {}",
                       source.t_ns.size(), split.blocks, kFewestBlocks);
  }
  std::vector<double> contrasts;
  for (const Image<float>& grey : source.grey) contrasts.push_back(ContrastOf(grey));
  if (const double contrast = Median(contrasts); contrast < kLeastContrast) {
    return fmt::format(
        "its pictures have no contrast: a standard deviation of {:.1f} of 255; need {:.0f}",
        255 * contrast, 255 * kLeastContrast);
  }
  return "";
}

SplitPoints LandmarksToRegister(const PictureRegistration& pictures, const ScanSplit& split) {
  return PointsOfParts(
      split, [&](const std::vector<Part>& parts) { return pictures.PointsOf(split, parts); });
}

/// Search input of a camera. A call of `residuals` evaluates the registration to which `pictures`
/// points at that time.
RegistrationBlock BlockOf(const PictureSource& source,
                          const std::unique_ptr<PictureRegistration>& pictures) {
  return {source.X_BS, source.present,
          CandidatesOf(source.kind, ComparedBy::kPictures, source.target, source.present),
          [&pictures](const std::vector<ScanPoints>& some, const SensorCalibration& calibration,
                      int level) { return pictures->ResidualsOf(some, calibration, level); },
          PictureLevels::kCount - 1};
}

/// Reason why the registered pictures do not match the simulation; empty if they do.
std::string ObstacleTo(const PictureRegistration& pictures, const SplitPoints& points,
                       const RegistrationSearch& search) {
  const double correlation = pictures.Correlation(points.seen, search.calibration);
  if (correlation < kLeastCorrelation) {
    return fmt::format(
        "its pictures are not like the simulated ones: a correlation of {:.2f} at their edges; "
        "need {:.1f}",
        correlation, kLeastCorrelation);
  }
  if (search.noise_rmse > kFurthest_px) {
    return fmt::format(
        "at best its edges lie within {:.1f} pixels of the simulated ones; need {:.0f}",
        search.noise_rmse, kFurthest_px);
  }
  return "";
}

}  // namespace

PerceptionDiagnosis DiagnosePictures(const PictureSource& source, std::uint64_t seed) {
  PerceptionDiagnosis diagnosis;
  diagnosis.channel = source.channel;
  diagnosis.target = source.target;
  diagnosis.unit = "px";
  diagnosis.scans = source.t_ns.size();
  const ScanSplit split =
      SplitScans(source.t_ns, Stream(seed, "diagnose/" + source.channel + "/split"));
  diagnosis.not_judged = ObstacleTo(source, split);
  if (!diagnosis.is_judged()) return diagnosis;
  auto pictures = std::make_unique<PictureRegistration>(source, source.calibration());
  if (const double count = pictures->MeanLandmarks(); count < kFewestLandmarks) {
    diagnosis.not_judged = fmt::format(
        "the simulated pictures show {:.0f} edges each that could be compared; need {:.0f}", count,
        kFewestLandmarks);
    return diagnosis;
  }
  RegistrationBlock block = BlockOf(source, pictures);
  SplitPoints points = LandmarksToRegister(*pictures, split);
  RegistrationSearch search = SearchRegistration(block, points);
  for (int round = 0; round < kRounds && !search.findings.empty(); ++round) {
    pictures = std::make_unique<PictureRegistration>(source, search.calibration);
    points = LandmarksToRegister(*pictures, split);
    search = SearchRegistration(block, points, search.found);
  }
  diagnosis.not_judged = ObstacleTo(*pictures, points, search);
  if (!diagnosis.is_judged()) return diagnosis;
  TakeOver(std::move(search), &diagnosis);
  diagnosis.sensor_candidates = std::move(block.candidates);
  return diagnosis;
}

namespace {

constexpr int kWidest_px = 400;

}  // namespace

PerceptionDiagnosis DiagnoseCamera(const RecordedSensor& camera, const Recording& recording,
                                   std::uint64_t seed, PictureCaster* caster) {
  const SensorDescription& sensor = *camera.description;
  const CameraIntrinsics& lens = PicturesOf(sensor)->intrinsics;
  const int reduced = (lens.width_px + kWidest_px - 1) / kWidest_px;
  const CameraIntrinsics small = Reduced(lens, reduced);
  PictureSource source;
  source.channel = camera.channel;
  source.target = sensor.name;
  source.kind = KindOf(sensor).target;
  source.X_BS = sensor.X_BS;
  source.X_SC = OpticalInSensor();
  source.present = sensor.effects;
  source.render = [&](std::size_t frame, const SensorCalibration& calibration) {
    return caster->Render(camera.machine, sensor, camera.scans[frame], calibration, reduced);
  };
  source.link_at = [&](std::size_t frame, const SensorCalibration& calibration) {
    return caster->LinkAt(camera.machine, sensor, camera.scans[frame], calibration);
  };
  source.project = [small](const Vec3& p_C_m) { return small.Project(p_C_m); };
  source.ray = [small](const Vec2& px) { return small.RayOf(px); };
  for (const ScanCaster::Scan& picture : camera.scans) {
    LoadedPicture loaded =
        LoadGreyPicture(recording, camera.channel, sensor, picture.t_ns, reduced);
    if (!loaded.obstacle.empty()) {
      return NotJudged(source.channel, source.target, loaded.obstacle);
    }
    source.t_ns.push_back(picture.t_ns);
    source.grey.push_back(std::move(loaded.grey));
  }
  return DiagnosePictures(source, seed);
}

}  // namespace tera
