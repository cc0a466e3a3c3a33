#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/foreign_file.h"
#include "dataset/import/suggest/command_guess.h"
#include "dataset/import/suggest/doubted_numbers.h"
#include "dataset/import/suggest/gnss_guess.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/joint_guess.h"
#include "dataset/import/suggest/long_table.h"
#include "dataset/import/suggest/rate_guess.h"
#include "dataset/import/suggest/suggest.h"
#include "dataset/import/suggest/table_layout.h"
#include "dataset/import/suggest/time_guess.h"

// Suggests a mapping for a text table.

namespace tera {
namespace {

using ColumnList = std::vector<const NumbersOfColumn*>;

class TableGuess {
 public:
  TableGuess(const std::filesystem::path& log, const TableLayout& layout)
      : log_(log), layout_(layout), csv_(log, layout.form, &left_out_) {
    if (csv_.row_count() == 0) {
      throw InputError(log.string(),
                       {FaultKind::kMissing, "has names of columns and no row; need rows"});
    }
    Look();
    if (time_.first_line > 0 || time_.last_line > 0) {
      layout_.form.first_line = time_.first_line;
      layout_.form.last_line = time_.last_line;
      const std::string parts = time_.parts;
      left_out_ = {};
      csv_ = CsvFile(log, layout_.form, &left_out_);
      Look();
      time_.yaml += parts;
    }
    taken_.insert(time_.columns.begin(), time_.columns.end());
  }

  std::string Yaml() {
    // Each step uses up columns, which are not available to later steps.
    std::string channels;
    if (long_) {
      channels = SignalsYaml(csv_, layout_, *long_);
    } else {
      channels += Imu();
      channels += Gnss();
      channels += Pose();
      channels += Encoders();
      std::string tables = MapPosition();
      tables += Commands();
      tables += Others();
      if (!tables.empty()) channels += "tables:\n" + tables;
    }
    if (channels.empty()) {
      throw InputError(log_.string(),
                       {FaultKind::kMissing, "has no column of numbers beside its time; need one"});
    }
    return Top() + channels + Remarks();
  }

