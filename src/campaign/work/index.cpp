#include "campaign/work/index.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "core/error.h"
#include "core/parse_number.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr int kBusyWait_ms = 60'000;  ///< waiting time for another process that updates the index

[[noreturn]] void FailIndex(const fs::path& file, FaultKind kind, const std::string& finding) {
  throw InputError(file.string(), {kind, finding + "; delete it to have it made anew"});
}

/// A value bound to an SQL statement.
using Cell = std::variant<std::int64_t, double, std::string>;

class Database {
 public:
  explicit Database(const fs::path& file) : file_(file) {
    sqlite3* opened = nullptr;
    const int status = sqlite3_open(file.c_str(), &opened);
    database_.reset(opened);
    if (status != SQLITE_OK) Fail();
    sqlite3_busy_timeout(opened, kBusyWait_ms);
  }

  /// Executes a statement. `visit` receives the columns of each row as text.
  template <typename Visit>
  void Execute(const char* sql, const std::vector<Cell>& cells, const Visit& visit) {
    sqlite3_stmt* prepared = nullptr;
    if (sqlite3_prepare_v2(database_.get(), sql, -1, &prepared, nullptr) != SQLITE_OK) Fail();
    const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement(prepared,
                                                                               sqlite3_finalize);
    for (std::size_t c = 0; c < cells.size(); ++c)
      Bind(prepared, static_cast<int>(c + 1), cells[c]);
    int status = SQLITE_ROW;
    while ((status = sqlite3_step(prepared)) == SQLITE_ROW) {
      std::vector<std::string> columns;
      for (int c = 0; c < sqlite3_column_count(prepared); ++c) {
        const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(prepared, c));
        columns.emplace_back(text ? text : "");
      }
      visit(columns);
    }
    if (status != SQLITE_DONE) Fail();
  }
  void Execute(const char* sql, const std::vector<Cell>& cells = {}) {
    Execute(sql, cells, [](const std::vector<std::string>&) {});
  }

 private:
  static void Bind(sqlite3_stmt* statement, int at, const Cell& cell) {
    if (const auto* whole = std::get_if<std::int64_t>(&cell)) {
      sqlite3_bind_int64(statement, at, *whole);
    } else if (const auto* number = std::get_if<double>(&cell)) {
      sqlite3_bind_double(statement, at, *number);
    } else {
      sqlite3_bind_text(statement, at, std::get<std::string>(cell).c_str(), -1, SQLITE_TRANSIENT);
    }
  }
  [[noreturn]] void Fail() const {
    const int status = sqlite3_errcode(database_.get());
    const std::string why = sqlite3_errmsg(database_.get());
    if (status == SQLITE_NOTADB || status == SQLITE_CORRUPT || status == SQLITE_ERROR) {
      FailIndex(file_, FaultKind::kMalformed, "is not an index of a campaign: " + why);
    }
    throw InputError(file_.string(), {FaultKind::kUnwritable,
                                      fmt::format("cannot be brought up to date: {}; free space "
                                                  "on that disk, or make it writable",
                                                  why)});
  }

  fs::path file_;
  std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database_{nullptr, sqlite3_close};
};

void RequireOwnIndex(const Plan& plan, const fs::path& file, Database* index) {
  std::optional<std::string> found;
  index->Execute("CREATE TABLE IF NOT EXISTS campaign (fingerprint TEXT, name TEXT)");
  index->Execute(
      "CREATE TABLE IF NOT EXISTS episodes (number INTEGER PRIMARY KEY, state TEXT, reason TEXT, "
      "message TEXT, seed INTEGER, draw INTEGER, wall_s REAL, peak_mb REAL, bytes INTEGER, "
      "sha256 TEXT, host TEXT)");
  index->Execute("SELECT fingerprint FROM campaign", {},
                 [&](const std::vector<std::string>& row) { found = row.at(0); });
  if (!found) {
    index->Execute("INSERT INTO campaign VALUES (?, ?)", {plan.fingerprint, plan.campaign.name});
  } else if (*found != plan.fingerprint) {
    FailIndex(file, FaultKind::kInconsistent, "is the index of another campaign");
  }
}

