#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "app/hand_made_recording.h"
#include "app/program.h"
#include "app/refused.h"
#include "core/faults.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A recording that cannot be compared: one message, exit 2, no report.
class BadRecording : public testing::Test {
 protected:
  BadRecording() { WriteWholeFile(scratch_.path() / "boom.yaml", kHandMadeScenario); }

  void ExpectRefusedWith(const testing::Matcher<const std::string&>& message) const {
    ExpectRefused(scratch_, {"diagnose", "boom.yaml", "real", "--out", "why"}, message);
  }
  std::filesystem::path File(const std::string& name) const {
    return scratch_.path() / "real" / "excavator1" / name;
  }
  std::string Read(const std::string& name) const {
    std::ifstream file(File(name));
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// Rewrites every row of a table below its header.
  void EditRows(const std::string& name,
                const std::function<std::string(const std::string&)>& edit) const {
    std::istringstream text(Read(name));
    std::string out, line;
    std::getline(text, line);
    out = line + "\n";
    while (std::getline(text, line)) out += edit(line) + "\n";
    WriteWholeFile(File(name), out);
  }

  const ScratchDirectory scratch_;
};

/// The columns of a row of the encoder.
std::array<std::string, 3> Cells(const std::string& row) {
  std::istringstream text(row);
  std::array<std::string, 3> cells;
  for (std::string& cell : cells) std::getline(text, cell, ',');
  return cells;
}

TEST_F(BadRecording, WithoutAnyCommonChannelSaysWhatIsNeeded) {
  WriteHandMade(scratch_.path() / "real", {});
  WriteWholeFile(scratch_.path() / "real" / "dataset.yaml",
                 Edited(ReadWholeFile(scratch_.path() / "real" / "dataset.yaml"),
                        "  - {path: excavator1/encoders, type: encoder}\n", ""));
  ExpectRefusedWith(AllOf(HasSubstr("no encoder channel of excavator1"),
                          HasSubstr("need something measured to compare")));
}

TEST_F(BadRecording, WithEncodersThatHaveNoSampleOrNoJointSaysWhich) {
  WriteHandMade(scratch_.path() / "real", {});
  WriteWholeFile(File("encoders/data.csv"), "t_ns\n0\n25000000000\n");
  ExpectRefusedWith(
      AllOf(HasSubstr("encoders measure no joint or gear of the machine, but nothing"),
            HasSubstr("need one of slew, ")));
  WriteWholeFile(File("encoders/data.csv"), "t_ns,boom_rad,boom_radps\n");
  ExpectRefusedWith(HasSubstr("no sample in the encoder channels of excavator1"));
}

TEST_F(BadRecording, WithTimesInMicrosecondsAsksWhatTheyAre) {
  WriteHandMade(scratch_.path() / "real", {});
  const auto in_microseconds = [](const std::string& row) {
    const std::size_t comma = row.find(',');
    return std::to_string(std::stoll(row) / 1000) + row.substr(comma);
  };
  EditRows("encoders/data.csv", in_microseconds);
  EditRows("commands.csv", in_microseconds);
  ExpectRefusedWith(AllOf(HasSubstr("0.0 s were measured"), HasSubstr("t_ns counts nanoseconds"),
                          HasSubstr("microseconds")));
}

TEST_F(BadRecording, WithoutALeverOfTheMachineNamesThoseThatItHas) {
  WriteHandMade(scratch_.path() / "real", {});
  const std::string commands = Read("commands.csv");
  WriteWholeFile(File("commands.csv"), Edited(commands, "t_ns,boom", "t_ns,throttle"));
  ExpectRefusedWith(AllOf(HasSubstr("no lever channel: the commands have the columns throttle"),
                          HasSubstr("need one of"), HasSubstr("boom")));
}

TEST_F(BadRecording, WithClocksThatDoNotOverlapGivesBothSpans) {
  WriteHandMade(scratch_.path() / "real", {.clock_s = 1000});
  ExpectRefusedWith(AllOf(HasSubstr("excavator1/encoders and commands have no time in common"),
                          HasSubstr("1000.000 s to 1041.980 s and 0.000 s to 41.980 s"),
                          HasSubstr("count from the same event")));
}

TEST_F(BadRecording, WithARateThatStandsStillWhileItsPositionChanges) {
  WriteHandMade(scratch_.path() / "real", {});
  EditRows("encoders/data.csv", [](const std::string& row) {
    const auto cells = Cells(row);
    return cells[0] + "," + cells[1] + ",0";
  });
  ExpectRefusedWith(TellsOf("encoders/data.csv"));
}

TEST_F(BadRecording, WithAPositionThatStandsStillWhileItsRateChanges) {
  WriteHandMade(scratch_.path() / "real", {});
  EditRows("encoders/data.csv", [](const std::string& row) {
    const auto cells = Cells(row);
    return cells[0] + ",0.5," + cells[2];
  });
  ExpectRefusedWith(AllOf(HasSubstr("column 'boom_rad' is 0.5 in all 2100 samples"),
                          HasSubstr("need the position that was measured")));
}

TEST_F(BadRecording, WithRatesInDegreesSuggestsThemAndConvertsNothing) {
  WriteHandMade(scratch_.path() / "real", {.rate_factor = 57.29578});
  ExpectRefusedWith(AllOf(HasSubstr("column 'boom_radps' is 57.3 times what 'boom_rad' changes by"),
                          HasSubstr("in deg/s"), HasSubstr("nothing is converted")));
}

TEST_F(BadRecording, WithPositionsInDegreesComparesThemWithTheJointsLimits) {
  WriteHandMade(scratch_.path() / "real", {.rate_factor = 57.29578, .position_factor = 57.29578});
  ExpectRefusedWith(AllOf(HasSubstr("column 'boom_rad' goes from"), HasSubstr("the joint from"),
                          HasSubstr("Is it in deg?")));
}

TEST_F(BadRecording, WithEverythingAThousandTimesTooSmallIsHeldAgainstTheLevers) {
  WriteHandMade(scratch_.path() / "real",
                {.noise_radps = 0.0003, .rate_factor = 0.001, .position_factor = 0.001});
  ExpectRefusedWith(AllOf(HasSubstr("boom_radps is 0.00"),
                          HasSubstr("times what the scenario says of it"),
                          HasSubstr("taken for mrad/s"), HasSubstr("nothing is converted")));
}

TEST_F(BadRecording, WhoseJointGoesAgainstItsLever) {
  WriteHandMade(scratch_.path() / "real", {.rate_factor = -1, .position_factor = -1});
  ExpectRefusedWith(AllOf(HasSubstr("boom_radps goes against its lever (correlation -1.0"),
                          HasSubstr("need the signs of the scenario's machine")));
}

TEST_F(BadRecording, WhoseJointIsLateDoesNotGoAgainstItsLever) {
  // Strokes back and forth in 2.8 s: a delay of 1.4 s would invert them, one of 0.7 s does not.
  WriteHandMade(scratch_.path() / "real", {.clock_s = 0.7});
  const Outcome outcome = RunTera(
      {"diagnose", "boom.yaml", "real", "--no-simulation", "--out", "why"}, {scratch_.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("command delay 0.7"));
}

TEST_F(BadRecording, OfWhichTooLittleIsLookedAt) {
  WriteHandMade(scratch_.path() / "real", {});
  const auto refused = [&](const Arguments& part, const char* left) {
    Arguments arguments = {"diagnose", "boom.yaml", "real", "--out", "why"};
    arguments.insert(arguments.end(), part.begin(), part.end());
    ExpectRefused(scratch_, arguments,
                  AllOf(HasSubstr("real: 42.0 s were measured, of which --from and --to leave"),
                        HasSubstr(left), HasSubstr("need 20 s at least")));
  };
  refused({"--to", "10"}, "leave 10.0 s");
  refused({"--from", "500"}, "leave 0.0 s");
  refused({"--from", "30", "--to", "20"}, "leave 0.0 s");
}

TEST_F(BadRecording, ThatIsTooShort) {
  WriteHandMade(scratch_.path() / "real", {.duration_s = 12});
  ExpectRefusedWith(HasSubstr("real: 12.0 s were measured; need 20 s at least"));
}

TEST_F(BadRecording, WithLeversInPercent) {
  WriteHandMade(scratch_.path() / "real", {.lever_factor = 100});
  ExpectRefusedWith(TellsOf("commands.csv"));
}

TEST_F(BadRecording, WithANumberThatIsNoneSaysWhere) {
  WriteHandMade(scratch_.path() / "real", {});
  int row = 0;
  EditRows("encoders/data.csv", [&](const std::string& line) {
    const auto cells = Cells(line);
    return ++row == 10 ? cells[0] + ",nan," + cells[2] : line;
  });
  ExpectRefusedWith(AllOf(HasSubstr("encoders/data.csv:11"), HasSubstr("boom_rad")));
}

TEST_F(BadRecording, WithATimeThatComesTwiceSaysWhere) {
  WriteHandMade(scratch_.path() / "real", {});
  int row = 0;
  std::string before;
  EditRows("encoders/data.csv", [&](const std::string& line) {
    const auto cells = Cells(line);
    const std::string time = ++row == 10 ? before : cells[0];
    before = cells[0];
    return time + "," + cells[1] + "," + cells[2];
  });
  ExpectRefusedWith(HasSubstr("encoders/data.csv:11"));
}

/// A recording of the boom and, in a separate encoder, of an arm at given times.
class PartlyBadRecording : public BadRecording {
 protected:
  /// Output of the diagnosis.
  std::string DiagnosedWithArmAt(const std::vector<double>& times_s) const {
    HandMade made;
    made.valve = DeadTo0_1;
    WriteHandMade(scratch_.path() / "real", made);
    std::filesystem::create_directories(File("arm_encoder"));
    std::ostringstream rows;
    rows.precision(12);
    rows << "t_ns,arm_rad,arm_radps\n";
    for (const double t_s : times_s) {
      rows << std::llround(t_s * 1e9) << ',' << 0.2 * std::sin(3 * t_s) - 1.5 << ','
           << 0.6 * std::cos(3 * t_s) << '\n';
    }
    WriteWholeFile(File("arm_encoder/data.csv"), rows.str());
    const std::filesystem::path dataset = scratch_.path() / "real" / "dataset.yaml";
    WriteWholeFile(dataset, Edited(ReadWholeFile(dataset), "  - {path: excavator1/encoders",
                                   "  - {path: excavator1/arm_encoder, type: encoder}\n"
                                   "  - {path: excavator1/encoders"));
    WriteWholeFile(scratch_.path() / "only.yaml", "only: [dead_band]\n");
    const Outcome outcome = RunTera({"diagnose", "boom.yaml", "real", "--library", "only.yaml",
                                     "--no-simulation", "--out", "why"},
                                    {scratch_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("Boom rate"), HasSubstr("dead band 0.")));
    return outcome.out;
  }
};

TEST_F(PartlyBadRecording, OfOneJointWithALongGapLeavesTheOthersToBeJudged) {
  std::vector<double> times_s;  // of a second, and one row a minute later
  for (int k = 0; k < 240; ++k) times_s.push_back(0.005 * k);
  times_s.push_back(70);
  EXPECT_THAT(DiagnosedWithArmAt(times_s),
              AllOf(HasSubstr("Not compared: excavator1/arm_encoder/arm_radps: 241 samples"),
                    HasSubstr("leave a long gap")));
}

TEST_F(PartlyBadRecording, OfAJointWithoutItsLeverNamesTheColumnsThatThereAre) {
  std::vector<double> times_s;
  for (int k = 0; k < 2100; ++k) times_s.push_back(0.02 * k);
  EXPECT_THAT(DiagnosedWithArmAt(times_s),
              HasSubstr("Not compared: excavator1/arm_encoder/arm_radps: commands have no column "
                        "'arm', but boom; need its lever."));
}

}  // namespace
}  // namespace tera
