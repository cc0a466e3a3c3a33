#include "dataset/import/scans/scan_file.h"

#include <fmt/format.h>
#include <liblzf/lzf.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <sstream>

#include "core/config/spelling.h"
#include "core/error.h"
#include "core/parse_number.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/calendar_time.h"
#include "dataset/import/logs/log_time.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void RefuseScan(const fs::path& file, FaultKind kind, const std::string& finding) {
  throw InputError(file.string(), {kind, finding});
}

std::string EndingOf(const fs::path& file) { return LowerCase(file.extension().string()); }

bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Natural order: "2.pcd" before "10.pcd".
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

/// The header of a PCD file.
struct PcdHead {
  std::vector<RecordField> fields;
  std::size_t step = 0, points = 0, columns = 0, body = 0;
  std::string data;
};

PcdHead ReadPcdHead(const fs::path& file, const std::string& bytes) {
  constexpr std::size_t kLongestHead = 1 << 16, kMostField = 1 << 16;
  std::map<std::string, std::vector<std::string>> entries;
  PcdHead head;
  while (!entries.contains("DATA")) {
    const std::size_t end = bytes.find('\n', head.body);
    if (end == bytes.npos || head.body > kLongestHead) {
      RefuseScan(file, FaultKind::kMalformed, "has no header of a PCD file that ends in DATA");
    }
    std::istringstream line(bytes.substr(head.body, end - head.body));
    head.body = end + 1;
    std::string key;
    line >> key;
    for (std::string word; line >> word;) entries[key].push_back(word);
  }
  auto& names = entries["FIELDS"];
  auto& counts = entries["COUNT"];
  if (counts.empty()) counts.assign(names.size(), "1");
  const auto whole = [&](const char* key, std::size_t k, std::size_t most) {
    const auto& words = entries[key];
    const auto value = k < words.size() ? ParseNumber<std::uint64_t>(words[k]) : std::nullopt;
    if (!value || *value > most) {
      RefuseScan(file, FaultKind::kMalformed,
                 fmt::format("its header's {} is no whole number of at most {}", key, most));
    }
    return static_cast<std::size_t>(*value);
  };
  for (std::size_t f = 0; f < names.size(); ++f) {
    const auto& types = entries["TYPE"];
    const std::size_t size = whole("SIZE", f, 8), count = whole("COUNT", f, kMostField);
    head.fields.push_back({names[f], f < types.size() ? types[f][0] : '?', size, head.step});
    head.step += size * count;
    head.columns += count;
  }
  constexpr std::size_t kMostPoints = 100'000'000;
  head.points = whole("POINTS", 0, kMostPoints);
  head.data = entries["DATA"].empty() ? "" : entries["DATA"][0];
  return head;
}

void RequireBody(const fs::path& file, std::size_t found, std::size_t need) {
  if (found >= need) return;
  RefuseScan(file, FaultKind::kMalformed,
             fmt::format("cut off: its points need {} bytes, {} are there; copy the file again",
                         need, found));
}

/// Decompresses a body, and converts it from field-major to point-major order.
std::string Unpacked(const fs::path& file, const PcdHead& head, std::string_view body) {
  std::uint32_t sizes[2] = {};
  RequireBody(file, body.size(), sizeof sizes);
  std::memcpy(sizes, body.data(), sizeof sizes);
  body.remove_prefix(sizeof sizes);
  RequireBody(file, body.size(), sizes[0]);
  std::string columns(head.points * head.step, '\0');
  constexpr std::size_t kMostExpanded = 512;  // limit of LZF's compression
  const bool fits = sizes[1] == columns.size() && columns.size() <= kMostExpanded * sizes[0];
  if (!columns.empty() &&
      (!fits || lzf_decompress(body.data(), sizes[0], columns.data(), sizes[1]) != sizes[1])) {
    RefuseScan(file, FaultKind::kMalformed, "its packed data are damaged; copy the file again");
  }
  std::string records(columns.size(), '\0');
  for (std::size_t f = 0; f < head.fields.size(); ++f) {
    const std::size_t begin = head.fields[f].at;
    const std::size_t end = f + 1 < head.fields.size() ? head.fields[f + 1].at : head.step;
    for (std::size_t k = 0; k < head.points; ++k) {
      std::memcpy(records.data() + k * head.step + begin,
                  columns.data() + head.points * begin + k * (end - begin), end - begin);
    }
  }
  return records;
}

