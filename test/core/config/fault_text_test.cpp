#include "core/config/fault_text.h"

#include <gtest/gtest.h>

#include "core/faults.h"

// The wording of the faults common to all readers is only here and in fault_text.cpp: change both.

namespace tera {
namespace {

using enum FaultKind;

TEST(FaultText, NamesWhatIsUnknownAndWhatIsNearestToIt) {
  EXPECT_EQ(fault::UnknownKey("max_rang_m", {"max_range_m", "min_range_m"}).finding,
            "unknown key (did you mean 'max_range_m'?)");
  EXPECT_EQ(fault::UnknownKey("extra", {"a", "file"}).finding, "unknown key; known here: a, file");
  EXPECT_EQ(fault::NotKnown("boxx", {"ball", "box"}).finding,
            "'boxx' is not known, need one of ball, box (did you mean 'box'?)");
  EXPECT_EQ(fault::NoSuchColumn("sped", {"speed", "b"}).finding,
            "no column 'sped' (did you mean 'speed'?); it has speed, b");
}

TEST(FaultText, SaysWhatWasFoundAndWhatIsNeeded) {
  EXPECT_EQ(fault::Missing("more than 0 s").finding, "missing, need more than 0 s");
  EXPECT_EQ(fault::RepeatedKey().finding, "repeated key; keep one");
  EXPECT_EQ(fault::NotANumber("'x'", "0 to 1 m").finding, "'x' is not a number, need 0 to 1 m");
  EXPECT_EQ(fault::NotAWholeNumber(1.5).finding, "1.5 is not a whole number");
  EXPECT_EQ(fault::NotABoolean("'on'").finding, "'on' is neither true nor false");
  EXPECT_EQ(fault::NotAText("a mapping").finding, "a mapping is not a text");
  EXPECT_EQ(fault::Mistyped("a list of 2", "a list of 3 numbers").finding,
            "a list of 2 found, need a list of 3 numbers");
  EXPECT_EQ(fault::OutOfRange("-0.02", "0 to 1 m").finding, "-0.02 is out of range, need 0 to 1 m");
  EXPECT_EQ(fault::FieldCount(1, 2).finding, "1 fields, need 2 as in the first line");
}

TEST(FaultText, OfAFileHasTheRemedy) {
  EXPECT_EQ(fault::NoSuchFile("lost.glb", "small.yaml").finding,
            "file 'lost.glb' does not exist; correct the path (relative to small.yaml, or "
            "'tera:...' for a file that TERA ships)");
  EXPECT_EQ(fault::CannotBeRead("a CSV file").finding, "cannot be read; need a CSV file");
  EXPECT_EQ(fault::NotAnEmptyFolder().finding,
            "is not an empty directory; choose another place or delete it");
  EXPECT_EQ(fault::NotValidYaml("end of map not found").finding,
            "not valid YAML: end of map not found");
  EXPECT_EQ(fault::NotAMapping("at the top").finding, "need a mapping of keys at the top");
}

TEST(InputError, TellsEachFaultOnALineOfItsOwnAfterItsPlace) {
  const InputError error({{FaultKind::kRepeated, "repeated key; keep one", "a.yaml:4:1: a"},
                          {FaultKind::kMissing, "there is none; need one"}});
  EXPECT_STREQ(error.what(), "a.yaml:4:1: a: repeated key; keep one\nthere is none; need one");
  EXPECT_EQ(InputError("--out", error.AsFinding()).faults().front().kind, FaultKind::kRepeated);
}

TEST(Faults, AreFoundByTheEndOfTheirPlaceInWholeComponents) {
  const std::string place = "run/site.yaml:3:10: piles[0].height_m";
  for (const char* end : {"height_m", "piles[0].height_m", "site.yaml:3:10: piles[0].height_m"}) {
    EXPECT_TRUE(EndsIn(place, end)) << end;
  }
  for (const char* end : {"eight_m", "piles[0]", "3:10", "te.yaml:3:10: piles[0].height_m"}) {
    EXPECT_FALSE(EndsIn(place, end)) << end;
  }
  EXPECT_TRUE(EndsIn("run/levers.csv:12", "levers.csv"));
  EXPECT_TRUE(EndsIn("run/levers.csv:12", "levers.csv:12"));
  EXPECT_FALSE(EndsIn("run/levers.csv:12", "levers.csv:1"));
  EXPECT_TRUE(EndsIn("a.yaml:1:2: box_m[1]", "box_m"));
  EXPECT_FALSE(EndsIn("a.yaml:1:2: box_m[1].x", "box_m"));
  const std::string told = "some warning\nrun/site.yaml:3:10: piles[0].height_m: -1 is: not so\n";
  EXPECT_THAT(told, TellsOf("site.yaml:3:10: piles[0].height_m"));
  EXPECT_THAT(told, TellsOf("height_m"));
  EXPECT_THAT(told, testing::Not(TellsOf("piles[0]")));
}

}  // namespace
}  // namespace tera
