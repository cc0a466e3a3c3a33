#include "dataset/import/suggest/time_candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "dataset/import/calendar_time.h"

namespace tera {
namespace {

bool IsAmong(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// True for words of counters, and of times that are not the time of the row.
bool NamesNoTime(const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return IsAmong(word, {"count",     "counter",  "index",   "idx",      "seq",       "sequence",
                          "delay",     "lag",      "latency", "duration", "dt",        "delta",
                          "diff",      "interval", "period",  "engine",   "operating", "cycle",
                          "remaining", "age",      "unnamed", "offset",   "id",        "machine"});
  });
}

// Numbers.

/// A count from an epoch other than 1970, recognised by its magnitude.
struct Epoch {
  double least, most;  ///< values of the years 2000 and 2100, in its unit
  const char* unit;
  double scale;
  const char* offset;  ///< in s
  const char* remark;
};

constexpr Epoch kEpochs[] = {
    {9e8, 4.2e9, "s", 1, "", ""},
    {9e11, 4.2e12, "ms", 1, "", ""},
    {9e14, 4.2e15, "us", 1, "", ""},
    {9e17, 4.2e18, "ns", 1, "", ""},
    {36525, 73050, "day", 1, "-2209161600", "days since 1899-12-30, as spreadsheets count them"},
    {730486, 767011, "day", 1, "-62167219200", "days since the year 0, as MATLAB counts them"},
    {1.25e17, 1.57e17, "us", 0.1, "-11644473600",
     "units of 100 ns since 1601, as Windows has them"},
    {6.3e17, 6.62e17, "us", 0.1, "-62135596800",
     "units of 100 ns since the year 1, as .NET has them"},
};

/// Rows of a log are less than an hour apart. A counter that happens to have the magnitude of an
/// epoch may take larger steps.
bool StepsAsALog(const NumbersOfColumn& column, const Epoch& epoch) {
  constexpr double kLongest_s = 3600;
  return std::abs(column.MedianStep()) * epoch.scale * FindUnit(epoch.unit)->factor <= kLongest_s;
}

/// The epoch by magnitude. Numbers of the magnitude of days are common, so days also need a name
/// that suggests a date or time.
const Epoch* EpochOf(const NumbersOfColumn& column, bool is_named) {
  if (column.values.empty()) return nullptr;
  const double first = column.values.front(), last = column.values.back();
  // .NET ticks have the magnitude of ns since 1970 in the year 1990. No log is that old.
  for (const Epoch& epoch : kEpochs) {
    const bool is_days = std::string_view(epoch.unit) == "day";
    const bool has_fractions = std::any_of(column.values.begin(), column.values.end(),
                                           [](double value) { return value != std::round(value); });
    if (is_days && (!is_named || !has_fractions)) continue;
    if (first >= epoch.least && first <= epoch.most && last >= epoch.least && last <= epoch.most &&
        (is_days || StepsAsALog(column, epoch))) {
      return &epoch;
    }
  }
  return nullptr;
}

/// True if the name says GPS and the number could be seconds since 1980. Up to July 2027, such
/// numbers look like dates up to July 2017 that count from 1970. GPS time is 18 s ahead of UTC
/// since 2017.
bool MayCountFrom1980(const NumbersOfColumn& column, const Epoch& epoch) {
  constexpr double kMost_s = 1.5e9;
  const std::vector<std::string> words = WordsOfName(column.name);
  const bool names_gps = std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word.starts_with("gps") || word.starts_with("gnss");
  });
  return names_gps && *epoch.offset == '\0' &&
         column.values.front() <= kMost_s * (epoch.least / kEpochs[0].least);
}

TimeCandidate OfEpoch(const NumbersOfColumn& column, const Epoch& epoch) {
  TimeCandidate candidate{.columns = {column.name}, .is_absolute = true};
  const std::string offset = *epoch.offset == '\0' ? "" : fmt::format(", offset: {}", epoch.offset);
  std::string yaml = ColumnYaml(column.name, {epoch.unit, epoch.scale, ""});
  candidate.time = yaml.substr(0, yaml.size() - 1) + offset + "}";
  candidate.remark = epoch.remark;
  if (MayCountFrom1980(column, epoch)) {
    candidate.time = fmt::format("{{column: {}, unit: unknown}}", YamlWord(column.name));
    candidate.remark = fmt::format(
        "{} of GPS time since 1980-01-06 need offset: 315964782 beside the unit, those since 1970 "
        "none",
        epoch.unit);
    candidate.to_fill_in = true;
    return candidate;
  }
  const auto told = ToldUnit(column, Dimension::kTime);
  if (told && told->unit != epoch.unit && *epoch.remark == '\0') {
    candidate.remark = fmt::format("by its size, though it is named in {}", told->unit);
  }
  return candidate;
}

