#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "app/program.h"

/// How the program takes bad input: exit status 2, one message that says where, what and what to
/// do, and nothing left behind.

namespace tera {

/// Runs the program in `scratch`, where it must refuse its input with one line like `message` and
/// leave everything as it was.
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

/// A scenario that neither check nor generate may take.
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
