#include "diagnose/perception/scene/scene_mechanisms.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/check.h"

namespace tera {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

std::vector<EffectParameter> HeightParameters() {
  return {{"area_m2", "m2", 0, kAny},
          {"volume_m3", "m3", -kAny, kAny},
          {"mean_m", "m", -kAny, kAny},
          {"lowest_m", "m", -kAny, kAny},
          {"highest_m", "m", -kAny, kAny}};
}

std::vector<Mechanism> All() {
  return {{"terrain_height", Slot::kGround, {}, HeightParameters()},
          {"object_added", Slot::kScene, {}, HeightParameters()},
          {"object_missing", Slot::kScene, {}, {{"share", "1", 0, 1}, {"rays", "1", 0, kAny}}},
          {"dust",
           Slot::kScene,
           {},
           {{"returns", "1", 0, kAny}, {"stopped_share", "1", 0, 1}, {"top_m", "m", -kAny, kAny}}}};
}

}  // namespace

std::span<const Mechanism> SceneMechanisms() {
  static const std::vector<Mechanism> mechanisms = All();
  return mechanisms;
}

const Mechanism& SceneMechanism(std::string_view id) {
  const auto found = std::find_if(SceneMechanisms().begin(), SceneMechanisms().end(),
                                  [&](const Mechanism& one) { return one.id == id; });
  TERA_CHECK(found != SceneMechanisms().end(), id);
  return *found;
}

}  // namespace tera
