#include <fmt/format.h>

#include <set>

#include "core/error.h"
#include "dataset/lint/checks/frames.h"
#include "dataset/lint/lint_job.h"

// Compares the files on disk with the expected files.

namespace tera {
namespace fs = std::filesystem;
namespace {

/// Files that belong to no channel.
const std::set<std::string> kFilesOfAll = {"dataset.yaml", "scenario.yaml", kFrameHashesName,
                                           "overview.png", "overview.mp4",  "truth/state.blocks"};
/// Files in this folder may have any name.
constexpr std::string_view kTerrainFolder = "truth/terrain";

bool IsSensor(const LintJob& job, const std::string& channel) {
  return job.RowsOf(channel) != channel;
}

void CheckSheet(LintJob* job, const std::string& sensor) {
  job->Applies("files.sheet");
  const std::string file = sensor + "/sensor.yaml";
  try {
    const SensorSheet sheet = ReadSensorSheet(job->Path(sensor));
    const std::string_view type = job->recording().TypeOf(sensor);
    if (sheet.type == type) return;
    job->Find(
        "files.sheet", sensor,
        {file, 0, fmt::format("has the type '{}', but {} in dataset.yaml", sheet.type, type)});
  } catch (const InputError& e) {
    job->Find("files.sheet", sensor, {file, 0, e.what()});
  }
}

void CheckRowFile(LintJob* job, const std::string& channel) {
  job->Applies("files.missing");
  const std::string file = job->RowsOf(channel);
  std::error_code ignored;
  if (fs::is_regular_file(job->Path(file), ignored)) return;
  job->Find("files.missing", channel, {file, 0, "is missing, but dataset.yaml lists it"});
  job->LeaveOut(channel);
}

std::set<std::string> NamesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

/// Compares a folder of frames with its frame list, in both directions.
void CompareFrames(LintJob* job, const std::string& channel, const FrameFolder& folder,
                   const std::vector<FrameRow>& frames) {
  std::error_code ignored;
  const fs::path path = job->Path(channel) / folder.name;
  std::set<std::string> left;
  if (fs::is_directory(path, ignored)) left = NamesIn(path);
  for (const FrameRow& frame : frames) {
    if (left.erase(fmt::format("{}.{}", frame.t_ns, folder.ending)) > 0) continue;
    job->Find("files.missing", channel,
              {channel + "/data.csv", frame.line,
               FrameFile(channel, folder, frame.t_ns) + " is not there"});
  }
  job->Applies("files.extra");
  for (const std::string& name : left) {
    job->Find("files.extra", channel,
              {fmt::format("{}/{}/{}", channel, folder.name, name), 0,
               "belongs to no frame that data.csv lists"});
  }
}

void CheckFrames(LintJob* job, const std::string& channel,
                 const std::vector<FrameFolder>& folders) {
  const std::vector<FrameRow> frames = FramesOf(*job, channel);
  if (folders.empty() && !frames.empty()) {
    job->Find("files.missing", channel,
              {channel + "/data.csv", frames.front().line, "the camera has no picture at all"});
  }
  for (const FrameFolder& folder : folders) CompareFrames(job, channel, folder, frames);
}

/// Files and folders that the format defines.
class KnownFiles {
 public:
  explicit KnownFiles(const LintJob& job) : files_(kFilesOfAll) {
    folders_.insert(std::string(kTerrainFolder));
    for (const ChannelDescription& channel : job.recording().channels()) {
      files_.insert(job.RowsOf(channel.path));
      if (!IsSensor(job, channel.path)) continue;
      files_.insert(channel.path + "/sensor.yaml");
      AddFrameFolders(channel.path);
    }
    for (const std::string& file : files_) AddParents(file);
    for (const std::string& folder : std::set<std::string>(folders_)) AddParents(folder);
  }

  bool HasFile(const std::string& file) const { return files_.contains(file); }
  bool HasFolder(const std::string& folder) const { return folders_.contains(folder); }
  /// True for folders whose files another check examines.
  bool IsHeldElsewhere(const std::string& folder) const { return frames_.contains(folder); }

 private:
  void AddFrameFolders(const std::string& channel) {
    std::vector<FrameFolder> all = PictureFolderNames();
    all.push_back(kScanFolder);
    for (const FrameFolder& folder : all) {
      const std::string path = fmt::format("{}/{}", channel, folder.name);
      folders_.insert(path);
      frames_.insert(path);
    }
  }
  void AddParents(const std::string& path) {
    for (fs::path p = fs::path(path).parent_path(); !p.empty(); p = p.parent_path()) {
      folders_.insert(p.string());
    }
  }

  std::set<std::string> files_, folders_, frames_;
};

void CheckUnknown(LintJob* job) {
  job->Applies("files.unknown");
  const KnownFiles known(*job);
  const auto find = [&](const std::string& name, const char* what) {
    job->Find("files.unknown", "", {name, 0, what});
  };
  const fs::path root = job->recording().directory();
  for (fs::recursive_directory_iterator entry(root), end; entry != end; ++entry) {
    const std::string name = entry->path().lexically_relative(root).generic_string();
    if (!entry->is_directory()) {
      const std::string folder = fs::path(name).parent_path().string();
      if (!known.HasFile(name) && folder != kTerrainFolder)
        find(name, "is not a file of the format");
      continue;
    }
    if (!known.HasFolder(name)) find(name, "is not a folder of the format or of a listed channel");
    if (!known.HasFolder(name) || known.IsHeldElsewhere(name) || name == kTerrainFolder) {
      entry.disable_recursion_pending();
    }
  }
}

}  // namespace

void CheckFiles(LintJob* job) {
  const Recording& recording = job->recording();
  for (const ChannelDescription& channel : recording.channels()) {
    if (job->IsLeftOut(channel.path)) continue;
    CheckRowFile(job, channel.path);
    if (IsSensor(*job, channel.path)) CheckSheet(job, channel.path);
  }
  for (const std::string& camera : recording.SensorsOf(ChannelForm::kPictures)) {
    job->Try(camera, [&] { CheckFrames(job, camera, UsedPictureFolders(*job, camera)); });
  }
  for (const std::string& lidar : recording.SensorsOf(ChannelForm::kScans)) {
    job->Try(lidar, [&] { CheckFrames(job, lidar, {kScanFolder}); });
  }
  CheckUnknown(job);
}

}  // namespace tera
