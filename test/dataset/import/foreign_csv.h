#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/faults.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"

/// Logs in foreign formats, and their mappings.

namespace tera {

class ForeignCsv : public ::testing::Test {
 protected:
  void Log(const std::string& text) { WriteWholeFile(scratch_.path() / "log.txt", text); }

  ImportReport Import(const std::string& keys, ImportOptions options = {}) {
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   "name: logged\nmachine: digger\nfile: log.txt\n" + keys);
    std::filesystem::remove_all(Out());
    return ImportCsv(scratch_.path() / "mapping.yaml", Out(), options);
  }

  /// A table with two columns.
  static std::string Table(const std::string& a, const std::string& b,
                           const std::string& name = "levels") {
    return "tables: [{name: " + name + ", columns: {a: {column: " + a +
           ", unit: '1'}, b: {column: " + b + ", unit: '1'}}}]\n";
  }

  std::vector<std::vector<double>> Rows(const std::string& name = "levels") const {
    return Recording(Out()).LoadTable("digger/" + name + ".csv").rows;
  }
  std::vector<TimeNs> Times() const { return Recording(Out()).LoadTable("digger/levels.csv").t_ns; }
  std::filesystem::path Out() const { return scratch_.path() / "out"; }

  ScratchDirectory scratch_;
};

inline constexpr char kSeconds[] = "time: {column: t, unit: s}\n";
inline const std::vector<std::vector<double>> kTwoRows = {{1.5, -2}, {3, 4e-3}};
inline const std::vector<TimeNs> kTwentyMs = {0, 20'000'000};

}  // namespace tera
