#include "layout/measures/eye_masking.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/error.h"
#include "layout/yard.h"

namespace tera {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// In the frame of the mast, 2.2 m above the ground.
const Vec3 kEye_m(0.2, 0.1, 1.0);
constexpr double kTolerance_m = 0.02;

EyeStudy Eye(double spacing_m) {
  EyeStudy eye;
  eye.link = "mast";
  eye.p_B_m = kEye_m;
  eye.spacing_m = spacing_m;
  return eye;
}

/// A plate straight ahead of and across the eye's view, from the ground to far above the eye.
TestBox Plate(double ahead_m, double breadth_m) {
  return {kEye_m + Vec3(ahead_m, -0.5 * breadth_m, -2.1),
          kEye_m + Vec3(ahead_m + 0.01, 0.5 * breadth_m, 2)};
}

EyeMasking Masked(const Yard& yard, const EyeStudy& eye) {
  EyeMasking masking(eye);
  masking.Add(yard.X_WH(), yard.X_WMast(), 0, yard.sighting());
  return masking;
}

/// From above, with the eye at the origin, looking along x: the place on the line `at` whose ray
/// from the left light grazes the plate's left edge. The left light sees places farther left.
Vec2 LeftEnd(const Vec2& edge_m, double spacing_m, const std::function<Vec2(double)>& at,
             double low, double high) {
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    const Vec2 place_m = at(middle), ahead = place_m.normalized();
    const Vec2 light_m = 0.5 * spacing_m * Vec2(-ahead.y(), ahead.x());
    const Vec2 ray = place_m - light_m, to_edge_m = edge_m - light_m;
    const bool is_hidden = ray.x() * to_edge_m.y() - ray.y() * to_edge_m.x() > 0;
    (is_hidden ? low : high) = middle;
  }
  return at(low);
}

double UmbraOnCircle_m(double ahead_m, double breadth_m, double spacing_m) {
  const auto on_circle = [](double at_rad) {
    return Vec2(12 * Vec2(std::cos(at_rad), std::sin(at_rad)));
  };
  return 2 * LeftEnd({ahead_m, 0.5 * breadth_m}, spacing_m, on_circle, 0, 1).y();
}

double WidestOnCircle_m(const EyeMasking& masking) {
  return FigureOf(masking.Figures(), "eye/circle/widest_masking_m").at[0];
}

TEST(EyeMasking, OfOneLightIsThePlatesShadow) {
  EyeStudy eye = Eye(0);
  eye.most_masking_m = 1;
  const EyeMasking masking = Masked(Yard(Plate(2, 0.6)), eye);
  EXPECT_NEAR(WidestOnCircle_m(masking), 2 * 12 * std::sin(std::atan(0.3 / 2)), kTolerance_m);
  // The middle of the shadow is 12 m ahead of the eye, which is to the side of H's origin: 0.47
  // deg.
  EXPECT_THAT(masking.Warnings(), Contains(testing::AllOf(HasSubstr("circle, digger/mast masks"),
                                                          HasSubstr("at azimuth 0 deg"))));
}

TEST(EyeMasking, OfTwoLightsIsTheUmbra) {
  for (const double spacing_m : {0.065, 0.205, 0.405}) {
    const Yard yard(Plate(2, 0.6));
    const EyeMasking masking = Masked(yard, Eye(spacing_m));
    const double width_m = WidestOnCircle_m(masking);
    EXPECT_NEAR(width_m, UmbraOnCircle_m(2, 0.6, spacing_m), kTolerance_m);
    // By similar triangles, as in Directive 2008/2/EC for tractors, with the circle's chord as far
    // away as the circle. It is nearer by at most 12 m (1 - cos 8.5 deg) = 0.13 m, which narrows
    // the shadow of 0.3 m at 2 m by 2 x 0.15 x 0.13 m.
    EXPECT_NEAR(width_m, (0.6 - spacing_m) / 2 * 12 + spacing_m, 0.04 + kTolerance_m);
    const double circumference_m = 2 * kPi * 12;
    EXPECT_NEAR(FigureOf(masking.Figures(), "eye/circle/masked_share").at[0],
                24 * std::asin(width_m / 24) / circumference_m, 1e-9);
  }
}

TEST(EyeMasking, APoleNarrowerThanTheSpacingMasksNothing) {
  const Yard yard(Plate(2, 0.1));
  EXPECT_EQ(WidestOnCircle_m(Masked(yard, Eye(0.205))), 0);
  EXPECT_NEAR(WidestOnCircle_m(Masked(yard, Eye(0.065))), UmbraOnCircle_m(2, 0.1, 0.065),
              kTolerance_m);
}

