#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/program.h"
#include "app/refused.h"
#include "core/faults.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/tiny_disk.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A receiver's report on an antenna.
struct Said {
  double t_s = 0, east_m = 0, north_m = 0, up_m = 0;
};

/// A recording without simulation: a level machine on a winding path, and receivers with antennas
/// 0.9 m behind and 2.1 m above the machine's origin.
class ReceiverRecording : public testing::Test {
 protected:
  ReceiverRecording() {
    std::ostringstream poses;
    poses.precision(12);
    poses << "t_ns,x_m,y_m,z_m,qw,qx,qy,qz\n";
    double x_m = -10, y_m = -10;
    for (int k = 0; k <= 1200; ++k) {
      const double t_s = 0.05 * k, yaw_rad = 0.8 * std::sin(0.31 * t_s) + 0.5;
      poses << k * 50'000'000LL << ',' << x_m << ',' << y_m << ",0," << std::cos(yaw_rad / 2)
            << ",0,0," << std::sin(yaw_rad / 2) << '\n';
      way_.push_back({t_s, x_m, y_m, yaw_rad});
      const double speed_mps = 0.6 + 0.5 * std::sin(0.9 * t_s);
      x_m += 0.05 * speed_mps * std::cos(yaw_rad);
      y_m += 0.05 * speed_mps * std::sin(yaw_rad);
    }
    WriteWholeFile(FileIn("truth/excavator1", "pose.csv"), poses.str());
  }

