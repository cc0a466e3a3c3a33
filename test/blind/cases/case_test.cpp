#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "blind/cases/benchmark_case.h"
#include "blind/cases/recording_files.h"
#include "blind/marking/seal.h"
#include "blind/prove.h"
#include "core/error.h"
#include "own_folder.h"

namespace tera::blind {
namespace {

namespace fs = std::filesystem;

const PlainMachine& Tb235() {
  static const PlainMachine machine = PlainMachine::Read("config/machines/tb235.yaml");
  return machine;
}

std::string TextOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Case, KindsComeInTheirShares) {
  std::map<CaseKind, int> count;
  for (int k = 0; k < 960; ++k) ++count[DrawCase(7, k, Tb235(), 45).kind];
  EXPECT_NEAR(count[CaseKind::kNothing], 400, 4);
  EXPECT_NEAR(count[CaseKind::kOne], 260, 4);
  EXPECT_NEAR(count[CaseKind::kTwo], 120, 4);
  EXPECT_NEAR(count[CaseKind::kOutside], 80, 4);
  EXPECT_NEAR(count[CaseKind::kConfounded], 60, 4);
  EXPECT_NEAR(count[CaseKind::kUntestable], 40, 4);
}

TEST(Case, HidesWhatItsKindSays) {
  for (int k = 0; k < 200; ++k) {
    const BenchmarkCase c = DrawCase(2, k, Tb235(), 45);
    const std::size_t hidden =
        c.kind == CaseKind::kNothing ? 0 : (c.kind == CaseKind::kTwo ? 2 : 1);
    EXPECT_EQ(c.hidden.size(), hidden);
    EXPECT_NE(c.joints.has_value(), c.tracks.has_value());
    for (const Concealed& concealed : c.hidden) {
      EXPECT_EQ(concealed.name.empty(), c.kind == CaseKind::kOutside);
    }
    if (!c.joints) continue;
    EXPECT_GE(c.joints->measured.size(), 2u);
    for (const HiddenInJoint& one : c.joints->hidden) {
      EXPECT_THAT(c.joints->measured, testing::Contains(one.axis));
    }
  }
}

TEST(Case, KeepsJointsOffTheirStopsWhateverIsHidden) {
  for (int k = 0; k < 6; ++k) {
    BenchmarkCase c = DrawCase(11, k, Tb235(), 26);
    if (!c.joints) continue;
    for (const std::vector<double>& row : Record(&c, 11).encoders.rows) {
      for (std::size_t m = 0; m < c.joints->measured.size(); ++m) {
        const PlainAxis& axis = Tb235().excavator.axis(c.joints->measured[m]);
        ASSERT_GT(row[m], axis.lower_rad) << "case " << k;
        ASSERT_LT(row[m], axis.upper_rad) << "case " << k;
      }
    }
  }
}

TEST(Case, ShowsInTheMotionWhatItHides) {
  for (int k = 0; k < 6; ++k) {
    BenchmarkCase c = DrawCase(1, k, Tb235(), 26);
    const CaseRecording recording = Record(&c, 1);
    ASSERT_EQ(recording.changes.size(), c.hidden.size());
    const bool shows = c.kind != CaseKind::kUntestable;
    for (const Change& change : recording.changes) {
      EXPECT_EQ(change.Rms() > 0.02, shows) << "case " << k;
    }
  }
}

TEST(Case, HidesBothOfTwoEffectsOfTracksInEitherOrder) {
  const std::pair<const char*, const char*> orders[] = {{"track_asymmetry", "track_scale"},
                                                        {"track_scale", "track_asymmetry"}};
  for (const auto& [first, second] : orders) {
    TrackForm form;
    HideInTracks(first, Strength::kStrong, Stream(1, "first"), &form);
    HideInTracks(second, Strength::kStrong, Stream(1, "second"), &form);
    EXPECT_LT(form.worn_left, 0.97 * form.worn_right) << first;
    EXPECT_LT(form.worn_left + form.worn_right, 1.94) << first;
  }
}

TEST(Case, TellsWhatEachOfTwoEffectsChangesBesideTheOther) {
  int cases = 0;
  for (int k = 0; k < 60 && cases < 3; ++k) {
    BenchmarkCase c = DrawCase(2, k, Tb235(), 26);
    if (c.kind != CaseKind::kTwo || !c.joints || c.hidden[0].target != c.hidden[1].target) continue;
    ++cases;
    const CaseRecording recording = Record(&c, 2);
    ASSERT_EQ(recording.changes.size(), 2u);
    EXPECT_NE(recording.changes[0].Rms(), recording.changes[1].Rms()) << "case " << k;
    for (const Change& change : recording.changes) EXPECT_GT(change.Rms(), 0.02) << "case " << k;
  }
  EXPECT_EQ(cases, 3);
}

constexpr const char* kDrive = "examples/recordings/drive_warthog/asphalt_2024-09-20.csv";

TEST(InjectedCase, LeavesTheRealDriveAsItIsButForTheWheels) {
  const RealDrive real = RealDrive::Read(kDrive);
  EXPECT_EQ(real.t_s.size(), 8747u);
  EXPECT_EQ(real.poses.columns.size(), 7u);
  InjectedCase injected{real.Part(150, 60)};
  EXPECT_NEAR(injected.drive.t_s.front(), 0, 0.06);
  EXPECT_NEAR(injected.drive.t_s.back(), 60, 0.06);
  const Concealed concealed =
      HideInRealDrive("track_asymmetry", Strength::kStrong, Stream(1, "injected"), &injected);
  EXPECT_EQ(concealed.target, "base");
  const CaseRecording recording = RecordInjected(injected);
  const double parts = injected.left / injected.right - 1;
  EXPECT_GT(parts, 0.08);
  EXPECT_LT(parts, 0.14);
  ASSERT_EQ(recording.encoders.rows.size(), injected.drive.t_s.size());
  for (std::size_t k = 0; k < recording.encoders.rows.size(); ++k) {
    EXPECT_EQ(recording.encoders.rows[k][2], injected.left * injected.drive.left_radps[k]);
    EXPECT_EQ(recording.encoders.rows[k][3], injected.right * injected.drive.right_radps[k]);
  }
  EXPECT_EQ(recording.poses.rows, injected.drive.poses.rows);
  EXPECT_GT(recording.changes[0].Rms(), 0.5);
}

TEST(InjectedCase, IsDrawnWhereThereIsARealDriveAlone) {
  PlainMachine with = Tb235();
  with.real = RealDrive::Read(kDrive);
  int injected = 0;
  for (int k = 0; k < 100; ++k) {
    injected += DrawCase(2, k, with, 45).kind == CaseKind::kInjected;
    EXPECT_NE(DrawCase(2, k, Tb235(), 45).kind, CaseKind::kInjected);
  }
  EXPECT_NEAR(injected, 4, 1);
}

TEST(InjectedCase, NeedsTheColumnsOfTheDrive) {
  EXPECT_THROW(RealDrive::Read("no/such.csv"), InputError);
  const fs::path other = OwnFolder() / "other.csv";
  std::ofstream(other) << "t_s,left\n0,1\n";
  EXPECT_THROW(RealDrive::Read(other), InputError);
}

TEST(Seal, IsThePublishedDigest) {
  // FIPS 180-4's example.
  EXPECT_EQ(Digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Prove, ToolSeesNoTruthAndTheSealHoldsBoth) {
  const fs::path folder = OwnFolder() / "blind_seal";
  const auto tool = [&](const fs::path& scenario, const fs::path& recording, const fs::path& out) {
    EXPECT_FALSE(fs::exists(scenario.parent_path() / "truth.json"));
    EXPECT_TRUE(fs::exists(recording / "dataset.yaml"));
    EXPECT_THAT(TextOf(scenario.parent_path() / "seal.txt"), testing::StartsWith("truth "));
    fs::create_directories(out);
    std::ofstream(out / "diagnosis.json")
        << R"({"verdict": ["none"], "findings": [], "untestable": [], "held_out": []})";
  };
  const ProveOptions options{.cases = 2,
                             .seed = 5,
                             .duration_s = 26,
                             .machine_yaml = "config/machines/tb235.yaml",
                             .out = folder / "proof"};
  EXPECT_EQ(Prove(options, {tool, {}}, [](const Mark&) {}).size(), 2u);
  const fs::path first = options.out / "case_0001";
  const std::string truth = TextOf(first / "truth.json");
  const std::string answer = TextOf(first / "report" / "diagnosis.json");
  EXPECT_EQ(TextOf(first / "seal.txt"), "truth " + Digest(truth) + "\nanswer " + Digest(answer) +
                                            "\nboth " + Digest(truth + answer) + "\n");
  EXPECT_THAT(TextOf(options.out / "table.md"), testing::HasSubstr("false alarm"));
}

TEST(Prove, SameSeedSameBytes) {
  const fs::path folder = OwnFolder() / "blind_bytes";
  BenchmarkCase c = DrawCase(3, 4, Tb235(), 26);
  WriteCase(c, Record(&c, 3), folder / "a");
  WriteCase(c, Record(&c, 3), folder / "b");
  const fs::path data = fs::path("recording") / kName / "encoders" / "data.csv";
  EXPECT_GT(TextOf(folder / "a" / data).size(), 10000u);
  EXPECT_EQ(TextOf(folder / "a" / data), TextOf(folder / "b" / data));
}

TEST(Prove, KeepsAToolThatGivesUpAsACaseWithoutAnswer) {
  const fs::path folder = OwnFolder() / "blind_fault";
  const auto tool = [](const fs::path&, const fs::path&, const fs::path&) {
    throw std::runtime_error("no");
  };
  const auto marks = Prove({.cases = 1,
                            .duration_s = 26,
                            .machine_yaml = "config/machines/tb235.yaml",
                            .out = folder / "proof"},
                           {tool, {}}, [](const Mark&) {});
  EXPECT_EQ(marks[0].fault, "no");
}

TEST(Case, ACounterpartThatRunsIntoItsCylindersDeadPointIsIntegrated) {
  // Without its rate limit the arm exceeds its stop by 16 deg, where the pins' distance is longest.
  BenchmarkCase c = DrawCase(36, 33, Tb235(), 45);
  ASSERT_EQ(c.hidden.size(), 2u);
  EXPECT_EQ(c.hidden[0].name, "cylinder_lever");
  for (const Change& change : Record(&c, 36).changes) EXPECT_GT(change.Rms(), 0.02);
}

}  // namespace
}  // namespace tera::blind