 private:
  /// Reads the numbers of all columns and guesses the time.
  void Look() {
    std::vector<std::size_t> rows(csv_.row_count());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    columns_ = NumbersOf(csv_, layout_, rows);
    if (layout_.form.has_header) long_ = FindLongForm(csv_, columns_);
    if (const auto sources = long_ ? std::nullopt : FindSources(columns_)) {
      std::erase_if(rows, [&](std::size_t row) {
        return csv_.NumberIfAny(row, csv_.Column(sources->column)) != sources->first;
      });
      columns_ = NumbersOf(csv_, layout_, rows);
      taken_ = {sources->column};
      source_rule_ = sources->rule;
      remarks_ = sources->remark;
    }
    if (!long_) {
      time_ = GuessTime(csv_, rows, columns_, layout_.form.has_header);
      return;
    }
    const std::vector<std::size_t> first = RowsOfSignal(csv_, *long_, long_->signals.front());
    time_ = GuessTime(csv_, first, NumbersOf(csv_, layout_, first), /*has_header=*/true);
  }
  /// The first unused column whose name has one of these stems.
  const NumbersOfColumn* Find(const std::vector<std::string>& stems) const {
    for (const std::string& stem : stems) {
      for (const NumbersOfColumn& column : columns_) {
        if (layout_.form.has_header && StemOfName(column.name) == stem && IsLeft(column)) {
          return &column;
        }
      }
    }
    return nullptr;
  }
  bool IsLeft(const NumbersOfColumn& column) const {
    return !column.values.empty() && !taken_.contains(column.name);
  }
  /// For the first possible stem, the columns stem + ending for every ending; empty if no stem has
  /// all.
  ColumnList FindAll(const std::vector<std::string>& stems,
                     const std::vector<std::string>& endings) const {
    for (const std::string& stem : stems) {
      ColumnList found;
      for (const std::string& ending : endings) {
        if (const auto* column = Find({stem + ending})) found.push_back(column);
      }
      if (found.size() == endings.size()) return found;
    }
    return {};
  }
  void Take(const ColumnList& columns) {
    for (const NumbersOfColumn* column : columns) {
      taken_.insert(column->name);
      if (column->words > 0) with_words_.push_back(column);
    }
  }
  static std::string Columns(const ColumnList& columns, const std::vector<std::string>& keys,
                             const UnitGuess& unit) {
    std::string yaml;
    for (std::size_t k = 0; k < keys.size(); ++k) {
      yaml += fmt::format("      {}: {}{}\n", keys[k], ColumnYaml(columns[k]->name, unit),
                          k == 0 ? DoubtRemark(unit) : "");
    }
    return yaml;
  }
  /// The key `valid_if` of a channel. Rules are needed if a row may repeat its time or lack a value
  /// in one of the columns.
  std::string Rules(const ColumnList& columns, std::string_view indent = "    ",
                    const std::string& more = "") const {
    std::vector<std::string> rules;
    if (!more.empty()) rules.push_back(more);
    if (!source_rule_.empty()) rules.push_back(source_rule_);
    if (!time_.rule.empty()) rules.push_back(time_.rule);
    std::set<std::size_t> gaps;
    for (const NumbersOfColumn* column : columns) {
      if (column->gaps == 0 || !gaps.insert(column->gaps).second) continue;
      rules.push_back(fmt::format("{{column: {}, {}: true}}", YamlWord(column->name),
                                  column->words > 0 ? "number" : "present"));
    }
    if (rules.empty()) return "";
    return fmt::format("{}valid_if: [{}]\n", indent, fmt::join(rules, ", "));
  }
  /// Groups of columns that have numbers in the same rows.
  static std::vector<ColumnList> ByGaps(const ColumnList& columns) {
    std::vector<ColumnList> groups;
    for (const NumbersOfColumn* column : columns) {
      const auto group = std::find_if(groups.begin(), groups.end(), [&](const ColumnList& list) {
        return list.front()->gaps == column->gaps;
      });
      if (group == groups.end()) {
        groups.push_back({column});
      } else {
        group->push_back(column);
      }
    }
    return groups;
  }
  /// "others", then "others_2" and so on.
  static std::string NumberedName(const std::string& name, std::size_t number) {
    return number == 0 ? name : fmt::format("{}_{}", name, number + 1);
  }

  std::string Top() const {
    std::string yaml = fmt::format(
        "# A first mapping by 'tera import --suggest': look at what is marked as guessed.\n"
        "name: {}\nmachine: machine   # guessed: name the machine's folder\nfile: {}\n",
        PlainNameOf(log_.stem().string()), YamlWord(log_.string()));
    return yaml + layout_.Yaml() + time_.yaml + origin_;
  }

  std::string Imu() {
    const std::vector<std::string> axes = {"x", "y", "z"};
    const auto rates =
        FindAll({"g", "gyro", "gyr", "gyroscope", "w", "omega", "imugyro", "imugyr", "imuw",
                 "angularvelocity", "imuangularvelocity", "angvel", "rate", "wrss"},
                axes);
    const auto forces =
        FindAll({"a", "acc", "accel", "accelerometer", "imuacc", "imuaccel", "imua", "acceleration",
                 "imuacceleration", "linearacceleration", "imulinearacceleration", "arss"},
                axes);
    if (rates.empty() || forces.empty()) return "";
    ColumnList all = rates;
    all.insert(all.end(), forces.begin(), forces.end());
    Take(all);
    TurnWitness witness{time_.t_ns, forces};
    for (const char* angle : {"roll", "pitch", "yaw"}) {
      witness.angles.push_back(Find({angle, std::string("imu") + angle}));
    }
    const UnitGuess rate = GuessRateUnit(rates, witness), force = GuessAccelerationUnit(forces);
    return "imus:\n  - name: imu\n" + Rules(all) +
           InertialRemarks(time_.t_ns, rates, rate, forces, force) + "    columns:\n" +
           Columns(rates, {"wx", "wy", "wz"}, rate) + Columns(forces, {"ax", "ay", "az"}, force);
  }

