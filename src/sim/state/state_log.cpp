#include "sim/state/state_log.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "dataset/files/file_digest.h"
#include "sim/state/state_rows.h"

namespace tera {
namespace {

constexpr int kVersion = 2;
constexpr double kBlock_s = 1.0;

std::string BytesOf(const std::vector<double>& numbers) {
  std::string bytes(numbers.size() * sizeof(double), '\0');
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

}  // namespace

void RequireState(const std::filesystem::path& dataset) {
  std::error_code ignored;
  if (std::filesystem::exists(dataset / kStateFile, ignored)) return;
  throw InputError(
      (dataset / kStateFile).string(),
      {FaultKind::kUnreadable,
       "is missing; need a dataset with the state that `tera generate --keep-state` keeps"});
}

std::string StateHeader(const std::string& resolved_yaml, std::size_t columns) {
  return fmt::format("state: {}\nscenario: {}\nnumbers: {}\n", kVersion, Sha256Of(resolved_yaml),
                     columns);
}

StateLog::StateLog(const Scenario& scenario, const std::string& resolved_yaml,
                   const std::filesystem::path& file, const WorldState& state)
    : scenario_(scenario),
      file_(file, StateHeader(resolved_yaml, StateColumns(scenario))),
      series_(StateColumns(scenario)),
      tracker_(scenario.site->surface()) {
  file_.Append({BytesOf(LinkMotions(state))});
  AddRow(state);
}

void StateLog::Add(const WorldState& state) {
  AddRow(state);
  if (static_cast<double>(count_) >= kBlock_s * scenario_.physics_rate_hz) WriteBlock();
}

void StateLog::AddRow(const WorldState& state) {
  AppendStateRow(scenario_, state, &rows_);
  // Changes are packed relative to the previous ground.
  const TerrainChange change = tracker_.Find(state.ground().surface());
  terrain_.Add(change, tracker_.known());
  tracker_.Accept(change);
  ++count_;
}

void StateLog::WriteBlock() {
  Block block = {std::to_string(std::exchange(count_, 0))};
  series_.Pack(rows_, &block);
  rows_.clear();
  terrain_.Take(&block);
  file_.Append(block);
}

void StateLog::Commit() {
  if (count_ > 0) WriteBlock();
  file_.Commit();
}

}  // namespace tera
