#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/blocks/base_block.h"
#include "diagnose/statistics/series/simulated.h"

namespace tera {
namespace {

// A machine drives straight at 0.8 m/s, stops, and returns. Its measured heading is 0.03 rad too
// far left, so that its apparent velocity is v cos(0.03) forward and -v sin(0.03) to the left.
TEST(MeasuredHeading, ExplainsThatAMachineSeemsToGoSideways) {
  ReplayBlock base;
  base.channels.resize(3);
  std::vector<double> forward_mps, left_mps;
  for (int k = 0; k < 150; ++k) {
    const double speed_mps = k < 50 ? 0.8 : k < 100 ? 0 : -0.8;
    forward_mps.push_back(speed_mps * std::cos(0.03));
    left_mps.push_back(-speed_mps * std::sin(0.03));
  }
  forward_mps[20] = NAN;
  base.channels[0].measured = MakeSeries(0.1, forward_mps);
  base.channels[1].measured = MakeSeries(0.1, left_mps);
  base.channels[1].nominal = Eigen::MatrixXd::Ones(150, 2);
  LetHeadingErr(0.05, &base);
  const Eigen::MatrixXd& nominal = base.channels[1].nominal;
  ASSERT_EQ(nominal.rows(), 150);
  ASSERT_EQ(nominal.cols(), 3);
  EXPECT_EQ(nominal(149, 1), 1);
  // 0.03 rad are 1.2 standard deviations of 0.025.
  for (int k = 0; k < 150; ++k) {
    EXPECT_NEAR(1.2 * nominal(k, 2), k == 20 ? 0 : left_mps[static_cast<std::size_t>(k)], 1e-5);
  }
}

}  // namespace
}  // namespace tera
