#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/types/sample_rows.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/logs/number_table.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/suggest.h"

// Suggests mappings for logs of known format and for folders.

namespace tera {
namespace fs = std::filesystem;
namespace {

std::string Top(const std::string& name) {
  return fmt::format(
      "# A first mapping by 'tera import --suggest': look at what is marked as guessed.\n"
      "name: {}\nmachine: machine   # guessed: name the machine's folder\nzero: start\n",
      PlainNameOf(name));
}

/// True if the row has a number in each of these columns.
bool HasAllOf(const RowTable& table, std::size_t row, const std::vector<const char*>& columns) {
  return std::all_of(columns.begin(), columns.end(), [&](const char* column) {
    return table.NumberIfAny(row, table.Column(column)).has_value();
  });
}

std::int64_t CountOf(const RowTable& table, const std::vector<const char*>& columns) {
  std::int64_t count = 0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (HasAllOf(table, row, columns)) ++count;
  }
  return count;
}

using IsValidRow = std::function<bool(std::size_t row)>;

/// The key `origin`, from the first valid row with a position; nullopt without one.
std::optional<std::string> OriginOf(const RowTable& table,
                                    const std::vector<const char*>& lat_lon_height,
                                    const IsValidRow& is_valid) {
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (!HasAllOf(table, row, lat_lon_height) || !is_valid(row)) continue;
    const auto number = [&](int k) {
      return table.Number(row, table.Column(lat_lon_height[static_cast<std::size_t>(k)]));
    };
    if (number(0) == 0 && number(1) == 0) continue;  // a receiver without a fix writes 0, 0
    return OriginYaml(number(0), number(1), number(2), "the first row with a fix");
  }
  return std::nullopt;
}

bool HasFix(const RowTable& table, std::size_t row) {
  const auto quality = table.NumberIfAny(row, table.Column("fix"));
  const auto fix = quality ? FixOfQuality(*quality) : std::nullopt;
  return fix && *fix != GnssFix::kNone;
}

TimeSteps TimeStepsOf(const RowTable& table) {
  TimeSteps steps;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    steps.Add(*table.Stamp(row, table.Column(kLogTimeColumn)));
  }
  return steps;
}

std::string PosYaml(const fs::path& log, const RowTable& table) {
  const auto origin = OriginOf(table, {"latitude", "longitude", "height"},
                               [&](std::size_t row) { return HasFix(table, row); });
  if (!origin)
    throw InputError(log.string(), {FaultKind::kMissing, "has no row with a fix; need one"});
  RuleGuesses rules;
  AddStepRule(TimeStepsOf(table), kLogTimeColumn, &rules);
  return Top(log.stem().string()) + "file: " + YamlWord(log.string()) + "\n" + *origin +
         "gnss:\n  - name: gnss\n" + rules.Yaml();
}

/// Rules that exclude rows without a fix, and rows whose fix is not a measurement.
RuleGuesses RulesOfNmea(const RowTable& table, const char* height) {
  std::int64_t without_fix = 0, not_measured = 0, without_height = 0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const auto quality = table.NumberIfAny(row, table.Column("fix"));
    if (!quality) ++without_fix;
    if (quality && !FixOfQuality(*quality)) ++not_measured;
    if (HasFix(table, row) && !HasAllOf(table, row, {height})) ++without_height;
  }
  RuleGuesses rules;
  if (without_fix > 0) {
    rules.Add("{column: fix, present: true}",
              fmt::format("{} times have no position", without_fix));
  }
  if (not_measured > 0) {
    rules.Add("{column: fix, below: 6}",
              fmt::format("{} fixes are estimated, by hand or simulated", not_measured));
  }
  if (without_height > 0) {
    rules.Add(fmt::format("{{column: {}, present: true}}", height),
              fmt::format("{} fixes have no height above the ellipsoid", without_height));
  }
  AddStepRule(TimeStepsOf(table), kLogTimeColumn, &rules);
  return rules;
}

std::string NmeaYaml(const fs::path& log, const RowTable& table, const NmeaContents& contents) {
  const bool has_altitude = CountOf(table, {"altitude"}) > 0;
  const char* const height = has_altitude ? "altitude" : "msl";
  const auto has_fix = [&](std::size_t row) { return HasFix(table, row); };
  const auto origin = OriginOf(table, {"latitude", "longitude", height}, has_fix);
  if (!origin) {
    throw InputError(log.string(), {FaultKind::kMissing,
                                    fmt::format("has no GGA, GNS or PTNL,GGK with a fix; it has {}",
                                                contents.kinds.empty() ? "none" : contents.kinds)});
  }
  std::string yaml = Top(log.stem().string()) + "file: " + YamlWord(log.string()) + "\n";
  if (!contents.has_dates) yaml += "# no sentence has a date: times count from 1970-01-01\n";
  if (!contents.rivals.empty()) {
    yaml += fmt::format("# talker: {}   # {} give positions at the same times: choose one\n",
                        contents.rivals.front(), fmt::join(contents.rivals, ", "));
  }
  yaml += *origin + "gnss:\n  - name: gnss\n" + RulesOfNmea(table, height).Yaml();
  std::string columns;
  if (!has_altitude) {
    columns +=
        "      alt: {column: msl, unit: m}   # guessed: above the sea, no separation is told\n";
  }
  const std::int64_t fixes = CountOf(table, {"latitude"});
  const std::int64_t deviations = CountOf(table, {"latitude", "var_e", "var_n", "var_u"});
  if (deviations < fixes) {
    for (const char* key : {"var_e", "var_n", "var_u"}) {
      columns += fmt::format(
          "      {}: {{constant: 4}}   # guessed: there is {}\n", key,
          deviations == 0 ? "no GST" : fmt::format("a GST for {} of {} fixes", deviations, fixes));
    }
  }
  if (!columns.empty()) yaml += "    columns:\n" + columns;
  if (CountOf(table, {"heading"}) > 0) {
    yaml +=
        "tables:\n  - name: heading\n    valid_if: [{column: heading, present: true}]\n"
        "    columns:\n      heading_rad: {column: heading, unit: deg}   # clockwise from north\n";
  }
  return yaml;
}

