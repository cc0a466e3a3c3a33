#include "layout/measures/pixel_density.h"

#include <gtest/gtest.h>

#include "layout/measures/polar_grid.h"
#include "layout/yard.h"

namespace tera {
namespace {

constexpr double kPxPerRad = 1000;  ///< so that the density is 1000 px / m at 1 m

/// Clear of all obstacles.
TestBox PixelDensityNothing() { return {Vec3(0, 0, -0.5), Vec3(0.01, 0.01, -0.4)}; }

/// Above the origin of H, level with the places, with H's orientation.
Viewer Camera(const Yard& yard, std::function<bool(const Vec3&)> looks) {
  return ViewerOf(ViewField::Samples::kPixels, kPxPerRad * kPxPerRad,
                  yard.X_WH() * MakePose(Vec3(0, 0, PixelDensity::kHeight_m)), std::move(looks));
}

PixelDensity DensityOf(const Yard& yard, const Viewer& viewer) {
  PixelDensity density;
  density.Add(PlacesAt(PixelDensity::kHeight_m, yard.X_WH(), yard.sighting(), yard.ground()),
              LayoutOf({viewer}), yard.sighting());
  return density;
}

TEST(PixelDensity, FallsWithDistanceThroughTheStandardsPurposes) {
  const Yard yard(PixelDensityNothing());
  const PixelDensity density = DensityOf(yard, Camera(yard, [](const Vec3&) { return true; }));
  // 25 px/m at 40 m, beyond the grid; 62.5 at 16, 125 at 8, 250 at 4 m. The last cells have their
  // middles at 23.5, 15.5, 7.5, 3.5 m.
  const std::vector<double> farthest_m = {23.5, 15.5, 7.5, 3.5};
  for (std::size_t purpose = 0; purpose < farthest_m.size(); ++purpose) {
    for (int sector = 0; sector < 72; ++sector) {
      EXPECT_EQ(density.Curves().at(purpose).mean.at(sector), farthest_m[purpose]);
    }
  }
  const std::vector<Figure> figures = density.Figures();
  EXPECT_NEAR(FigureOf(figures, "pixels/detect/share_to_12m").at[0], 1, 1e-12);
  EXPECT_NEAR(FigureOf(figures, "pixels/recognise/share_to_12m").at[0], 64.0 / 144, 1e-9);
  EXPECT_NEAR(FigureOf(figures, "pixels/identify/share_to_12m").at[0], 16.0 / 144, 1e-9);
  EXPECT_EQ(FigureOf(figures, "pixels/observe/mean_to_m_behind").at[0], 15.5);
  EXPECT_NEAR(density.Map().value[PolarGrid::Index(30, 9)], kPxPerRad / 9.5, 1e-3);
}

TEST(PixelDensity, IsThatOfDirectionsThatACameraShows) {
  const Yard yard(PixelDensityNothing());
  const auto to_the_left = [](const Vec3& d_S) { return d_S.y() > 0.1; };
  const std::vector<Figure> figures = DensityOf(yard, Camera(yard, to_the_left)).Figures();
  EXPECT_EQ(FigureOf(figures, "pixels/recognise/mean_to_m_left").at[0], 7.5);
  EXPECT_EQ(FigureOf(figures, "pixels/recognise/mean_to_m_right").at[0], 0);
  // Directions 5 deg apart from -45 to 45 deg are 19; the 8 from 10 deg on are in view.
  EXPECT_NEAR(FigureOf(figures, "pixels/recognise/mean_to_m_ahead").at[0], 7.5 * 8 / 19, 1e-9);
}

TEST(PixelDensity, IsDrawnByDirection) {
  const Yard yard(PixelDensityNothing());
  const auto to_the_left = [](const Vec3& d_S) { return d_S.y() > 0.1; };
  const PolarCurve recognise = DensityOf(yard, Camera(yard, to_the_left)).Curves().at(2);
  EXPECT_EQ(NameOf(recognise.id), "pixels/recognise");
  ASSERT_EQ(recognise.worst.size(), 72u);
  EXPECT_EQ(recognise.worst[18], 7.5);
  EXPECT_EQ(recognise.mean[18], 7.5);
  EXPECT_EQ(recognise.mean[54], 0);
}

TEST(PixelDensity, EndsAtWhatStandsInTheWay) {
  const Yard yard({Vec3(2.8, -3, -1), Vec3(2.9, 3, 3)});  // a plate across, in the mast's frame
  const PixelDensity density = DensityOf(yard, Camera(yard, [](const Vec3&) { return true; }));
  EXPECT_EQ(density.Curves().at(0).mean.at(0), 2.5);
  EXPECT_EQ(density.Curves().at(0).mean.at(36), 23.5);
}

TEST(PixelDensity, IsNoneOfALidar) {
  const Yard yard(PixelDensityNothing());
  Viewer lidar = Camera(yard, [](const Vec3&) { return true; });
  lidar.field.samples = ViewField::Samples::kPoints;
  EXPECT_EQ(FigureOf(DensityOf(yard, lidar).Figures(), "pixels/detect/share_to_12m").at[0], 0);
}

}  // namespace
}  // namespace tera