  std::string Gnss() {
    PlaceColumns place;
    place.lat = Find({"lat", "latitude", "gpslat", "gnsslat", "gpslatitude", "late7", "lat1e7",
                      "latitudee7", "late6", "breite", "breitengrad"});
    place.lon =
        Find({"lon", "lng", "long", "longitude", "gpslon", "gnsslon", "gpslongitude", "lone7",
              "lon1e7", "longitudee7", "lone6", "gpslong", "gpslng", "laenge", "laengengrad"});
    place.alt = Find({"alt", "altitude", "height", "h", "ellipsoidalheight", "gpsalt", "hoehe",
                      "gpsaltitude", "gpsheight", "heightellipsoid", "elevation", "altmsl"});
    if (place.lat == nullptr || place.lon == nullptr || place.alt == nullptr) return "";
    const std::vector<std::string> fixes = {"fix",    "quality",    "fixtype",    "q",
                                            "gpsfix", "gpsquality", "fixquality", "gpsfixtype"};
    place.fix = Find(fixes);
    for (const NumbersOfColumn& column : columns_) {
      const bool is_fix =
          std::find(fixes.begin(), fixes.end(), StemOfName(column.name)) != fixes.end();
      if (is_fix && column.values.empty() && column.words > 0) place.fix_words = column.name;
    }
    ColumnList all = {place.lat, place.lon, place.alt};
    if (place.fix != nullptr) all.push_back(place.fix);
    place.lat_side = SideColumn(csv_, columns_, "NS");
    place.lon_side = SideColumn(csv_, columns_, "EW");
    const auto guess = GuessGnss(csv_, place);
    if (!guess) {
      remarks_ += "# no row has a fix with a place: no gnss channel\n";
      return "";
    }
    Take(all);
    taken_.insert({place.lat_side, place.lon_side, place.fix_words});
    origin_ = guess->origin;
    return "gnss:\n  - name: gnss\n" + Rules(all, "    ", guess->rules) + "    columns:\n" +
           guess->columns;
  }

  /// Map coordinates become a table.
  std::string MapPosition() {
    const auto* east = Find({"easting", "eastings", "utmeasting", "utme", "rechtswert", "rechts",
                             "ostwert", "east", "e", "xutm", "utmx"});
    const auto* north = Find({"northing", "northings", "utmnorthing", "utmn", "hochwert", "hoch",
                              "nordwert", "north", "n", "yutm", "utmy"});
    if (east == nullptr || north == nullptr) return "";
    constexpr double kFarFromAnySite = 1e4;
    const bool is_far = std::max(east->LargestSize(), north->LargestSize()) > kFarFromAnySite;
    if (!is_far && (east->name.size() == 1 || north->name.size() == 1)) return "";
    const auto* up = Find({"alt", "altitude", "height", "h", "elevation", "up", "hoehe", "z"});
    ColumnList all = {east, north};
    if (up != nullptr) all.push_back(up);
    Take(all);
    return "  - name: map_position\n" + Rules(all) + MapPositionYaml(all, is_far);
  }

  std::string Pose() {
    const auto place =
        FindAll({"", "pos", "position", "p", "icppos", "prsr", "prs"}, {"x", "y", "z"});
    const auto turn =
        FindAll({"q", "quat", "orientation", "rot", "icpquat", "qrs"}, {"w", "x", "y", "z"});
    if (place.empty() || turn.empty()) return "";
    ColumnList all = place;
    all.insert(all.end(), turn.begin(), turn.end());
    Take(all);
    return "pose:\n" + Rules(all, "  ") + "  columns:\n" +
           Columns(place, {"x", "y", "z"}, GuessPlaceUnit(place, time_.t_ns)) +
           Columns(turn, {"qw", "qx", "qy", "qz"}, {"1"});
  }

  std::string Encoders() {
    if (!layout_.form.has_header) return "";
    const JointGuesses guesses = GuessJoints(Left(), time_.t_ns);
    if (guesses.joints.empty()) return "";
    Take(guesses.columns);
    ColumnList columns;
    std::map<const NumbersOfColumn*, std::string> line_of;
    for (const auto& [column, yaml] : guesses.joints) {
      columns.push_back(column);
      line_of[column] = yaml;
    }
    std::string yaml = "encoders:\n";
    const std::vector<ColumnList> groups = ByGaps(columns);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      yaml +=
          fmt::format("  - name: {}\n{}    joints:\n", NumberedName("joints", g), Rules(groups[g]));
      for (const NumbersOfColumn* column : groups[g]) yaml += line_of[column];
    }
    return yaml;
  }

