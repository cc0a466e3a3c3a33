#include "diagnose/perception/pictures/picture_diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "diagnose/perception/pictures/picture_registration.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr double kLeastContrast = 0.012;  ///< of the range of values, three of 255
constexpr double kFewestLandmarks = 40;   ///< of a picture
constexpr double kLike = 0.5;
constexpr double kFurthest_px = 1;  ///< of edges, with the best numbers
constexpr int kRounds = 2;          ///< of rendering again

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

/// Why the pictures themselves tell nothing; empty where they do.
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

SearchedPoints LandmarksToSearch(const PictureRegistration& pictures, const ScanSplit& split) {
  return PointsToSearch(
      split, [&](const std::vector<Part>& parts) { return pictures.PointsOf(split, parts); });
}

SensorSearch SearchPictures(const PictureSource& source, const PictureRegistration& pictures,
                            const SearchedPoints& points, const SensorNumbers& start) {
  SensorComparison comparison;
  comparison.present = source.present;
  comparison.start = start;
  comparison.coarsest = PictureLevels::kCount - 1;
  comparison.residuals = [&](const std::vector<ScanPoints>& some, const SensorNumbers& numbers,
                             int coarse) { return pictures.Compare(some, numbers, coarse); };
  return SearchSensor(comparison, {OfMount(), OfClock()}, points);
}

}  // namespace

PerceptionDiagnosis DiagnosePictures(const PictureSource& source, std::uint64_t seed) {
  PerceptionDiagnosis diagnosis;
  diagnosis.channel = source.channel;
  diagnosis.target = source.target;
  diagnosis.unit = "px";
  diagnosis.scans = source.t_ns.size();
  const ScanSplit split =
      SplitTimes(source.t_ns, Stream(seed, "diagnose/" + source.channel + "/split"));
  diagnosis.not_judged = ObstacleTo(source, split);
  if (!diagnosis.is_judged()) return diagnosis;
  auto pictures = std::make_unique<PictureRegistration>(source, source.present);
  if (const double count = pictures->LandmarksOfFrame(); count < kFewestLandmarks) {
    diagnosis.not_judged = fmt::format(
        "the simulated pictures show {:.0f} edges each that could be compared; need {:.0f}", count,
        kFewestLandmarks);
    return diagnosis;
  }
  SearchedPoints points = LandmarksToSearch(*pictures, split);
  diagnosis.sensor = SearchPictures(source, *pictures, points, source.present);
  for (int round = 0; round < kRounds && !diagnosis.sensor.findings.empty(); ++round) {
    const SensorNumbers found = diagnosis.sensor.numbers;
    pictures = std::make_unique<PictureRegistration>(source, found);
    points = LandmarksToSearch(*pictures, split);
    diagnosis.sensor = SearchPictures(source, *pictures, points, found);
  }
  const double like = pictures->Likeness(points.seen, diagnosis.sensor.numbers);
  if (like < kLike) {
    diagnosis.sensor = {};
    diagnosis.not_judged = fmt::format(
        "its pictures are not like the simulated ones: a correlation of {:.2f} at their edges; "
        "need {:.1f}",
        like, kLike);
    return diagnosis;
  }
  if (diagnosis.sensor.noise_rmse > kFurthest_px) {
    diagnosis.not_judged =
        fmt::format("at best its edges lie within {:.1f} pixels of the simulated ones; need {:.0f}",
                    diagnosis.sensor.noise_rmse, kFurthest_px);
    diagnosis.sensor = {};
    return diagnosis;
  }
  for (const SensorFinding& found : diagnosis.sensor.findings) {
    diagnosis.findings.push_back(AsFinding(found, source.target));
  }
  for (const SensorFinding& found : diagnosis.sensor.unconfirmed) {
    diagnosis.unconfirmed.push_back(AsFinding(found, source.target));
  }
  return diagnosis;
}

}  // namespace tera
