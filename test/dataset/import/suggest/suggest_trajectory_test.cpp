#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"
#include "dataset/import/suggest/suggest.h"

/// Text files of poses: TUM, EuRoC and KITTI.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Trajectory : public ::testing::Test {
 protected:
  std::vector<TruthPose> Suggested(const std::string& name, const std::string& text) {
    fs::create_directories((scratch_.path() / name).parent_path());
    WriteWholeFile(scratch_.path() / name, text);
    return Imported(SuggestMapping(scratch_.path() / name));
  }
  std::vector<TruthPose> Imported(const std::string& yaml) {
    yaml_ = yaml;
    WriteWholeFile(scratch_.path() / "mapping.yaml", yaml);
    fs::remove_all(scratch_.path() / "out");
    ImportCsv(scratch_.path() / "mapping.yaml", scratch_.path() / "out");
    return Recording(scratch_.path() / "out").LoadPose("truth/machine/pose.csv").poses;
  }
  /// Poses of KITTI's form, whose suggestion leaves the time to be filled in.
  std::vector<TruthPose> FilledIn(const std::string& name, const std::string& text) {
    try {
      Suggested(name, text);
      ADD_FAILURE() << "imported without a time: " << yaml_;
    } catch (const InputError& fault) {
      EXPECT_THAT(fault.what(), HasSubstr("'unknown' does not describe a time"));
    }
    const std::string unknown = "time: unknown";
    const std::size_t at = yaml_.find(unknown);
    if (at == std::string::npos) return {};
    return Imported(
        std::string(yaml_).replace(at, unknown.size(), "time: {interval: 0.1, unit: s}"));
  }
  /// 0.1 s apart, at 1 2 3 and 4 2 3, turned about z by 2 atan(0.6 / 0.8).
  void ExpectThePoses(const std::vector<TruthPose>& poses) {
    ASSERT_EQ(poses.size(), 2u) << yaml_;
    EXPECT_EQ(poses[1].t_ns - poses[0].t_ns, 100'000'000);
    EXPECT_EQ(poses[0].X_WB.translation(), Vec3(1, 2, 3));
    EXPECT_EQ(poses[1].X_WB.translation(), Vec3(4, 2, 3));
    EXPECT_NEAR(poses[1].X_WB.linear()(0, 0), 0.28, 1e-12);
    EXPECT_NEAR(poses[1].X_WB.linear()(1, 0), 0.96, 1e-12);
    EXPECT_NEAR(poses[1].X_WB.linear()(2, 2), 1, 1e-12);
  }
  ScratchDirectory scratch_;
  std::string yaml_;
};

TEST_F(Trajectory, OfTumHasTheQuaternionsWLast) {
  const std::string rows = "1305031102.1 1 2 3 0 0 0.6 0.8\n1305031102.2 4 2 3 0 0 0.6 0.8\n";
  for (const std::string head :
       {"", "# ground truth trajectory\n# timestamp tx ty tz qx qy qz qw\n"}) {
    ExpectThePoses(Suggested("groundtruth.txt", head + rows));
    EXPECT_THAT(yaml_, HasSubstr("form: tum"));
  }
  // As numpy.savetxt writes them.
  ExpectThePoses(Suggested("a.tum",
                           "1.0e+01 1.0e+00 2.0e+00 3.0e+00 0.0e+00 0.0e+00 6.0e-01 8.0e-01\n"
                           "1.01e+01 4.0e+00 2.0e+00 3.0e+00 0.0e+00 0.0e+00 6.0e-01 8.0e-01\n"));
}

