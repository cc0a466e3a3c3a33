#include "dataset/import/stamped_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "core/config/listed_folder.h"
#include "core/config/spelling.h"
#include "core/error.h"
#include "core/parse_number.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/calendar_time.h"
#include "dataset/import/logs/log_time.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Natural order: "2.pcd" comes before "10.pcd".
bool IsBefore(const fs::path& a_path, const fs::path& b_path) {
  const std::string a = a_path.filename().string(), b = b_path.filename().string();
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!IsDigit(a[i]) || !IsDigit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [](const std::string& text, std::size_t* at) {
      std::size_t begin = *at;
      while (*at < text.size() && IsDigit(text[*at])) ++*at;
      while (begin + 1 < *at && text[begin] == '0') ++begin;
      return text.substr(begin, *at - begin);
    };
    const std::string m = number(a, &i), n = number(b, &j);
    if (m != n) return m.size() != n.size() ? m.size() < n.size() : m < n;
  }
  return a.size() - i < b.size() - j;
}

std::vector<fs::path> FilesIn(const fs::path& folder,
                              std::initializer_list<std::string_view> endings) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string ending = LowerCase(entry.path().extension().string());
    if (entry.is_regular_file() &&
        std::find(endings.begin(), endings.end(), ending) != endings.end()) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end(), IsBefore);
  return files;
}

/// Times of frames, one per line: seconds (1403636579.763555), ns if an integer exceeds 1e17, or a
/// date with a time of day as in KITTI.
std::vector<TimeNs> ReadFrameTimes(const fs::path& file) {
  constexpr std::int64_t kNanoseconds = 100'000'000'000'000'000;
  std::istringstream lines(ReadWholeFile(file));
  std::vector<TimeNs> times_ns;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const auto whole = ParseNumber<std::int64_t>(line);
    std::optional<TimeNs> t_ns;
    if (whole && *whole >= kNanoseconds) t_ns = *whole;
    if (!t_ns) t_ns = SecondsOfText(line);
    // KITTI odometry writes times such as 1.037875e-01.
    if (const auto seconds = ParseNumber<double>(line); !t_ns && seconds) {
      t_ns = FromSeconds(*seconds);
    }
    if (const auto date = CalendarTimeOf(line, std::nullopt); !t_ns && date) t_ns = date->t_ns;
    if (!t_ns) {
      throw InputError(fmt::format("{}:{}", file.string(), number),
                       {FaultKind::kMistyped,
                        fmt::format("found '{}', need a time in seconds, in ns since 1970, or a "
                                    "date with a time of day",
                                    line)});
    }
    times_ns.push_back(*t_ns);
  }
  return times_ns;
}

/// Reads the file `times`, or else the times in the file names.
std::vector<TimeNs> TimesOfFiles(const ConfigMap& channel, const std::vector<fs::path>& files,
                                 std::string_view of) {
  std::vector<TimeNs> times_ns;
  if (channel.Has("times")) {
    const fs::path times = channel.File("times");
    if (!times.empty()) times_ns = ReadFrameTimes(times);
    if (!times.empty() && times_ns.size() != files.size()) {
      channel.Fault("times", {FaultKind::kInconsistent,
                              fmt::format("has {} times, the folder has {} {}; need one each",
                                          times_ns.size(), files.size(), of)});
    }
    return times_ns;
  }
  for (const fs::path& file : files) {
    const auto t_ns = StampOfName(file);
    if (!t_ns) {
      channel.Fault(
          "times",
          {FaultKind::kMissing,
           fmt::format(
               "is missing: the name {} is not a time since 1970; need a file with one time a line",
               file.filename().string())});
      return {};
    }
    times_ns.push_back(*t_ns);
  }
  return times_ns;
}

}  // namespace

std::optional<TimeNs> StampOfName(const fs::path& file) {
  const std::string name = file.stem().string();
  const std::size_t point = name.find('.');
  const bool is_number = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return IsDigit(c) || c == '.';
  });
  if (!is_number) return std::nullopt;
  constexpr std::size_t kSecondsDigits = 10;  // years 2001 to 2286
  constexpr TimeNs kLeastStamp_s = 100'000'000;
  if (point != name.npos) return point >= kSecondsDigits ? SecondsOfText(name) : std::nullopt;
  if (name.size() < kSecondsDigits || name.size() > kSecondsDigits + 9) return std::nullopt;
  const auto number = ParseNumber<std::int64_t>(name);
  if (!number) return std::nullopt;
  for (const auto& [digits, unit_ns] : {std::pair{19, TimeNs{1}},
                                        {16, TimeNs{1000}},
                                        {13, TimeNs{1'000'000}},
                                        {10, TimeNs{1'000'000'000}}}) {
    if (name.size() != static_cast<std::size_t>(digits)) continue;
    const TimeNs t_ns = *number * unit_ns;
    // A smaller number, such as 0000000010, is the index of a file.
    return t_ns >= kLeastStamp_s * kNsPerSecond ? std::optional(t_ns) : std::nullopt;
  }
  return std::nullopt;
}

StampedFiles ReadStampedFiles(const ConfigMap& channel,
                              std::initializer_list<std::string_view> endings,
                              std::string_view of) {
  StampedFiles read{.folder = Folder(channel, "files")};
  if (read.folder.empty()) return read;
  read.files = FilesIn(read.folder, endings);
  if (read.files.empty()) {
    channel.Fault("files", {FaultKind::kMissing,
                            fmt::format("{} has no {}, need files {}", read.folder.string(), of,
                                        fmt::join(endings, ", "))});
    return read;
  }
  try {
    read.times_ns = TimesOfFiles(channel, read.files, of);
  } catch (const InputError& fault) {
    channel.Fault("files", fault.AsFinding());
  }
  for (const fs::path& file : read.files) channel.AlsoReads(file);
  return read;
}

}  // namespace tera
