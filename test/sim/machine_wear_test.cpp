#include "sim/machine_wear.h"

#include <gtest/gtest.h>

#include "core/config/config.h"
#include "sim/scenario/scenario.h"
#include "sim/scenario/scenario_text.h"

namespace tera {
namespace {

Scenario MachineWearExcavator() {
  const Config config = Config::FromText(std::string(kSite) + kExcavator, "s.yaml", {});
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

double FromSoil_m(const NodeWear& wear, const Vec3& p_B_m) {
  return wear.from_soil_normal_B.dot(p_B_m) + wear.from_soil_offset_m;
}

TEST(MachineWear, IsAsFarFromTheSoilAsThePartIs) {
  const Scenario scenario = MachineWearExcavator();
  const MachineModel& machine = scenario.machines[0].placement.model;
  const Wear wear{.mud = 1};
  const Vec3 soil(0.2, 0.15, 0.1);
  const std::vector<NodeWear> worn = WearOfLinks(machine, wear, soil);
  const auto of = [&](const char* link) { return worn[machine.LinkIndex(link)]; };
  // tb235: the undercarriage's origin is on the ground, the slew bearing 0.56 m above it.
  EXPECT_NEAR(FromSoil_m(of("undercarriage"), Vec3(0.5, 0.2, 0.3)), 0.3, 0.02);
  EXPECT_NEAR(FromSoil_m(of("upper"), Vec3(-1, 0.2, 0.9)), 1.46, 0.02);
  // The arm's pins are 1.545 m apart.
  EXPECT_NEAR(FromSoil_m(of("arm"), Vec3::Zero()), 1.545, 1e-9);
  EXPECT_NEAR(FromSoil_m(of("arm"), Vec3(1.545, 0, 0)), 0, 1e-9);
  EXPECT_EQ(FromSoil_m(of("bucket"), Vec3(0.3, 0, 0.1)), 0);
  ASSERT_TRUE(of("bucket").edge_B_m);
  EXPECT_EQ(*of("bucket").edge_B_m, machine.ground_tools.shovels[0].profile_B_m.front());
  EXPECT_FALSE(of("upper").edge_B_m);
  EXPECT_EQ(of("boom").wear, wear);
  EXPECT_EQ(of("boom").soil_albedo, soil);
}

TEST(MachineWear, ItsColourIsOfTheSoilAtThePlace) {
  const Config config = Config::FromText(R"(
name: test
duration_s: 1
terrain: {size_m: [20, 20], cell_m: 0.1, soils: [dirt, sand], soil: dirt,
          regions: [{outline_m: [[2, -9], [9, -9], [9, 9], [2, 9]], soil: sand}]}
)" + std::string(kExcavator),
                                         "s.yaml", {});
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  const std::vector<SoilType>& soils = scenario.site->soils();
  EXPECT_EQ(SoilAlbedoAt(*scenario.site, Vec2(-5, 3)), soils[0].albedo);
  EXPECT_EQ(SoilAlbedoAt(*scenario.site, Vec2(6, 3)), soils[1].albedo);
  EXPECT_EQ(SoilAlbedoAt(*scenario.site, Vec2(-500, 0)), soils[0].albedo) << "beyond the site";
}

}  // namespace
}  // namespace tera