/// Numbers of the episodes whose names occur in a folder, with an ending.
std::vector<int> NumbersIn(const fs::path& folder, const std::string& ending = "") {
  std::vector<int> numbers;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(ending)) continue;
    const auto number =
        ParseNumber<int>(std::string_view(name).substr(0, name.size() - ending.size()));
    if (number) numbers.push_back(*number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

EpisodeRecord OwnRecord(const Plan& plan, int number) {
  const fs::path file = plan.EpisodeFolder(number) / "episode.yaml";
  EpisodeRecord record = ReadRecord(file);
  if (record.fingerprint == plan.fingerprint && record.number == number &&
      number < plan.campaign.episodes) {
    return record;
  }
  throw InputError(file.string(), {FaultKind::kInconsistent,
                                   "is an episode of another campaign, or has another number; move "
                                   "it away, and `tera campaign run` makes the right episode"});
}

void WriteRows(const CampaignState& state, Database* index) {
  index->Execute("BEGIN IMMEDIATE");
  index->Execute("DELETE FROM episodes");
  for (const auto& [number, record] : state.done) {
    index->Execute(
        "INSERT INTO episodes VALUES (?, 'done', '', '', ?, ?, ?, ?, ?, ?, ?)",
        {std::int64_t{number}, static_cast<std::int64_t>(record.seed), std::int64_t{record.draw},
         record.wall_s, record.peak_mb, record.bytes, record.sha256, record.host});
  }
  for (const auto& [number, failure] : state.failed) {
    index->Execute(
        "INSERT INTO episodes (number, state, reason, message) VALUES (?, 'failed', ?, ?)",
        {std::int64_t{number}, NameOf(failure.reason), failure.message});
  }
  index->Execute("COMMIT");
}

}  // namespace

double CampaignState::LargestPeakMb() const {
  double peak_mb = 0;
  for (const auto& [_, record] : done) peak_mb = std::max(peak_mb, record.peak_mb);
  return peak_mb;
}

double CampaignState::MeanWall_s() const {
  double sum_s = 0;
  for (const auto& [_, record] : done) sum_s += record.wall_s;
  return done.empty() ? 0 : sum_s / static_cast<double>(done.size());
}

CampaignState RefreshIndex(const Plan& plan) {
  const fs::path file = plan.folder / "index.sqlite";
  Database index(file);
  RequireOwnIndex(plan, file, &index);
  CampaignState state;
  for (const int number : NumbersIn(plan.folder / "episodes")) {
    state.done.emplace(number, OwnRecord(plan, number));
  }
  for (const int number : NumbersIn(plan.folder / "failed", ".yaml")) {
    if (!state.done.contains(number)) {
      state.failed.emplace(number, ReadFailure(plan.FailureFile(number)));
    }
  }
  for (const int number : NumbersIn(plan.folder / "work")) {
    if (!state.done.contains(number) && !state.failed.contains(number)) state.begun.insert(number);
  }
  for (int number = 0; number < plan.campaign.episodes; ++number) {
    if (!state.done.contains(number) && !state.failed.contains(number)) {
      state.missing.push_back(number);
    }
  }
  WriteRows(state, &index);
  return state;
}

std::string StatusText(const Plan& plan, const CampaignState& state) {
  std::string text = fmt::format("{}: {} of {} episodes done, {} failed, {} to do",
                                 plan.campaign.name, state.done.size(), plan.campaign.episodes,
                                 state.failed.size(), state.missing.size());
  if (!state.begun.empty()) text += fmt::format(", of them {} begun", state.begun.size());
  text += '\n';
  std::map<std::string, int> refusals;
  for (const auto& [_, record] : state.done) {
    for (const std::string& rule : record.refused) ++refusals[rule];
  }
  for (const auto& [rule, count] : refusals) {
    text += fmt::format("  {} drawn anew by rule '{}'\n", count, rule);
  }
  for (const auto& [number, failure] : state.failed) {
    const std::string first = failure.message.substr(0, failure.message.find('\n'));
    text += fmt::format("  episode {} failed ({}): {}\n", number, NameOf(failure.reason), first);
  }
  return text;
}

int ClearFailures(const Plan& plan, bool all) {
  int cleared = 0;
  for (const int number : NumbersIn(plan.folder / "failed", ".yaml")) {
    const fs::path file = plan.FailureFile(number);
    if (all || IsWorthRetry(ReadFailure(file).reason)) cleared += fs::remove(file);
  }
  return cleared;
}

}  // namespace tera