  /// A receiver, and a sensor of the scenario at `documented`. `measured` changes its report at a
  /// time for an antenna at x, y, z of the machine.
  void Write(const std::string& name, const Said& documented_m, const Said& antenna_m,
             const std::function<Said(Said)>& measured) {
    std::ostringstream gnss;
    gnss.precision(12);
    gnss << "t_ns,lat_deg,lon_deg,alt_m,east_m,north_m,up_m,fix,var_e_m2,var_n_m2,var_u_m2\n";
    for (std::size_t k = 0; k < way_.size(); k += 4) {
      const auto& [t_s, x_m, y_m, yaw_rad] = way_[k];
      const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
      const Said said =
          measured({t_s, x_m + c * antenna_m.east_m - s * antenna_m.north_m + Noise_m(0.005),
                    y_m + s * antenna_m.east_m + c * antenna_m.north_m + Noise_m(0.005),
                    antenna_m.up_m + Noise_m(0.009)});
      gnss << std::llround(said.t_s * 1e9) << ",0,0,0," << said.east_m << ',' << said.north_m << ','
           << said.up_m << ",4,1e-4,1e-4,2e-4\n";
    }
    WriteWholeFile(FileIn("excavator1/" + name, "data.csv"), gnss.str());
    channels_ += "  - {path: excavator1/" + name + ", type: gnss}\n";
    std::ostringstream sensor;
    sensor << "\n      - {name: " << name
           << ", preset: tera:config/sensors/rtk_f9p.yaml, link: " << link_ << ", xyz_m: ["
           << documented_m.east_m << ", " << documented_m.north_m << ", " << documented_m.up_m
           << "]}";
    sensors_ += sensor.str();
    WriteWholeFile(FileIn("", "dataset.yaml"),
                   "format: 1\ntera_version: \"0.1.0\"\nname: hand\nsimulated: false\nseed: 0\n"
                   "duration_s: 60\norigin: {lat_deg: 0, lon_deg: 0, height_m: 0}\nchannels:\n"
                   "  - {path: truth/excavator1/pose.csv, type: pose}\n" +
                       channels_ + "classes:\n  - {id: 0, name: sky}\ninstances: []\n");
    WriteWholeFile(scratch_.path() / "site.yaml", R"(
name: site
duration_s: 60
terrain: {size_m: [60, 60], cell_m: 0.5, soil: asphalt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    operator: {type: idle}
    rig:
      sensors:)" + sensors_ + "\n");
  }
  void Write(const Said& antenna_m, const std::function<Said(Said)>& measured) {
    Write("gnss", kAsDocumented, antenna_m, measured);
  }

  nlohmann::json Diagnosed() const {
    const Outcome outcome =
        RunTera({"diagnose", "site.yaml", "real", "--out", "why"}, {scratch_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    out_ = outcome.out;
    return nlohmann::json::parse(ReadWholeFile(scratch_.path() / "why" / "diagnosis.json"));
  }
  void ExpectRefusedWith(const testing::Matcher<const std::string&>& message) const {
    ExpectRefused(scratch_, {"diagnose", "site.yaml", "real", "--out", "why"}, message);
  }

  static constexpr Said kAsDocumented = {0, -0.9, 0, 2.1};
  static Said AsItIs(Said said) { return said; }
  /// All samples of a second within five milliseconds, so that most of an even grid would be empty.
  static Said InBursts(Said said) {
    const double second = std::floor(said.t_s + 1e-6);
    said.t_s = second + 0.005 * (said.t_s - second);
    return said;
  }
  const ScratchDirectory scratch_;
  mutable std::string out_;
  std::string link_ = "undercarriage";

 private:
  struct PlanarPose {
    double t_s, x_m, y_m, yaw_rad;
  };
  std::filesystem::path FileIn(const std::string& folder, const std::string& file) const {
    const std::filesystem::path in = scratch_.path() / "real" / folder;
    std::filesystem::create_directories(in);
    return in / file;
  }
  double Noise_m(double sigma_m) {  // uniform
    state_ = state_ * 1664525u + 1013904223u;
    return sigma_m * std::sqrt(12.0) * (state_ / 4294967296.0 - 0.5);
  }

  std::vector<PlanarPose> way_;
  std::string channels_, sensors_;
  unsigned state_ = 1;
};

TEST_F(ReceiverRecording, OfAnAntennaThatIsWhereItShouldBeIsAsTheScenario) {
  Write(kAsDocumented, AsItIs);
  const auto json = Diagnosed();
  EXPECT_EQ(json["verdict"][0], "none") << out_;
  EXPECT_EQ(json["findings"].size(), 0u) << out_;
  EXPECT_THAT(out_, HasSubstr("gnss and poses agree with each other"));
}

TEST_F(ReceiverRecording, OnALinkWhoseJointHasNoEncoderIsComparedAsFarAsTheOthersTell) {
  Write(kAsDocumented, AsItIs);
  link_ = "upper";
  Write("gnss_upper", {0, -0.9, 0, 1.54}, kAsDocumented, AsItIs);
  const auto json = Diagnosed();
  EXPECT_EQ(json["findings"].size(), 0u) << out_;
  EXPECT_THAT(out_, HasSubstr("gnss upper"));
}

TEST_F(ReceiverRecording, ShowsALeverArmAndTheOverlayThatHasIt) {
  Write({0, -0.6, 0.25, 2.1}, AsItIs);
  const auto json = Diagnosed();
  ASSERT_EQ(json["findings"].size(), 1u) << out_;
  const auto& finding = json["findings"][0];
  EXPECT_EQ(finding["mechanism"], "gnss_lever_arm");
  EXPECT_EQ(finding["target"], "gnss");
  EXPECT_NEAR(finding["parameters"]["x_m"]["value"].get<double>(), 0.3, 0.02);
  EXPECT_NEAR(finding["parameters"]["y_m"]["value"].get<double>(), 0.25, 0.02);
  const Outcome check =
      RunTera({"check", "site.yaml", "--effects", "why/effects.yaml"}, {scratch_.path()});
  EXPECT_EQ(check.status, 0) << check.err;
}

TEST_F(ReceiverRecording, ShowsTheSecondsBetweenGpsTimeAndUtc) {
  Write(kAsDocumented, [](Said said) {
    said.t_s += 18;
    return said;
  });
  const auto json = Diagnosed();
  ASSERT_EQ(json["findings"].size(), 1u) << out_;
  EXPECT_EQ(json["findings"][0]["mechanism"], "clock_offset");
  const auto& offset = json["findings"][0]["parameters"]["offset_s"];
  EXPECT_NEAR(offset["value"].get<double>(), 18, 0.05);
}

TEST_F(ReceiverRecording, WithAClockOfAnotherDayGivesBothSpans) {
  Write(kAsDocumented, [](Said said) {
    said.t_s += 86400;
    return said;
  });
  ExpectRefusedWith(AllOf(HasSubstr("a receiver and poses have no time in common"),
                          HasSubstr("86400.000 s to 86460.000 s and 0.000 s to 60.000 s")));
}

TEST_F(ReceiverRecording, InMillimetresSuggestsThemAndConvertsNothing) {
  Write(kAsDocumented, [](Said said) {
    return Said{said.t_s, 1000 * said.east_m, 1000 * said.north_m, 1000 * said.up_m};
  });
  ExpectRefusedWith(TellsOf("gnss/data.csv"));
}

TEST_F(ReceiverRecording, ThatStandsStillWhileTheMachineDrives) {
  Write(kAsDocumented, [](Said said) {
    said.north_m = 3.5;
    return said;
  });
  ExpectRefusedWith(AllOf(HasSubstr("column 'north_m' is 3.5 in all 301 samples with a fix"),
                          HasSubstr("while the machine goes")));
}

TEST_F(ReceiverRecording, WithoutPosesSaysWhatItNeeds) {
  Write(kAsDocumented, AsItIs);
  const std::filesystem::path file = scratch_.path() / "real" / "dataset.yaml";
  WriteWholeFile(
      file, Edited(ReadWholeFile(file), "  - {path: truth/excavator1/pose.csv, type: pose}\n", ""));
  std::filesystem::remove_all(scratch_.path() / "real" / "truth");
  ExpectRefusedWith(
      AllOf(HasSubstr("nothing of excavator1 can be replayed"), HasSubstr("a receiver and poses")));
}

TEST_F(ReceiverRecording, ThatComesInBurstsSaysWhichReceiverAndWhatItNeeds) {
  Write(kAsDocumented, InBursts);
  ExpectRefusedWith(TellsOf("excavator1/gnss"));
}

TEST_F(ReceiverRecording, OfOneReceiverIsJudgedWhereTheOtherOneComesInBursts) {
  Write("left", {0, -0.9, 0.5, 2.1}, {0, -0.6, 0.5, 2.1}, AsItIs);
  Write("right", {0, -0.9, -0.5, 2.1}, {0, -0.9, -0.5, 2.1}, InBursts);
  const auto json = Diagnosed();
  ASSERT_EQ(json["findings"].size(), 1u) << out_;
  EXPECT_EQ(json["findings"][0]["mechanism"], "gnss_lever_arm");
  EXPECT_EQ(json["findings"][0]["target"], "left");
  ASSERT_EQ(json["not_compared"].size(), 2u);
  EXPECT_THAT(json["not_compared"][0].get<std::string>(),
              AllOf(HasSubstr("excavator1/right: 301 samples"), HasSubstr("bursts")));
  EXPECT_THAT(json["not_compared"][1].get<std::string>(), HasSubstr("excavator1/base: what its"));
  EXPECT_THAT(out_, HasSubstr("Not compared: excavator1/right: 301 samples"));
  EXPECT_THAT(json["verdict"], testing::Contains("untestable"));
}

TEST_F(ReceiverRecording, WhoseReportFitsNotOnTheDiskLeavesNoneAndSaysSo) {
  Write({0, -0.6, 0.25, 2.1}, AsItIs);
  const TinyDisk disk(scratch_.path() / "disk", "8k");
  ASSERT_TRUE(disk.mounted()) << "needs root, or the right to make user namespaces";
  const Outcome full =
      RunTera({"diagnose", "site.yaml", "real", "--out", "disk/why"}, {scratch_.path()});
  EXPECT_EQ(full.status, 2);
  EXPECT_THAT(full.err, AllOf(HasSubstr("disk/why"), HasSubstr("No space left on device"),
                              HasSubstr("free space on that disk")));
  EXPECT_THAT(Entries(scratch_.path() / "disk"), testing::IsEmpty());
}

}  // namespace
}  // namespace tera