/// True if all numbers can be times of day in the notation of receivers: 224610.12.
bool AreClockDigits(const NumbersOfColumn& column) {
  constexpr double kLeast = 10000, kMost = 240000, kPair = 100, kSixty = 60;
  return column.LargestSize() >= kLeast &&
         std::all_of(column.values.begin(), column.values.end(), [](double value) {
           return value >= 0 && value < kMost && std::fmod(value, kPair) < kSixty &&
                  std::fmod(std::floor(value / kPair), kPair) < kSixty;
         });
}

/// Candidate from a column whose name suggests a time.
TimeCandidate OfNamed(const NumbersOfColumn& column) {
  if (const Epoch* epoch = EpochOf(column, true)) return OfEpoch(column, *epoch);
  TimeCandidate candidate{.columns = {column.name}};
  if (const auto told = ToldUnit(column, Dimension::kTime)) {
    candidate.time = ColumnYaml(column.name, *told);
    return candidate;
  }
  // A column called "seconds" states its unit.
  if (const auto unit = UnitOfText(column.name, Dimension::kTime); unit && column.name.size() > 1) {
    candidate.time = ColumnYaml(column.name, {unit->unit->name, unit->scale, ""});
    return candidate;
  }
  const double step = column.MedianStep();
  if (AreClockDigits(column)) {
    candidate.time = fmt::format("{{column: {}, unit: unknown}}", YamlWord(column.name));
    candidate.remark = fmt::format(
        "digits of a time of day, hhmmss, are {{clock: {0}}}, or {{date: NAME, clock: {0}}} beside "
        "a date; a number of seconds has unit: s",
        YamlWord(column.name));
    candidate.to_fill_in = true;
    return candidate;
  }
  const bool has_fractions = std::any_of(column.values.begin(), column.values.end(),
                                         [](double value) { return value != std::round(value); });
  // Step lengths that machine loggers use. Milliseconds read as seconds would make the recording
  // too long.
  constexpr double kLeast_s = 2e-3, kMost_s = 0.5, kLongest_s = 6 * 3600;
  const bool is_long =
      !column.values.empty() && column.values.back() - column.values.front() > kLongest_s;
  if (has_fractions && step >= kLeast_s && step <= kMost_s && !is_long) {
    candidate.time = ColumnYaml(column.name, {"s", 1.0, ""});
    candidate.remark = fmt::format("steps of {:.4g} with fractions are seconds", step);
    return candidate;
  }
  candidate.time = fmt::format("{{column: {}, unit: unknown}}", YamlWord(column.name));
  candidate.remark =
      fmt::format("its unit is unknown; it steps by {:.4g}, at {:.4g} Hz in s or {:.4g} Hz in ms",
                  step, 1 / step, 1e3 / step);
  candidate.to_fill_in = true;
  return candidate;
}

/// Whole seconds in one column and nanoseconds in another, as in ROS stamps.
std::optional<TimeCandidate> OfSecondsAndNanoseconds(const std::vector<NumbersOfColumn>& columns) {
  for (const NumbersOfColumn& nanos : columns) {
    for (const std::string_view ending : {"nanosec", "nsecs", "nsec"}) {
      if (!nanos.name.ends_with(ending) || nanos.values.empty() || nanos.LargestSize() >= 1e9) {
        continue;
      }
      const std::string stem = nanos.name.substr(0, nanos.name.size() - ending.size());
      for (const NumbersOfColumn& seconds : columns) {
        if (seconds.name != stem + "sec" && seconds.name != stem + "secs") continue;
        const double size = seconds.LargestSize();
        return TimeCandidate{
            .time = fmt::format("{{sum: [{}, {}]}}", ColumnYaml(seconds.name, {"s", 1.0, ""}),
                                ColumnYaml(nanos.name, {"ns", 1.0, ""})),
            .columns = {seconds.name, nanos.name},
            .is_absolute = size > kLeastEpoch_s};
      }
    }
  }
  return std::nullopt;
}

std::string LettersOf(std::string_view name) {
  std::string letters;
  for (const std::string& word : WordsOfName(name)) letters += word;
  return letters;
}

