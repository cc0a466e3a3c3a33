#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include "dataset/format/sample_recording.h"
#include "dataset/lint/lint.h"

/// A small faultless recording with every kind of channel, all consistent with one motion and one
/// scene; and its mutations.

namespace tera {

/// Writes it. A chassis drives east at 0.5 m/s, pitched, and turns left at 0.4 rad/s for 2 s. It
/// carries an inertial unit, a receiver, an encoder of two joints, a camera before a wall 5 m away
/// with a truck and a boom in the picture, and a lidar that sees the wall.
void WriteHealthyRecording(const std::filesystem::path& directory);

inline constexpr int kHealthyWidth_px = 24, kHealthyHeight_px = 16;

/// A healthy recording that each test breaks in one place.
class LintTest : public testing::Test {
 protected:
  LintTest() { WriteHealthyRecording(run()); }
  std::filesystem::path run() const { return scratch_.path() / "run"; }

  LintReport Linted(const LintOptions& options = {}) const { return Lint(run(), options); }
  /// Ids of the rules with findings.
  std::set<std::string> Found() const;
  /// Expects that this rule alone found something in this channel; returns its finding.
  LintFinding Only(const std::string& rule, const std::string& channel) const;

  /// Replaces the first `from` by `to` in a file.
  void Edit(const std::string& file, const std::string& from, const std::string& to) const;
  /// Rewrites a file's rows except the header: `change` has the line's number and its fields.
  void EditRows(const std::string& file,
                const std::function<void(int, std::vector<std::string>*)>& change) const;
  /// Multiplies columns of all rows.
  void Scale(const std::string& file, const std::vector<std::string>& columns, double by) const;
  void Put(const std::string& file, const std::string& bytes) const {
    WriteWholeFile(run() / file, bytes);
  }

 private:
  ScratchDirectory scratch_;
};

}  // namespace tera
