#include <fmt/format.h>

#include <fstream>
#include <set>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/file_digest.h"
#include "dataset/lint/checks/frames.h"
#include "dataset/lint/lint_job.h"

// Checks frames.sha256. Its lines are "<64 hexadecimal digits>  <name>", the format of sha256sum.

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kDigits = 64;
constexpr std::string_view kBetween = "  ";

/// Files of channels and the descriptions, by name. Excludes frames.sha256 itself and files that
/// other programs may rewrite, such as overview.png.
std::set<std::string> HashedFiles(const LintJob& job) {
  std::set<std::string> files;
  const auto add = [&](const std::string& file) {
    std::error_code ignored;
    if (fs::is_regular_file(job.Path(file), ignored)) files.insert(file);
  };
  add("dataset.yaml");
  add("scenario.yaml");
  const Recording& recording = job.recording();
  for (const ChannelDescription& channel : recording.channels()) {
    add(job.RowsOf(channel.path));
    if (job.RowsOf(channel.path) != channel.path) add(channel.path + "/sensor.yaml");
  }
  for (const std::string& camera : recording.SensorsOf(ChannelForm::kPictures)) {
    const auto folders = UsedPictureFolders(job, camera);
    for (const FrameRow& frame : FramesOf(job, camera)) {
      for (const FrameFolder& folder : folders) add(FrameFile(camera, folder, frame.t_ns));
    }
  }
  for (const std::string& lidar : recording.SensorsOf(ChannelForm::kScans)) {
    for (const FrameRow& frame : FramesOf(job, lidar)) {
      add(FrameFile(lidar, kScanFolder, frame.t_ns));
    }
  }
  return files;
}

void CheckLine(LintJob* job, const std::string& text, int line, std::set<std::string>* unlisted) {
  const auto find = [&](const std::string& file, int at, const std::string& what) {
    job->Find("files.hash", "", {file, at, what});
  };
  const bool has_form = text.size() > kDigits + kBetween.size() &&
                        text.compare(kDigits, kBetween.size(), kBetween) == 0;
  if (!has_form) {
    find(kFrameHashesName, line, "is not a line of digest and name");
    return;
  }
  const std::string file = text.substr(kDigits + kBetween.size());
  unlisted->erase(file);
  std::error_code ignored;
  if (!fs::is_regular_file(job->Path(file), ignored)) {
    find(kFrameHashesName, line, fmt::format("{} is missing", file));
    return;
  }
  const std::string found = DigestOf(job->Path(file)).sha256;
  if (text.compare(0, kDigits, found) == 0) return;
  find(file, 0,
       fmt::format("has the SHA-256 {}, but {} in frames.sha256", found, text.substr(0, kDigits)));
}

}  // namespace

void CheckHashes(LintJob* job) {
  const fs::path list = job->Path(kFrameHashesName);
  std::error_code ignored;
  if (!fs::exists(list, ignored)) return;
  job->Applies("files.hash");
  std::set<std::string> unlisted = HashedFiles(*job);
  std::ifstream stream(list);
  int line = 0;
  for (std::string text; std::getline(stream, text);) CheckLine(job, text, ++line, &unlisted);
  for (const std::string& file : unlisted) {
    job->Find("files.hash", "", {file, 0, "is not listed in frames.sha256"});
  }
}

std::int64_t WriteFrameHashes(const fs::path& dataset) {
  const Recording recording(dataset);
  const LintOptions options;
  const LintJob job(recording, options);
  const std::set<std::string> files = HashedFiles(job);
  std::string text;
  for (const std::string& file : files) {
    text += fmt::format("{}{}{}\n", DigestOf(dataset / file).sha256, kBetween, file);
  }
  WriteWholeFile(dataset / kFrameHashesName, text);
  return static_cast<std::int64_t>(files.size());
}

}  // namespace tera
