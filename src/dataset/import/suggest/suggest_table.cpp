#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"
#include "dataset/import/bag/bag_source.h"
#include "dataset/import/csv_file.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/suggest.h"

// Guesses about a text table.

namespace tera {
namespace {

/// A name without case, unit and what is neither letter nor digit: "Gyro X [deg/s]" is "gyrox".
std::string Stem(std::string_view name) {
  std::string stem;
  for (const char c : name.substr(0, name.find_first_of("[("))) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      stem += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  for (const std::string_view unit : {"degps", "radps", "mps2", "dps", "deg", "rad", "rpm"}) {
    if (stem.ends_with(unit) && stem.size() > unit.size()) {
      stem.resize(stem.size() - unit.size());
      break;
    }
  }
  return stem;
}

class TableGuess {
 public:
  explicit TableGuess(const std::filesystem::path& log) : log_(log) {
    CsvForm form;
    LeftOutRows left_out;
    const CsvFile as_rows(log, {.has_header = false}, &left_out);
    has_header_ = !IsAllNumbers(as_rows);
    form.has_header = has_header_;
    const CsvFile csv(log, form, &left_out);
    for (std::size_t c = 0; c < csv.columns().size(); ++c) columns_.push_back(NumbersOf(csv, c));
    if (std::all_of(columns_.begin(), columns_.end(),
                    [](const NumbersOfColumn& column) { return column.values.empty(); })) {
      throw InputError(fmt::format(
          "{}: has no column of numbers; need a table, a bag or another log that is known "
          "(docs/reference/dataset.md, importing)",
          log.string()));
    }
  }

  std::string Yaml() {
    // One after the other: what one takes is none of those behind it.
    std::string yaml = Top();
    yaml += Imu();
    yaml += Gnss();
    yaml += Pose();
    yaml += Encoders();
    const std::string levers = Levers();
    const std::string tables = levers + Others();
    if (!tables.empty()) yaml += "tables:\n" + tables;
    return yaml;
  }

 private:
  static bool IsAllNumbers(const CsvFile& csv) {
    if (csv.row_count() == 0) return false;
    for (std::size_t c = 0; c < csv.columns().size(); ++c) {
      if (csv.IsPresent(0, c) && !NumberAt(csv, 0, c)) return false;
    }
    return true;
  }
  static std::optional<double> NumberAt(const CsvFile& csv, std::size_t row, std::size_t column) {
    std::string_view field = csv.Field(row, column);
    if (field.starts_with('+')) field.remove_prefix(1);
    double value = 0;
    const auto [stop, status] = std::from_chars(field.data(), field.data() + field.size(), value);
    const bool is_number =
        status == std::errc() && stop == field.data() + field.size() && std::isfinite(value);
    return is_number ? std::optional(value) : std::nullopt;
  }
  static NumbersOfColumn NumbersOf(const CsvFile& csv, std::size_t column) {
    NumbersOfColumn numbers{.name = csv.columns()[column]};
    numbers.increases = csv.row_count() > 1;
    for (std::size_t row = 0; row < csv.row_count(); ++row) {
      const auto value = NumberAt(csv, row, column);
      const bool goes_on = value && (numbers.values.empty() || *value > numbers.values.back());
      numbers.increases = numbers.increases && goes_on;
      if (value) numbers.values.push_back(*value);
    }
    return numbers;
  }

  /// The column of one of these stems that is not taken yet.
  const NumbersOfColumn* Find(const std::vector<std::string>& stems) const {
    for (const std::string& stem : stems) {
      for (const NumbersOfColumn& column : columns_) {
        if (has_header_ && Stem(column.name) == stem && !column.values.empty() &&
            !taken_.contains(column.name)) {
          return &column;
        }
      }
    }
    return nullptr;
  }
  /// Columns "stem + ending" for all of the endings, of the first stem that has them all.
  std::vector<const NumbersOfColumn*> FindAll(const std::vector<std::string>& stems,
                                              const std::vector<std::string>& endings) const {
    for (const std::string& stem : stems) {
      std::vector<const NumbersOfColumn*> found;
      for (const std::string& ending : endings) {
        if (const auto* column = Find({stem + ending})) found.push_back(column);
      }
      if (found.size() == endings.size()) return found;
    }
    return {};
  }
  void Take(const std::vector<const NumbersOfColumn*>& columns) {
    for (const NumbersOfColumn* column : columns) taken_.insert(column->name);
  }
  static std::string Columns(const std::vector<const NumbersOfColumn*>& columns,
                             const std::vector<std::string>& keys, const UnitGuess& unit) {
    std::string yaml;
    for (std::size_t k = 0; k < keys.size(); ++k) {
      yaml += fmt::format("      {}: {}{}\n", keys[k], ColumnYaml(columns[k]->name, unit),
                          k == 0 ? DoubtRemark(unit) : "");
    }
    return yaml;
  }