TEST_F(Trajectory, OfEurocHasTheQuaternionsWFirst) {
  const std::string head =
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
      "q_RS_z "
      "[], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], "
      "b_w_RS_S_y "
      "[rad s^-1], b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m "
      "s^-2]\n";
  const auto row = [](const std::string& time, int x_m, const std::string& rest) {
    return fmt::format("{},{},2,3,0.8,0,0,0.6{}\n", time, x_m, rest);
  };
  const std::string wide = ",0,0,0,0,0,0,0,0,0";
  ExpectThePoses(Suggested("data.csv", head + row("1403636580838555648", 1, wide) +
                                           row("1403636580938555648", 4, wide)));
  EXPECT_THAT(yaml_, HasSubstr("form: euroc"));
  ExpectThePoses(Suggested("poses.csv",
                           row("1403636580838555648", 1, "") + row("1403636580938555648", 4, "")));
  EXPECT_THAT(yaml_, HasSubstr("form: euroc"));
}

TEST_F(Trajectory, WhereTwoOrdersArePossibleTheImportAsks) {
  WriteWholeFile(scratch_.path() / "poses.csv", "0.1,1,2,3,0,0,0.6,0.8\n0.2,4,2,3,0,0,0.6,0.8\n");
  const std::string yaml = SuggestMapping(scratch_.path() / "poses.csv");
  try {
    Imported(yaml);
    FAIL() << yaml;
  } catch (const InputError& fault) {
    EXPECT_THAT(fault.what(), AllOf(HasSubstr("pose.form: 'tum_or_euroc'"), HasSubstr("tum")));
  }
  std::string chosen = yaml;
  chosen.replace(chosen.find("tum_or_euroc"), 12, "tum");
  ExpectThePoses(Imported(chosen));
}

// As in TERA's export of a machine and its links.
TEST_F(Trajectory, OfAFolderOfTumsTheMachinesIsThePose) {
  const std::string rows = "0.1 1 2 3 0 0 0.6 0.8\n0.2 4 2 3 0 0 0.6 0.8\n";
  fs::create_directories(scratch_.path() / "tum/digger/links");
  WriteWholeFile(scratch_.path() / "tum/digger/links/arm.tum",
                 "0 9 9 9 0 0 0 1\n1 9 9 9 0 0 0 1\n");
  WriteWholeFile(scratch_.path() / "tum/digger.tum", rows);
  ExpectThePoses(Imported(SuggestMapping(scratch_.path() / "tum")));
  EXPECT_THAT(yaml_, HasSubstr("# not imported: "));
}

// 0.28 and 0.96 are cosine and sine of the turn.
TEST_F(Trajectory, OfKittiIsRowsOfRotationAndPlaceAndNeedsTimes) {
  const std::string rows =
      "0.28 -0.96 0 1 0.96 0.28 0 2 0 0 1 3\n0.28 -0.96 0 4 0.96 0.28 0 2 0 0 1 3\n";
  const auto poses = FilledIn("00.txt", rows);
  ExpectThePoses(poses);
  EXPECT_THAT(yaml_, AllOf(HasSubstr("form: kitti"), HasSubstr("the file has no times")));
  const std::string head = "name: n\nmachine: machine\nfile: 00.txt\n";
  EXPECT_THROW(Imported(head + "pose: {form: kitti}\n"), InputError);
  WriteWholeFile(scratch_.path() / "00.txt", "1 2 3 4 5 6 7 8 9 10 11 12\n");
  try {
    Imported(head + "pose: {form: kitti, time: {interval: 0.1, unit: s}}\n");
    FAIL();
  } catch (const InputError& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("00.txt:1: its numbers are not a rotation and a position"));
  }
}

TEST_F(Trajectory, OfKittiHasTheTimesOfAFileBesideIt) {
  const std::string rows =
      "0.28 -0.96 0 1 0.96 0.28 0 2 0 0 1 3\n0.28 -0.96 0 4 0.96 0.28 0 2 0 0 1 3\n";
  fs::create_directories(scratch_.path() / "sequences/00");
  fs::create_directories(scratch_.path() / "poses");
  for (const auto& [poses, times] :
       {std::pair{"00.txt", "times.txt"}, {"poses/00.txt", "sequences/00/times.txt"}}) {
    WriteWholeFile(scratch_.path() / times, "0.000000e+00\n1.037359e-01\n");
    const auto found = Suggested(poses, rows);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[1].t_ns, 103'735'900);
    EXPECT_EQ(found[1].X_WB.translation().x(), 4);
  }
  WriteWholeFile(scratch_.path() / "times.txt", "0\n1\n2\n");
  EXPECT_THAT(
      [&] {
        Imported(
            "name: n\nmachine: machine\nfile: 00.txt\npose: {form: kitti, times: times.txt}\n");
      },
      ThrowsFault(FaultKind::kInconsistent, "00.txt"));
}

