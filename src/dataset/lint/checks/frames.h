#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dataset/lint/lint_job.h"

namespace tera {

struct FrameRow {
  int line = 0;
  TimeNs t_ns = 0;
  std::string filename;
};

/// Frames in data.csv of a camera or lidar, without unreadable rows.
std::vector<FrameRow> FramesOf(const LintJob& job, const std::string& channel);

/// A folder with files of frames, and the ending of their names.
struct FrameFolder {
  std::string_view name, ending;
};

/// All image folders that docs/reference/dataset.md defines for a camera.
std::vector<FrameFolder> PictureFolderNames();
/// Folders in which the camera has at least one file.
std::vector<FrameFolder> UsedPictureFolders(const LintJob& job, const std::string& camera);
inline constexpr FrameFolder kScanFolder = {"scans", "pcd"};

/// Path of a frame's file, relative to the dataset.
std::string FrameFile(const std::string& channel, const FrameFolder& folder, TimeNs t_ns);

}  // namespace tera
