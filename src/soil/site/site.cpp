#include "soil/site/site.h"

#include "soil/site/site_plan.h"

namespace tera {

Site Site::Read(const ConfigMap& config, std::uint64_t seed) {
  const SitePlan plan = ReadSite(config, seed);
  return {BuildColumns(plan), plan.georeference};
}

}  // namespace tera
