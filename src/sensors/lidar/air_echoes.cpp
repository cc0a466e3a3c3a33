#include "sensors/lidar/air_echoes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/units.h"
#include "render/air/dust_volume.h"
#include "render/air/weather.h"

namespace tera {
namespace {

constexpr double kUsualPulse_m = 0.75;  ///< of 5 ns
constexpr double kLight_mps = 299792458;
constexpr double kStep_m = 0.05;
constexpr double kFarthestParticle_m = 40;
// Lanes of the random draws. A kind of particle has two.
constexpr std::uint32_t kStart = 0, kDrop = 1, kFlake = 3, kFogStart = 5, kFogNoise = 6;

}  // namespace

double PulseLength_m(const std::optional<LidarBeam>& beam) {
  return beam ? 0.5 * kLight_mps * beam->pulse_s : kUsualPulse_m;
}

AirEchoes::AirEchoes(const RangeEquation& equation, const Ranges& ranges, const SensedAir& air,
                     const Stream& draws)
    : equation_(equation),
      ranges_(ranges),
      dust_(air.dust != nullptr && !air.dust->occupied_W_m.isEmpty() ? air.dust : nullptr),
      draws_(draws) {
  const double fog_1pm = FogExtinction_1pm(air.visibility_m);
  const Rain rain(air.rain_mmph);
  const Snowfall snow(air.snowfall_mmph);
  extinction_1pm_ = fog_1pm + rain.Extinction_1pm() + snow.Extinction_1pm();
  if (!equation_.limits()) return;
  fog_reflectance_ = kPi * FogBackscatter_1pmsr(fog_1pm) * ranges_.pulse_m;
  if (rain.Extinction_1pm() > 0) Meet(rain, Rain::kLidarRatio_sr, kDrop);
  if (snow.Extinction_1pm() > 0) Meet(snow, Snowfall::kLidarRatio_sr, kFlake);
}

double AirEchoes::LeastDiameter_m(const Falling& falling, double range_m) const {
  const double two_way = std::exp(-2 * extinction_1pm_ * range_m);
  const double least = equation_.LeastAir(range_m) / two_way;
  const double area_m2 = equation_.BeamArea_m2(range_m);
  return std::sqrt(2 * falling.ratio_sr * area_m2 * least) / (kPi * falling.sizes.swelling());
}

void AirEchoes::Meet(FallingParticles sizes, double ratio_sr, std::uint32_t lane) {
  Falling falling{sizes, ratio_sr, lane, {}};
  const double end_m = std::min(ranges_.max_m, kFarthestParticle_m);
  double sum = 0;
  for (double r_m = 0; r_m < end_m; r_m += kStep_m) {
    falling.before.push_back(sum);
    const double middle_m = r_m + 0.5 * kStep_m;
    if (middle_m < ranges_.min_m) continue;
    const double least_m = LeastDiameter_m(falling, middle_m);
    if (least_m > FallingParticles::kLargest_m) break;
    sum += equation_.BeamArea_m2(middle_m) * sizes.CountAbove_1pm3(least_m) * kStep_m;
  }
  falling.before.push_back(sum);
  falling_.push_back(std::move(falling));
}

double AirEchoes::DustDepth(const Ray& ray, double range_m) const {
  if (dust_ == nullptr) return 0;
  return OpticalDepth(*dust_, ray.origin_W_m.cast<double>(), ray.direction_W.cast<double>(),
                      range_m);
}

double AirEchoes::TwoWay(const Ray& ray, double range_m) const {
  return std::exp(-2 * (extinction_1pm_ * range_m + DustDepth(ray, range_m)));
}

void AirEchoes::AddDust(const Ray& ray, double range_m, std::uint64_t number,
                        std::vector<Echo>* echoes) const {
  const Vec3 origin_W_m = ray.origin_W_m.cast<double>(), unit_W = ray.direction_W.cast<double>();
  const DustySpan span = SpanOf(*dust_, origin_W_m, unit_W, range_m);
  if (span.from_m >= span.to_m) return;
  const double step_m = MarchStep_m(*dust_);
  double depth = 0;
  Echo strongest;
  // A random first step keeps the ranges of returns off a lattice.
  double length_m = step_m * draws_.Uniform(number, kStart);
  for (double from_m = span.from_m; from_m < span.to_m;
       from_m += length_m, length_m = std::min(step_m, span.to_m - from_m)) {
    const double r_m = from_m + 0.5 * length_m;
    const double extinction_1pm = dust_->Extinction_1pm(origin_W_m + r_m * unit_W);
    const double passed = depth + 0.5 * extinction_1pm * length_m;
    depth += extinction_1pm * length_m;
    if (r_m < ranges_.min_m) continue;
    const double reflectance = kPi * extinction_1pm / DustVolume::kLidarRatio_sr * ranges_.pulse_m *
                               std::exp(-2 * (passed + extinction_1pm_ * r_m));
    const double power = equation_.Power(reflectance, r_m);
    if (reflectance > equation_.LeastAir(r_m) && power > strongest.power) {
      strongest = {r_m, power, SemanticClass::kDust, 0, true};
    }
  }
  if (strongest.power > 0) echoes->push_back(strongest);
}

void AirEchoes::AddFog(const Ray& ray, double range_m, std::uint64_t number,
                       std::vector<Echo>* echoes) const {
  const double noise = equation_.LeastPower() / kThresholdToNoise;
  double r_m = ranges_.min_m + draws_.Uniform(number, kFogStart) * ranges_.pulse_m;
  Echo strongest;
  for (std::uint32_t lane = kFogNoise; r_m < range_m; r_m += ranges_.pulse_m, ++lane) {
    const double two_way = std::exp(-2 * extinction_1pm_ * r_m);
    const double reflectance = fog_reflectance_ * two_way;
    // Beyond, the signal is weaker still.
    if (reflectance < 0.5 * equation_.LeastAir(r_m)) break;
    const double power = equation_.Power(reflectance, r_m) + noise * draws_.Gaussian(number, lane);
    if (power < equation_.Power(equation_.LeastAir(r_m), r_m) || power <= strongest.power) continue;
    strongest = {r_m, power, SemanticClass::kRain, 0, true};
  }
  if (strongest.power <= 0) return;
  strongest.power *= std::exp(-2 * DustDepth(ray, strongest.range_m));
  echoes->push_back(strongest);
}

void AirEchoes::AddParticle(const Falling& falling, const Ray& ray, double range_m,
                            std::uint64_t number, std::vector<Echo>* echoes) const {
  const std::vector<double>& before = falling.before;
  const double met = -std::log(draws_.Uniform(number, falling.lane));
  const auto after = std::upper_bound(before.begin(), before.end(), met);
  if (after == before.end() || after == before.begin()) return;
  const auto step = static_cast<double>(after - before.begin() - 1);
  const double share = (met - *(after - 1)) / (*after - *(after - 1));
  const double r_m = (step + share) * kStep_m;
  if (r_m >= range_m) return;
  const double diameter_m =
      falling.sizes.swelling() * falling.sizes.DiameterAt(LeastDiameter_m(falling, r_m),
                                                          draws_.Uniform(number, falling.lane + 1));
  const double reflectance = kPi * kPi * diameter_m * diameter_m /
                             (2 * falling.ratio_sr * equation_.BeamArea_m2(r_m)) * TwoWay(ray, r_m);
  if (reflectance <= equation_.LeastAir(r_m)) return;
  echoes->push_back({r_m, equation_.Power(reflectance, r_m), SemanticClass::kRain, 0, true});
}

void AirEchoes::Add(const Ray& ray, double range_m, std::uint64_t number,
                    std::vector<Echo>* echoes) const {
  if (!equation_.limits()) return;
  if (dust_ != nullptr) AddDust(ray, range_m, number, echoes);
  if (fog_reflectance_ > 0) AddFog(ray, range_m, number, echoes);
  for (const Falling& falling : falling_) AddParticle(falling, ray, range_m, number, echoes);
}

}  // namespace tera
