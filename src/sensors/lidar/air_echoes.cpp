#include "sensors/lidar/air_echoes.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "render/air/dust_volume.h"
#include "render/air/rain.h"

namespace tera {
namespace {

constexpr double kDropStep_m = 0.05;
constexpr double kFarthestDrop_m = 40;
// Lanes of the random draws.
constexpr std::uint32_t kStart = 0, kDrop = 1, kSize = 2;

}  // namespace

AirEchoes::AirEchoes(const Limits& limits, const SensedAir& air, const Stream& draws)
    : dust_(air.dust != nullptr && !air.dust->occupied_W_m.isEmpty() ? air.dust : nullptr),
      rain_mmph_(air.rain_mmph),
      limits_(limits),
      draws_(draws) {
  if (rain_mmph_ <= 0) return;
  extinction_1pm_ = Rain(rain_mmph_).Extinction_1pm();
  if (limits_.least_power > 0) FindDrops();
}

double AirEchoes::BeamArea_m2(double range_m) {
  const double diameter_m = kBeam_m + kDivergence_rad * range_m;
  return 0.25 * kPi * diameter_m * diameter_m;
}

/// Diameter of the smallest detectable drop at that range.
double AirEchoes::LeastDrop_m(double range_m) const {
  const double least_echo = limits_.least_power * range_m * range_m;
  const double two_way = std::exp(-2 * extinction_1pm_ * range_m);
  return std::sqrt(2 * kDropRatio_sr * BeamArea_m2(range_m) * least_echo / (kPi * kPi * two_way));
}

void AirEchoes::FindDrops() {
  const Rain rain(rain_mmph_);
  const double end_m = std::min(limits_.max_range_m, kFarthestDrop_m);
  double sum = 0;
  for (double r_m = 0; r_m < end_m; r_m += kDropStep_m) {
    drops_before_.push_back(sum);
    const double middle_m = r_m + 0.5 * kDropStep_m;
    if (middle_m < limits_.min_range_m) continue;
    const double least_m = LeastDrop_m(middle_m);
    if (least_m > Rain::kLargest_m) break;
    sum += BeamArea_m2(middle_m) * rain.CountAbove_1pm3(least_m) * kDropStep_m;
  }
  drops_before_.push_back(sum);
}

void AirEchoes::MeetDust(const Ray& ray, double range_m, std::uint64_t number,
                         Passage* passage) const {
  const Vec3 origin_W_m = ray.origin_W_m.cast<double>(), unit_W = ray.direction_W.cast<double>();
  const DustySpan span = SpanOf(*dust_, origin_W_m, unit_W, range_m);
  if (span.from_m >= span.to_m) return;
  const double step_m = MarchStep_m(*dust_);
  double depth = 0;
  double r_m = span.from_m + step_m * draws_.Uniform(number, kStart);
  // A random first step keeps the ranges of returns off a lattice.
  double length_m = r_m - span.from_m;
  for (double from_m = span.from_m; from_m < span.to_m;
       from_m += length_m, length_m = std::min(step_m, span.to_m - from_m)) {
    r_m = from_m + 0.5 * length_m;
    const double extinction_1pm = dust_->Extinction_1pm(origin_W_m + r_m * unit_W);
    const double passed = depth + 0.5 * extinction_1pm * length_m;
    depth += extinction_1pm * length_m;
    if (r_m < limits_.min_range_m) continue;
    const Echo echo{r_m,
                    kPi * extinction_1pm / DustVolume::kLidarRatio_sr * kPulse_m *
                        std::exp(-2 * (passed + extinction_1pm_ * r_m)),
                    SemanticClass::kDust};
    const double least = passage->echo ? passage->echo->power() : limits_.least_power;
    if (echo.power() > least) passage->echo = echo;
  }
  passage->two_way *= std::exp(-2 * depth);
}

void AirEchoes::MeetDrop(const Ray& ray, double range_m, std::uint64_t number,
                         Passage* passage) const {
  if (drops_before_.empty()) return;
  const double met = -std::log(draws_.Uniform(number, kDrop));
  const auto after = std::upper_bound(drops_before_.begin(), drops_before_.end(), met);
  if (after == drops_before_.end() || after == drops_before_.begin()) return;
  const auto step = static_cast<double>(after - drops_before_.begin() - 1);
  const double share = (met - *(after - 1)) / (*after - *(after - 1));
  const double r_m = (step + share) * kDropStep_m;
  if (r_m >= range_m) return;
  const double diameter_m =
      Rain(rain_mmph_).DiameterAt(LeastDrop_m(r_m), draws_.Uniform(number, kSize));
  const double dust = dust_ ? OpticalDepth(*dust_, ray.origin_W_m.cast<double>(),
                                           ray.direction_W.cast<double>(), r_m)
                            : 0;
  const Echo echo{r_m,
                  kPi * kPi * diameter_m * diameter_m / (2 * kDropRatio_sr * BeamArea_m2(r_m)) *
                      std::exp(-2 * (extinction_1pm_ * r_m + dust)),
                  SemanticClass::kRain};
  if (echo.power() <= limits_.least_power) return;
  if (!passage->echo || echo.power() > passage->echo->power()) passage->echo = echo;
}

AirEchoes::Passage AirEchoes::Along(const Ray& ray, double range_m, std::uint64_t number) const {
  Passage passage;
  passage.two_way = std::exp(-2 * extinction_1pm_ * range_m);
  if (dust_ != nullptr) MeetDust(ray, range_m, number, &passage);
  MeetDrop(ray, range_m, number, &passage);
  if (limits_.least_power <= 0) passage.echo.reset();
  return passage;
}

}  // namespace tera
