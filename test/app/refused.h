#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "app/program.h"

/// Response of the program to bad input: exit status 2, one message with place, finding and remedy,
/// and no files left behind.

namespace tera {

/// Runs the program in `scratch`. It must refuse its input with one line like `message`, and change
/// no file.
inline void ExpectRefused(const ScratchDirectory& scratch, const Arguments& arguments,
                          const testing::Matcher<const std::string&>& message,
                          const std::map<std::string, std::string>& environment = {}) {
  const auto before = Entries(scratch.path());
  const Outcome outcome = RunTera(arguments, {scratch.path(), environment});
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, testing::AllOf(message, testing::EndsWith("\n")));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(Entries(scratch.path()), before);
}

/// Expects check and generate to refuse a scenario.
inline void ExpectScenarioRefused(const ScratchDirectory& scratch, const std::string& scenario,
                                  const testing::Matcher<const std::string&>& message) {
  WriteWholeFile(scratch.path() / "small.yaml", scenario);
  ExpectRefused(scratch, {"check", "small.yaml"}, message);
  ExpectRefused(scratch, {"generate", "small.yaml", "--out", "run"}, message);
}

inline void ExpectScenarioRefused(const std::string& scenario,
                                  const testing::Matcher<const std::string&>& message) {
  const ScratchDirectory scratch;
  ExpectScenarioRefused(scratch, scenario, message);
}

/// "small.yaml:line:column: " of the first `needle`.
inline std::string At(const std::string& scenario, const std::string& needle) {
  return "small.yaml:" + LineAndColumn(scenario, needle) + ": ";
}

}  // namespace tera
