#include "soil/site/seepage.h"

#include <algorithm>
#include <cmath>

#include "soil/columns/soil_water.h"

namespace tera {
namespace {

constexpr double kSlice_m = 0.1, kDeepest_m = 2;
constexpr double kLongestStep_s = 60, kCourant = 0.25;
constexpr double kFieldSuction_m = 3.37;  ///< suction at field capacity, 33 kPa
constexpr double kFreely = 0.75;          ///< share of the field capacity
constexpr double kOneStratum = 0.03;  ///< slices with a smaller difference in moisture are merged

std::vector<WaterSlice> SlicesOf(const GroundProfile& profile, const std::vector<SoilType>& soils) {
  std::vector<WaterSlice> slices;
  double top_m = 0;
  for (const Stratum& stratum : profile.strata()) {
    if (top_m >= kDeepest_m) break;
    const double bottom_m = std::min(stratum.bottom_m, kDeepest_m);
    const int count = static_cast<int>(std::ceil((bottom_m - top_m) / kSlice_m - 1e-9));
    const double thickness_m = (bottom_m - top_m) / count;
    const auto moisture = static_cast<double>(stratum.moisture);
    const double capacity_m = thickness_m * Porosity(stratum.density_kgpm3, moisture);
    for (int n = 0; n < count; ++n) {
      slices.push_back(
          {stratum, soils[stratum.soil].water, thickness_m, capacity_m, moisture * capacity_m});
    }
    top_m = bottom_m;
  }
  return slices;
}

/// Water that can leave a slice.
double Mobile_m(const WaterSlice& slice) {
  return std::max(0.0, slice.water_m - slice.water.residual * slice.capacity_m);
}

}  // namespace

Seepage::Seepage(const std::vector<SoilType>& soils, const GroundProfile& profile)
    : before_(profile), slices_(SlicesOf(profile, soils)), step_s_(kLongestStep_s) {
  for (const WaterSlice& slice : slices_) {
    const double most_mps = slice.water.conductivity_mps;
    if (most_mps > 0 && slice.capacity_m > 0)
      step_s_ = std::min(step_s_, kCourant * slice.capacity_m / most_mps);
  }
}

void Seepage::Run(const WeatherSpell& weather, double duration_s) {
  const auto count = static_cast<std::int64_t>(std::ceil(duration_s / step_s_));
  const double dt_s = duration_s / static_cast<double>(count);
  for (std::int64_t k = 0; k < count; ++k) {
    Step(weather.rain_mps() * dt_s, weather.evaporation_mps() * dt_s, dt_s);
  }
}

void Seepage::Step(double rain_m, double evaporation_m, double dt_s) {
  WaterSlice& top = slices_.front();
  if (const SoilWater& water = top.water; water.holds() && evaporation_m > 0) {
    const double freely = kFreely * (MoistureAt(water, kFieldSuction_m) - water.residual);
    const double share = std::min(1.0, (top.moisture() - water.residual) / freely);
    const double gone_m = std::min(Mobile_m(top), std::max(0.0, share) * evaporation_m);
    top.water_m -= gone_m;
    balance_.evaporated_m += gone_m;
    balance_.stored_m -= gone_m;
  }
  for (WaterSlice& slice : slices_) {
    slice.out_m = std::min(Mobile_m(slice), Conductivity_mps(slice.water, slice.moisture()) * dt_s);
  }
  const auto room_m = [](const WaterSlice& slice) {
    return std::max(0.0, slice.capacity_m - slice.water_m + slice.out_m);
  };
  for (std::size_t n = slices_.size() - 1; n > 0; --n) {
    const bool takes = slices_[n].water.holds();
    slices_[n - 1].out_m = takes ? std::min(slices_[n - 1].out_m, room_m(slices_[n])) : 0;
  }
  double in_m = top.water.holds() ? std::min(rain_m, room_m(top)) : 0;
  balance_.rained_m += rain_m;
  balance_.ran_off_m += rain_m - in_m;
  balance_.stored_m += in_m;
  for (WaterSlice& slice : slices_) {
    slice.water_m += in_m - slice.out_m;
    in_m = slice.out_m;
  }
  balance_.drained_m += in_m;
  balance_.stored_m -= in_m;
}

GroundProfile Seepage::Profile() const {
  std::vector<Stratum> strata;
  double bottom_m = 0;
  for (std::size_t n = 0; n < slices_.size();) {
    WaterSlice joined = slices_[n];
    const double first = joined.moisture();
    std::size_t next = n + 1;
    for (; next < slices_.size() && slices_[next].soil.bottom_m == joined.soil.bottom_m &&
           std::abs(slices_[next].moisture() - first) < kOneStratum;
         ++next) {
      joined.thickness_m += slices_[next].thickness_m;
      joined.capacity_m += slices_[next].capacity_m;
      joined.water_m += slices_[next].water_m;
    }
    const double was_m = static_cast<double>(joined.soil.moisture) * joined.capacity_m;
    bottom_m += joined.thickness_m;
    Stratum stratum = joined.soil;
    stratum.density_kgpm3 += kWater_kgpm3 * (joined.water_m - was_m) / joined.thickness_m;
    stratum.moisture = static_cast<float>(joined.moisture());
    const bool ends_stratum =
        next == slices_.size() || slices_[next].soil.bottom_m != joined.soil.bottom_m;
    stratum.bottom_m = ends_stratum ? std::min(joined.soil.bottom_m, kDeepest_m) : bottom_m;
    bottom_m = stratum.bottom_m;
    strata.push_back(stratum);
    n = next;
  }
  for (const Stratum& stratum : before_.strata()) {
    if (stratum.bottom_m > kDeepest_m) strata.push_back(stratum);
  }
  return GroundProfile(strata);
}

WaterBalance Seep(const std::vector<WeatherSpell>& weather, const std::vector<SoilType>& soils,
                  GroundProfile* profile) {
  Seepage seepage(soils, *profile);
  for (const WeatherSpell& spell : weather) seepage.Run(spell, spell.duration_s());
  *profile = seepage.Profile();
  return seepage.balance();
}

std::vector<WeatherSpell> ReadWeatherBefore(const ConfigMap& config) {
  constexpr double kLongest_h = 1000;
  std::vector<WeatherSpell> weather;
  for (const ConfigMap& item : config.List("weather_before")) {
    weather.push_back(
        {item.Number("hours", {.min = 0, .max = kLongest_h, .min_excluded = true, .unit = "h"}),
         item.Number("rain_mmph", Between(0, kMostRain_mmph, "mm/h"), 0.0),
         item.Number("evaporation_mmpd", Between(0, kMostEvaporation_mmpd, "mm a day"), 0.0)});
  }
  return weather;
}

GroundProfile OfKinds(const SoilKinds& kinds, const GroundProfile& profile) {
  std::vector<Stratum> strata = profile.strata();
  for (Stratum& stratum : strata) {
    stratum.soil = kinds.At(stratum.soil, static_cast<double>(stratum.moisture));
  }
  return GroundProfile(strata);
}

bool Wet(const std::vector<WeatherSpell>& weather, SoilKinds* kinds,
         std::vector<GroundProfile>* profiles) {
  for (GroundProfile& profile : *profiles) {
    Seep(weather, kinds->soils(), &profile);
    for (const Stratum& stratum : profile.strata()) {
      if (!kinds->Add(stratum.soil, static_cast<double>(stratum.moisture))) return false;
    }
    profile = OfKinds(*kinds, profile);
  }
  return true;
}

}  // namespace tera
