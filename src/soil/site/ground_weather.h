#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/time.h"
#include "soil/columns/columns.h"
#include "soil/site/seepage.h"

namespace tera {

/// Water in the ground under steady rain and evaporation during a run. It depends on time alone,
/// because rain is uniform over the site. A copy continues from the same state.
///
/// Model   Every ten seconds the water of each profile seeps on (Seepage). Every minute the columns
///         take it over. The visible surface has the moisture of the uppermost slice. Under rain,
///         it has at least the moisture of the uppermost 2 mm. These fill up to the moisture at
///         which the rain passes through.
/// Omits   Water that runs or stands on the surface; frost. Profiles with the same soil at the
///         surface look like the first of them.
class GroundWeather {
 public:
  /// `weather` gives the rates; its hours are ignored. `is_wet` means that it has already rained on
  /// the surface.
  GroundWeather(const WeatherSpell& weather, bool is_wet, const Columns& ground);

  /// Advances to a time since the start. True if the water has changed.
  bool Advance(TimeNs since_start_ns);
  /// Visible moisture of the surface, by visible soil.
  std::vector<TerrainSurface::Wetness> wetness() const;
  /// Water to pass to the columns. Empty if the last call was less than a minute ago.
  std::optional<Columns::Water> TakeWater();

 private:
  double Seen(const Seepage& seepage) const;

  WeatherSpell weather_;
  bool is_wet_;
  SoilKinds kinds_;
  std::vector<Seepage> seeping_;  ///< one for each profile, then for soils at no profile's surface
  std::size_t profile_count_ = 0;
  std::vector<std::size_t> seepage_of_;  ///< for each visible soil: index into seeping_
  /// water in the slices of each profile at the last TakeWater
  std::vector<std::vector<double>> taken_m_;
  std::int64_t periods_ = 0, taken_periods_ = 0;
};

}  // namespace tera
