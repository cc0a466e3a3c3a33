#include "dataset/import/suggest/time_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/quantile.h"
#include "dataset/import/row_time.h"
#include "dataset/import/suggest/time_candidates.h"

namespace tera {
namespace {

/// Properties of the times that a candidate gives.
struct SeenTimes {
  std::size_t rows = 0, without = 0, repeats = 0, backs = 0;
  int first_repeat = 0, first_back = 0;  ///< line numbers
  std::vector<TimeNs> t_ns;              ///< times of the rows that have one
  std::vector<std::size_t> timed;        ///< indices of these rows
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
    seen.t_ns.push_back(*t_ns);
    seen.timed.push_back(row);
    if (before_ns && *t_ns == *before_ns && seen.repeats++ == 0) seen.first_repeat = csv.Line(row);
    if (before_ns && *t_ns < *before_ns && seen.backs++ == 0) seen.first_back = csv.Line(row);
    seen.goes_on = seen.goes_on || (before_ns && *t_ns > *before_ns);
    before_ns = t_ns;
  }
  if (rows.size() == 1 && before_ns) seen.goes_on = true;
  return seen;
}

struct SeenCandidate : TimeCandidate {
  SeenTimes seen;
};

/// Rows at which the times restart: this row and the next two are earlier than the row before them.
std::vector<std::size_t> StartsAnew(const SeenTimes& seen) {
  constexpr std::size_t kRowsOfStart = 3;
  std::vector<std::size_t> starts;
  for (std::size_t k = 1; k < seen.t_ns.size(); ++k) {
    if (seen.t_ns[k] >= seen.t_ns[k - 1]) continue;
    const std::size_t end = std::min(k + kRowsOfStart, seen.t_ns.size());
    const bool stays = std::all_of(seen.t_ns.begin() + static_cast<std::ptrdiff_t>(k),
                                   seen.t_ns.begin() + static_cast<std::ptrdiff_t>(end),
                                   [&](TimeNs t_ns) { return t_ns < seen.t_ns[k - 1]; });
    if (stays && end == k + kRowsOfStart) starts.push_back(k);
  }
  return starts;
}

TimeNs UsualStep(const SeenTimes& seen) {
  std::vector<TimeNs> steps;
  for (std::size_t k = 1; k < seen.t_ns.size(); ++k) {
    if (seen.t_ns[k] > seen.t_ns[k - 1]) steps.push_back(seen.t_ns[k] - seen.t_ns[k - 1]);
  }
  return steps.empty() ? 0 : Median(std::move(steps));
}

/// The period of a one-column time that restarts whenever it goes back.
std::optional<double> TurnOf(const CsvFile& csv, const TimeCandidate& candidate,
                             const SeenTimes& seen) {
  if (candidate.columns.size() != 1 || seen.backs == 0) return std::nullopt;
  const Config config = Config::FromText("time: " + candidate.time, "suggested");
  const RowTime time = ReadRowTime(config.root().Map("time"), /*has_stamps=*/false);
  const RowTimes times(csv, time);
  const TimeNs step_ns = UsualStep(seen);
  std::optional<double> turn;
  for (std::size_t k = 1; k < seen.t_ns.size(); ++k) {
    if (seen.t_ns[k] >= seen.t_ns[k - 1]) continue;
    const auto here = times.TurnAt(seen.timed[k], seen.t_ns[k - 1], step_ns);
    if (!here || (turn && *here != *turn)) return std::nullopt;
    turn = here;
  }
  return turn;
}

/// Restricts the guess to the longest part between restarts.
void TakeLongestPart(const CsvFile& csv, const SeenTimes& seen, TimeGuess* guess) {
  std::vector<std::size_t> starts = StartsAnew(seen);
  if (starts.empty()) return;
  starts.insert(starts.begin(), 0);
  starts.push_back(seen.timed.size());
  std::size_t longest = 0;
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    if (starts[k + 1] - starts[k] > starts[longest + 1] - starts[longest]) longest = k;
  }
  const auto line_of = [&](std::size_t k) { return csv.Line(seen.timed[k]); };
  if (longest > 0) guess->first_line = line_of(starts[longest]);
  if (starts[longest + 1] < seen.timed.size()) guess->last_line = line_of(starts[longest + 1]) - 1;
  for (std::size_t k = 1; k + 1 < starts.size(); ++k) {
    const std::size_t row = starts[k];
    guess->parts += fmt::format(
        "# line {} goes back by {:.6g} s, as after a restart of the logger or a change of its "
        "clock\n",
        line_of(row), ToSeconds(seen.t_ns[row - 1] - seen.t_ns[row]));
  }
  guess->parts +=
      "# csv selects the longest part with first_line and last_line: import each other part "
      "separately\n";
}