// A camera that drives along its z and turns left about -y, by its cosine 0.8 and sine 0.6.
TEST_F(Trajectory, OfKittisCameraIsTurnedUpright) {
  const auto poses =
      FilledIn("05.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n0.8 0 -0.6 -2 0 1 0 0.1 0.6 0 0.8 10\n");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_TRUE(poses[0].X_WB.isApprox(Pose::Identity(), 1e-9)) << yaml_;
  EXPECT_TRUE(poses[1].X_WB.translation().isApprox(Vec3(10, 2, -0.1), 1e-9));
  EXPECT_NEAR(poses[1].X_WB.linear()(0, 0), 0.8, 1e-9);
  EXPECT_NEAR(poses[1].X_WB.linear()(1, 0), 0.6, 1e-9);
}

TEST_F(Trajectory, LinesThatAreNoPoseAreToldOf) {
  WriteWholeFile(scratch_.path() / "p.txt", "0 1 2 3 0 0 0 1\n1 1 2 3 0 0 0 1\n2 1 2 x 0 0 0 1\n");
  const std::string yaml = "name: n\nmachine: machine\nfile: p.txt\npose: {form: tum}\n";
  try {
    Imported(yaml);
    FAIL();
  } catch (const InputError& fault) {
    EXPECT_THAT(fault.what(), AllOf(HasSubstr("p.txt:3: 'x' is no number"), HasSubstr("skip-bad")));
  }
  WriteWholeFile(scratch_.path() / "p.txt", "0 1 2 3 0 0 0 1\n1 1 2\n");
  EXPECT_THROW(Imported(yaml), InputError);
}

// mav0 as published: the ground truth's first name has no unit, blanks follow commas, and its
// biases have names that end like the inertial unit's.
TEST_F(Trajectory, AFolderOfEurocAsPublishedHasUnitAndPose) {
  const auto write = [&](const std::string& file, const std::string& text) {
    fs::create_directories((scratch_.path() / file).parent_path());
    WriteWholeFile(scratch_.path() / file, text);
  };
  write("mav0/imu0/data.csv",
        "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m "
        "s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n1403636580838555648,0.1,0.2,0.3,1,2,9.8\n");
  write("mav0/cam0/data.csv", "#timestamp [ns],filename\n1403636580838555648,a.png\n");
  write("mav0/leica0/data.csv",
        "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m]\n1,2,3,4\n");
  write(
      "mav0/arm/vicon0/data.csv",
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z "
      "[]\n1403636580838555648,7,7,7,1,0,0,0\n");
  write(
      "mav0/state_groundtruth_estimate0/data.csv",
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
      "q_RS_z [], b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1], b_a_RS_S_x "
      "[m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]\n"
      "1403636580838555648,1,2,3,0.8,0,0,0.6,0,0,0,0,0,0\n"
      "1403636580938555648,4,2,3,0.8,0,0,0.6,0,0,0,0,0,0\n");
  ExpectThePoses(Imported(SuggestMapping(scratch_.path() / "mav0")));
  const Recording recording(scratch_.path() / "out");
  EXPECT_EQ(recording.LoadImu("machine/imu0")[0].f_S_mps2, Vec3(1, 2, 9.8));
  EXPECT_EQ(recording.ChannelsOf("imu").size(), 1u);
  EXPECT_THAT(yaml_, HasSubstr("cam0/data.csv, a mapping cannot import pictures"));
}

}  // namespace
}  // namespace tera
