#include "soil/site/site.h"

#include "soil/site/site_plan.h"

namespace tera {

Site Site::Read(const ConfigMap& config, std::uint64_t seed,
                const std::optional<GivenGround>& given) {
  const SitePlan plan = ReadSite(config, seed, given);
  return {BuildColumns(plan), plan.georeference, plan.has_weather_before};
}

bool Site::LetWeatherAct(const WeatherSpell& weather, bool is_wet) {
  if (!columns_.AddHiddenKinds()) return false;
  weather_.emplace(weather, is_wet, columns_);
  columns_.SetWetness(weather_->wetness());
  return true;
}

}  // namespace tera
