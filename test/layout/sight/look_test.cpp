#include "layout/sight/look.h"

#include <gtest/gtest.h>

#include <cmath>

#include "layout/looked_at_site.h"
#include "sensors/camera/camera_view.h"
#include "sensors/lidar/lidar_view.h"

namespace tera {
namespace {

/// It sees surfaces that return a tenth of the light up to 6 m.
ViewField Lidar(double per_sr = 1e9) {
  ViewField field = EverywhereAlike(per_sr);
  field.reach_m = [](double returned) { return 6 * std::sqrt(returned / 0.1); };
  return field;
}

class LookAtATarget : public testing::Test {
 protected:
  /// From (0, 0, 2) of H.
  Look At(const ViewField& field, const Vec3& p_H_m, const Asked& asked = {},
          const std::optional<Vec3>& normal_H = std::nullopt) const {
    Target target{X_WH() * p_H_m};
    if (normal_H) target.normal_W = X_WH().linear() * normal_H->normalized();
    return LookFrom(ViewerAt("viewer", {0, 0, 2}, field), {&target, 1}, asked, site_.sighting())[0];
  }

  const LookedAtSite site_{{.boxes = {{"wall1", {3, -2, 0}, {3.2, 2, 4}}}}};
};

TEST_F(LookAtATarget, IsDenseByTheSolidAngleOfASquareMetre) {
  // 100 per steradian are 4 per square metre at 5 m, and half of that where it is turned by 60 deg.
  EXPECT_NEAR(At(EverywhereAlike(100), {-5, 0, 2}).per_m2, 4, 1e-9);
  const Vec3 by_60_deg(0.5, std::sqrt(0.75), 0);
  EXPECT_NEAR(At(EverywhereAlike(100), {-5, 0, 2}, {}, by_60_deg).per_m2, 2, 1e-9);
  EXPECT_TRUE(At(EverywhereAlike(100), {-5, 0, 2}, {.least_per_m2 = 3.99}).sees);
  const Look sparse = At(EverywhereAlike(100), {-5, 0, 2}, {.least_per_m2 = 4.01});
  EXPECT_FALSE(sparse.sees);
  EXPECT_EQ(sparse.why, Unseen::kTooFarOrSparse);
}

TEST_F(LookAtATarget, ReachesAsFarAsTheLightThatItReturns) {
  EXPECT_TRUE(At(Lidar(), {-5.99, 0, 2}, {.reflectance = 0.1}).sees);
  EXPECT_FALSE(At(Lidar(), {-6.01, 0, 2}, {.reflectance = 0.1}).sees);
  // A quarter of the light comes back at an incidence of acos(1/4): half as far.
  const Vec3 askew(0.25, std::sqrt(1 - 0.0625), 0);
  EXPECT_TRUE(At(Lidar(), {-2.99, 0, 2}, {.reflectance = 0.1}, askew).sees);
  const Look beyond = At(Lidar(), {-3.01, 0, 2}, {.reflectance = 0.1}, askew);
  EXPECT_FALSE(beyond.sees);
  EXPECT_EQ(beyond.why, Unseen::kTooFarOrSparse);
}

TEST_F(LookAtATarget, ASurfaceThatIsTurnedAwayIsOutOfView) {
  const Look away = At(EverywhereAlike(), {-5, 0, 2}, {}, Vec3(-1, 0.2, 0));
  EXPECT_FALSE(away.sees);
  EXPECT_EQ(away.why, Unseen::kOutOfView);
}

TEST_F(LookAtATarget, NearerThanItSeesThereIsNothing) {
  ViewField field = EverywhereAlike();
  field.nearest_m = 1;
  EXPECT_FALSE(At(field, {-0.99, 0, 2}).sees);
  EXPECT_TRUE(At(field, {-1.01, 0, 2}).sees);
}

TEST_F(LookAtATarget, ShowsBeyondTheLimitsInWhichItMeasures) {
  ViewField camera = EverywhereAlike();
  camera.min_distance_m = 2;
  camera.max_distance_m = 4;
  for (const double x_m : {-1.9, -4.1}) {
    EXPECT_TRUE(At(camera, {x_m, 0, 2}).sees);
    EXPECT_FALSE(At(camera, {x_m, 0, 2}, {.ranges = true}).sees);
  }
  for (const double x_m : {-2.1, -3.9}) EXPECT_TRUE(At(camera, {x_m, 0, 2}, {.ranges = true}).sees);
  camera.ranges = false;
  EXPECT_TRUE(At(camera, {-3, 0, 2}).sees);
  EXPECT_FALSE(At(camera, {-3, 0, 2}, {.ranges = true}).sees);
}

TEST_F(LookAtATarget, ADepthCameraGoesByDepthAlongItsAxis) {
  // 4 m along the axis and 3 m aside: 5 m away. f b = 160 px 0.05 m, sigma_z = 4^2 0.1 / 8 = 0.2 m,
  // and 5 / 4 of it along the ray.
  CameraModel camera;
  camera.intrinsics = {
      .width_px = 320, .height_px = 240, .fx_px = 160, .fy_px = 160, .cx_px = 160, .cy_px = 120};
  camera.depth = true;
  camera.disparity_noise_px = 0.1;
  camera.baseline_m = 0.05;
  const auto at = [&](double min_m, double max_m) {
    camera.depth_min_m = min_m;
    camera.depth_max_m = max_m;
    return At(ViewOf(camera, 10), {4, 3, 2}, {.ranges = true});
  };
  EXPECT_TRUE(at(0.3, 4.1).sees);
  EXPECT_FALSE(at(0.3, 3.9).sees);
  EXPECT_TRUE(at(3.9, 9).sees);
  EXPECT_FALSE(at(4.1, 9).sees);
  EXPECT_NEAR(at(0.3, 9).sigma_m, 0.25, 1e-9);
}

TEST_F(LookAtATarget, SeesNothingBehindAWallUnlessItsMarginHoldsIt) {
  const Look hidden = At(EverywhereAlike(), {5, 0, 2});
  EXPECT_FALSE(hidden.sees);
  EXPECT_EQ(hidden.why, Unseen::kBlocked);
  EXPECT_EQ(site_.sighting().NameOf(hidden.by), "wall1");
  EXPECT_GT(hidden.per_m2, 0);
  // The wall's front is 2 m before it.
  EXPECT_FALSE(At(EverywhereAlike(), {5, 0, 2}, {.margin_m = 1.99}).sees);
  EXPECT_TRUE(At(EverywhereAlike(), {5, 0, 2}, {.margin_m = 2.01}).sees);
}

TEST(LookFrom, ThroughAPaneACameraShowsWhatItAndALidarDoNotMeasure) {
  // Two panes of 8 mm, with a wall behind one of them.
  const LookedAtSite site({.boxes = {{"pane1", {3, -2, 0}, {3.008, 2, 4}, true},
                                     {"pane2", {4, -2, 0}, {4.008, 2, 4}, true},
                                     {"wall1", {5, 0, 0}, {5.1, 2, 4}}}});
  CameraModel model;
  model.intrinsics = {
      .width_px = 320, .height_px = 240, .fx_px = 160, .fy_px = 160, .cx_px = 160, .cy_px = 120};
  model.depth = true;
  const auto at = [&](const ViewField& field, double y_m, const Asked& asked) {
    const Target target{X_WH() * Vec3(6, y_m, 2)};
    return LookFrom(ViewerAt("viewer", {0, 0, 2}, field), {&target, 1}, asked, site.sighting())[0];
  };
  EXPECT_TRUE(at(ViewOf(model, 10), -1, {}).sees);
  EXPECT_EQ(site.sighting().NameOf(at(ViewOf(model, 10), 1, {}).by), "wall1");
  EXPECT_EQ(site.sighting().NameOf(at(ViewOf(model, 10), -1, {.ranges = true}).by), "pane1");
  model.rgb = false;
  EXPECT_EQ(site.sighting().NameOf(at(ViewOf(model, 10), -1, {}).by), "pane1");
  LidarModel lidar;
  for (int b = 0; b < 16; ++b) lidar.elevation_rad.push_back((15 - 2 * b) * kDeg);
  EXPECT_EQ(site.sighting().NameOf(at(ViewOf(lidar, 10), -1, {}).by), "pane1");
}

}  // namespace
}  // namespace tera
