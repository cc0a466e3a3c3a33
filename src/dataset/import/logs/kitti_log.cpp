#include <fmt/format.h>

#include <array>
#include <string>

#include "core/error.h"
#include "core/motion.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/site_frame.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/logs/log_time.h"
#include "dataset/import/logs/number_table.h"

namespace tera {
namespace {

/// In the order of dataformat.txt.
constexpr std::array<const char*, 30> kOxtsFields = {
    "lat",          "lon",     "alt",     "roll",    "pitch",   "yaw",    "vn", "ve",
    "vf",           "vl",      "vu",      "ax",      "ay",      "az",     "af", "al",
    "au",           "wx",      "wy",      "wz",      "wf",      "wl",     "wu", "pos_accuracy",
    "vel_accuracy", "navstat", "numsats", "posmode", "velmode", "orimode"};
constexpr std::size_t kLat = 0, kLon = 1, kAlt = 2, kRoll = 3, kPitch = 4, kYaw = 5;

/// Parses "2011-09-26 13:02:25.964389445".
std::optional<TimeNs> OxtsTime(std::string_view text) {
  constexpr std::size_t kDate = 10;
  if (text.size() <= kDate || text[kDate] != ' ') return std::nullopt;
  const auto day_ns = DateOfText(text.substr(0, kDate));
  const auto time_ns = TimeOfDayText(text.substr(kDate + 1));
  if (!day_ns || !time_ns) return std::nullopt;
  return *day_ns + *time_ns;
}

/// Numbers in the file of a frame, up to the first invalid one.
std::vector<double> NumbersOf(const std::filesystem::path& file) {
  std::string text = ReadWholeFile(file);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  std::vector<double> numbers;
  for (const std::string_view field : FieldsOf(text, ' ')) {
    const auto value = WholeNumber(field);
    if (!value) break;
    numbers.push_back(*value);
  }
  return numbers;
}

/// Pose of a frame, relative to the position of the first frame.
std::vector<NumberTable::Cell> PoseOf(const std::vector<double>& v, const SiteFrame& site) {
  const Vec3 p_m = site.ToEnu({v[kLat], v[kLon], v[kAlt]});
  const Quat q(RotationFromRpy(v[kRoll], v[kPitch], v[kYaw]));
  return {{"x", p_m.x()}, {"y", p_m.y()}, {"z", p_m.z()}, {"qw", q.w()},
          {"qx", q.x()},  {"qy", q.y()},  {"qz", q.z()}};
}

}  // namespace

std::unique_ptr<const RowTable> ReadKittiLog(const std::filesystem::path& timestamps,
                                             LeftOutRows* left_out) {
  std::vector<std::string> columns(kOxtsFields.begin(), kOxtsFields.end());
  columns.insert(columns.end(), {"x", "y", "z", "qw", "qx", "qy", "qz"});
  auto table = std::make_unique<NumberTable>(timestamps, columns);
  std::optional<SiteFrame> site;
  LogLines lines(timestamps);
  for (std::string line; lines.Next(&line);) {
    if (line.empty()) continue;
    const std::filesystem::path file =
        timestamps.parent_path() / "data" / fmt::format("{:010}.txt", lines.number() - 1);
    const auto t_ns = OxtsTime(line);
    if (!t_ns) {
      lines.Fault(fmt::format("'{}' is no time", line), left_out);
      continue;
    }
    std::error_code ignored;
    const bool is_there = std::filesystem::is_regular_file(file, ignored);
    const std::vector<double> values = is_there ? NumbersOf(file) : std::vector<double>();
    if (values.size() != kOxtsFields.size()) {
      lines.Fault(fmt::format("{} {}, need {} numbers", file.string(),
                              is_there ? fmt::format("has {}", values.size()) : "is not there",
                              kOxtsFields.size()),
                  left_out);
      continue;
    }
    if (!site) site.emplace(values[kLat], values[kLon], values[kAlt]);
    std::vector<NumberTable::Cell> cells = PoseOf(values, *site);
    for (std::size_t k = 0; k < values.size(); ++k) cells.push_back({kOxtsFields[k], values[k]});
    table->AddRow(lines.number(), *t_ns, cells);
  }
  return table;
}

}  // namespace tera
