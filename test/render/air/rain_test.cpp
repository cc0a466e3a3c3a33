#include "render/air/rain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

/// Integral of a drop's property over drops of all sizes, for each m^3.
template <typename OfDrop>
double Sum_1pm3(const Rain& rain, OfDrop of_drop) {
  constexpr double kStep_m = 2e-6;
  double sum = 0;
  for (double d = 0; d < 0.02; d += kStep_m) {
    const double count = rain.CountAbove_1pm3(d) - rain.CountAbove_1pm3(d + kStep_m);
    sum += count * of_drop(d + 0.5 * kStep_m);
  }
  return sum;
}

TEST(Rain, ItsWaterIsMarshallAndPalmersMoment) {
  // Liquid water pi rho N0 / L^4 (closed form of the fourth moment): for 10 mm/h L is 2.528 / mm,
  // hence 0.615 g/m^3 in the air.
  const Rain rain(10);
  const double water_kgpm3 = Sum_1pm3(rain, [](double d) { return 1000 * kPi / 6 * d * d * d; });
  EXPECT_NEAR(std::log(rain.CountAbove_1pm3(0.001) / rain.CountAbove_1pm3(0.002)), 2.528, 0.001);
  EXPECT_NEAR(water_kgpm3, 0.615e-3, 0.001e-3);
}

TEST(Rain, ItsFluxIsNearTheRateThatItIsNamedBy) {
  // The exponential spectrum with measured fall speeds reproduces the rate within a tenth or two.
  for (const double rate_mmph : {1.0, 10.0, 50.0}) {
    const double flux_mmph =
        Sum_1pm3(Rain(rate_mmph),
                 [](double d) { return kPi / 6 * d * d * d * Rain::FallSpeed_mps(d); }) *
        1000 * 3600;
    EXPECT_NEAR(flux_mmph / rate_mmph, 1, 0.2) << rate_mmph;
  }
}

TEST(Rain, ExtinctionIsTwiceTheCrossSectionOfItsDrops) {
  const Rain rain(25);
  const double twice_area = Sum_1pm3(rain, [](double d) { return 2 * kPi / 4 * d * d; });
  EXPECT_NEAR(rain.Extinction_1pm(), twice_area, 1e-4 * twice_area);
  // Atlas 1953: visibilities of some kilometres in rain of that rate.
  EXPECT_NEAR(-std::log(0.02) / rain.Extinction_1pm(), 1420, 30);
  EXPECT_EQ(Rain(0).Extinction_1pm(), 0);
}

TEST(Rain, DropsFallAsGunnAndKinzerMeasured) {
  // 4.03, 6.49 and 8.83 m/s of 1, 2 and 4 mm (Gunn and Kinzer 1949, table 2).
  EXPECT_NEAR(Rain::FallSpeed_mps(1e-3), 4.03, 0.1);
  EXPECT_NEAR(Rain::FallSpeed_mps(2e-3), 6.49, 0.1);
  EXPECT_NEAR(Rain::FallSpeed_mps(4e-3), 8.83, 0.15);
}

TEST(Snowfall, ItsWaterIsGunnAndMarshallsMoment) {
  // pi rho N0 / L^4 with N0 = 3800 / (m^3 mm) and L = 2.55 / mm of 1 mm/h: 0.282 g/m^3.
  constexpr double kStep_m = 2e-6;
  const Snowfall snow(1);
  double water_kgpm3 = 0;
  for (double d = 0; d < 0.02; d += kStep_m) {
    const double count = snow.CountAbove_1pm3(d) - snow.CountAbove_1pm3(d + kStep_m);
    water_kgpm3 += count * 1000 * kPi / 6 * std::pow(d + 0.5 * kStep_m, 3);
  }
  EXPECT_NEAR(water_kgpm3, 0.282e-3, 0.002e-3);
}

TEST(Snowfall, OfOneMillimetreLeavesTheVisibilityOfModerateSnow) {
  // Moderate snow has a visibility of 0.5 to 1 km (WMO-No. 306, code 4677; observers relate it to 1
  // mm/h and more of water). At the visibility 2 % of the contrast remains.
  const double visibility_m = std::log(50.0) / Snowfall(1).Extinction_1pm();
  EXPECT_GT(visibility_m, 500);
  EXPECT_LT(visibility_m, 1000);
  EXPECT_EQ(Snowfall(0).Extinction_1pm(), 0);
}

}  // namespace
}  // namespace tera
