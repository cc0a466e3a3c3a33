#include "dataset/export/export_job.h"

#include <fmt/format.h>

#include <iterator>

#include "core/check.h"
#include "core/error.h"
#include "dataset/files/frame_log.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

std::string_view NameOf(ExportFormat format) {
  return kExportFormats[static_cast<std::size_t>(format)].name;
}

}  // namespace

bool ExportJob::Next(RecordStream* stream, Record* record) {
  if (!stream->Next(record)) return false;
  constexpr std::int64_t kRecordsPerNews = 64;
  if (++records % kRecordsPerNews == 0 && options.progress) {
    options.progress({ToSeconds(record->t_ns), recording.info().duration_s, records});
  }
  return true;
}

bool ExportJob::IsWritten(const std::string& of, std::int64_t frame) const {
  TERA_CHECK(whole_frames != nullptr, of);
  return whole_frames->WasWhole(of, frame);
}

void ExportJob::Written(const std::string& of, std::int64_t frame,
                        const std::vector<fs::path>& files) {
  TERA_CHECK(whole_frames != nullptr, of);
  std::vector<FrameLog::File> entries;
  for (const fs::path& file : files) {
    entries.push_back(
        {file.lexically_relative(folder).string(), static_cast<std::int64_t>(fs::file_size(file))});
  }
  whole_frames->Append(of, frame, entries);
  frames_written = true;
}

const std::vector<JointTree>& ExportJob::JointTrees() {
  if (!known_joint_trees) {
    known_joint_trees = options.joint_trees ? options.joint_trees() : std::vector<JointTree>{};
  }
  return *known_joint_trees;
}

const JointTree* ExportJob::JointTreeOf(const std::string& machine) {
  for (const JointTree& tree : JointTrees()) {
    if (tree.machine == machine) return &tree;
  }
  return nullptr;
}

TimeNs ExportJob::Stamp(TimeNs t_ns, TimeNs without_date) const {
  const std::optional<RecordingEpoch>& epoch = recording.info().epoch;
  const bool needs_date = without_date != 0;
  const TimeNs own_ns = needs_date && epoch ? UtcOf(*epoch) : without_date;
  return t_ns + options.start_utc_ns.value_or(own_ns);
}

void RequireAny(const std::vector<std::string>& paths, const ExportJob& job,
                std::string_view needed) {
  if (!paths.empty()) return;
  throw InputError(
      job.recording.directory().string(),
      {FaultKind::kMissing,
       fmt::format(
           "has no {}, which the format '{}' needs; need a recording with one, or another format",
           needed, NameOf(job.options.format))});
}

std::string MachineOf(const std::string& path) {
  fs::path parts(path);
  auto part = parts.begin();
  if (*part == "truth" && std::next(part) != parts.end()) ++part;
  return part->string();
}

}  // namespace tera