/// Hours, minutes and seconds in separate columns. Hours may be absent.
std::optional<TimeCandidate> OfClockParts(const std::vector<NumbersOfColumn>& columns) {
  constexpr double kSixty = 60, kHours = 24;
  const auto find = [&](std::initializer_list<std::string_view> names, double below) {
    return std::find_if(columns.begin(), columns.end(), [&](const NumbersOfColumn& column) {
      const auto fits = [&](double value) { return value >= 0 && value < below; };
      return IsAmong(LettersOf(column.name), names) && !column.values.empty() &&
             std::all_of(column.values.begin(), column.values.end(), fits);
    });
  };
  const auto hours = find({"hh", "hr", "hour", "hours", "stunde", "heure"}, kHours);
  const auto minutes = find({"min", "mins", "minute", "minutes"}, kSixty);
  const auto seconds = find({"sec", "secs", "second", "seconds", "sekunde"}, kSixty);
  if (minutes == columns.end() || seconds == columns.end()) return std::nullopt;
  TimeCandidate candidate{.is_absolute = true};
  std::string parts;
  const auto add = [&](const NumbersOfColumn& column, const char* unit) {
    parts += (parts.empty() ? "" : ", ") + ColumnYaml(column.name, {unit, 1.0, ""});
    candidate.columns.push_back(column.name);
  };
  if (hours != columns.end()) add(*hours, "h");
  add(*minutes, "min");
  add(*seconds, "s");
  candidate.time = "{sum: [" + parts + "]}";
  return candidate;
}

std::optional<TimeCandidate> OfGpsWeek(const std::vector<NumbersOfColumn>& columns) {
  const auto find = [&](std::initializer_list<std::string_view> names) {
    return std::find_if(columns.begin(), columns.end(), [&](const NumbersOfColumn& column) {
      return IsAmong(LettersOf(column.name), names) && !column.values.empty();
    });
  };
  const auto week = find({"week", "gpsweek", "gnssweek", "wn", "gpswn", "weekno", "weeknumber"});
  const auto tow = find(
      {"tow",        "gpstow",   "itow",      "sow",     "gpssow",   "gpsseconds", "secondsofweek",
       "timeofweek", "tows",     "towms",     "towsec",  "gpstows",  "gpstowms",   "gpstowsec",
       "gnsstow",    "gnsstows", "gnsstowms", "gpstime", "gpstimes", "gpssec",     "weekseconds"});
  if (week == columns.end() || tow == columns.end()) return std::nullopt;
  constexpr double kWeek_s = 604'800;
  const auto told = ToldUnit(*tow, Dimension::kTime);
  const UnitGuess unit =
      told.value_or(UnitGuess{tow->LargestSize() > kWeek_s ? "ms" : "s", 1.0, ""});
  const std::string seconds = ColumnYaml(tow->name, unit);
  return TimeCandidate{
      .time = fmt::format("{{week: {}, {}", YamlWord(week->name), seconds.substr(1)),
      .remark = "GPS time, which becomes UTC",
      .columns = {week->name, tow->name},
      .is_absolute = true};
}

// Dates.

/// Number of texts of each kind in a column.
struct CalendarColumn {
  std::string name;
  std::size_t dates = 0, clocks = 0, both = 0, without_zone = 0;
  bool needs_order = false, day_beyond_12 = false, month_beyond_12 = false;
};

CalendarColumn ReadCalendar(const CsvFile& csv, const std::vector<std::size_t>& rows,
                            std::size_t column) {
  CalendarColumn read{.name = csv.columns()[column]};
  for (const std::size_t row : rows) {
    const std::string_view text = csv.Field(row, column);
    const bool has_order = !NeedsDateOrder(text);
    const auto as_day = CalendarTimeOf(text, DateOrder::kDayFirst);
    const auto as_month = CalendarTimeOf(text, DateOrder::kMonthFirst);
    const auto time = as_day ? as_day : as_month;
    read.needs_order = read.needs_order || (!has_order && time);
    if (!has_order) {
      read.day_beyond_12 = read.day_beyond_12 || (as_day && !as_month);
      read.month_beyond_12 = read.month_beyond_12 || (as_month && !as_day);
    }
    const auto clock = time ? std::nullopt : ClockTimeOf(text);
    if (time) ++(time->has_clock ? read.both : read.dates);
    if (clock) ++read.clocks;
    const bool has_zone = (time && time->has_zone) || (clock && clock->has_zone);
    if ((time || clock) && !has_zone) ++read.without_zone;
  }
  return read;
}

