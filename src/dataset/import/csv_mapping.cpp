#include "dataset/import/csv_mapping.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "core/config/listed_folder.h"
#include "core/config/spelling.h"
#include "core/error.h"
#include "dataset/import/bag/standard_topics.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/logs/ulog.h"
#include "dataset/import/table_text.h"

namespace tera {
namespace {

RowRule ReadRule(const ConfigMap& config) {
  RowRule rule;
  rule.column = config.Text("column");
  int tests = 0;
  const auto read = [&](const char* key, RowRule::Test test) {
    if (const auto value = config.OptionalNumber(key, Any(""))) {
      rule.test = test;
      rule.value = *value;
      ++tests;
    }
  };
  read("above", RowRule::Test::kAbove);
  read("below", RowRule::Test::kBelow);
  if (config.Has("equals")) {
    rule.test = RowRule::Test::kEquals;
    rule.text = config.Text("equals");
    const auto number = NumberOfField(rule.text, {});
    rule.is_text = !number;
    rule.value = number.value_or(0);
    ++tests;
  }
  if (config.Boolean("changes", false)) {
    rule.test = RowRule::Test::kChanges;
    ++tests;
  }
  if (config.Boolean("present", false)) {
    rule.test = RowRule::Test::kPresent;
    ++tests;
  }
  if (config.Boolean("number", false)) {
    rule.test = RowRule::Test::kNumber;
    ++tests;
  }
  if (tests != 1) {
    config.Fault("",
                 "need exactly one of above, below, equals, changes: true, present: true and "
                 "number: true");
  }
  return rule;
}

bool Holds(const RowTable& table, const RowRule& rule, std::size_t row) {
  const std::size_t column = table.Column(rule.column);
  const std::optional<double> number = table.NumberIfAny(row, column);
  switch (rule.test) {
    case RowRule::Test::kAbove:
      return number && *number > rule.value;
    case RowRule::Test::kBelow:
      return number && *number < rule.value;
    case RowRule::Test::kEquals:
      if (table.Text(row, column) == rule.text) return true;
      return !rule.is_text && number && *number == rule.value;
    case RowRule::Test::kChanges:
      return row == 0 || !table.Repeats(row, column);
    case RowRule::Test::kPresent:
      return table.IsPresent(row, column);
    case RowRule::Test::kNumber:
      return number.has_value();
  }
  return false;
}

}  // namespace

CsvForm ReadCsvForm(const ConfigMap& config) {
  constexpr double kMostSkipped = 1e6, kMostUnitLines = 100, kMostLine = 2e9;
  CsvForm form;
  const std::string separator =
      config.Choice("separator", {"auto", ",", ";", "|", "tab", "blank"}, "auto");
  form.separator = separator == "tab"     ? '\t'
                   : separator == "blank" ? ' '
                   : separator == "auto"  ? '\0'
                                          : separator.front();
  form.has_header = config.Boolean("header", true);
  form.skipped_lines =
      static_cast<int>(config.Integer("skip_lines", Between(0, kMostSkipped, ""), 0));
  form.unit_lines =
      static_cast<int>(config.Integer("unit_lines", Between(0, kMostUnitLines, ""), 0));
  form.first_line = static_cast<int>(config.Integer("first_line", Between(0, kMostLine, ""), 0));
  form.last_line = static_cast<int>(config.Integer("last_line", Between(0, kMostLine, ""), 0));
  form.numbers.decimal = config.Choice("decimal", {".", ","}, ".").front();
  const std::string thousands =
      config.Choice("thousands", {"none", ",", ".", "'", "blank"}, "none");
  form.numbers.thousands = thousands == "none"    ? '\0'
                           : thousands == "blank" ? ' '
                                                  : thousands.front();
  if (form.numbers.thousands == form.numbers.decimal) {
    config.Fault("thousands", fmt::format("'{}' is already the decimal sign", thousands));
  }
  return form;
}

std::optional<BagTopic> ReadNamedTopic(const ConfigMap& channel, std::string_view key,
                                       const std::filesystem::path& bag, UnpackedFiles* unpacked) {
  for (const std::filesystem::path& part : FilesOfBag(bag)) channel.AlsoReads(part);
  const std::string name = channel.Text(key);
  const FoundTopic found = FindTopic(bag, name, unpacked);
  if (!found.topic) {
    channel.Fault(
        key,
        {FaultKind::kNoSuchName,
         fmt::format(
             "{} has no topic '{}'{}; it has {}", bag.string(), name, DidYouMean(name, found.names),
             found.names.empty() ? "none" : fmt::format("{}", fmt::join(found.names, ", ")))});
  }
  return found.topic;
}

namespace {

/// The topic that a channel names, as its bag describes it.
std::optional<BagTopic> ReadTopic(const ConfigMap& channel, const std::filesystem::path& file,
                                  UnpackedFiles* unpacked) {
  if (!channel.Has("topic")) {
    if (LooksLikeBag(file)) channel.Fault("topic", "is missing; need one of the bag's topics");
    return std::nullopt;
  }
  const BagTopic unknown{.name = channel.Text("topic")};
  if (file.empty()) return unknown;
  return ReadNamedTopic(channel, "topic", file, unpacked).value_or(unknown);
}

/// True if the mapping gives a time for a channel whose rows have their own stamps.
bool HasTimeForStamps(const ConfigMap& channel, const ConfigMap& top) {
  if (channel.Has("time") || !channel.Has("file") || !top.Has("time")) {
    return channel.Has("time") || top.Has("time");
  }
  if (top.IsText("time")) return false;
  // A `time` with keys other than column and offset belongs to text tables.
  const std::vector<std::string> keys = top.Map("time").Keys();
  return std::all_of(keys.begin(), keys.end(),
                     [](const std::string& key) { return key == "column" || key == "offset"; });
}

/// Selects the transform between the channel's frames. Rows are the messages that contain it.
void ReadTransform(const ConfigMap& channel, RowSource* source) {
  if (!channel.Has("parent") && !channel.Has("child")) return;
  const std::string parent = channel.Text("parent"), child = channel.Text("child");
  std::vector<std::string> pairs;
  for (const auto& [pair, count] :
       NamesInMessages(source->file, *source->topic, source->unpacked)) {
    pairs.push_back(pair.front());
  }
  const auto bare = [](const std::string& frame) {
    return frame.substr(frame.starts_with('/') ? 1 : 0);
  };
  const std::string pair = bare(parent) + ">" + bare(child);
  if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) {
    channel.Fault("child", fmt::format("{} has no transform {}{}; it has {}", source->topic->name,
                                       pair, DidYouMean(pair, pairs), fmt::join(pairs, ", ")));
  }
  source->element = PathOfTransform(parent, child);
  source->rules.push_back({source->element + "transform.translation.x", RowRule::Test::kPresent});
}

/// Default time column of a topic or of a log with known format.
std::string OwnTimeColumn(const RowSource& source) {
  if (!source.topic) return kLogTimeColumn;
  const bool has_stamp = !source.element.empty() || HasHeader(*source.topic);
  return has_stamp ? source.element + kHeaderStamp : kLogTime;
}

/// Only text tables support rules that compare texts.
std::vector<RowRule> ReadRules(const ConfigMap& channel, const RowSource& source) {
  std::vector<RowRule> rules;
  for (const ConfigMap& item : channel.List("valid_if")) {
    rules.push_back(ReadRule(item));
    const bool has_texts = !source.topic && source.log_type.empty();
    if (rules.back().is_text && !has_texts) {
      item.Fault("equals", fmt::format("'{}' is not a number, need a number", rules.back().text));
    }
  }
  return rules;
}

}  // namespace

