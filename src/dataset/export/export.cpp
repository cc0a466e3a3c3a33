#include "dataset/export/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "core/check.h"
#include "core/error.h"
#include "dataset/export/export_job.h"
#include "dataset/export/stopped_export.h"
#include "dataset/files/frame_log.h"
#include "dataset/files/whole_folder.h"
#include "dataset/format/png.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

using WriteFormat = void (*)(ExportJob* job);

WriteFormat WriterOf(ExportFormat format) {
  switch (format) {
    case ExportFormat::kTum:
      return ExportTum;
    case ExportFormat::kEuroc:
      return ExportEuroc;
    case ExportFormat::kNmea:
      return ExportNmea;
    case ExportFormat::kPos:
      return ExportPos;
    case ExportFormat::kRosbag2:
      return ExportRosbag2;
    case ExportFormat::kBag:
      return ExportBag;
    case ExportFormat::kPcd:
      return ExportPcd;
    case ExportFormat::kPly:
      return ExportPly;
    case ExportFormat::kLas:
      return ExportLas;
    case ExportFormat::kCoco:
      return ExportCoco;
    case ExportFormat::kKitti:
      return ExportKitti;
    case ExportFormat::kSemanticKitti:
      return ExportSemanticKitti;
    case ExportFormat::kWebdataset:
      return ExportWebdataset;
    case ExportFormat::kNuscenes:
      return ExportNuscenes;
    case ExportFormat::kPcap:
      return ExportPackets;
  }
  TERA_CHECK(false, static_cast<int>(format));
  return nullptr;
}

/// Throws InputError if `out` exists or lies inside the recording.
void RequireNewPlace(const fs::path& dataset, const fs::path& out) {
  const fs::path name = out.has_filename() ? out.filename() : out.parent_path().filename();
  if (name.empty() || name == "." || name == "..") {
    throw InputError("", {FaultKind::kUnwritable,
                          fmt::format("'{}': names no new folder; give the export's folder a name",
                                      out.string())});
  }
  std::error_code ignored;
  if (HoldsSomething(out) || fs::is_symlink(out, ignored)) {
    throw InputError(out.string(),
                     {FaultKind::kUnwritable, "exists already; choose another place or delete it"});
  }
  const fs::path inside =
      fs::weakly_canonical(out, ignored).lexically_relative(fs::weakly_canonical(dataset, ignored));
  if (!inside.empty() && *inside.begin() != "..") {
    throw InputError(
        out.string(),
        {FaultKind::kUnwritable,
         fmt::format("is inside the recording {}; choose a place outside it", dataset.string())});
  }
}

/// Channel paths become names of files and topics. A path must not leave the recording's folder or
/// occur twice.
void RequirePlainPaths(const Recording& recording) {
  std::set<std::string> seen;
  for (const ChannelDescription& channel : recording.channels()) {
    const fs::path path(channel.path);
    const bool plain = !channel.path.empty() && path.is_relative() &&
                       path.lexically_normal() == path && path.has_filename() &&
                       *path.begin() != ".." && *path.begin() != "." &&
                       std::none_of(channel.path.begin(), channel.path.end(),
                                    [](char c) { return static_cast<unsigned char>(c) < ' '; });
    if (!plain || !seen.insert(channel.path).second) {
      throw InputError(
          (recording.directory() / "dataset.yaml").string(),
          {plain ? FaultKind::kRepeated : FaultKind::kMalformed,
           fmt::format(
               "the channel '{}' {}; need unique paths within the recording", channel.path,
               plain ? "occurs twice" : "is not a path of a folder or file below the recording")});
    }
  }
}

/// Writes all files of the format. After a failure, keeps the files from which `resume` can
/// continue.
void WriteFrames(ExportJob* job, WholeFolder* folder) {
  FrameLog whole(job->folder);
  job->whole_frames = &whole;
  try {
    WriterOf(job->options.format)(job);
  } catch (...) {
    if (job->options.resume && job->frames_written) folder->Keep();
    throw;
  }
  whole.Remove();
}

void CountFiles(const fs::path& folder, ExportReport* report) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    ++report->files;
    report->bytes += static_cast<std::int64_t>(entry.file_size());
  }
}

}  // namespace

ExportReport Export(const fs::path& dataset, const fs::path& out, const ExportOptions& options) {
  PreparePng();
  const Recording recording(dataset);
  RequirePlainPaths(recording);
  RequireNewPlace(dataset, out);
  if (!options.resume) RequireNoStoppedExport(out);
  WholeFolder folder(out,
                     options.resume ? WholeFolder::Left::kIsKept : WholeFolder::Left::kIsRefused);
  BeginExport(ExportKey(recording, options), options.format, &folder);
  ExportJob job{recording, folder.temporary(),
                (out.has_filename() ? out : out.parent_path()).filename().string(), options};
  if (GoesOnByFrames(options.format)) {
    WriteFrames(&job, &folder);
  } else {
    WriterOf(options.format)(&job);
  }
  EndExport(folder.temporary());
  ExportReport report;
  report.records = job.records;
  report.messages = job.messages;
  report.absent = job.absent;
  CountFiles(folder.temporary(), &report);
  folder.Commit();
  return report;
}

}  // namespace tera
