#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/files/whole_folder.h"
#include "dataset/format/recording.h"
#include "diagnose/diagnosis.h"

namespace tera {

/// Writes diagnosis.json, effects.yaml, report.html and, if present, next_manoeuvre.csv and the
/// ground map of each sensor, as GeoTIFF. Creates the folder if missing; that of a
/// WholeFolder appears when complete. `recording` is the recording's name in the files. Throws
/// InputError.
void WriteReport(const std::filesystem::path& directory, const Diagnosis& diagnosis,
                 const std::string& recording);

/// Throws InputError if the folder exists, so that reports of two runs never mix.
void RequireNewFolder(const std::filesystem::path& out);

/// Reports of all machines of a recording. With several machines, each has its own folder. The
/// folder appears when it is complete.
class ReportFolder {
 public:
  /// Throws InputError if the folder cannot be written.
  explicit ReportFolder(const std::filesystem::path& out) : out_(out), whole_(out) {}

  /// Returns the page of each machine.
  std::vector<std::filesystem::path> Write(const std::vector<Diagnosis>& diagnoses,
                                           const Recording& recording);

 private:
  std::filesystem::path out_;
  WholeFolder whole_;
};

}  // namespace tera