std::string KittiYaml(const fs::path& timestamps, const RowTable& table) {
  return Top(timestamps.parent_path().parent_path().filename().string()) +
         "file: " + YamlWord(timestamps.string()) + "\n" +
         OriginOf(table, {"lat", "lon", "alt"}, [](std::size_t) { return true; }).value_or("") +
         "imus:\n  - {name: imu}\n"
         "gnss:\n  - name: gnss\n    columns:\n"
         "      fix: {constant: 4}   # guessed: the unit's modes are not GGA's\n"
         "      var_e: {constant: 4e-4}   # guessed: 2 cm, as of RTK\n"
         "      var_n: {constant: 4e-4}   # guessed\n"
         "      var_u: {constant: 1.6e-3}   # guessed\n"
         "pose: {}   # of the unit, east, north and up of the first frame\n";
}

// Folders in EuRoC format.

struct EurocFile {
  fs::path file;
  std::string name;                  ///< name of its folder
  std::vector<std::string> columns;  ///< from the first line, after '#'

  bool Has(const std::string& column) const {
    return std::find(columns.begin(), columns.end(), column) != columns.end();
  }
};

/// Column names of a first line like "#timestamp [ns],w_RS_S_x [rad s^-1]", with or without blanks.
std::vector<std::string> EurocColumnsOf(const fs::path& file) {
  constexpr std::string_view kBlanks = " \t\r";
  std::string header;
  std::ifstream stream(file);
  std::getline(stream, header);
  if (!header.starts_with('#')) return {};
  std::vector<std::string> columns;
  for (std::string_view name : FieldsOf(std::string_view(header).substr(1), ',')) {
    name.remove_prefix(std::min(name.find_first_not_of(kBlanks), name.size()));
    columns.emplace_back(name.substr(0, name.find_last_not_of(kBlanks) + 1));
  }
  return columns;
}

/// Files below a folder that have this ending. Files higher in the tree come first, because they
/// belong to the machine and deeper ones to its parts.
std::vector<fs::path> FilesBelow(const fs::path& folder, std::string_view ending) {
  constexpr int kDeepest = 5;
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end;
       at.increment(failed)) {
    if (at.depth() >= kDeepest) at.disable_recursion_pending();
    if (at->path().filename().string().ends_with(ending) && at->is_regular_file()) {
      files.push_back(at->path());
    }
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const auto depth = [](const fs::path& path) { return std::distance(path.begin(), path.end()); };
    return std::pair(depth(a), a) < std::pair(depth(b), b);
  });
  return files;
}

/// All NAME/data.csv below a folder whose first column is a time.
std::vector<EurocFile> EurocFilesOf(const fs::path& folder) {
  std::vector<EurocFile> files;
  for (const fs::path& path : FilesBelow(folder, "data.csv")) {
    EurocFile file{path, path.parent_path().filename().string(), EurocColumnsOf(path)};
    if (!file.columns.empty() && file.columns.front().starts_with("timestamp")) {
      files.push_back(std::move(file));
    }
  }
  return files;
}

/// Mapping of the first TUM trajectory below a folder; empty without one.
std::string TumFolderYaml(const fs::path& folder) {
  std::string yaml, others;
  for (const fs::path& file : FilesBelow(folder, ".tum")) {
    const auto own = yaml.empty() ? SuggestForTrajectory(file) : std::nullopt;
    if (own) yaml = *own;
    if (!own) others += "# not imported: " + file.string() + "\n";
  }
  return yaml.empty() ? "" : yaml + others;
}

using EurocColumns = std::vector<std::pair<const char*, const char*>>;  // pairs of key and column

std::string EurocColumnsYaml(const EurocColumns& columns, const std::string& unit) {
  std::string yaml;
  for (const auto& [key, column] : columns) {
    yaml += fmt::format("      {}: {{column: \"{}\", unit: {}}}\n", key, column, unit);
  }
  return yaml;
}