  /// A table of commands. Entries whose names are equal are named after their columns.
  std::string CommandTable(const std::string& name, std::vector<CommandLine> lines) {
    if (lines.empty()) return "";
    ColumnList all;
    std::set<std::string> names;
    std::string columns;
    for (CommandLine& line : lines) {
      all.insert(all.end(), line.columns.begin(), line.columns.end());
      if (!names.insert(line.name).second) line.name = PlainNameOf(line.columns.front()->name);
      columns += fmt::format("      {}: {}{}\n", line.name, line.yaml,
                             line.remark.empty() ? "" : "   # guessed: " + line.remark);
    }
    Take(all);
    return "  - name: " + name + "\n" + Rules(all) + "    columns:\n" + columns;
  }

  ColumnList Left() const {
    ColumnList left;
    for (const NumbersOfColumn& column : columns_) {
      if (IsLeft(column)) left.push_back(&column);
    }
    return left;
  }

  std::string Commands() {
    if (!layout_.form.has_header) return "";
    const std::string levers = CommandTable("commands", GuessLevers(Left()));
    return levers + CommandTable("setpoints", GuessSetpoints(Left()));
  }

  /// Remaining columns become tables, with known units or the placeholder.
  std::string Others() {
    std::string yaml;
    std::set<std::string> names;
    const std::vector<ColumnList> groups = ByGaps(Left());
    for (std::size_t g = 0; g < groups.size(); ++g) {
      yaml += fmt::format("  - name: {}\n{}    columns:\n", NumberedName("others", g),
                          Rules(groups[g]));
      for (const NumbersOfColumn* column : groups[g]) {
        std::string name = PlainNameOf(column->name);
        if (std::isdigit(static_cast<unsigned char>(name.front())) != 0) name = "column_" + name;
        if (!names.insert(name).second || name == "t_ns") name += fmt::format("_{}", names.size());
        const UnitGuess unit = GuessAnyUnit(*column);
        yaml += fmt::format("      {}: {}{}\n", name, ColumnYaml(column->name, unit),
                            DoubtRemark(unit));
      }
    }
    Take(Left());
    return yaml;
  }

  std::string Remarks() const {
    std::string yaml = remarks_;
    for (const NumbersOfColumn& column : columns_) {
      if (!column.values.empty() || taken_.contains(column.name)) continue;
      if (long_ && column.words > 0) continue;
      yaml += "# no numbers: " + PlainNameOf(column.name) + "\n";
    }
    for (const NumbersOfColumn* column : with_words_) {
      yaml +=
          fmt::format("# '{}' has words instead of numbers in {} rows, which valid_if excludes\n",
                      column->name, column->words);
    }
    if (left_out_.count > 0) {
      yaml += fmt::format("# {} rows cannot be read, the first: {}; --skip-bad-rows skips them\n",
                          left_out_.count, left_out_.first);
    }
    return yaml;
  }

  std::filesystem::path log_;
  TableLayout layout_;
  LeftOutRows left_out_;
  CsvFile csv_;
  std::vector<NumbersOfColumn> columns_;
  std::optional<LongForm> long_;
  TimeGuess time_;
  std::string origin_, remarks_, source_rule_;
  std::set<std::string> taken_;
  ColumnList with_words_;
};

}  // namespace

std::string SuggestForTable(const std::filesystem::path& log,
                            const std::vector<std::string>& overrides) {
  RefuseForeignFile(log, "a text table, a bag or another supported log");
  const std::string text = DecodedTable(ReadWholeFile(log));
  const auto layout = FindTableLayout(text, GivenFormOf(overrides));
  if (!layout) {
    const bool is_empty = text.find_first_not_of(" \t\r\n") == std::string::npos;
    throw InputError(log.string(),
                     {FaultKind::kMissing,
                      is_empty ? "is empty; need a table with rows, copy or record it again"
                               : fmt::format("has no {}; need a table, a bag or another supported "
                                             "log (docs/reference/dataset.md, importing)",
                                             std::count(text.begin(), text.end(), '\n') <= 1
                                                 ? "row behind its first line"
                                                 : "column of numbers")});
  }
  return TableGuess(log, *layout).Yaml();
}

}  // namespace tera