  const NumbersOfColumn* TimeColumn() const {
    if (const auto* named = Find({"tns", "tus", "tms", "ts", "t", "time", "times", "timems",
                                  "timens", "timestamp", "stamp", "secs", "sec", "ms"})) {
      if (named->increases) return named;
    }
    for (const NumbersOfColumn& column : columns_) {
      if (column.increases) return &column;
    }
    return nullptr;
  }

  std::string Top() {
    std::string yaml = fmt::format(
        "# A first mapping by 'tera import --suggest': look at what is marked as guessed.\n"
        "name: {}\nmachine: machine   # guessed: name the machine's folder\nfile: {}\n",
        PlainNameOf(log_.stem().string()), YamlWord(log_.string()));
    if (!has_header_) yaml += "csv: {header: false}   # guessed: its first line has numbers only\n";
    const NumbersOfColumn* time = TimeColumn();
    if (time == nullptr) {
      return yaml + "time: {interval: 10, unit: ms}   # guessed: no column always increases\n";
    }
    const UnitGuess unit = GuessTimeUnit(*time);
    yaml += fmt::format("time: {}{}\n", ColumnYaml(time->name, unit), DoubtRemark(unit));
    if (!time->values.empty() && time->values.front() * SecondsOf(unit) > kLeastEpoch_s) {
      yaml += "zero: start\n";
    }
    Take({time});
    return yaml;
  }

  std::string Imu() {
    const std::vector<std::string> axes = {"x", "y", "z"};
    const auto rates = FindAll({"g", "gyro", "gyr", "w", "omega", "imugyro", "angularvelocity",
                                "imuangularvelocity", "angvel", "rate"},
                               axes);
    const auto forces = FindAll({"a", "acc", "accel", "imuacc", "acceleration", "imuacceleration",
                                 "linearacceleration", "imulinearacceleration"},
                                axes);
    if (rates.empty() || forces.empty()) return "";
    Take(rates);
    Take(forces);
    return "imus:\n  - name: imu\n    columns:\n" +
           Columns(rates, {"wx", "wy", "wz"}, GuessRateUnit(rates)) +
           Columns(forces, {"ax", "ay", "az"}, GuessAccelerationUnit(forces));
  }

  std::string Gnss() {
    const auto* lat = Find({"lat", "latitude", "gpslat", "gnsslat"});
    const auto* lon = Find({"lon", "lng", "long", "longitude", "gpslon", "gnsslon"});
    const auto* alt = Find({"alt", "altitude", "height", "h", "ellipsoidalheight", "gpsalt"});
    if (lat == nullptr || lon == nullptr || alt == nullptr) return "";
    const auto* fix = Find({"fix", "quality", "fixtype", "q", "gpsfix"});
    Take({lat, lon, alt});
    const UnitGuess angle = GuessAngleUnit({lat, lon}), metres{"m", 1.0, ""};
    const double to_deg = angle.unit == "rad" ? 57.29577951308232 : 1.0;
    std::string yaml = fmt::format(
        "origin: {{lat_deg: {:.7f}, lon_deg: {:.7f}, height_m: {:.3f}}}   # guessed: the first "
        "row\n"
        "gnss:\n  - name: gnss\n    columns:\n",
        lat->values.front() * to_deg, lon->values.front() * to_deg, alt->values.front());
    yaml += Columns({lat, lon}, {"lat", "lon"}, angle) + Columns({alt}, {"alt"}, metres);
    if (fix != nullptr) {
      Take({fix});
      yaml += "      fix: " + ColumnYaml(fix->name, {"1"}) + "   # guessed: a quality as of GGA\n";
    } else {
      yaml += "      fix: {constant: 1}   # guessed: no column of it\n";
    }
    for (const char* key : {"var_e", "var_n", "var_u"}) {
      yaml += fmt::format("      {}: {{constant: 4}}   # guessed: no column of it\n", key);
    }
    return yaml;
  }

