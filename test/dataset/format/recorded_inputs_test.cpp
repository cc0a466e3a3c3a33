#include "dataset/format/recorded_inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/portable_name.h"
#include "core/faults.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using enum FaultKind;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
namespace fs = std::filesystem;

InputFile Written(const fs::path& file, const std::string& bytes) {
  WriteWholeFile(file, bytes);
  return {PortableName(file), file};
}

TEST(RecordedInputs, HaveTheDigestsOfTheStandardsExamples) {
  const ScratchDirectory scratch;
  const auto digest = [&](const std::string& bytes) {
    return DigestsOf({Written(scratch.path() / "file", bytes)}).at(0).sha256;
  };
  // NIST, "SHA-256", the example values for FIPS 180-4: nothing, one block, many blocks.
  EXPECT_EQ(digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(RecordedInputs, ComeBackFromDatasetYaml) {
  const ScratchDirectory scratch;
  DatasetInfo info = SampleInfo();
  info.inputs = DigestsOf({Written(scratch.path() / "le \"vers\".csv", "t_ns\n0\n"),
                           Written(scratch.path() / "site.tif", "II*")});
  DatasetWriter(scratch.path() / "run", info, {}).Finish();
  const auto read = LoadInputs(scratch.path() / "run");
  ASSERT_EQ(read.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].name, info.inputs[i].name);
    EXPECT_EQ(read[i].bytes, info.inputs[i].bytes);
    EXPECT_EQ(read[i].sha256, info.inputs[i].sha256);
  }
  EXPECT_FALSE(fs::exists(scratch.path() / "run" / kInputsOfStoppedName));
}

TEST(RecordedInputs, OfARecordingThatNamesNoneAreNone) {
  const ScratchDirectory scratch;
  WriteWholeSample(scratch.path() / "run", {});
  const fs::path description = scratch.path() / "run/dataset.yaml";
  std::string text = ReadWholeFile(description);
  ASSERT_THAT(text, HasSubstr("inputs: []\n"));
  WriteWholeFile(description, text.erase(text.find("inputs: []\n")));  // as versions before had it
  EXPECT_TRUE(LoadInputs(scratch.path() / "run").empty());
  EXPECT_TRUE(LoadInputs(scratch.path() / "nowhere").empty());
}

TEST(RecordedInputs, ThatAreNotWhatTheyWereAreAllNamedAtOnce) {
  const ScratchDirectory scratch;
  const auto file = [&](const char* name) { return scratch.path() / name; };
  const auto inputs = DigestsOf({Written(file("same"), "as it was"), Written(file("longer"), "a"),
                                 Written(file("other"), "as it was"), Written(file("gone"), "b")});
  EXPECT_EQ(RequireInputs(inputs, {}, "act").size(), 4u);
  WriteWholeFile(file("longer"), "aa");
  WriteWholeFile(file("other"), "as it wuz");
  fs::remove(file("gone"));
  const auto faults = FaultsIn([&] { RequireInputs(inputs, {}, "act"); });
  EXPECT_THAT(faults, ElementsAre(IsFault(kInconsistent, ""), IsFault(kInconsistent, ""),
                                  IsFault(kUnreadable, "")));
  EXPECT_THAT(faults[1].finding, HasSubstr("other"));
  EXPECT_THAT(faults[2].finding, HasSubstr("gone"));
  // Digests by sha256sum.
  EXPECT_THAT(faults[0].finding,
              AllOf(HasSubstr("961b6dd3ede3"), HasSubstr("ca978112ca1b"), EndsWith("act")));
}

TEST(RecordedInputs, OfNoSenseAreAnErrorAtTheirPlace) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / kInputsOfStoppedName,
                 "inputs:\n  - {file: a, bytes: -1, sha256: \"12ab\", size: 3}\n");
  EXPECT_THAT(FaultsIn([&] { LoadInputs(scratch.path()); }),
              AllOf(HasFault(kOutOfRange, "inputs[0].bytes"), HasFaultAt("inputs[0].sha256"),
                    HasFault(kUnknown, "inputs[0].size")));
}

TEST(DatasetWriter, WillNotResumeWithOtherInputs) {
  const ScratchDirectory scratch;
  DatasetInfo info = SampleInfo();
  info.inputs = DigestsOf({Written(scratch.path() / "levers.csv", "t_ns\n0\n")});
  { const DatasetWriter writer(scratch.path() / "run", info, {}); }
  WriterOptions resume;
  resume.resume = true;
  DatasetInfo other = info;
  other.inputs = DigestsOf({Written(scratch.path() / "levers.csv", "t_ns\n1\n")});
  EXPECT_THAT([&] { DatasetWriter(scratch.path() / "run", other, resume); },
              ThrowsFault(kInconsistent));
  EXPECT_NO_THROW(DatasetWriter(scratch.path() / "run", info, resume).Finish());
}

}  // namespace
}  // namespace tera
