#include "soil/site/ground_weather.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "soil/columns/soil_type.h"
#include "soil/columns/soil_water.h"

namespace tera {
namespace {

constexpr int kPeriod_s = 10;
constexpr TimeNs kPeriod_ns = kPeriod_s * kNsPerSecond;
constexpr std::int64_t kPeriodsPerTake = 6;
constexpr double kSeen_m = 0.002;  ///< depth of the layer that makes a surface look wet

/// Moisture at which a soil conducts water at a rate; 1 if it never does.
double MoisturePassing(const SoilWater& water, double rate_mps) {
  constexpr int kHalvings = 40;
  double low = water.residual, high = 1;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (Conductivity_mps(water, middle) < rate_mps ? low : high) = middle;
  }
  return high;
}

std::uint8_t Byte(double share) { return static_cast<std::uint8_t>(std::lround(255 * share)); }

}  // namespace

GroundWeather::GroundWeather(const WeatherSpell& weather, bool is_wet, const Columns& ground)
    : weather_(weather),
      is_wet_(is_wet),
      kinds_(ground.kinds()),
      profile_count_(ground.profiles().size()) {
  const std::vector<SoilType>& soils = kinds_.soils();
  std::vector<std::optional<std::size_t>> showing(kinds_.shown_count());
  for (const GroundProfile& profile : ground.profiles()) {
    std::optional<std::size_t>& first = showing[profile.strata().front().soil];
    if (!first) first = seeping_.size();
    taken_m_.emplace_back();
    for (const WaterSlice& slice : seeping_.emplace_back(soils, profile).slices()) {
      taken_m_.back().push_back(slice.water_m);
    }
  }
  for (std::size_t soil = 0; soil < showing.size(); ++soil) {
    if (!showing[soil]) {
      showing[soil] = seeping_.size();
      const Stratum heap{std::numeric_limits<double>::infinity(), static_cast<std::uint8_t>(soil),
                         static_cast<float>(soils[soil].moisture), LooseDensity_kgpm3(soils[soil])};
      seeping_.emplace_back(soils, GroundProfile({heap}));
    }
    seepage_of_.push_back(*showing[soil]);
  }
}

bool GroundWeather::Advance(TimeNs since_start_ns) {
  const std::int64_t due = since_start_ns / kPeriod_ns;
  if (periods_ >= due) return false;
  for (; periods_ < due; ++periods_) {
    for (Seepage& seepage : seeping_) seepage.Run(weather_, kPeriod_s);
  }
  return true;
}

/// Visible moisture of the surface.
double GroundWeather::Seen(const Seepage& seepage) const {
  const WaterSlice& top = seepage.slices().front();
  const double net_mps = weather_.rain_mps() - weather_.evaporation_mps();
  if (net_mps <= 0 || !top.water.holds() || top.capacity_m <= 0) return top.moisture();
  const double most = MoisturePassing(top.water, net_mps);
  if (is_wet_) return std::max(top.moisture(), most);
  const double fallen_m = net_mps * kPeriod_s * static_cast<double>(periods_);
  const double wetted = static_cast<double>(top.soil.moisture) +
                        fallen_m / (kSeen_m * top.capacity_m / top.thickness_m);
  return std::max(top.moisture(), std::min(most, wetted));
}

std::vector<TerrainSurface::Wetness> GroundWeather::wetness() const {
  std::vector<TerrainSurface::Wetness> wetness;
  for (const std::size_t n : seepage_of_) {
    const std::uint8_t first =
        Byte(static_cast<double>(seeping_[n].slices().front().soil.moisture));
    const std::uint8_t now = Byte(Seen(seeping_[n]));
    TerrainSurface::Wetness& bounds = wetness.emplace_back();
    if (now > first) bounds.least = now;
    if (now < first) bounds.most = now;
  }
  return wetness;
}

std::optional<Columns::Water> GroundWeather::TakeWater() {
  if (periods_ < taken_periods_ + kPeriodsPerTake) return std::nullopt;
  taken_periods_ = periods_ - periods_ % kPeriodsPerTake;
  Columns::Water water;
  for (std::size_t n = 0; n < profile_count_; ++n) {
    water.profiles.push_back(OfKinds(kinds_, seeping_[n].Profile()));
    std::vector<Columns::Gained>& gained = water.gained.emplace_back();
    double bottom_m = 0;
    for (std::size_t k = 0; k < taken_m_[n].size(); ++k) {
      const WaterSlice& slice = seeping_[n].slices()[k];
      bottom_m += slice.thickness_m;
      gained.push_back({bottom_m, slice.water_m - taken_m_[n][k]});
      taken_m_[n][k] = slice.water_m;
    }
  }
  return water;
}

}  // namespace tera
