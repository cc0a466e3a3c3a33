#include <cmath>

#include "dataset/import/suggest/suggested_table.h"

// Units of rates, angles and inertial units without a hint in the names. Each suggestion is run.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kG_mps2 = 9.81;

/// A log of 50 Hz, a row by its time.
std::string Log(const std::string& head, int rows,
                const std::function<std::vector<double>(double t_s)>& row) {
  std::string log = head + "\n";
  for (int k = 0; k < rows; ++k) {
    log += fmt::format("{:.2f}", 0.02 * k);
    for (const double value : row(0.02 * k)) log += fmt::format(",{:.7f}", value);
    log += "\n";
  }
  return log;
}

/// An inertial unit on a boom that pitches by 20 deg and back in 8 s; `unit_radps` is the unit of
/// its rates.
std::string Pitching(double unit_radps) {
  return Log("time_s,gx,gy,gz,ax,ay,az", 1000, [=](double t_s) {
    const double w = 2 * kPi / 8, pitch_rad = 20 * kDeg * std::sin(w * t_s);
    return std::vector<double>{0, 20 * kDeg * w * std::cos(w * t_s) / unit_radps,
                               0, -kG_mps2 * std::sin(pitch_rad),
                               0, kG_mps2 * std::cos(pitch_rad)};
  });
}

TEST_F(SuggestedTable, RatesThatNothingTellsTheUnitOfAreToBeFilledIn) {
  // Slewing level, at rates that are fast in rad/s and slow in deg/s.
  const std::string log = Log("time_s,gx,gy,gz,ax,ay,az", 200, [](double t_s) {
    return std::vector<double>{0.1, 0.05, 3 + 15 * std::abs(std::sin(t_s)), 0.02, 0.05, kG_mps2};
  });
  EXPECT_THAT(Refusal(log), HasFault(FaultKind::kNoSuchName, "columns.wx.unit"));
  EXPECT_THAT(yaml_, HasSubstr("wx: {column: gx, unit: unknown}   # to fill in: "));
}

TEST_F(SuggestedTable, GravityTellsTheUnitOfRates) {
  for (const double unit_radps : {1.0, kDeg}) {
    const auto imu = Imported(Pitching(unit_radps)).LoadImu("machine/imu");
    EXPECT_NEAR(imu.at(0).w_WS_S_radps.y(), 20 * kDeg * 2 * kPi / 8, 1e-6);
  }
}

TEST_F(SuggestedTable, AnAngleTellsTheUnitOfItsRate) {
  const auto log = [](const std::string& head, double unit_radps) {
    return Log(head, 400, [=](double t_s) {
      return std::vector<double>{20 * std::sin(t_s), 20 * std::cos(t_s) * kDeg / unit_radps};
    });
  };
  for (const double unit_radps : {1.0, kDeg}) {
    for (const std::string name : {"boom_rate", "boom_velocity", "boom_vel", "BoomOmega"}) {
      const EncoderRecording joints = Joints(log("time_s,boom_deg," + name, unit_radps));
      ASSERT_EQ(joints.axes.size(), 1u);
      EXPECT_NEAR(joints.samples[0].qd_radps[0], 20 * kDeg, 1e-6) << name;
    }
  }
  // The angle's own unit is that of the neighbouring arm.
  const std::string arm = Log("time_s,boom,boom_rate,arm", 400, [](double t_s) {
    return std::vector<double>{20 * std::sin(t_s), 20 * std::cos(t_s), -80};
  });
  EXPECT_NEAR(Joints(arm).samples[0].qd_radps[0], 20 * kDeg, 1e-6);
  // The yaw's unit, about an axis invisible to gravity.
  const std::string yaw = Log("time_s,gx,gy,gz,ax,ay,az,yaw_deg", 400, [](double t_s) {
    return std::vector<double>{0, 0, 20 * std::cos(t_s), 0, 0, kG_mps2, 20 * std::sin(t_s)};
  });
  EXPECT_NEAR(Imported(yaw).LoadImu("machine/imu").at(0).w_WS_S_radps.z(), 20 * kDeg, 1e-6);
}

TEST_F(SuggestedTable, RatesOfJointsAloneHaveTheUnitOfTheirNameOrNone) {
  const auto rate = [](double t_s) { return std::vector<double>{20 * std::cos(t_s)}; };
  EXPECT_THAT(Refusal(Log("time_s,boom_rate", 50, rate)),
              HasFault(FaultKind::kNoSuchName, "joints[0].rate.unit"));
  EXPECT_NEAR(Joints(Log("time_s,boom_rate_dps", 50, rate)).samples[0].qd_radps[0], 20 * kDeg,
              1e-9);
  EXPECT_NEAR(Joints(Log("time_s,boom velocity [rpm]", 50, rate)).samples[0].qd_radps[0],
              20 * 2 * kPi / 60, 1e-9);
  // A cylinder's rate, and a commanded one.
  Suggest(Log("time_s,boom_velocity_mmps,arm_rate_cmd", 50, [](double) {
    return std::vector<double>{1, 2};
  }));
  EXPECT_THAT(yaml_, Not(HasSubstr("rate:")));
}

TEST_F(SuggestedTable, RatesThatNoMachineHasAreDegreesOrCounts) {
  const auto still = [](double rate) {
    return Log("time_s,gx,gy,gz,ax,ay,az", 50,
               [=](double) { return std::vector<double>{0, 0, rate, 0, 0, kG_mps2}; });
  };
  EXPECT_NEAR(Imported(still(45)).LoadImu("machine/imu").at(0).w_WS_S_radps.z(), 45 * kDeg, 1e-6);
  EXPECT_THAT(Refusal(still(3000)), HasFault(FaultKind::kNoSuchName, "columns.wx.unit"));
}

