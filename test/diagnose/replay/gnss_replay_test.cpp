#include "diagnose/replay/gnss_replay.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/replay/recorded_receivers.h"

namespace tera {
namespace {

double RmsError_m(const ReceiverLog& log, const std::vector<Vec3>& predicted_m) {
  double square = 0;
  for (std::size_t k = 0; k < predicted_m.size(); ++k) {
    square += (predicted_m[k] - log.p_WS_m[k]).squaredNorm();
  }
  return std::sqrt(square / static_cast<double>(predicted_m.size()));
}

TEST(GnssReplay, IsWhereTheReceiverSaysWithItsErrorsAndNotWithout) {
  for (const Effects& effects :
       {Effects{Named("gnss_lever_arm", {0.3, -0.2, 0.1}), Named("latency", {0.4, 0})},
        Effects{Named("antenna_swap", {})}, Effects{Named("clock_offset", {18})},
        Effects{Named("filter_delay", {0.8})}, Effects{Named("multipath", {0.4, 0.6, 30})},
        Effects{Named("position_datum", {2, -1}), Named("height_datum", {0.5})}}) {
    const Receivers receivers(effects, {});
    const GnssLog log = receivers.Log();
    ASSERT_GT(log[0].t_ns.size(), 300u);
    const GnssReplay replay(receivers.sensors, log);
    // Noise of 0.9 cm along each of two axes and 1.5 cm upwards.
    EXPECT_LT(RmsError_m(log[0], replay.Predict(0, {effects, {}})), 0.03);
    EXPECT_GT(RmsError_m(log[0], replay.Predict(0, {{}, {}})), 0.2) << effects[0].mechanism->id;
    EXPECT_LT(RmsError_m(log[1], replay.Predict(1, {effects, {}})), 0.03);
  }
}

TEST(GnssReplay, LeavesOutWhatIsWorseThanTheDocumentedFix) {
  Receivers receivers({}, {});
  for (std::size_t k = 50; k < 100; ++k) receivers.samples[0][k].fix = GnssFix::kRtkFloat;
  receivers.samples[1][5].fix = GnssFix::kNone;
  const GnssLog log = receivers.Log();
  EXPECT_EQ(log[0].t_ns.size(), 351u);
  EXPECT_EQ(log[1].t_ns.size(), 400u);
}

}  // namespace
}  // namespace tera
