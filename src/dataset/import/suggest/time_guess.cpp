#include "dataset/import/suggest/time_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "dataset/import/row_time.h"
#include "dataset/import/suggest/time_candidates.h"

namespace tera {
namespace {

/// How the times that a mapping gives look.
struct SeenTimes {
  std::size_t rows = 0, without = 0, repeats = 0, backs = 0;
  int first_repeat = 0, first_back = 0;  ///< lines
  std::vector<TimeNs> t_ns;              ///< of the rows that have one
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
                   const std::vector<SeenCandidate>& candidates) {
  std::string seen;
  for (const SeenCandidate& candidate : candidates) {
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
  // The best of those that go on: first by what is known of them, then by how they go on.
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
  if (!best->to_fill_in && best->seen.without == 0) guess.t_ns = best->seen.t_ns;
  const std::string what = best->to_fill_in ? "to fill in: " : "guessed: ";
  guess.yaml = fmt::format("time: {}{}\n", best->time,
                           best->remark.empty() ? "" : "   # " + what + best->remark);
  if (best->is_absolute || ToSeconds(best->seen.t_ns.front()) > kLeastEpoch_s)
    guess.yaml += "zero: start\n";
  guess.yaml += RepeatRemarks(best->seen);
  if (best->seen.repeats > 0) {
    guess.rule = fmt::format("{{column: {}, changes: true}}", YamlWord(best->columns.back()));
  }
  return guess;
}

}  // namespace tera