TEST(EyeMasking, OnTheRectangleAMaskingIsAsLongAsItHidesOfIt) {
  // Sides of the base, which is turned by -40 deg in H, ahead of its middle: its left front corner.
  const Vec3 corner_m = Yard::Base().high_m;
  const double front_m = corner_m.x() * std::cos(Yard::kTurn_rad) +
                         corner_m.y() * std::sin(Yard::kTurn_rad) + 1 - kEye_m.x();
  const double spacing_m = 0.205;
  const Yard yard(Plate(1.2, 0.6));
  const EyeMasking masking = Masked(yard, Eye(spacing_m));
  const auto on_front = [&](double y_m) { return Vec2(front_m, y_m); };
  const double width_m = 2 * LeftEnd({1.2, 0.3}, spacing_m, on_front, 0, 1).y();
  EXPECT_NEAR(FigureOf(masking.Figures(), "eye/rectangle/widest_masking_m").at[0], width_m,
              kTolerance_m);
  // Around a rotated rectangle, the bounding one is |cos| and |sin| of both sides.
  const double length_m = 2.5, breadth_m = 1.6;
  const double around_m =
      2 * ((length_m + breadth_m) * (std::cos(Yard::kTurn_rad) + std::sin(Yard::kTurn_rad)) + 4);
  EXPECT_NEAR(FigureOf(masking.Figures(), "eye/rectangle/masked_share").at[0], width_m / around_m,
              0.002);
}

TEST(EyeMasking, WhatIsNotTheMachineMasksNothing) {
  const Yard yard(Plate(2, 0.1),
                  "obstacles:\n  - {name: rock1, preset: tera:config/obstacles/container.yaml, "
                  "xy_m: [4, 5], yaw_deg: 20}\n");
  EXPECT_EQ(WidestOnCircle_m(Masked(yard, Eye(0.205))), 0);
}

TEST(EyeMasking, IsHeldAgainstTheStudysLimitAndNoOther) {
  const Yard yard(Plate(2, 0.6));
  EyeStudy eye = Eye(0.205);
  EXPECT_THAT(Masked(yard, eye).Warnings(), IsEmpty());
  EXPECT_EQ(Masked(yard, eye).Figures().size(), 4u);
  eye.most_masking_m = 2;
  EXPECT_THAT(Masked(yard, eye).Warnings(),
              ElementsAre(testing::AllOf(HasSubstr("digger/mast masks 2.5"),
                                         HasSubstr("the study allows (2 m"))));
  EXPECT_EQ(FigureOf(Masked(yard, eye).Figures(), "eye/circle/exceeds_limit").at[0], 1);
  eye.most_masking_m = 3;
  EXPECT_THAT(Masked(yard, eye).Warnings(), IsEmpty());
  EXPECT_EQ(FigureOf(Masked(yard, eye).Figures(), "eye/circle/exceeds_limit").at[0], 0);
}

TEST(EyeMasking, NeedsALinkThatTheMachineHas) {
  MachineModel machine;
  machine.links.resize(2);
  machine.links[0].name = "base";
  machine.links[1].name = "mast";
  EyeStudy eye = Eye(0.205);
  EXPECT_EQ(LinkOfEye(eye, machine), 1);
  eye.link = "cab";
  EXPECT_THROW(LinkOfEye(eye, machine), InputError);
}

TEST(EyeMasking, PanesOfTheCabMaskNothing) {
  const Config config = Config::FromText(R"(
name: cab
duration_s: 1
terrain: {size_m: [30, 30], cell_m: 0.5, soil: asphalt}
machines:
  - {name: digger, machine: tera:config/machines/tb235.yaml, operator: {type: idle}}
)",
                                         "cab.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  const SceneAssembly assembly(scenario);
  const Simulation simulation(scenario);
  Sighting sighting(scenario, assembly, 1);
  sighting.Show(simulation.state(), simulation.ground());
  const MachineModel& model = scenario.machines[0].placement.model;
  const Pose& X_WB = simulation.state().machines[0].links[model.LinkIndex("upper")].X_WB;
  EyeStudy eye = Eye(0.205);
  eye.p_B_m = Vec3(0.1, 0.37, 1.3);  // within the cab, which has glass on all sides
  EyeMasking masking(eye);
  masking.Add(Levelled(X_WB), X_WB, 0, sighting);
  const double share = FigureOf(masking.Figures(), "eye/circle/masked_share").at[0];
  EXPECT_GT(share, 0.01);  // pillars
  EXPECT_LT(share, 0.5);
}

}  // namespace
}  // namespace tera
