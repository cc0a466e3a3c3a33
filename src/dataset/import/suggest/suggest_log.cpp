#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "core/error.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/suggest.h"

// Guesses about logs of known form, and about folders.

namespace tera {
namespace fs = std::filesystem;
namespace {

std::string Top(const std::string& name) {
  return fmt::format(
      "# A first mapping by 'tera import --suggest': look at what is marked as guessed.\n"
      "name: {}\nmachine: machine   # guessed: name the machine's folder\nzero: start\n",
      PlainNameOf(name));
}

/// What the first row that has all of these columns says of them.
std::vector<double> FirstOf(const RowTable& table, const std::vector<std::string>& columns) {
  std::vector<std::size_t> places;
  for (const std::string& name : columns) places.push_back(table.Column(name));
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    std::vector<double> values;
    for (const std::size_t place : places) {
      if (const auto value = table.NumberIfAny(row, place)) values.push_back(*value);
    }
    if (values.size() == columns.size()) return values;
  }
  return {};
}

std::string OriginYaml(const RowTable& table, const std::vector<std::string>& columns,
                       const fs::path& log) {
  const std::vector<double> place = FirstOf(table, columns);
  if (place.empty()) {
    throw InputError(fmt::format("{}: has no row with a position; need one", log.string()));
  }
  return fmt::format(
      "origin: {{lat_deg: {:.9f}, lon_deg: {:.9f}, height_m: {:.4f}}}   # guessed: the first row\n",
      place[0], place[1], place[2]);
}

std::string PosYaml(const fs::path& log, const RowTable& table) {
  return Top(log.stem().string()) + "file: " + YamlWord(log.string()) + "\n" +
         OriginYaml(table, {"latitude", "longitude", "height"}, log) + "gnss:\n  - {name: gnss}\n";
}

std::string NmeaYaml(const fs::path& log, const RowTable& table) {
  std::string yaml = Top(log.stem().string()) + "file: " + YamlWord(log.string()) + "\n" +
                     OriginYaml(table, {"latitude", "longitude", "msl"}, log) +
                     "gnss:\n  - name: gnss\n";
  std::string columns;
  if (FirstOf(table, {"altitude"}).empty()) {
    columns +=
        "      alt: {column: msl, unit: m}   # guessed: above the sea, no separation is told\n";
  }
  if (FirstOf(table, {"var_e"}).empty()) {
    for (const char* key : {"var_e", "var_n", "var_u"}) {
      columns += fmt::format("      {}: {{constant: 4}}   # guessed: there is no GST\n", key);
    }
  }
  if (!columns.empty()) yaml += "    columns:\n" + columns;
  if (!FirstOf(table, {"heading"}).empty()) {
    yaml +=
        "tables:\n  - name: heading\n    valid_if: [{column: heading, present: true}]\n"
        "    columns:\n      heading_rad: {column: heading, unit: deg}   # clockwise from north\n";
  }
  return yaml;
}

std::string KittiYaml(const fs::path& timestamps, const RowTable& table) {
  return Top(timestamps.parent_path().parent_path().filename().string()) +
         "file: " + YamlWord(timestamps.string()) + "\n" +
         OriginYaml(table, {"lat", "lon", "alt"}, timestamps) +
         "imus:\n  - {name: imu}\n"
         "gnss:\n  - name: gnss\n    columns:\n"
         "      fix: {constant: 4}   # guessed: the unit's modes are not GGA's\n"
         "      var_e: {constant: 4e-4}   # guessed: 2 cm, as of RTK\n"
         "      var_n: {constant: 4e-4}   # guessed\n"
         "      var_u: {constant: 1.6e-3}   # guessed\n"
         "pose: {}   # of the unit, east, north and up of the first frame\n";
}

// --- Folders in the form of EuRoC's.

struct EurocFile {
  fs::path file;
  std::string name;  ///< of its folder
  std::string header;
};

/// All NAME/data.csv below a folder whose first column is a time in ns.
std::vector<EurocFile> EurocFilesOf(const fs::path& folder) {
  constexpr int kDeepest = 5;
  std::vector<EurocFile> files;
  std::error_code failed;
  for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end;
       at.increment(failed)) {
    if (at.depth() >= kDeepest) at.disable_recursion_pending();
    if (at->path().filename() != "data.csv" || !at->is_regular_file()) continue;
    std::string header;
    std::ifstream stream(at->path());
    std::getline(stream, header);
    if (header.ends_with('\r')) header.pop_back();
    if (!header.starts_with("#timestamp [ns],")) continue;
    files.push_back({at->path(), at->path().parent_path().filename().string(), header});
  }
  std::sort(files.begin(), files.end(),
            [](const EurocFile& a, const EurocFile& b) { return a.file < b.file; });
  return files;
}

