#include "dataset/import/suggest/time_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "core/error.h"
#include "dataset/import/row_time.h"

namespace tera {
namespace {

bool IsAmong(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Words of counters and of times that are no time of the row.
bool NamesNoTime(const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return IsAmong(word, {"count",     "counter",  "index",   "idx",      "seq",       "sequence",
                          "delay",     "lag",      "latency", "duration", "dt",        "delta",
                          "diff",      "interval", "period",  "engine",   "operating", "cycle",
                          "remaining", "age",      "unnamed", "offset",   "id",        "machine"});
  });
}

/// How the times that a mapping gives look.
struct SeenTimes {
  std::size_t rows = 0, without = 0, repeats = 0, backs = 0;
  int first_repeat = 0, first_back = 0;  ///< lines
  TimeNs first_ns = 0;
  bool goes_on = false;
  bool is_usable() const {
    return goes_on && 10 * without <= rows && 5 * repeats <= rows && 20 * backs <= rows + 20;
  }
};

SeenTimes Look(const CsvFile& csv, const std::vector<std::size_t>& rows, const std::string& yaml) {
  SeenTimes seen{.rows = rows.size()};
  const Config config = Config::FromText(yaml, "suggested");
  const RowTime time = ReadRowTime(config.root().Map("time"), /*has_stamps=*/false);
  const RowTimes times(csv, time);
  std::optional<TimeNs> before_ns;
  for (const std::size_t row : rows) {
    std::optional<TimeNs> t_ns;
    try {
      t_ns = times.At(row);
    } catch (const InputError&) {
      ++seen.without;
      continue;
    }
    if (!before_ns) seen.first_ns = *t_ns;
    if (before_ns && *t_ns == *before_ns && seen.repeats++ == 0) seen.first_repeat = csv.Line(row);
    if (before_ns && *t_ns < *before_ns && seen.backs++ == 0) seen.first_back = csv.Line(row);
    seen.goes_on = seen.goes_on || (before_ns && *t_ns > *before_ns);
    before_ns = t_ns;
  }
  if (rows.size() == 1 && before_ns) seen.goes_on = true;
  return seen;
}

/// A way to read the time.
struct Candidate {
  std::string time;                  ///< "{column: t, unit: s}"
  std::string remark;                ///< behind it
  std::vector<std::string> columns;  ///< the last one is the one that changes most
  bool is_absolute = false;          ///< counts from an epoch
  bool to_fill_in = false;           ///< `time` is not whole
  SeenTimes seen = {};
};

// --- Numbers.

/// A count of seconds that begins elsewhere than in 1970, by the size of its numbers.
struct Epoch {
  double least, most;  ///< years 2000 to 2100, in its unit
  const char* unit;
  double scale;
  const char* offset;  ///< s
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

/// By size; days only where the name says a date or a time, since such numbers are no rarity.
const Epoch* EpochOf(const NumbersOfColumn& column, bool is_named) {
  if (column.values.empty()) return nullptr;
  const double first = column.values.front(), last = column.values.back();
  // .NET's ticks lie within what would be ns of 1990, before any epoch of a log.
  for (const Epoch& epoch : kEpochs) {
    const bool is_days = std::string_view(epoch.unit) == "day";
    const bool has_fractions = std::any_of(column.values.begin(), column.values.end(),
                                           [](double value) { return value != std::round(value); });
    if (is_days && (!is_named || !has_fractions)) continue;
    if (first >= epoch.least && first <= epoch.most && last >= epoch.least && last <= epoch.most) {
      return &epoch;
    }
  }
  return nullptr;
}

Candidate OfEpoch(const NumbersOfColumn& column, const Epoch& epoch) {
  Candidate candidate{.columns = {column.name}, .is_absolute = true};
  const std::string offset = *epoch.offset == '\0' ? "" : fmt::format(", offset: {}", epoch.offset);
  std::string yaml = ColumnYaml(column.name, {epoch.unit, epoch.scale, ""});
  candidate.time = yaml.substr(0, yaml.size() - 1) + offset + "}";
  candidate.remark = epoch.remark;
  const auto told = ToldUnit(column, Dimension::kTime);
  if (told && told->unit != epoch.unit && *epoch.remark == '\0') {
    candidate.remark = fmt::format("by its size, though it is named in {}", told->unit);
  }
  return candidate;
}

/// A column whose name says time.
Candidate OfNamed(const NumbersOfColumn& column) {
  if (const Epoch* epoch = EpochOf(column, true)) return OfEpoch(column, *epoch);
  Candidate candidate{.columns = {column.name}};
  if (const auto told = ToldUnit(column, Dimension::kTime)) {
    candidate.time = ColumnYaml(column.name, *told);
    return candidate;
  }
  // "seconds" alone names its unit.
  if (const auto unit = UnitOfText(column.name, Dimension::kTime); unit && column.name.size() > 1) {
    candidate.time = ColumnYaml(column.name, {unit->unit->name, unit->scale, ""});
    return candidate;
  }
  const double step = column.MedianStep();
  const bool has_fractions = std::any_of(column.values.begin(), column.values.end(),
                                         [](double value) { return value != std::round(value); });
  constexpr double kLeast_s = 5e-4, kMost_s = 0.5;  // of loggers of machines
  if (has_fractions && step >= kLeast_s && step <= kMost_s) {
    candidate.time = ColumnYaml(column.name, {"s", 1.0, ""});
    candidate.remark = fmt::format("steps of {:.4g} with fractions are seconds", step);
    return candidate;
  }
  candidate.time = fmt::format("{{column: {}, unit: unknown}}", YamlWord(column.name));
  candidate.remark = fmt::format(
      "nothing tells its unit; it steps by {:.4g}, at {:.4g} Hz in s or {:.4g} Hz in ms", step,
      1 / step, 1e3 / step);
  candidate.to_fill_in = true;
  return candidate;
}

/// Whole seconds and the nanoseconds beyond them, as stamps of ROS are written.
std::optional<Candidate> OfSecondsAndNanoseconds(const std::vector<NumbersOfColumn>& columns) {
  for (const NumbersOfColumn& nanos : columns) {
    for (const std::string_view ending : {"nanosec", "nsecs", "nsec"}) {
      if (!nanos.name.ends_with(ending) || nanos.values.empty() || nanos.LargestSize() >= 1e9) {
        continue;
      }
      const std::string stem = nanos.name.substr(0, nanos.name.size() - ending.size());
      for (const NumbersOfColumn& seconds : columns) {
        if (seconds.name != stem + "sec" && seconds.name != stem + "secs") continue;
        const double size = seconds.LargestSize();
        return Candidate{
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

std::optional<Candidate> OfGpsWeek(const std::vector<NumbersOfColumn>& columns) {
  const auto find = [&](std::initializer_list<std::string_view> names) {
    return std::find_if(columns.begin(), columns.end(), [&](const NumbersOfColumn& column) {
      return IsAmong(LettersOf(column.name), names) && !column.values.empty();
    });
  };
  const auto week = find({"week", "gpsweek", "gnssweek", "wn", "gpswn", "weekno", "weeknumber"});
  const auto tow = find({"tow", "gpstow", "itow", "sow", "gpssow", "gpsseconds", "secondsofweek",
                         "timeofweek", "tows", "towms", "gpstime", "gpssec", "weekseconds"});
  if (week == columns.end() || tow == columns.end()) return std::nullopt;
  constexpr double kWeek_s = 604'800;
  const auto told = ToldUnit(*tow, Dimension::kTime);
  const UnitGuess unit =
      told.value_or(UnitGuess{tow->LargestSize() > kWeek_s ? "ms" : "s", 1.0, ""});
  const std::string seconds = ColumnYaml(tow->name, unit);
  return Candidate{.time = fmt::format("{{week: {}, {}", YamlWord(week->name), seconds.substr(1)),
                   .remark = "GPS time, which becomes UTC",
                   .columns = {week->name, tow->name},
                   .is_absolute = true};
}

// --- Dates.

/// What the texts of a column are.
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

Candidate OfCalendar(const CalendarColumn& date, const std::string& clock) {
  Candidate candidate{.columns = {date.name}, .is_absolute = true};
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
    if (candidate.to_fill_in) candidate.remark = "no row tells whether day or month is first";
  }
  if (has_date && date.without_zone > 0 && !candidate.to_fill_in) {
    candidate.remark = "no zone is told, taken as UTC; else say zone: \"+01:00\"";
  }
  candidate.time = "{" + keys + "}";
  return candidate;
}

std::vector<Candidate> CalendarCandidates(const CsvFile& csv, const std::vector<std::size_t>& rows,
                                          const std::vector<NumbersOfColumn>& columns) {
  std::vector<CalendarColumn> found;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].words > 0) found.push_back(ReadCalendar(csv, rows, c));
  }
  const auto most = [&](std::size_t count) { return count > 0 && 10 * count >= 9 * rows.size(); };
  std::vector<Candidate> candidates;
  for (const CalendarColumn& column : found) {
    if (most(column.both)) candidates.push_back(OfCalendar(column, ""));
  }
  for (const CalendarColumn& date : found) {
    for (const CalendarColumn& clock : found) {
      // A date may stand beside midnights.
      if (most(date.dates + date.both) && most(clock.clocks)) {
        candidates.push_back(OfCalendar(date, clock.name));
      }
    }
  }
  for (const CalendarColumn& column : found) {
    if (most(column.clocks)) candidates.push_back(OfCalendar(column, ""));
  }
  return candidates;
}

std::vector<Candidate> AllCandidates(const CsvFile& csv, const std::vector<std::size_t>& rows,
                                     const std::vector<NumbersOfColumn>& columns, bool has_header) {
  std::vector<Candidate> candidates;
  if (has_header) {
    if (auto stamps = OfSecondsAndNanoseconds(columns)) candidates.push_back(std::move(*stamps));
    if (auto gps = OfGpsWeek(columns)) candidates.push_back(std::move(*gps));
  }
  for (Candidate& candidate : CalendarCandidates(csv, rows, columns)) {
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

/// `time` of a candidate; what is to be filled in is as if it were one of what is possible.
std::string PossibleTime(std::string time) {
  for (const auto& [unknown, possible] :
       {std::pair{"unit: unknown", "unit: ms"}, std::pair{"order: unknown", "order: dmy"}}) {
    if (const std::size_t at = time.find(unknown); at != std::string::npos) {
      time.replace(at, std::string_view(unknown).size(), possible);
    }
  }
  return time;
}

std::string RepeatRemarks(const SeenTimes& seen) {
  std::string remarks;
  if (seen.repeats > 0) {
    remarks += fmt::format(
        "# line {} repeats the time of the row before{}; valid_if leaves such rows out\n",
        seen.first_repeat,
        seen.repeats > 1 ? fmt::format(", and so do {} more", seen.repeats - 1) : "");
  }
  if (seen.backs > 0) {
    remarks += fmt::format(
        "# line {} is earlier than the row before{}; --skip-bad-rows leaves such rows out\n",
        seen.first_back, seen.backs > 1 ? fmt::format(", and so are {} more", seen.backs - 1) : "");
  }
  if (seen.without > 0) {
    remarks +=
        fmt::format("# {} rows have no time; --skip-bad-rows leaves such rows out\n", seen.without);
  }
  return remarks;
}

/// A `time:` that is not known.
TimeGuess ToFillIn(std::size_t row_count, const std::vector<NumbersOfColumn>& columns,
                   const std::vector<Candidate>& candidates) {
  std::string seen;
  for (const Candidate& candidate : candidates) {
    seen +=
        fmt::format("; {} does not go on as a time: of {} rows {} repeat, {} go back, {} lack it",
                    candidate.time, candidate.seen.rows, candidate.seen.repeats,
                    candidate.seen.backs, candidate.seen.without);
  }
  constexpr int kMostNamed = 3;
  int named = 0;
  for (const NumbersOfColumn& column : columns) {
    const bool increases =
        column.values.size() == row_count && row_count > 1 &&
        std::is_sorted(column.values.begin(), column.values.end(), std::less_equal<>());
    if (!increases || ++named > kMostNamed) continue;
    seen += fmt::format("; '{}' always increases, by {:.4g}, but no name says that it is a time",
                        column.name, column.MedianStep());
  }
  return {
      "time: unknown   # to fill in, as {column: NAME, unit: s}, or {interval: 10, unit: ms} "
      "from row to row" +
          seen + "\n",
      {},
      ""};
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

TimeGuess GuessTime(const CsvFile& csv, const std::vector<std::size_t>& rows,
                    const std::vector<NumbersOfColumn>& columns, bool has_header) {
  std::vector<Candidate> candidates = AllCandidates(csv, rows, columns, has_header);
  for (Candidate& candidate : candidates) {
    candidate.seen = Look(csv, rows, "time: " + PossibleTime(candidate.time));
  }
  // The best of those that go on: first by what is known of them, then by how they go on.
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates) {
    if (!candidate.seen.is_usable()) continue;
    const auto faults = [](const Candidate& c) {
      return std::tuple(c.to_fill_in, c.seen.repeats + c.seen.backs + c.seen.without > 0);
    };
    if (best == nullptr || faults(candidate) < faults(*best)) best = &candidate;
  }
  if (best == nullptr) return ToFillIn(rows.size(), columns, candidates);
  TimeGuess guess{.columns = best->columns};
  const std::string what = best->to_fill_in ? "to fill in: " : "guessed: ";
  guess.yaml = fmt::format("time: {}{}\n", best->time,
                           best->remark.empty() ? "" : "   # " + what + best->remark);
  if (best->is_absolute || ToSeconds(best->seen.first_ns) > kLeastEpoch_s)
    guess.yaml += "zero: start\n";
  guess.yaml += RepeatRemarks(best->seen);
  if (best->seen.repeats > 0) {
    guess.rule = fmt::format("{{column: {}, changes: true}}", YamlWord(best->columns.back()));
  }
  return guess;
}

std::vector<TimeNs> TimesOf(const CsvFile& csv, const TimeGuess& guess) {
  std::vector<TimeNs> all;
  try {
    const Config config = Config::FromText(guess.yaml, "suggested");
    const RowTime time = ReadRowTime(config.root().Map("time"), /*has_stamps=*/false);
    const RowTimes times(csv, time);
    for (std::size_t row = 0; row < csv.row_count(); ++row) all.push_back(times.At(row));
  } catch (const InputError&) {
    return {};
  }
  return all;
}

}  // namespace tera