/// The candidate's `time`, with a possible value in place of each placeholder.
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
        "# line {} repeats the time of the previous row{}; valid_if excludes such rows\n",
        seen.first_repeat,
        seen.repeats > 1 ? fmt::format(", and so do {} more", seen.repeats - 1) : "");
  }
  if (seen.backs > 0) {
    remarks += fmt::format(
        "# line {} is earlier than the previous row{}; --skip-bad-rows skips such rows\n",
        seen.first_back, seen.backs > 1 ? fmt::format(", and so are {} more", seen.backs - 1) : "");
  }
  if (seen.without > 0) {
    remarks +=
        fmt::format("# {} rows have no time; --skip-bad-rows skips such rows\n", seen.without);
  }
  return remarks;
}

TimeGuess ToFillIn(std::size_t row_count, const std::vector<NumbersOfColumn>& columns,
                   const std::vector<SeenCandidate>& candidates) {
  std::string seen;
  for (const SeenCandidate& candidate : candidates) {
    seen += fmt::format(
        "; {} does not increase as a time: of {} rows {} repeat, {} go back, {} lack it",
        candidate.time, candidate.seen.rows, candidate.seen.repeats, candidate.seen.backs,
        candidate.seen.without);
  }
  constexpr int kMostNamed = 3;
  int named = 0;
  for (const NumbersOfColumn& column : columns) {
    const bool increases =
        column.values.size() == row_count && row_count > 1 &&
        std::is_sorted(column.values.begin(), column.values.end(), std::less_equal<>());
    if (!increases || ++named > kMostNamed) continue;
    seen += fmt::format("; '{}' always increases, by {:.4g}, but its name is not that of a time",
                        column.name, column.MedianStep());
  }
  return {.yaml =
              "time: unknown   # to fill in, as {column: NAME, unit: s}, or {interval: 10, unit: "
              "ms} from row to row" +
              seen + "\n"};
}

}  // namespace

TimeGuess GuessTime(const CsvFile& csv, const std::vector<std::size_t>& rows,
                    const std::vector<NumbersOfColumn>& columns, bool has_header) {
  std::vector<SeenCandidate> candidates;
  constexpr std::size_t kMostCandidates = 20;
  for (TimeCandidate& found : FindTimeCandidates(csv, rows, columns, has_header)) {
    if (candidates.size() == kMostCandidates) break;
    SeenTimes seen = Look(csv, rows, "time: " + PossibleTime(found.time));
    candidates.push_back({std::move(found), std::move(seen)});
  }
  // Among candidates that increase, the most certain one is best; at equal certainty, the most
  // regular.
  const SeenCandidate* best = nullptr;
  for (const SeenCandidate& candidate : candidates) {
    if (!candidate.seen.is_usable()) continue;
    const auto faults = [](const SeenCandidate& c) {
      return std::tuple(c.to_fill_in, c.seen.repeats + c.seen.backs + c.seen.without > 0);
    };
    if (best == nullptr || faults(candidate) < faults(*best)) best = &candidate;
  }
  if (best == nullptr) return ToFillIn(rows.size(), columns, candidates);
  TimeGuess guess{.columns = best->columns};
  SeenTimes best_seen = best->seen;
  if (!best->to_fill_in && best->seen.without == 0) guess.t_ns = best->seen.t_ns;
  const std::string what = best->to_fill_in ? "to fill in: " : "guessed: ";
  std::string time = best->time, remark = best->remark;
  if (const auto turn = best->to_fill_in ? std::nullopt : TurnOf(csv, *best, best->seen)) {
    time.insert(time.size() - 1, fmt::format(", wraps_at: {:.10g}", *turn));
    remark += fmt::format("{}it wraps after {:.10g}, {} time{}", remark.empty() ? "" : "; ", *turn,
                          best->seen.backs, best->seen.backs == 1 ? "" : "s");
    best_seen = Look(csv, rows, "time: " + time);
    if (!guess.t_ns.empty()) guess.t_ns = best_seen.t_ns;
  }
  guess.yaml = fmt::format("time: {}{}\n", time, remark.empty() ? "" : "   # " + what + remark);
  if (best->is_absolute || ToSeconds(best->seen.t_ns.front()) > kLeastEpoch_s)
    guess.yaml += "zero: start\n";
  TakeLongestPart(csv, best_seen, &guess);
  if (guess.first_line > 0 || guess.last_line > 0) return guess;
  guess.yaml += RepeatRemarks(best_seen);
  if (best_seen.repeats > 0) {
    guess.rule = fmt::format("{{column: {}, changes: true}}", YamlWord(best->columns.back()));
  }
  return guess;
}

}  // namespace tera