std::string ColumnsYaml(const std::vector<std::pair<const char*, const char*>>& columns,
                        const std::string& unit) {
  std::string yaml;
  for (const auto& [key, column] : columns) {
    yaml += fmt::format("      {}: {{column: \"{}\", unit: {}}}\n", key, column, unit);
  }
  return yaml;
}

bool HasAll(const EurocFile& file,
            const std::vector<std::pair<const char*, const char*>>& columns) {
  return std::all_of(columns.begin(), columns.end(), [&](const auto& column) {
    return file.header.find(column.second) != std::string::npos;
  });
}

std::string EurocYaml(const fs::path& folder, const std::vector<EurocFile>& files) {
  using Columns = std::vector<std::pair<const char*, const char*>>;
  const Columns rates = {
      {"wx", "w_RS_S_x [rad s^-1]"}, {"wy", "w_RS_S_y [rad s^-1]"}, {"wz", "w_RS_S_z [rad s^-1]"}};
  const Columns forces = {
      {"ax", "a_RS_S_x [m s^-2]"}, {"ay", "a_RS_S_y [m s^-2]"}, {"az", "a_RS_S_z [m s^-2]"}};
  const Columns place = {{"x", "p_RS_R_x [m]"}, {"y", "p_RS_R_y [m]"}, {"z", "p_RS_R_z [m]"}};
  const Columns turn = {
      {"qw", "q_RS_w []"}, {"qx", "q_RS_x []"}, {"qy", "q_RS_y []"}, {"qz", "q_RS_z []"}};
  std::string imus, pose, others;
  for (const EurocFile& file : files) {
    if (HasAll(file, rates) && HasAll(file, forces)) {
      imus += fmt::format("  - name: {}\n    file: {}\n    columns:\n{}{}", PlainNameOf(file.name),
                          YamlWord(file.file.string()), ColumnsYaml(rates, "rad/s"),
                          ColumnsYaml(forces, "m/s2"));
    } else if (pose.empty() && HasAll(file, place) && HasAll(file, turn)) {
      pose = fmt::format("pose:\n  file: {}\n  columns:\n{}{}", YamlWord(file.file.string()),
                         ColumnsYaml(place, "m"), ColumnsYaml(turn, "\"1\""));
    } else {
      others += "# not imported: " + file.file.string() + "\n";
    }
  }
  return Top(folder.filename().string()) + "time: {column: \"timestamp [ns]\", unit: ns}\n" +
         (imus.empty() ? "" : "imus:\n" + imus) + pose + others;
}

}  // namespace

std::string SuggestForLog(const fs::path& log) {
  const std::string type = TypeOfLog(log);
  if (type == kUlogType) return SuggestForUlog(log);
  LeftOutRows left_out;
  const auto table = ReadLog(log, type, &left_out);
  const std::string yaml = type == kPosType    ? PosYaml(log, *table)
                           : type == kNmeaType ? NmeaYaml(log, *table)
                                               : KittiYaml(log, *table);
  if (left_out.count == 0) return yaml;
  return yaml +
         fmt::format("# {} lines cannot be read, the first: {}\n", left_out.count, left_out.first);
}

std::string SuggestForFolder(const fs::path& folder) {
  for (const fs::path& drive : {folder / "oxts/timestamps.txt", folder / "timestamps.txt"}) {
    if (!TypeOfLog(drive).empty() && fs::is_regular_file(drive)) return SuggestForLog(drive);
  }
  const std::vector<EurocFile> files = EurocFilesOf(folder);
  if (!files.empty()) return EurocYaml(folder, files);
  throw InputError(fmt::format(
      "{}: is a folder of no known form; need a rosbag2 with metadata.yaml, a drive of KITTI with "
      "oxts/timestamps.txt, data.csv files as EuRoC has them, or a file",
      folder.string()));
}

}  // namespace tera
