#include "diagnose/sensors/sensor_parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/units.h"
#include "diagnose/sensors/usual_tolerances.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

const UsualTolerances kSensorParametersTolerances;

Effect Named(EffectTarget target, std::string_view id, std::vector<double> values) {
  return {&SensorMechanism(id, target), std::move(values)};
}

/// Tables of a unit, a receiver, two axes and poses with their channels.
struct All {
  ParameterTable table;
  UnitChannel unit;
  ReceiverChannel receiver;
  AxisChannel turns, slides;
  MapChannel map;

  explicit All(const Effects& of_unit = {}, const Effects& of_receiver = {},
               const Effects& of_axis = {}) {
    SensorDescription imu, gnss;
    imu.name = "imu";
    imu.model = ImuModel{};
    imu.effects = of_unit;
    gnss.name = "gnss";
    gnss.model = GnssModel{};
    gnss.effects = of_receiver;
    AddImuParameters(imu, {2, 0.4, 0.3}, &table, &unit);
    AddReceiverParameters(gnss, {2, 0.4, 0.3}, 10, &table, &receiver);
    receiver.pair_yaw = AddPairYaw(gnss, 0, &table);
    AddAxisParameters("encoders/boom", of_axis, false, 0.3, &table, &turns);
    AddAxisParameters("encoders/stick", {}, true, 0.3, &table, &slides);
    turns.late = slides.late = AddEncoderDelay("encoders", {}, &table);
    AddPoseParameters(true, &table, &map);
  }
  const SensorParameter& At(int place) const {
    return table.parameters[static_cast<std::size_t>(place)];
  }
};

TEST(SensorParameters, AreInGroupsThatFollowEachOtherWithoutAGap) {
  const All all;
  int next = 0;
  for (const ParameterGroup& group : all.table.groups) {
    EXPECT_EQ(group.first, next) << group.Name();
    EXPECT_GT(group.count, 0);
    next += group.count;
  }
  EXPECT_EQ(next, static_cast<int>(all.table.parameters.size()));
}

// A joint at rest, within the tolerance of its zero, shows no scale. Half of 0.56 mrad of noise and
// quantisation is far below a tolerance of some milliradians; half of 0.2 rad is above.
TEST(SensorParameters, TheScaleOfAnAxisIsNamedOnlyWhereItSwings) {
  for (const auto& [swing, may_be_named] : {std::pair{0.00056, false}, std::pair{0.2, true}}) {
    ParameterTable table;
    AxisChannel channel;
    AddAxisParameters("encoders/bucket", {}, false, swing, &table, &channel);
    for (const ParameterGroup& group : table.groups) {
      EXPECT_EQ(group.may_be_named, group.mechanism->id != "scale" || may_be_named) << swing;
    }
  }
}

// A tolerance of 0.05 rad for the heading covers every rotation of the line between two antennas.
TEST(SensorParameters, ThePairsYawLeavesRoomForWhatPlacesTurn) {
  SensorDescription gnss;
  gnss.name = "gnss";
  ParameterTable table;
  const double all_rad = AddPairYaw(gnss, 0, &table) == 0 ? table.parameters[0].tolerance : 0;
  for (const auto& [by_places, left] :
       {std::pair{0.0, 1.0}, std::pair{0.6, 0.4}, std::pair{1.5, 0.01}}) {
    ParameterTable one;
    AddPairYaw(gnss, by_places * all_rad, &one);
    const ParameterPrior prior = one.PriorWith({});
    EXPECT_NEAR(prior.upper[0], left * all_rad, 1e-9) << by_places;
    EXPECT_NEAR(prior.sigma[0], left * all_rad / 2, 1e-9) << by_places;
    EXPECT_EQ(one.parameters[0].tolerance, all_rad) << "beyond which it is named";
  }
}

// A group is reported as a mechanism of the library with its parameters.
TEST(SensorParameters, AreNumbersOfMechanismsThatThereAre) {
  const All all;
  for (const ParameterGroup& group : all.table.groups) {
    for (int i = group.first; i < group.first + group.count; ++i) {
      const SensorParameter& one = all.At(i);
      bool is_there = false;
      for (const EffectParameter& parameter : group.mechanism->parameters) {
        is_there |= parameter.name == one.name && parameter.unit == one.unit;
      }
      EXPECT_TRUE(is_there) << group.Name() << " " << one.name << " in " << one.unit;
    }
  }
}

TEST(SensorParameters, HaveUnitsThatTheirNumbersOfSiAreOf) {
  const All all;
  for (const SensorParameter& one : all.table.parameters) {
    const bool in_degrees = one.unit.find("deg") != std::string::npos;
    EXPECT_DOUBLE_EQ(one.si_per_unit, in_degrees ? kDeg : 1) << one.name;
    EXPECT_GT(one.tolerance, 0) << one.name;
    EXPECT_LT(one.lower, one.documented - one.tolerance) << one.name;
    EXPECT_GT(one.upper, one.documented + one.tolerance) << one.name;
  }
}