TimeCandidate OfCalendar(const CalendarColumn& date, const std::string& clock) {
  TimeCandidate candidate{.columns = {date.name}, .is_absolute = true};
  const bool has_date = date.both + date.dates > 0;
  std::string keys = fmt::format("{}: {}", has_date ? "date" : "clock", YamlWord(date.name));
  if (!clock.empty()) {
    keys += ", clock: " + YamlWord(clock);
    candidate.columns.push_back(clock);
  }
  if (date.needs_order) {
    candidate.to_fill_in = date.day_beyond_12 == date.month_beyond_12;
    keys += candidate.to_fill_in ? ", order: unknown"
            : date.day_beyond_12 ? ", order: dmy"
                                 : ", order: mdy";
    if (candidate.to_fill_in) candidate.remark = "no row shows whether day or month is first";
  }
  if (has_date && date.without_zone > 0 && !candidate.to_fill_in) {
    candidate.remark = "no zone is given, taken as UTC; otherwise set zone: \"+01:00\"";
  }
  candidate.time = "{" + keys + "}";
  return candidate;
}

std::vector<TimeCandidate> CalendarCandidates(const CsvFile& csv,
                                              const std::vector<std::size_t>& rows,
                                              const std::vector<NumbersOfColumn>& columns) {
  std::vector<CalendarColumn> found;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].words > 0) found.push_back(ReadCalendar(csv, rows, c));
  }
  const auto most = [&](std::size_t count) { return count > 0 && 10 * count >= 9 * rows.size(); };
  std::vector<TimeCandidate> candidates;
  for (const CalendarColumn& column : found) {
    if (most(column.both)) candidates.push_back(OfCalendar(column, ""));
  }
  for (const CalendarColumn& date : found) {
    for (const CalendarColumn& clock : found) {
      // A date column may show midnight while the time of day is in another column.
      if (most(date.dates + date.both) && most(clock.clocks)) {
        candidates.push_back(OfCalendar(date, clock.name));
      }
    }
  }
  // A date is preferred even if its order is ambiguous.
  const bool asks_for_order = std::any_of(candidates.begin(), candidates.end(),
                                          [](const TimeCandidate& one) { return one.to_fill_in; });
  for (const CalendarColumn& column : found) {
    if (most(column.clocks) && !asks_for_order) candidates.push_back(OfCalendar(column, ""));
  }
  return candidates;
}

}  // namespace

bool NamesTime(std::string_view name) {
  const std::vector<std::string> words = WordsOfName(name);
  if (NamesNoTime(words)) return false;
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return IsAmong(
        word, {"time",   "times",      "timestamp",   "stamp",   "datetime", "date",     "clock",
               "t",      "ts",         "tns",         "tus",     "tms",      "timens",   "timeus",
               "timems", "sec",        "secs",        "seconds", "msec",     "millis",   "micros",
               "nanos",  "epoch",      "unixtime",    "utc",     "tow",      "itow",     "elapsed",
               "ms",     "zeit",       "zeitstempel", "uhrzeit", "datum",    "sekunden", "laufzeit",
               "temps",  "horodatage", "heure",       "tempo",   "tiempo",   "fecha",    "hora",
               "tijd",   "tid",        "czas",        "aika"});
  });
}

std::vector<TimeCandidate> FindTimeCandidates(const CsvFile& csv,
                                              const std::vector<std::size_t>& rows,
                                              const std::vector<NumbersOfColumn>& columns,
                                              bool has_header) {
  std::vector<TimeCandidate> candidates;
  if (has_header) {
    if (auto stamps = OfSecondsAndNanoseconds(columns)) candidates.push_back(std::move(*stamps));
    if (auto gps = OfGpsWeek(columns)) candidates.push_back(std::move(*gps));
    if (auto parts = OfClockParts(columns)) candidates.push_back(std::move(*parts));
  }
  for (TimeCandidate& candidate : CalendarCandidates(csv, rows, columns)) {
    candidates.push_back(std::move(candidate));
  }
  for (const NumbersOfColumn& column : columns) {
    if (column.values.empty()) continue;
    if (has_header && NamesTime(column.name)) {
      candidates.push_back(OfNamed(column));
    } else if (const Epoch* epoch = EpochOf(column, false);
               epoch != nullptr && epoch->least > 1e11 &&
               !(has_header && NamesNoTime(WordsOfName(column.name)))) {
      candidates.push_back(OfEpoch(column, *epoch));
    }
  }
  return candidates;
}

}  // namespace tera
