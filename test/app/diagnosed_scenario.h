#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "app/program.h"

namespace tera {

using Json = nlohmann::json;
using Names = std::vector<std::string>;

/// Curves and turns in both directions, forwards and backwards, 61 s.
inline std::string TrackLevers() {
  std::ostringstream csv;
  csv << "t_s,left_track,right_track\n0,0,0\n";
  const double sides[][2] = {{0.6, 0.2},  {-0.5, -0.1}, {0.1, 0.5},  {-0.2, -0.7}, {0.5, -0.5},
                             {-0.4, 0.4}, {0.7, 0.7},   {-0.6, 0.1}, {0.3, 0.7},   {-0.6, -0.6},
                             {0.6, -0.2}, {-0.3, 0.5},  {0.5, 0.3},  {-0.4, -0.6}};
  double t_s = 1;
  for (int round = 0; round < 2; ++round) {
    for (const auto& [left, right] : sides) {
      csv << t_s << ',' << left << ',' << right << '\n' << t_s + 1.6 << ",0,0\n";
      t_s += 2.1;
    }
  }
  return csv.str();
}

/// Removes the truth of a recording, and keeps the measurements.
inline void RemoveTruth(const std::filesystem::path& recording) {
  std::filesystem::remove_all(recording / "truth");
  std::ifstream file(recording / "dataset.yaml");
  std::string kept;
  for (std::string line; std::getline(file, line);) {
    if (line.find("\"truth/") == line.npos) kept += line + '\n';
  }
  file.close();
  std::ofstream(recording / "dataset.yaml") << kept;
}

/// A scenario, its recordings, and the diagnosis with few candidates.
class DiagnoseByScenario : public testing::Test {
 protected:
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(scratch_.path() / name) << text;
  }
  void Record(const std::string& out, const Arguments& more = {}) const {
    Run({"generate", "scenario.yaml", "--out", out}, more);
  }
  /// The findings, "unexplained" included.
  Names Diagnose(const std::string& recording, const std::string& out,
                 const Arguments& more = {}) const {
    Run({"diagnose", "scenario.yaml", recording, "--library", "library.yaml", "--out", out}, more);
    Names names;
    const Json report = Report(out);
    for (const Json& finding : report["findings"]) names.push_back(finding["mechanism"]);
    return names;
  }
  Json Report(const std::string& out) const {
    std::ifstream file(scratch_.path() / out / "diagnosis.json");
    return Json::parse(file);
  }

  std::filesystem::path folder() const { return scratch_.path(); }

 private:
  void Run(Arguments arguments, const Arguments& more) const {
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = RunTera(arguments, {scratch_.path()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  const ScratchDirectory scratch_;
};

}  // namespace tera
