#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/time.h"
#include "soil/columns/columns.h"
#include "soil/site/seepage.h"

namespace tera {

/// The ground's water under steady rain and evaporation during a run. It is a function of time
/// alone, since rain falls alike everywhere. Copies go on from the same state.
///
/// Model   Every ten seconds the water of each profile seeps on (Seepage); every minute the ground
///         takes it over. The surface looks as wet as its slice, and as its upper 2 mm while they
///         fill with rain, up to the moisture at which the rain passes through.
/// Omits   water that runs or stands on the surface; frost. Ground of one soil at the surface looks
///         as that of the first profile with it.
class GroundWeather {
 public:
  /// Weather as in a spell, whose hours do not count. The surface `is_wet` from the start, if it
  /// has rained already.
  GroundWeather(const WeatherSpell& weather, bool is_wet, const Columns& ground);

  /// Goes on to a time since the start; true if that brings anything new.
  bool Advance(TimeNs since_start_ns);
  /// How the surface looks, by the soil that is shown.
  std::vector<TerrainSurface::Wetness> wetness() const;
  /// The water that the ground takes over, once each.
  std::optional<Columns::Water> TakeWater();

 private:
  double Seen(const Seepage& seepage) const;

  WeatherSpell weather_;
  bool is_wet_;
  SoilKinds kinds_;
  std::vector<Seepage> seeping_;  ///< of each profile, then of soils that no profile shows
  std::size_t profile_count_ = 0;
  std::vector<std::size_t> seepage_of_;       ///< of each soil that is shown
  std::vector<std::vector<double>> taken_m_;  ///< water in each profile's slices, as last taken
  std::int64_t periods_ = 0, taken_periods_ = 0;
};

}  // namespace tera