RowSource ReadRowSource(const ConfigMap& channel, const ConfigMap& top, UnpackedFiles* unpacked) {
  RowSource source{.unpacked = unpacked};
  source.files = FilesOrList(channel.Has("file") ? channel : top, "file", kBagMetadata);
  if (!source.files.empty()) source.file = source.files.front();
  source.log_type = TypeOfLog(source.file);
  if (channel.Has("form")) {
    source.log_type = TypeOfTrajectory(channel.Choice("form", {"tum", "euroc", "kitti"}, "tum"));
  }
  if (source.log_type == kUlogType) {
    source.log_topic = channel.Text("topic");
  } else {
    source.topic = ReadTopic(channel, source.file, unpacked);
  }
  if (source.log_type == kNmeaType) {
    const ConfigMap& chooses = channel.Has("talker") ? channel : top;
    source.talker = chooses.Has("talker") ? chooses.Text("talker") : "";
  }
  if (source.files.size() > 1 && !TypeOf(source).empty()) {
    channel.Fault("file", "names several files; only text tables are joined, need one file");
  }
  if (source.log_type == kKittiType) {
    for (const auto& frame :
         std::filesystem::directory_iterator(source.file.parent_path() / "data")) {
      channel.AlsoReads(frame.path());
    }
  }
  if (const auto form = (channel.Has("csv") ? channel : top).OptionalMap("csv")) {
    source.form = ReadCsvForm(*form);
  }
  source.rules = ReadRules(channel, source);
  if (source.topic && HoldsTransforms(source.topic->type)) ReadTransform(channel, &source);
  const ConfigMap& holder = channel.Has("time") ? channel : top;
  const bool has_stamps = source.topic || !source.log_type.empty();
  if (source.log_type == kKittiPosesType && channel.Has("times")) {
    source.pose_times = channel.File("times");
    source.time.number.column = kLogTimeColumn;
  } else if (source.log_type == kKittiPosesType && !holder.Has("time")) {
    channel.Fault("time", {FaultKind::kMissing,
                           "is missing: poses in KITTI's form have no times; need {interval: 0.1, "
                           "unit: s}, or times: times.txt"});
  } else if (has_stamps && !HasTimeForStamps(channel, top)) {
    source.time.number.column = OwnTimeColumn(source);
  } else if (!IsTimeToFillIn(holder)) {
    source.time = ReadRowTime(holder.Map("time"), has_stamps);
  }
  return source;
}

