#include "soil/site/site.h"

#include "soil/site/site_plan.h"

namespace tera {

Site Site::Read(const ConfigMap& config, std::uint64_t seed,
                const std::optional<GivenGround>& given) {
  const SitePlan plan = ReadSite(config, seed, given);
  return {BuildColumns(plan), plan.georeference};
}

}  // namespace tera
