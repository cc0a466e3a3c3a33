#include "dataset/import/import_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "core/config/plain_name.h"
#include "core/error.h"
#include "core/quantile.h"
#include "core/types/mounting.h"
#include "dataset/import/bag/standard_topics.h"
#include "dataset/import/logs/foreign_log.h"

namespace tera {
namespace {

std::vector<TimeNs> TimesOf(const std::vector<MappedRow>& rows) {
  std::vector<TimeNs> t_ns;
  for (const MappedRow& row : rows) t_ns.push_back(row.t_ns);
  return t_ns;
}

void Describe(const std::vector<TimeNs>& t_ns, ImportedChannel* channel) {
  channel->rows = static_cast<std::int64_t>(t_ns.size());
  if (t_ns.empty()) return;
  channel->first_ns = t_ns.front();
  channel->last_ns = t_ns.back();
  std::vector<TimeNs> intervals_ns;
  for (std::size_t i = 1; i < t_ns.size(); ++i) intervals_ns.push_back(t_ns[i] - t_ns[i - 1]);
  if (intervals_ns.empty()) return;
  channel->longest_gap_ns = *std::max_element(intervals_ns.begin(), intervals_ns.end());
  channel->interval_ns = Median(intervals_ns);
  std::int64_t early_or_late = 0;
  for (const TimeNs interval_ns : intervals_ns) {
    if (2 * std::abs(interval_ns - channel->interval_ns) > channel->interval_ns) ++early_or_late;
  }
  channel->irregular = early_or_late;
}

/// Rate from the median interval, so gaps do not change it; 0 without an interval.
double TypicalRate_hz(const std::vector<MappedRow>& rows) {
  std::vector<TimeNs> intervals_ns;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    intervals_ns.push_back(rows[i].t_ns - rows[i - 1].t_ns);
  }
  if (intervals_ns.empty()) return 0;
  return 1.0 / ToSeconds(Median(std::move(intervals_ns)));
}

/// Time scale of a file. Logs of receivers, dates and GPS weeks are converted to UTC. The clock of
/// a bag, or of numbers in a table, is unknown.
ClockScale ClockOf(const RowSource& source) {
  const RowTime::Form form = source.time.form;
  if (form == RowTime::Form::kDate || form == RowTime::Form::kGpsWeek) return ClockScale::kUtc;
  const bool is_of_receiver = source.log_type == kPosType || source.log_type == kNmeaType;
  const bool is_own = source.time.Columns() == std::vector<std::string>{kLogTimeColumn};
  return is_of_receiver && is_own ? ClockScale::kUtc : ClockScale::kUnknown;
}

}  // namespace

std::vector<MappedRow> ImportRun::Read(const std::string& path, const RowSource& source,
                                       const std::vector<ColumnMapping>& columns,
                                       const RowCheck& check) {
  ImportedChannel channel{.path = path, .file = source.file.filename().string()};
  LeftOutRows left_out;
  std::vector<MappedRow> rows =
      ReadRows(source, columns, zero_ns_, options_.skips_bad_rows ? &left_out : nullptr);
  if (check) {
    std::erase_if(rows, [&](const MappedRow& row) {
      try {
        check(row);
        return false;
      } catch (const InputError& fault) {
        if (!options_.skips_bad_rows) throw;
        left_out.Add(fault.what());
        return true;
      }
    });
  }
  clocks_.insert(ClockOf(source));
  if (left_out.count > static_cast<std::int64_t>(rows.size())) {
    throw InputError(
        fmt::format("{}: {} of {} rows cannot be read, more than --skip-bad-rows may skip (half); "
                    "the first: {}",
                    path, left_out.count, left_out.count + static_cast<std::int64_t>(rows.size()),
                    left_out.first));
  }
  channel.left_out = left_out.count;
  channel.first_fault = left_out.first;
  Describe(TimesOf(rows), &channel);
  report_.channels.push_back(channel);
  return rows;
}