namespace {

/// Converts the rows of one file.
class MappedRows {
 public:
  MappedRows(const RowTable& table, const RowSource& source,
             const std::vector<ColumnMapping>& columns, TimeNs zero_ns)
      : table_(table),
        source_(source),
        times_(table, source.time, [this](std::size_t row) { return IsValid(row); }),
        zero_ns_(zero_ns) {
    // A missing column is a fault of the mapping even if the file has no rows.
    for (const ColumnMapping& column : columns) columns_.emplace_back(table, column);
    for (const RowRule& rule : source.rules) table.Column(rule.column);
  }

  bool IsValid(std::size_t row) const {
    return std::all_of(source_.rules.begin(), source_.rules.end(),
                       [&](const RowRule& rule) { return Holds(table_, rule, row); });
  }

  MappedRow At(std::size_t row, const std::vector<MappedRow>& before) const {
    MappedRow mapped{times_.At(row) - zero_ns_, table_.Place(row), {}};
    if (!before.empty() && mapped.t_ns <= before.back().t_ns) {
      FailGoingBack(row, before.back().t_ns,
                    before.size() > 1 ? before.back().t_ns - before[before.size() - 2].t_ns : 0);
    }
    for (const MappedColumn& column : columns_) mapped.values.push_back(column.At(row));
    return mapped;
  }

