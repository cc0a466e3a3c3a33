#include "dataset/lint/checks/frames.h"

#include <fmt/format.h>

#include "core/types/label_channels.h"
#include "dataset/format/row_scan.h"

namespace tera {
namespace fs = std::filesystem;

std::vector<FrameRow> FramesOf(const LintJob& job, const std::string& channel) {
  std::vector<FrameRow> frames;
  if (job.IsLeftOut(channel)) return frames;
  RowScan scan(job.Path(job.RowsOf(channel)), {});
  if (!scan.lists_frames()) return frames;
  for (ScannedRow row; scan.Next(&row);) frames.push_back({row.line, row.t_ns, row.filename});
  return frames;
}

std::vector<FrameFolder> PictureFolderNames() {
  std::vector<FrameFolder> folders = {{"rgb", "png"}, {"depth", "png"}};
  for (const LabelChannel& channel : kLabelChannels) folders.push_back({channel.name, "png"});
  folders.push_back({"boxes", "json"});
  return folders;
}

std::vector<FrameFolder> UsedPictureFolders(const LintJob& job, const std::string& camera) {
  std::vector<FrameFolder> used;
  for (const FrameFolder& folder : PictureFolderNames()) {
    std::error_code error;
    const fs::directory_iterator first(job.Path(camera) / folder.name, error);
    if (!error && first != fs::directory_iterator()) used.push_back(folder);
  }
  return used;
}

std::string FrameFile(const std::string& channel, const FrameFolder& folder, TimeNs t_ns) {
  return fmt::format("{}/{}/{}.{}", channel, folder.name, t_ns, folder.ending);
}

}  // namespace tera