ImportedChannel* ImportRun::AddFrames(const std::string& path, const std::string& file,
                                      const std::vector<TimeNs>& t_ns,
                                      const LeftOutRows& left_out) {
  ImportedChannel channel{
      .path = path, .file = file, .left_out = left_out.count, .first_fault = left_out.first};
  Describe(t_ns, &channel);
  clocks_.insert(ClockScale::kUnknown);
  report_.channels.push_back(channel);
  return last();
}

void ImportRun::AddMotion(const RowSource& source, std::vector<MotionSeries> series) {
  if (series.empty()) return;
  // empty for a ULog, whose topics share one clock
  const std::string topic = source.topic ? source.topic->name : "";
  const std::vector<std::string> columns = source.time.Columns();
  const std::string time = columns.empty() ? "by interval" : columns.front();
  motions_.push_back({.path = last()->path,
                      .clock = source.file.string() + "\n" + topic + "\n" + time,
                      .interval_s = ToSeconds(last()->interval_ns),
                      .series = std::move(series)});
}

ClockScale ImportRun::Clock() const {
  return clocks_.size() == 1 ? *clocks_.begin() : ClockScale::kUnknown;
}

ImportReport ImportRun::TakeReport() {
  report_.clocks = ClockDifferences(motions_);
  return std::move(report_);
}

std::string ReadPath(const ConfigMap& config, const std::string& ending, Mapping* mapping) {
  const std::string name = config.Text("name");
  const std::string path = mapping->machine + "/" + name + ending;
  RequirePlainName(config, "name", name);
  if (!mapping->paths.insert(path).second) {
    config.Fault("name", fmt::format("'{}' is taken by another channel; give each its own", name));
  }
  return path;
}

ColumnKeys::ColumnKeys(const ConfigMap& channel, const RowSource& source, std::string_view makes,
                       std::string_view key)
    : given_(channel.OptionalMap("columns")), type_(TypeOf(source)), element_(source.element) {
  if (given_) return;
  if (HoldsTransforms(type_) && element_.empty()) {
    std::vector<std::string> pairs;
    for (const auto& [pair, count] : NamesInMessages(source.file, *source.topic, source.unpacked)) {
      pairs.push_back(pair.front());
    }
    channel.Fault("topic", fmt::format("has the type {}, which holds many transforms; need the "
                                       "frames 'parent' and 'child' of one; it has {}",
                                       type_, fmt::join(pairs, ", ")));
    return;
  }
  if (!source.topic && !StandardColumnOf(type_, key)) {
    channel.Map("columns");  // reports that it is missing
  } else if (!type_.empty() && !StandardColumnOf(type_, key)) {
    channel.Fault(
        "topic",
        fmt::format("has the type {}; need {}, or 'columns' that assign the fields", type_, makes));
  }
}

std::optional<ConfigMap> ColumnKeys::Given(const char* key) const {
  return given_ ? given_->OptionalMap(key) : std::nullopt;
}

ColumnMapping ColumnKeys::Read(const char* key, Dimension dimension, const Range& allowed) const {
  if (const auto given = Given(key)) return ReadColumnMapping(*given, dimension, allowed);
  if (const auto standard = StandardColumnOf(type_, key)) {
    return {.column = element_ + standard->path,
            .factor = standard->factor,
            .allowed = allowed,
            .may_lack = standard->may_lack};
  }
  if (given_) return ReadColumnMapping(given_->Map(key), dimension, allowed);
  return {};
}

std::string SensorText(const ImportedSensor& sensor, const RowSource& source,
                       const std::vector<MappedRow>& rows) {
  std::string text = fmt::format("type: {}\nname: {}\n", sensor.type, sensor.name);
  if (!sensor.link.empty()) text += MountingYaml(sensor.link, sensor.X_LS);
  if (rows.size() > 1) text += fmt::format("rate_hz: {:.6g}\n", TypicalRate_hz(rows));
  return text + fmt::format("imported_from: {}\n", YamlQuoted(source.file.filename().string()));
}

}  // namespace tera
