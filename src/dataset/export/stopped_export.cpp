#include "dataset/export/stopped_export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>
#include <vector>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/file_digest.h"
#include "dataset/files/whole_folder.h"
#include "dataset/format/dataset_description.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr const char* kKeyFile = "INCOMPLETE.export";

/// Size of a channel's table in bytes; 0 if it has none.
std::uintmax_t RowBytes(const fs::path& channel) {
  std::error_code ignored;
  const fs::path file = fs::is_directory(channel, ignored) ? channel / "data.csv" : channel;
  const std::uintmax_t bytes = fs::file_size(file, ignored);
  return ignored ? 0 : bytes;
}

std::string OptionLines(const ExportOptions& options) {
  std::vector<int> layouts;
  for (const KittiLayout layout : options.kitti_layouts)
    layouts.push_back(static_cast<int>(layout));
  return fmt::format(
      "format {}\nstart {}\nstorage {}\ncompression {}\nimages {}\nlayouts {}\ncamera {}\n"
      "lidar {}\nkey frames {}\nshard {}\n",
      kExportFormats[static_cast<std::size_t>(options.format)].name,
      options.start_utc_ns ? std::to_string(*options.start_utc_ns) : "none",
      static_cast<int>(options.storage), static_cast<int>(options.compression),
      static_cast<int>(options.images), fmt::join(layouts, ","), options.camera, options.lidar,
      options.key_frames_hz, options.shard_bytes);
}

}  // namespace

std::string ExportKey(const Recording& recording, const ExportOptions& options) {
  std::string key = fmt::format("tera {}\n", TeraVersion()) + OptionLines(options);
  const fs::path& run = recording.directory();
  key += fmt::format("dataset.yaml {}\n", Sha256Of(ReadWholeFile(run / "dataset.yaml")));
  for (const ChannelDescription& channel : recording.channels()) {
    key += fmt::format("{} {}\n", RowBytes(run / channel.path), channel.path);
  }
  return key;
}

void BeginExport(const std::string& key, ExportFormat format, WholeFolder* folder) {
  const fs::path file = folder->temporary() / kKeyFile;
  std::error_code ignored;
  if (HoldsSomething(folder->temporary())) {
    if (!fs::is_regular_file(file, ignored)) {
      throw InputError(folder->temporary().string(),
                       {FaultKind::kUnwritable,
                        "holds no interrupted export; choose another place or delete it"});
    }
    if (ReadWholeFile(file) != key) {
      throw InputError(folder->temporary().string(),
                       "belongs to another export: the dataset, an option or the program's version "
                       "differs; repeat the original command, or delete it to start afresh");
    }
    if (!GoesOnByFrames(format)) folder->Clear();
  }
  WriteWholeFile(file, key);
}

void EndExport(const fs::path& folder) { fs::remove(folder / kKeyFile); }

void RequireNoStoppedExport(const fs::path& out) {
  std::error_code ignored;
  if (!fs::is_regular_file(IncompleteOf(out) / kKeyFile, ignored)) return;
  throw InputError(
      IncompleteOf(out).string(),
      {FaultKind::kUnwritable,
       "holds an interrupted export; resume it by the same command with --resume, or delete it"});
}

}  // namespace tera