 private:
  /// Reports a time that does not increase, with its probable cause.
  void FailGoingBack(std::size_t row, TimeNs before_ns, TimeNs step_ns) const {
    constexpr TimeNs kManySteps = 10;
    const TimeNs back_ns = before_ns + zero_ns_ - times_.At(row);
    std::string remedy = "exclude such rows with valid_if or --skip-bad-rows";
    if (const auto turn = times_.TurnAt(row, before_ns + zero_ns_, step_ns)) {
      remedy = fmt::format(
          "the counter wraps after {0:.10g}: unwrap it with time: {{..., wraps_at: {0:.10g}}}",
          *turn);
    } else if (table_.Text(row, 0) && step_ns > 0 && back_ns > kManySteps * step_ns) {
      const int line = table_.Line(row);
      remedy = fmt::format(
          "it goes back by {:.6g} s, as after a restart of the logger or a change of the clock: "
          "import the part before it with csv: {{last_line: {}}}, and the rest with csv: "
          "{{first_line: {}}}",
          ToSeconds(back_ns), line - 1, line);
    }
    table_.Fail(row, times_.place(),
                {FaultKind::kInconsistent, "need a later time than in the row before; " + remedy});
  }

  const RowTable& table_;
  const RowSource& source_;
  RowTimes times_;
  std::vector<MappedColumn> columns_;
  TimeNs zero_ns_;
};

/// Paths used by columns, time and rules, without duplicates.
std::vector<std::string> PathsOf(const RowSource& source,
                                 const std::vector<ColumnMapping>& columns) {
  std::vector<std::string> paths;
  const auto add = [&](const std::string& path) {
    if (!path.empty() && std::find(paths.begin(), paths.end(), path) == paths.end()) {
      paths.push_back(path);
    }
  };
  for (const ColumnMapping& column : columns) {
    for (const ColumnTerm& term : column.Terms()) add(term.column);
  }
  for (const std::string& column : source.time.Columns()) add(column);
  for (const RowRule& rule : source.rules) add(rule.column);
  return paths;
}

std::unique_ptr<const RowTable> TableOf(const RowSource& source,
                                        const std::vector<ColumnMapping>& columns,
                                        LeftOutRows* left_out) {
  if (source.log_type == kUlogType) {
    std::vector<std::string> paths = PathsOf(source, columns);
    std::erase(paths, kLogTimeColumn);
    return ReadUlog(source.file, source.log_topic, paths, left_out);
  }
  if (!source.pose_times.empty()) {
    return ReadTrajectoryLog(source.file, source.log_type, left_out, source.pose_times);
  }
  if (!source.log_type.empty()) {
    return ReadLog(source.file, source.log_type, source.talker, left_out);
  }
  if (!source.topic) return ReadTextTables(source.files, source.form, left_out);
  return std::make_unique<TopicTable>(source.file, *source.topic, PathsOf(source, columns),
                                      source.unpacked, left_out);
}

}  // namespace

std::string TypeOf(const RowSource& source) {
  return source.topic ? source.topic->type : source.log_type;
}

std::string PlaceOf(const RowSource& source, const RowPlace& line) {
  if (source.topic) return MessagePlace(source.file, *source.topic, line.line);
  const std::filesystem::path& file =
      line.file < source.files.size() ? source.files[line.file] : source.file;
  return fmt::format("{}:{}", file.string(), line.line);
}

std::vector<MappedRow> ReadRows(const RowSource& source, const std::vector<ColumnMapping>& columns,
                                TimeNs zero_ns, LeftOutRows* left_out) {
  const std::unique_ptr<const RowTable> table = TableOf(source, columns, left_out);
  const MappedRows reader(*table, source, columns, zero_ns);
  std::vector<MappedRow> rows;
  for (std::size_t row = 0; row < table->row_count(); ++row) {
    try {
      if (!reader.IsValid(row)) continue;
      rows.push_back(reader.At(row, rows));
    } catch (const InputError& fault) {
      if (left_out == nullptr) throw;
      left_out->Add(fault.what());
    }
  }
  return rows;
}

}  // namespace tera
