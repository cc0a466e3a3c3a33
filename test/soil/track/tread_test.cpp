#include "soil/track/tread.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "soil/block_fixture.h"

/// The print of grousers in a rut.

namespace tera {
namespace {

using namespace testing_soil;

constexpr double kPitch_m = 0.12, kGrouser_m = 0.03;

/// Heights along a rut, every centimetre from -1 to 0.5 m.
struct Profile {
  static constexpr double kFrom_m = -1, kTo_m = 0.5, kStep_m = 0.01;
  std::vector<double> height_m;

  double Mean_m() const {
    double sum_m = 0;
    for (const double z_m : height_m) sum_m += z_m;
    return sum_m / height_m.size();
  }
  /// Amplitude of the wave of that length in them.
  double Amplitude_m(double length_m) const {
    double c = 0, s = 0;
    for (std::size_t n = 0; n < height_m.size(); ++n) {
      const double angle = 2 * kPi * n * kStep_m / length_m;
      c += (height_m[n] - Mean_m()) * std::cos(angle);
      s += (height_m[n] - Mean_m()) * std::sin(angle);
    }
    return 2 * std::hypot(c, s) / height_m.size();
  }
  /// The length of the greatest wave between 5 and 15 cm.
  double Wave_m() const {
    double best_m = 0, most_m = 0;
    for (double length_m = 0.05; length_m < 0.15; length_m += 0.001) {
      const double amplitude_m = Amplitude_m(length_m);
      if (amplitude_m > most_m) most_m = amplitude_m, best_m = length_m;
    }
    return best_m;
  }
};

std::string Site(const std::string& soil, double cell_m) {
  return soil + fmt::format("cell_m: {}\n", cell_m);
}

/// The rut of a block that has driven on, its shoes slipping by `slip`.
Profile Rut(const std::string& site, double slip, double grouser_m, double speed_mps = 1.0) {
  Block block(site, Vec2(speed_mps > 0 ? -2.03 : 1.53, 0.013), 0,
              {.grouser_m = grouser_m, .grouser_pitch_m = kPitch_m});
  block.Stand();
  block.Drive(4, speed_mps, slip, [](const Vec3&) {});
  EXPECT_NEAR(block.soil->ledger().total_kg(), 0, 1e-9);
  Profile profile;
  for (double x_m = Profile::kFrom_m; x_m < Profile::kTo_m; x_m += Profile::kStep_m) {
    profile.height_m.push_back(-block.Rut_m(x_m));
  }
  return profile;
}

TEST(Tread, GrousersPrintTheirPitchAndHeightIntoTheRut) {
  // A wave of 3 cm from trough to crest, in means over cells of 2.5 cm between which surfaces are
  // straight: sin(x) / x, x = pi 2.5 / 12, of it, and its square of what lies between.
  const double x = kPi * 0.025 / kPitch_m;
  const double shown = std::pow(std::sin(x) / x, 3);
  for (const double speed_mps : {1.0, -1.0}) {
    const Profile rut = Rut(Site(kDrySand, 0.025), 0, kGrouser_m, speed_mps);
    EXPECT_NEAR(rut.Wave_m(), kPitch_m, 0.002) << speed_mps;
    EXPECT_NEAR(rut.Amplitude_m(kPitch_m) / (0.5 * kGrouser_m * shown), 1, 0.15) << speed_mps;
  }
}

TEST(Tread, PrintsKeepTheRutsDepth) {
  const double smooth_m = Rut(Site(kDrySand, 0.025), 0, 0).Mean_m();
  const double printed_m = Rut(Site(kDrySand, 0.025), 0, kGrouser_m).Mean_m();
  EXPECT_LT(smooth_m, -0.03);
  // Crests are loose soil: soil that was a tenth denser stands as much higher.
  EXPECT_NEAR(printed_m, smooth_m, 0.003);
}

TEST(Tread, PrintsOfSlippingShoesAreCloser) {
  EXPECT_NEAR(Rut(Site(kDrySand, 0.025), 0.15, kGrouser_m).Wave_m(), 0.85 * kPitch_m, 0.003);
}

TEST(Tread, PrintsAreNoDeeperThanTheGroundWasPressed) {
  // Asphalt: 40 kPa on 1e9 N/m^3 is 0.04 mm.
  const Profile asphalt = Rut(Site("size_m: [12, 4]\nsoil: asphalt\n", 0.025), 0, kGrouser_m);
  EXPECT_LT(asphalt.Amplitude_m(kPitch_m), 5e-5);
}

TEST(Tread, CellsWiderThanHalfAPitchKeepASmoothRut) {
  const Profile fine = Rut(Site(kDrySand, 0.05), 0, kGrouser_m);
  const Profile coarse = Rut(Site(kDrySand, 0.1), 0, kGrouser_m);
  EXPECT_GT(fine.Amplitude_m(kPitch_m), 0.003);
  EXPECT_LT(coarse.Amplitude_m(kPitch_m), 0.0005);
  EXPECT_NEAR(coarse.Mean_m(), fine.Mean_m(), 0.006);
}

}  // namespace
}  // namespace tera
