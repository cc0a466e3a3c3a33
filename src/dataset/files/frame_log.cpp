#include "dataset/files/frame_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <sstream>
#include <utility>

#include "dataset/files/checked_file.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr char kLogName[] = "INCOMPLETE.frames";
constexpr char kSeparator = '\t';

std::vector<std::string> Split(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, kSeparator);) fields.push_back(field);
  return fields;
}

bool HasSize(const fs::path& file, const std::string& bytes) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  return !error && std::to_string(size) == bytes;
}

}  // namespace

FrameLog::FrameLog(const fs::path& root) : path_(root / kLogName) {
  std::error_code ignored;
  if (fs::exists(path_, ignored)) Load(root);
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor_ < 0) FailFile(path_, "cannot be created", errno);
}

FrameLog::~FrameLog() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void FrameLog::Load(const fs::path& root) {
  std::string text = ReadWholeFile(path_);
  text.resize(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
  WriteWholeFile(path_, text);  // drops the incomplete last line of a killed run
  std::stringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const std::vector<std::string> fields = Split(line);
    bool whole = fields.size() >= 4 && fields.size() % 2 == 0;
    for (std::size_t i = 2; whole && i < fields.size(); i += 2) {
      whole = HasSize(root / fields[i + 1], fields[i]);
    }
    if (whole) whole_[fields[0]].insert(std::stoll(fields[1]));
  }
}

bool FrameLog::WasWhole(const std::string& folder, TimeNs t_ns) const {
  const auto found = whole_.find(folder);
  return found != whole_.end() && found->second.contains(t_ns);
}

void FrameLog::Append(const std::string& folder, TimeNs t_ns, const std::vector<File>& files) {
  std::string line = fmt::format("{}{}{}", folder, kSeparator, t_ns);
  for (const File& file : files) {
    line += fmt::format("{}{}{}{}", kSeparator, file.bytes, kSeparator, file.name);
  }
  line += '\n';
  // A line is a single write to a file opened for appending, so lines of different threads do not
  // mix.
  const ssize_t count = ::write(descriptor_, line.data(), line.size());
  if (count != static_cast<ssize_t>(line.size())) {
    FailFile(path_, "cannot be written", count < 0 ? errno : ENOSPC);
  }
}

void FrameLog::Remove() {
  ::close(std::exchange(descriptor_, -1));
  std::error_code error;
  fs::remove(path_, error);
  if (error) FailFile(path_, "cannot be removed", error.value());
}

}  // namespace tera
