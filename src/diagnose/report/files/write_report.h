#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/files/whole_folder.h"
#include "dataset/format/recording.h"
#include "diagnose/diagnosis.h"

namespace tera {

/// Writes diagnosis.json, effects.yaml, report.html and, where there is one, next_manoeuvre.csv
/// into a folder, and the ground map of each sensor that has one, as CSV and as GeoTIFF. The folder
/// is made where it is missing; as that of a WholeFolder it appears complete. `recording` is the
/// recording's name in the files. Throws InputError.
void WriteReport(const std::filesystem::path& directory, const Diagnosis& diagnosis,
                 const std::string& recording);

/// Throws InputError where the folder exists, so that a report has nothing of an earlier run.
void RequireNewFolder(const std::filesystem::path& out);

/// The reports of all machines of a recording, in a folder of each where there are several. It
/// appears when it is complete.
class ReportFolder {
 public:
  /// Throws InputError where it cannot be written.
  explicit ReportFolder(const std::filesystem::path& out) : out_(out), whole_(out) {}

  /// Returns the page of each machine.
  std::vector<std::filesystem::path> Write(const std::vector<Diagnosis>& diagnoses,
                                           const Recording& recording);

 private:
  std::filesystem::path out_;
  WholeFolder whole_;
};

}  // namespace tera