TEST_F(SuggestedTable, CountsOfAnInertialUnitAreToBeFilledInAndJudgedByTheirDirectionAlone) {
  const std::string log = Log("time_s,gx,gy,gz,ax,ay,az", 200, [](double t_s) {
    return std::vector<double>{10, 5, 700 * std::cos(t_s), 100, -200, -16384};
  });
  EXPECT_THAT(Refusal(log), AllOf(HasFault(FaultKind::kNoSuchName, "columns.ax.unit"),
                                  HasFault(FaultKind::kNoSuchName, "columns.wx.unit")));
  EXPECT_THAT(yaml_, HasSubstr("rpy_deg: [180, 0, 0]"));
  EXPECT_THAT(yaml_, Not(HasSubstr("-1.64e+04 m/s2")));
}

TEST_F(SuggestedTable, AUnitWhoseXOrYIsUprightIsToldWithTheTurnThatMakesItZ) {
  // The rotation is applied to gravity as measured.
  for (const auto& [up, rpy] : {std::pair{Vec3(1, 0, 0), "[0, -90, 0]"},
                                {Vec3(-1, 0, 0), "[0, 90, 0]"},
                                {Vec3(0, 1, 0), "[90, 0, 0]"},
                                {Vec3(0, -1, 0), "[-90, 0, 0]"}}) {
    Suggest(Log("time_s,wx_radps,wy_radps,wz_radps,ax,ay,az", 100, [&up](double) {
      const Vec3 f = kG_mps2 * up;
      return std::vector<double>{0, 0, 0.01, f.x(), f.y(), f.z()};
    }));
    const std::string key = std::string("rpy_deg: ") + rpy;
    ASSERT_THAT(yaml_, HasSubstr(key));
    yaml_.insert(yaml_.find("    columns:"), "    " + key + "\n");
    const Vec3 f_mps2 = Import().LoadImu("machine/imu").at(0).f_S_mps2;
    EXPECT_NEAR((f_mps2 - Vec3(0, 0, kG_mps2)).norm(), 0, 1e-6);
  }
}

TEST_F(SuggestedTable, AnglesOfOneLoggerHaveOneUnit) {
  const EncoderRecording both = Joints("time_s,boom,arm\n0.00,3,-80\n0.02,3.1,-81\n0.04,3.2,-82\n");
  EXPECT_NEAR(both.samples[0].q_rad[0], 3 * kDeg, 1e-12);
  EXPECT_THAT(Refusal("time_s,boom\n0.00,3\n0.02,3.1\n0.04,3.2\n"),
              HasFault(FaultKind::kNoSuchName, "joints[0].angle.unit"));
  EXPECT_NEAR(Joints("time_s,slew [gon]\n0.00,100\n0.02,101\n").samples[0].q_rad[0], kPi / 2,
              1e-12);
}

TEST_F(SuggestedTable, RowsOfSeveralSensorsAreToldApart) {
  std::string log = "time_s,imu_id,gx_dps,gy_dps,gz_dps,ax_g,ay_g,az_g\n";
  for (int k = 0; k < 40; ++k) {
    for (const int id : {3, 5}) log += fmt::format("{:.2f},{},0,0,{},0,0,1\n", 0.02 * k, id, id);
  }
  const auto imu = Imported(log).LoadImu("machine/imu");
  ASSERT_EQ(imu.size(), 40u);
  for (const ImuSample& one : imu) EXPECT_NEAR(one.w_WS_S_radps.z(), 3 * kDeg, 1e-9);
}

TEST_F(SuggestedTable, AnAccelerationInGThatIsNamedInMetresIsTold) {
  Suggest(Log("time_s,wx_radps,wy_radps,wz_radps,ax_mps2,ay_mps2,az_mps2", 50,
              [](double) { return std::vector<double>{0, 0, 0.01, 0, 0, 1}; }));
  EXPECT_THAT(yaml_, HasSubstr("unit: g\n    columns:"));
}

// --- Long tables.

TEST_F(SuggestedTable, AUnitThatChangesWithinASignalIsToBeFilledIn) {
  EXPECT_THAT(Refusal("time_s,signal,value,unit\n0.00,boom,20,deg\n0.02,boom,0.35,rad\n"
                      "0.04,boom,20.2,deg\n"),
              HasFault(FaultKind::kNoSuchName, "columns.boom.unit"));
}

TEST_F(SuggestedTable, CountsOfALongTableAreNoAngles) {
  std::string log = "time_s,signal,raw\n";
  for (int k = 0; k < 40; ++k) {
    log += fmt::format("{:.3f},{},{}\n", 0.01 * k, k % 2 == 0 ? "boom" : "arm", 1000 + k);
  }
  EXPECT_EQ(Imported(log).LoadTable("machine/boom.csv").rows.at(1).at(0), 1002);
}

TEST_F(SuggestedTable, AnglesOfALongTableGoOnAndRatesAreRates) {
  std::string log = "time_s,signal,value\n";
  for (int k = 0; k < 80; ++k) {
    log += fmt::format("{:.3f},slew_deg,{}\n{:.3f},arm_rate [deg/s],30\n", 0.02 * k,
                       (300 + 3 * k) % 360, 0.02 * k + 0.01);
  }
  const Recording recording = Imported(log);
  const auto slew = recording.LoadEncoder("machine/slew_deg").samples;
  EXPECT_NEAR(slew.back().q_rad[0] - slew.front().q_rad[0], 3 * 79 * kDeg, 1e-9);
  EXPECT_NEAR(recording.LoadEncoder("machine/arm_rate_deg_s").samples.at(0).qd_radps[0], 30 * kDeg,
              1e-9);
}

}  // namespace
}  // namespace tera