/// Converts a text table to records of doubles, and changes the fields accordingly.
std::string FromText(const fs::path& file, PcdHead* head, const std::string& body) {
  std::istringstream words(body);
  std::string records;
  for (std::size_t k = 0; k < head->points * head->columns; ++k) {
    std::string word;
    words >> word;
    const auto value =
        word == "nan" || word == "NaN" ? std::optional(std::nan("")) : ParseNumber<double>(word);
    if (!value) {
      RefuseScan(file, FaultKind::kMalformed,
                 fmt::format("point {} has '{}' where a number is needed; copy the file again",
                             k / head->columns + 1, word));
    }
    records.append(reinterpret_cast<const char*>(&*value), sizeof(double));
  }
  std::size_t at = 0;
  for (RecordField& field : head->fields) {
    field = {field.name, 'F', sizeof(double), at};
    at += sizeof(double);
  }
  head->step = at;
  return records;
}

UnitScan ReadPcdScan(const fs::path& file, const PointForm& form, TimeNs stamp_ns) {
  const std::string bytes = ReadWholeFile(file);
  PcdHead head = ReadPcdHead(file, bytes);
  std::string records = bytes.substr(head.body);
  if (head.data == "binary_compressed") {
    records = Unpacked(file, head, records);
  } else if (head.data == "ascii") {
    if (head.columns != head.fields.size()) {
      RefuseScan(file, FaultKind::kUnsupported, "has fields of several numbers in text");
    }
    records = FromText(file, &head, records);
  } else if (head.data != "binary") {
    RefuseScan(file, FaultKind::kMalformed,
               fmt::format("DATA is '{}', need ascii, binary or binary_compressed", head.data));
  }
  RequireBody(file, records.size(), head.points * head.step);
  const PointRecords points{.fields = head.fields,
                            .step = head.step,
                            .count = head.points,
                            .bytes = records,
                            .place = file.string()};
  return RecordReader(points, form).Read(stamp_ns);
}

UnitScan ReadKittiScan(const fs::path& file, const PointForm& form, TimeNs stamp_ns) {
  constexpr std::size_t kPoint = 16;
  const std::string bytes = ReadWholeFile(file);
  if (bytes.size() % kPoint != 0) {
    RefuseScan(file, FaultKind::kMalformed,
               fmt::format("has {} bytes, need a multiple of the {} of a point (x, y, z and "
                           "reflectance as floats)",
                           bytes.size(), kPoint));
  }
  const PointRecords points{
      .fields = {{"x", 'F', 4, 0}, {"y", 'F', 4, 4}, {"z", 'F', 4, 8}, {"intensity", 'F', 4, 12}},
      .step = kPoint,
      .count = bytes.size() / kPoint,
      .bytes = bytes,
      .place = file.string()};
  return RecordReader(points, form).Read(stamp_ns);
}

}  // namespace

std::vector<fs::path> ScanFilesOf(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string ending = EndingOf(entry.path());
    if (entry.is_regular_file() && (ending == ".pcd" || ending == ".bin")) {
      files.push_back(entry.path());
    }
  }
  if (files.empty()) {
    RefuseScan(folder, FaultKind::kMissing, "has no scans, need files .pcd or .bin (KITTI's)");
  }
  std::sort(files.begin(), files.end(), IsBefore);
  return files;
}

UnitScan ReadScanFile(const fs::path& file, const PointForm& form, TimeNs stamp_ns) {
  return EndingOf(file) == ".bin" ? ReadKittiScan(file, form, stamp_ns)
                                  : ReadPcdScan(file, form, stamp_ns);
}

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
    // Smaller numbers, such as 0000000010, are indices of files.
    return t_ns >= kLeastStamp_s * kNsPerSecond ? std::optional(t_ns) : std::nullopt;
  }
  return std::nullopt;
}

std::vector<TimeNs> ReadScanTimes(const fs::path& file) {
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
    // KITTI's odometry writes 1.037875e-01.
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

}  // namespace tera