bool HasAll(const EurocFile& file, const EurocColumns& columns) {
  return std::all_of(columns.begin(), columns.end(),
                     [&](const auto& column) { return file.Has(column.second); });
}

std::string EurocTimeYaml(const EurocFile& file, std::string_view indent) {
  return fmt::format("{}time: {{column: \"{}\", unit: ns}}\n", indent, file.columns.front());
}

/// The pose of the ground truth, or else of another instrument.
const EurocFile* EurocPoseOf(const std::vector<EurocFile>& files, const EurocColumns& columns) {
  const EurocFile* pose = nullptr;
  for (const EurocFile& file : files) {
    if (!HasAll(file, columns)) continue;
    const auto is_truth = [](const EurocFile& f) { return f.name.find("truth") != f.name.npos; };
    if (pose == nullptr || (is_truth(file) && !is_truth(*pose))) pose = &file;
  }
  return pose;
}

std::string EurocYaml(const fs::path& folder, const std::vector<EurocFile>& files) {
  const EurocColumns rates = {
      {"wx", "w_RS_S_x [rad s^-1]"}, {"wy", "w_RS_S_y [rad s^-1]"}, {"wz", "w_RS_S_z [rad s^-1]"}};
  const EurocColumns forces = {
      {"ax", "a_RS_S_x [m s^-2]"}, {"ay", "a_RS_S_y [m s^-2]"}, {"az", "a_RS_S_z [m s^-2]"}};
  const EurocColumns place = {{"x", "p_RS_R_x [m]"}, {"y", "p_RS_R_y [m]"}, {"z", "p_RS_R_z [m]"}};
  const EurocColumns turn = {
      {"qw", "q_RS_w []"}, {"qx", "q_RS_x []"}, {"qy", "q_RS_y []"}, {"qz", "q_RS_z []"}};
  EurocColumns whole_pose = place;
  whole_pose.insert(whole_pose.end(), turn.begin(), turn.end());
  const EurocFile* const pose = EurocPoseOf(files, whole_pose);
  std::string imus, others;
  TakenNames names;
  for (const EurocFile& file : files) {
    if (&file == pose) continue;
    if (HasAll(file, rates) && HasAll(file, forces)) {
      imus +=
          fmt::format("  - name: {}\n    file: {}\n{}    columns:\n{}{}", PlainNameOf(file.name),
                      YamlWord(file.file.string()), EurocTimeYaml(file, "    "),
                      EurocColumnsYaml(rates, "rad/s"), EurocColumnsYaml(forces, "m/s2"));
    } else {
      others += "# not imported: " + file.file.string() +
                (file.Has("filename") ? ", a mapping cannot import pictures\n" : "\n");
    }
  }
  std::string yaml = Top(folder.filename().string());
  if (!imus.empty()) yaml += "imus:\n" + imus;
  if (pose != nullptr) {
    yaml += fmt::format("pose:\n  file: {}\n{}  columns:\n{}{}", YamlWord(pose->file.string()),
                        EurocTimeYaml(*pose, "  "), EurocColumnsYaml(place, "m"),
                        EurocColumnsYaml(turn, "\"1\""));
  }
  return yaml + others;
}

}  // namespace

std::string SuggestForLog(const fs::path& log) {
  const std::string type = TypeOfLog(log);
  if (type == kUlogType) return SuggestForUlog(log);
  LeftOutRows left_out;
  const NmeaContents contents = type == kNmeaType ? ContentsOfNmea(log) : NmeaContents{};
  const std::string talker = contents.rivals.empty() ? "" : contents.rivals.front();
  const auto table = ReadLog(log, type, talker, &left_out);
  const std::string yaml = type == kPosType    ? PosYaml(log, *table)
                           : type == kNmeaType ? NmeaYaml(log, *table, contents)
                                               : KittiYaml(log, *table);
  if (left_out.count == 0) return yaml;
  return yaml + fmt::format("# {} lines cannot be read and need --skip-bad-rows; the first: {}\n",
                            left_out.count, left_out.first);
}

std::string SuggestForFolder(const fs::path& folder) {
  for (const fs::path& drive : {folder / "oxts/timestamps.txt", folder / "timestamps.txt"}) {
    if (!TypeOfLog(drive).empty() && fs::is_regular_file(drive)) return SuggestForLog(drive);
  }
  const std::vector<EurocFile> files = EurocFilesOf(folder);
  if (!files.empty()) return EurocYaml(folder, files);
  if (const std::string yaml = TumFolderYaml(folder); !yaml.empty()) return yaml;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string ending = entry.path().extension();
    if (ending != ".db3" && ending != ".mcap") continue;
    throw InputError(fmt::format(
        "{0}: holds {1} of a rosbag2 and no metadata.yaml, which lists its files; 'ros2 bag "
        "reindex {0}' writes it, or name {1} itself",
        folder.string(), entry.path().filename().string()));
  }
  throw InputError(
      fmt::format("{}: is a folder of unknown form; need a rosbag2 with metadata.yaml, a drive of "
                  "KITTI with oxts/timestamps.txt, data.csv files of EuRoC, or a file",
                  folder.string()));
}

}  // namespace tera
