#include "physics/traction/ground_faults.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "physics/traction/track_drive.h"

namespace tera {

std::vector<EffectFault> FaultsOfBase(const MachineModel& model) {
  std::vector<EffectFault> faults;
  const GroundTools& tools = model.ground_tools;
  bool driven = false;
  for (std::size_t g = 0; g < tools.gears.size(); ++g) {
    driven = driven || WhyGearUndriven(model, g).empty();
  }
  for (const Effect& effect : model.effects.base) {
    const std::string_view id = effect.mechanism->id;
    if (id == "soil_strength" || id == "terrain_height") continue;  // acts on the ground
    if (id == "digging_force") {
      if (tools.shovels.empty()) {
        faults.push_back({id, "drags the base by its tools, of which it has none; need shovels"});
      }
    } else if (!driven) {
      faults.push_back({id,
                        "changes how tracks or wheels move the machine, but none is driven; "
                        "need one with a lever, a speed and a torque"});
    }
  }
  return faults;
}

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
