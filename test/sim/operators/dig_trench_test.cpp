#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/config/config.h"
#include "core/units.h"
#include "sim/operators/dig_cycle.h"
#include "sim/operators/operator_plan.h"
#include "sim/operators/planar_arm.h"

/// The digging operator along a trench, on a machine that nothing moves.

namespace tera {
namespace {

constexpr double kPatience_s = 0.05;

/// A machine at the first stand of a trench of 0.6 x 0.4 m, on level ground at `ground_m`. Its tip
/// is held at radius 4.3 m and at `tip_m` above the ground.
class HeldDigger {
 public:
  HeldDigger(double ground_m, double tip_m)
      : model_(Compact()),
        plan_(Plan(model_)),
        ground_(kGrid, TerrainGrid::kTileCells,
                std::vector<float>(kBaseVertices * kBaseVertices, static_cast<float>(ground_m)),
                std::vector<TerrainSurface::Cover>(kGrid.tile_count())) {
    const PlanarArm::Joints& joints = plan_.joints;
    const Vec3 slew_m = model_.joints[joints.slew].X_PJ.translation();
    state_.links.resize(model_.links.size());
    for (BodyState& link : state_.links) link.X_WB.translation().z() = ground_m;
    state_.q_rad.resize(model_.joints.size());
    state_.qd_radps.resize(model_.joints.size());
    const auto angles =
        PlanarArm(model_, joints, plan_.tip_frame).Inverse({4.3, tip_m - slew_m.z(), -75 * kDeg});
    state_.q_rad[joints.boom] = angles.value().boom_rad;
    state_.q_rad[joints.arm] = angles->arm_rad;
    state_.q_rad[joints.bucket] = angles->bucket_rad;

    TrenchPlan trench;
    trench.tracks = plan_.tracks;
    trench.bucket_m = 0.6;
    trench.near_m = 2.4;
    trench.far_m = 4.4;
    const Vec2 axis_m = slew_m.head<2>(), side_m(0, 0.3);
    const Vec2 from_m = axis_m + Vec2(4.25, 0), to_m = axis_m - Vec2(1.75, 0);
    trench.task.trench = TrenchLine{from_m, to_m, 0.6, 0.4};
    trench.task.design = {
        .corners_W_m = {from_m + side_m, to_m + side_m, to_m - side_m, from_m - side_m},
        .at_W_m = from_m,
        .floor_m = ground_m - 0.4};
    plan_.trench = trench;
  }

  const std::string& LeverName(std::size_t lever) const { return model_.levers[lever].name; }
  std::unique_ptr<DigCycle> Digger() const { return std::make_unique<DigCycle>(model_, plan_); }
  std::vector<double> Levers(DigCycle* digger, double t_s) const {
    return digger->Levers({FromSeconds(t_s), model_, state_, ground_});
  }
  /// When it first slews, within a minute; nothing if it does not.
  std::optional<double> FirstSlew_s() const {
    const auto slew = std::ranges::find(model_.levers, plan_.joints.slew, &Lever::joint);
    const auto digger = Digger();
    for (int step = 0; step < 6000; ++step) {
      const std::vector<double> levers = Levers(digger.get(), 0.01 * step);
      if (std::abs(levers[slew - model_.levers.begin()]) > 0.4) return 0.01 * step;
    }
    return std::nullopt;
  }

 private:
  static constexpr int kBaseVertices = 5;
  inline static const TerrainGrid kGrid{Vec2(-10, -10), 0.1, 201, 201};

  static MachineModel Compact() {
    const Config machine = Config::FromFile(DataRoot() / "config/machines/tb235.yaml");
    MachineModel model = ReadMachine(machine.root());
    machine.Finish();
    return model;
  }
  static DigPlan Plan(const MachineModel& model) {
    const Config config =
        Config::FromText("{type: dig_to_design, dump_azimuth_deg: 90}", "operator.yaml");
    DigPlan plan = std::get<DigPlan>(ReadOperatorPlan(config.root(), model));
    plan.patience_s = kPatience_s;
    return plan;
  }

  MachineModel model_;
  DigPlan plan_;
  MachineState state_;
  TerrainSurface ground_;
};

TEST(DigTrench, SlewsFromATipThatCannotRiseOverTheRimWhenTheRiseOfItsTargetEnds) {
  const std::optional<double> high_s = HeldDigger(0, 0).FirstSlew_s();
  const std::optional<double> deep_s = HeldDigger(0, -0.7).FirstSlew_s();
  ASSERT_TRUE(high_s && deep_s);
  // The lift rises by 0.7 m more at 0.7 m/s; phases end by patience.
  EXPECT_NEAR(*deep_s - *high_s, 1.0, 2 * kPatience_s);
}

TEST(DigTrench, CarriesItsBucketToTheFirstStandAlikeOnHighAndLowGround) {
  const HeldDigger level(0, 0), low(-20, 0);
  const auto at_level = level.Digger(), at_low = low.Digger();
  for (const double t_s : {0.0, 0.02, 0.04}) {  // before its patience with the pose ends
    const std::vector<double> expected = level.Levers(at_level.get(), t_s);
    const std::vector<double> levers = low.Levers(at_low.get(), t_s);
    ASSERT_EQ(levers.size(), expected.size());
    for (std::size_t i = 0; i < levers.size(); ++i) {
      EXPECT_NEAR(levers[i], expected[i], 1e-6) << level.LeverName(i) << " at " << t_s << " s";
    }
  }
}

}  // namespace
}  // namespace tera
