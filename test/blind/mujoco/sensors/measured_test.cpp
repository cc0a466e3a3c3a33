#include "blind/mujoco/sensors/measured.h"

#include <gtest/gtest.h>

#include <cmath>

#include "blind/mujoco/sensors/logger.h"

namespace tera::blind::mujoco {
namespace {

TEST(MujocoMeasured, ADegreeIsAsLongAsPublished) {
  // Length of a degree of latitude: 111132.954 - 559.822 cos 2 phi + 1.175 cos 4 phi metres. Degree
  // of longitude: 111412.84 cos phi - 93.5 cos 3 phi + 0.118 cos 5 phi. Both are on the ellipsoid;
  // 430 m above it they are longer by 430 m over the radius.
  const double phi = 47.4 * M_PI / 180, higher = 1 + 430 / 6.38e6;
  const double north_m =
      (111132.954 - 559.822 * std::cos(2 * phi) + 1.175 * std::cos(4 * phi)) * higher;
  const double east_m =
      (111412.84 * std::cos(phi) - 93.5 * std::cos(3 * phi) + 0.118 * std::cos(5 * phi)) * higher;
  const Vec3 origin = Geodetic(Vec3::Zero());
  EXPECT_NEAR(origin.x(), 47.4, 1e-10);
  EXPECT_NEAR(origin.y(), 9, 1e-10);
  EXPECT_NEAR(origin.z(), 430, 1e-6);
  EXPECT_NEAR((Geodetic({0, 20, 0}).x() - 47.4) * north_m, 20, 0.002);
  EXPECT_NEAR((Geodetic({20, 0, 0}).y() - 9) * east_m, 20, 0.002);
  EXPECT_NEAR(Geodetic({0, 0, 3}).z(), 433, 1e-6);
}

TEST(MujocoMeasured, RowsAreLostAndStampsJitterAndRise) {
  NoiseForm noise;
  noise.lost = 0.02;
  noise.bursts_1ps = 0;
  const std::vector<Row> rows = Log(600, 0.01, {0.2, 0}, noise, 3, "unit");
  // 2 % of 60000 rows are lost: 1200, with five standard deviations of 171.
  EXPECT_NEAR(static_cast<double>(rows.size()), 60000 - 1200 - 12, 171 + 12);
  double late_s = 0, squared_s2 = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double off_s = 1e-9 * static_cast<double>(rows[k].t_ns) - rows[k].true_s;
    late_s += off_s;
    squared_s2 += (off_s - 0.2) * (off_s - 0.2);
    if (k > 0) {
      EXPECT_GT(rows[k].t_ns, rows[k - 1].t_ns);
    }
  }
  const double n = static_cast<double>(rows.size());
  EXPECT_NEAR(late_s / n, 0.2, 5 * 0.0006 / std::sqrt(n) + 1e-6);
  EXPECT_NEAR(std::sqrt(squared_s2 / n), 0.0006, 0.00002);
}

TEST(MujocoMeasured, PosesOfAStandingMachineAreOne) {
  MachineNumbers numbers;
  numbers.antennas = {Mount{"gnss_left", kUndercarriage, {0, 0.5, 1.5}},
                      Mount{"gnss_right", kUndercarriage, {0, -0.5, 1.5}}};
  Start start;
  start.yaw_rad = M_PI / 2;  // nose north: the left antenna lies west
  Measured measured;
  for (int k = 0; k < 20; ++k) {
    const double off_m = k % 2 == 0 ? 0.01 : -0.01;
    const auto row = [&](double east_m) {
      return std::vector<double>{0, 0, 0, east_m + off_m, 2, 1.5, 4, 0, 0, 0};
    };
    for (std::size_t r = 0; r < 2; ++r) {
      measured.receivers[r].t_ns.push_back(100'000'000LL * k);
      measured.receivers[r].rows.push_back(row(r == 0 ? -0.5 : 0.5));
    }
  }
  const Table standing = OwnersPoses(numbers, measured, start, true);
  ASSERT_GT(standing.rows.size(), 15u);
  EXPECT_EQ(standing.rows.front(), standing.rows.back());
  EXPECT_NEAR(standing.rows[0][0], 0, 0.002);
  EXPECT_NEAR(standing.rows[0][1], 2, 1e-9);
  EXPECT_NEAR(standing.rows[0][2], 0, 1e-9);
  const Table driving = OwnersPoses(numbers, measured, start, false);
  EXPECT_NEAR(driving.rows[3][3], std::sqrt(0.5), 1e-9);  // turned by a right angle about z
  EXPECT_NEAR(driving.rows[3][6], std::sqrt(0.5), 1e-9);
  EXPECT_NE(driving.rows[2][0], driving.rows[3][0]);
}

}  // namespace
}  // namespace tera::blind::mujoco
