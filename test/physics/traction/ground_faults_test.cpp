#include "physics/traction/ground_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "physics/machine_fixture.h"
#include "physics/traction/ground_mechanisms.h"

// Effects of the base without any action: the machine lacks the part they act through.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// "track_scale ...; side_slip ...", of the dozer.
std::string OfDozer(const std::vector<std::string>& overrides, bool shovels) {
  MachineModel model = ShippedMachine("dozer", overrides);
  if (!shovels) model.ground_tools.shovels.clear();
  const Config config = Config::FromText(
      "{track_scale: {scale: 1.1}, side_slip: {drift_per_slope: 0.1}, soil_strength: {}, "
      "terrain_height: {x_m: 0, y_m: 0, radius_m: 1, height_m: 0.1}, "
      "digging_force: {yield_mps: 1}}",
      "effects.yaml");
  model.effects.base = ReadEffects(config.root(), EffectTarget::kBase, GroundMechanisms());
  std::string text;
  for (const EffectFault& fault : FaultsOfBase(model)) {
    text += std::string(fault.mechanism) + " " + fault.finding + "; ";
  }
  return text;
}

TEST(GroundFaults, TheBaseNeedsADrivenTrackAndForDiggingATool) {
  EXPECT_THAT(OfDozer({}, true), IsEmpty());
  EXPECT_THAT(OfDozer({"levers=[lift, tilt]"}, false),
              AllOf(HasSubstr("track_scale changes how"), HasSubstr("side_slip changes how"),
                    HasSubstr("digging_force drags the base by its tools"),
                    Not(HasSubstr("soil_strength")), Not(HasSubstr("terrain_height"))));
}

}  // namespace
}  // namespace tera
