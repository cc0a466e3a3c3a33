#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "app/program.h"
#include "dataset/compare/compare.h"

/// A segment of a recorded drive, imported, and the simulated machine under the same commands.

namespace tera {

/// Copies the rows of a DRIVE recording from `begin_s` to `end_s`; time counts from `begin_s`.
inline void CutDrive(const std::filesystem::path& from, double begin_s, double end_s,
                     const std::filesystem::path& to) {
  std::ifstream in(from);
  std::ofstream out(to);
  std::string line;
  ASSERT_TRUE(std::getline(in, line)) << from << " cannot be read";
  out << line << '\n';
  while (std::getline(in, line)) {
    const double t_s = std::strtod(line.c_str(), nullptr);
    if (t_s < begin_s || t_s > end_s) continue;
    out << std::to_string(t_s - begin_s) << line.substr(line.find(',')) << '\n';
  }
}

/// Imports `csv` to real/ and simulates its commands to simulated/, both in `directory`.
inline void ImportAndReplay(const std::filesystem::path& csv, double duration_s,
                            const std::filesystem::path& directory) {
  const std::string config = TERA_SOURCE_DIR "/config/";
  const Outcome import = RunTera({"import", config + "import/drive_warthog.yaml", "--set",
                                  "file=" + csv.string(), "--out", "real"},
                                 {directory});
  EXPECT_EQ(import.status, 0) << import.err;
  const Outcome run = RunTera({"generate", config + "scenarios/warthog_asphalt.yaml", "--set",
                               "machines[0].operator.csv=" + csv.string(), "--duration",
                               std::to_string(duration_s), "--out", "simulated"},
                              {directory});
  EXPECT_EQ(run.status, 0) << run.err;
}

/// Difference b - a of a channel's column.
inline ChannelDifference DifferenceOf(const Comparison& comparison, const std::string& column) {
  for (const ChannelDifference& d : comparison.machines.at(0).channels) {
    if (d.column == column) return d;
  }
  ADD_FAILURE() << "no column " << column;
  return {};
}

}  // namespace tera
