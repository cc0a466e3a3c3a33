#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dataset/lint/lint_job.h"

namespace tera {

/// A row of a list of frames.
struct FrameRow {
  int line = 0;
  TimeNs t_ns = 0;
  std::string filename;
};

/// The frames in a camera's or lidar's data.csv, without unreadable rows.
std::vector<FrameRow> FramesOf(const LintJob& job, const std::string& channel);

/// A folder of a camera's or lidar's frames and the extension of its files.
struct FrameFolder {
  std::string_view name, ending;
};

/// All camera folders of docs/reference/dataset.md.
std::vector<FrameFolder> PictureFolderNames();
/// The folders in which a camera has at least one file.
std::vector<FrameFolder> UsedPictureFolders(const LintJob& job, const std::string& camera);
inline constexpr FrameFolder kScanFolder = {"scans", "pcd"};

/// Name of a frame's file, relative to the dataset.
std::string FrameFile(const std::string& channel, const FrameFolder& folder, TimeNs t_ns);

}  // namespace tera
