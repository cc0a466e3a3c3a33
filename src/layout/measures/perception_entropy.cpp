#include "layout/measures/perception_entropy.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr double kLeastPrecision = 0.001, kMostPrecision = 0.999;
constexpr double kFirst_m = 1, kEntropyStep_m = 2;  ///< first tested distance and step

}  // namespace

double PrecisionOf(const PrecisionFit& fit, double samples) {
  if (samples <= 0) return kLeastPrecision;
  return std::clamp(fit.a * std::log(samples) + fit.b, kLeastPrecision, kMostPrecision);
}

double SigmaOf(double precision) { return 1 / precision - 1; }

double FusedSigma(const std::vector<double>& sigmas) {
  double inverse_squares = 0;
  for (const double sigma : sigmas) inverse_squares += 1 / (sigma * sigma);
  return 1 / std::sqrt(inverse_squares);
}

double PlanarEntropy(double sigma) { return 2 * std::log(sigma) + 1 + std::log(2 * kPi); }

PerceptionEntropy::PerceptionEntropy(const PersonStudy& person, const InformationStudy& information,
                                     double reflectance)
    : person_(person), information_(information), reflectance_(reflectance) {
  TERA_CHECK(!person.postures.empty());
  patches_ = PatchesOf(person.postures.front());
}

void PerceptionEntropy::Add(const Pose& X_WH, const std::vector<double>& hull_m,
                            const Layout& layout, const Sighting& sighting,
                            const TerrainSurface& ground) {
  std::vector<double> distances_m;
  for (double d_m = kFirst_m; d_m <= person_.farthest_m; d_m += kEntropyStep_m)
    distances_m.push_back(d_m);
  std::vector<Pose> X_WP;
  for (const PersonPlace& place : PlacesAroundHull(X_WH, hull_m, distances_m, sighting, ground)) {
    X_WP.push_back(place.X_WP);
  }
  std::vector<std::vector<double>> sigmas(X_WP.size());
  for (const Viewer& viewer : layout.viewers) {
    const bool is_lidar = viewer.field.samples == ViewField::Samples::kPoints;
    const PrecisionFit& fit = is_lidar ? information_.lidar : information_.camera;
    const std::vector<double> samples =
        SamplesOnPersons(patches_, X_WP, viewer, reflectance_, sighting);
    for (std::size_t p = 0; p < samples.size(); ++p) {
      if (samples[p] > 0) sigmas[p].push_back(SigmaOf(PrecisionOf(fit, samples[p])));
    }
  }
  double sum_nat = 0, sum_nat2 = 0;
  for (const std::vector<double>& of_place : sigmas) {
    const double sigma = of_place.empty() ? SigmaOf(kLeastPrecision) : FusedSigma(of_place);
    sum_nat += PlanarEntropy(sigma);
    sum_nat2 += PlanarEntropy(sigma) * PlanarEntropy(sigma);
  }
  const double count = static_cast<double>(sigmas.size()), mean_nat = sum_nat / count;
  mean_nat_.push_back(mean_nat);
  error_nat_.push_back(std::sqrt(std::max(0.0, sum_nat2 / count - mean_nat * mean_nat) / count));
}

std::vector<Figure> PerceptionEntropy::Figures() const {
  return {{{Measure::kPerceptionEntropy}, mean_nat_, error_nat_}};
}

}  // namespace tera