TEST(SensorParameters, AreDocumentedAsTheEffectsOfTheScenarioHaveThem) {
  const All all({Named(EffectTarget::kImu, "bias", {1, 2, 3, 0.1, 0.2, 0.3}),
                 Named(EffectTarget::kImu, "scale", {1.1, 1.2, 1.3, 1.01, 1.02, 1.03}),
                 Named(EffectTarget::kImu, "mount_rotation", {10, -20, 30}),
                 Named(EffectTarget::kImu, "imu_lever_arm", {0.1, 0.2, 0.3}),
                 Named(EffectTarget::kImu, "axis_flip", {0, 1, 1, 0, 0, 0, 1, 0, 0}),
                 Named(EffectTarget::kImu, "latency", {0.05, 0})},
                {Named(EffectTarget::kGnss, "gnss_lever_arm", {-0.1, 0.4, 0}),
                 Named(EffectTarget::kGnss, "height_datum", {40}),
                 Named(EffectTarget::kGnss, "position_datum", {1, 2}),
                 Named(EffectTarget::kGnss, "antenna_yaw", {90}),
                 Named(EffectTarget::kGnss, "clock_offset", {-0.2})},
                {});
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(all.At(all.unit.bias + i).documented, (i + 1) * kDeg, 1e-12);
    EXPECT_NEAR(all.At(all.unit.bias + 3 + i).documented, 0.1 * (i + 1), 1e-12);
    EXPECT_NEAR(all.At(all.unit.scale + i).documented, 1 + 0.1 * (i + 1), 1e-12);
    EXPECT_NEAR(all.At(all.unit.mount + i).documented, (i == 1 ? -20 : 10 + 10 * i) * kDeg, 1e-12);
    EXPECT_NEAR(all.At(all.unit.place + i).documented, 0.1 * (i + 1), 1e-12);
  }
  EXPECT_EQ(all.unit.signs, (Eigen::Matrix<double, 6, 1>{1, -1, -1, -1, -1, -1}));
  EXPECT_NEAR(all.At(all.unit.late).documented, 0.05, 1e-12);
  EXPECT_NEAR(all.At(all.receiver.place + 1).documented, 0.4, 1e-12);
  EXPECT_NEAR(all.At(all.receiver.datum).documented, 1, 1e-12);
  EXPECT_NEAR(all.At(all.receiver.datum + 1).documented, 2, 1e-12);
  EXPECT_NEAR(all.At(all.receiver.datum + 2).documented, 40, 1e-12) << "up";
  EXPECT_NEAR(all.At(all.receiver.pair_yaw).documented, kPi / 2, 1e-12);
  EXPECT_NEAR(all.At(all.receiver.late).documented, -0.2, 1e-12) << "its stamps are early";
}

// Without documented effects, the scale is one and everything else zero.
TEST(SensorParameters, AreDocumentedAsIdealWithoutEffects) {
  const All all;
  for (const SensorParameter& one : all.table.parameters) {
    const bool is_factor = one.name.find("factor") != std::string::npos;
    EXPECT_EQ(one.documented, is_factor ? 1 : 0) << one.name;
  }
}

TEST(SensorParameters, OfPosesOfASimulationSayNoMoreThanHowLateTheyAre) {
  ParameterTable table;
  MapChannel map;
  AddPoseParameters(false, &table, &map);
  ASSERT_EQ(table.groups.size(), 1u);
  EXPECT_EQ(table.groups[0].mechanism->id, "clock_offset");
  EXPECT_EQ(map.late, 0);
  EXPECT_EQ(map.shift, kNoParameter);
  EXPECT_EQ(map.turn, kNoParameter);
}

TEST(SensorParameters, OfAPriorAreHeldWithinTheirTolerancesButForFreeGroups) {
  const All all;
  const ParameterTable& table = all.table;
  const int free = 2;
  const ParameterPrior prior = table.PriorWith({free}), wide = table.FlexiblePrior();
  for (std::size_t g = 0; g < table.groups.size(); ++g) {
    for (int i = table.groups[g].first; i < table.groups[g].first + table.groups[g].count; ++i) {
      const SensorParameter& one = all.At(i);
      EXPECT_EQ(prior.documented[i], one.documented);
      if (static_cast<int>(g) == free) {
        EXPECT_EQ(prior.lower[i], one.lower);
        EXPECT_EQ(prior.upper[i], one.upper);
        EXPECT_GT(prior.sigma[i], 10 * one.tolerance);
      } else {
        EXPECT_DOUBLE_EQ(prior.sigma[i], one.tolerance / 2);
        EXPECT_DOUBLE_EQ(prior.lower[i], one.documented - one.tolerance);
        EXPECT_DOUBLE_EQ(prior.upper[i], one.documented + one.tolerance);
      }
      EXPECT_FALSE(std::isfinite(wide.lower[i]) || std::isfinite(wide.upper[i])) << one.name;
      EXPECT_GT(wide.sigma[i], prior.sigma[i] * (static_cast<int>(g) == free ? 0 : 1.5));
    }
  }
}

// A range that leaves out the documented number does not hold what is not free.
TEST(SensorParameters, HoldsWithinTolerancesWhateverALibrarysRanges) {
  ParameterTable table;
  UnitChannel channel;
  SensorDescription unit;
  unit.name = "imu";
  unit.model = ImuModel{};
  AddImuParameters(unit, Vec3::Ones(), &table, &channel);
  const CandidateLibrary library{
      .ranges = {{&SensorMechanism("clock_offset", EffectTarget::kImu), {{0, 0.1, 0.3}}}}};
  table.LimitTo(library);
  const ParameterPrior prior = table.PriorWith({});
  EXPECT_LT(prior.lower[channel.late], 0);
  EXPECT_GT(prior.upper[channel.late], 0);
  EXPECT_LT(prior.upper[channel.late], 0.1);
}

}  // namespace
}  // namespace tera