  std::string Pose() {
    const auto place = FindAll({"", "pos", "position", "p", "icppos"}, {"x", "y", "z"});
    const auto turn = FindAll({"q", "quat", "orientation", "rot", "icpquat"}, {"w", "x", "y", "z"});
    if (place.empty() || turn.empty()) return "";
    Take(place);
    Take(turn);
    return "pose:\n  columns:\n" + Columns(place, {"x", "y", "z"}, {"m"}) +
           Columns(turn, {"qw", "qx", "qy", "qz"}, {"1"});
  }

  std::string Encoders() {
    std::string joints;
    for (const std::string joint : {"swing", "slew", "boom", "arm", "stick", "bucket"}) {
      const auto* angle = Find({joint, joint + "angle", joint + "pos", joint + "position"});
      if (angle == nullptr) continue;
      Take({angle});
      const UnitGuess unit = GuessAngleUnit({angle});
      joints += fmt::format("      - {{name: {}, angle: {}}}{}\n", joint,
                            ColumnYaml(angle->name, unit), DoubtRemark(unit));
    }
    return joints.empty() ? "" : "encoders:\n  - name: joints\n    joints:\n" + joints;
  }

  /// Columns whose names say that they are levers become the table that operators replay.
  std::string Levers() {
    std::vector<std::pair<std::string, const NumbersOfColumn*>> levers;
    double largest = 0;
    for (const std::string lever : {"left_track", "right_track", "slew", "swing", "boom", "arm",
                                    "stick", "bucket", "blade"}) {
      const std::string stem = Stem(lever);
      const auto* column =
          Find({"lever" + stem, stem + "lever", "cmd" + stem, stem + "cmd", "command" + stem,
                stem + "command", "joystick" + stem, stem + "joystick"});
      if (column == nullptr) continue;
      Take({column});
      largest = std::max(largest, column->LargestSize());
      levers.emplace_back(lever, column);
    }
    constexpr double kMostOfFull = 1.5;  // beyond it, -1 to 1 is not what was logged
    const std::string unit = largest > kMostOfFull ? "%" : "1";
    std::string yaml;
    for (const auto& [lever, column] : levers) {
      yaml += fmt::format("      {}: {}   # guessed: up to {:.4g}\n", lever,
                          ColumnYaml(column->name, {unit}), column->LargestSize());
    }
    return yaml.empty() ? "" : "  - name: commands\n    columns:\n" + yaml;
  }

  /// What is left becomes a table, in units that nobody knows.
  std::string Others() const {
    std::string yaml;
    for (const NumbersOfColumn& column : columns_) {
      if (taken_.contains(column.name)) continue;
      if (column.values.empty()) {
        yaml += "# no numbers: " + PlainNameOf(column.name) + "\n";
        continue;
      }
      const std::string name = (has_header_ ? "" : "column_") + PlainNameOf(column.name);
      yaml += fmt::format("      {}: {}   # guessed: unit unknown, up to {:.4g}\n", name,
                          ColumnYaml(column.name, {"1"}), column.LargestSize());
    }
    return yaml.empty() ? "" : "  - name: others\n    columns:\n" + yaml;
  }

  std::filesystem::path log_;
  bool has_header_ = true;
  std::vector<NumbersOfColumn> columns_;
  std::set<std::string> taken_;
};

}  // namespace

std::string SuggestForTable(const std::filesystem::path& log) { return TableGuess(log).Yaml(); }

std::string SuggestMapping(const std::filesystem::path& log) {
  if (LooksLikeBag(log)) return SuggestForBag(log);
  if (std::filesystem::is_directory(log)) return SuggestForFolder(log);
  return TypeOfLog(log).empty() ? SuggestForTable(log) : SuggestForLog(log);
}

}  // namespace tera
