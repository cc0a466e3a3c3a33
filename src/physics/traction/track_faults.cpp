#include "physics/traction/track_faults.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "physics/traction/track_drive.h"

namespace tera {

std::vector<EffectFault> FaultsOfSlips(const MachineModel& model) {
  std::vector<std::string_view> slips;
  for (const std::string_view id : {"track_slip", "slope_slip", "rolling_resistance"}) {
    if (FindEffect(model.effects.base, id)) slips.push_back(id);
  }
  if (slips.empty() || TrackDrive(model).MovesOnLevelGround()) return {};
  return {{slips.back(),
           fmt::format("leaves nothing of the tracks' speed on level ground, so that the machine "
                       "never moves; need slips of {} below 1 in sum, or more friction",
                       fmt::join(slips, ", "))}};
}

}  // namespace tera
