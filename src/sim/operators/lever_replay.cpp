#include "sim/operators/lever_replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/config/csv.h"
#include "core/error.h"

namespace tera {
namespace {

/// Line number of the first row in the file, below the header.
constexpr std::size_t kFirstRowLine = 2;

/// Column names of `file`. Empty after a fault, which is reported.
std::vector<std::string> HeaderOf(const ConfigMap& config, const std::filesystem::path& file) {
  if (file.empty()) return {};
  try {
    return ReadCsvHeader(file);
  } catch (const InputError& e) {
    config.Fault("csv", e.faults().front());
    return {};
  }
}

/// Reads the time column (seconds, or nanoseconds if its name ends in _ns) and `columns`. An
/// unusable file is a fault of `config` and gives an empty table.
CommandTable ReadCommands(const ConfigMap& config, const std::filesystem::path& file,
                          const std::string& time_column, std::vector<std::string> columns) {
  CommandTable table;
  if (file.empty()) return table;
  columns.insert(columns.begin(), time_column);
  try {
    const auto values = ReadCsvColumns(file, columns);
    const double ns_per_unit = time_column.ends_with("_ns") ? 1.0 : 1e9;
    for (std::size_t r = 0; r < values[0].size(); ++r) {
      table.t_ns.push_back(std::llround(values[0][r] * ns_per_unit));
      std::vector<double> row;
      for (std::size_t c = 1; c < columns.size(); ++c) row.push_back(values[c][r]);
      table.rows.push_back(std::move(row));
      if (r > 0 && table.t_ns[r] <= table.t_ns[r - 1]) {
        config.Fault("csv", {FaultKind::kInconsistent, "time does not grow from the row before",
                             fmt::format("{}:{}", file.string(), r + kFirstRowLine)});
        return table;
      }
    }
  } catch (const InputError& e) {
    config.Fault("csv", e.faults().front());
  }
  return table;
}

/// Allowed excess over full lever, for rounding in the file.
constexpr double kLeverRounding = 1e-9;

/// Reports the first lever beyond +-1. Clamps rounding errors.
void CheckLevers(const ConfigMap& config, const std::filesystem::path& file,
                 const std::vector<std::string>& columns, CommandTable* table) {
  for (std::size_t r = 0; r < table->rows.size(); ++r) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      double& lever = table->rows[r][c];
      if (std::abs(lever) > 1 + kLeverRounding) {
        config.Fault(
            "csv", {FaultKind::kOutOfRange,
                    fmt::format("column '{}' is {}, need -1 to 1 of full lever", columns[c], lever),
                    fmt::format("{}:{}", file.string(), r + kFirstRowLine)});
        return;
      }
      lever = std::clamp(lever, -1.0, 1.0);
    }
  }
}

}  // namespace

int RowInForce(const CommandTable& table, TimeNs t_ns) {
  const auto after = std::upper_bound(table.t_ns.begin(), table.t_ns.end(), t_ns);
  return static_cast<int>(after - table.t_ns.begin()) - 1;
}

std::vector<double> LeverReplay::Levers(const OperatorView& view) {
  std::vector<double> levers(view.model.levers.size(), 0.0);
  const int row = RowInForce(*plan_.table, view.t_ns);
  if (row < 0) return levers;
  for (std::size_t c = 0; c < plan_.lever_of_column.size(); ++c) {
    levers[plan_.lever_of_column[c]] = plan_.table->rows[row][c];
  }
  return levers;
}

std::vector<double> TwistReplay::Levers(const OperatorView& view) {
  std::vector<double> levers(view.model.levers.size(), 0.0);
  const int row = RowInForce(*plan_.table, view.t_ns);
  if (row < 0) return levers;
  const std::vector<double>& twist = plan_.table->rows[row];
  SetSkidSteer(view.model, plan_.levers, twist[0], twist[1], &levers);
  return levers;
}

LeverReplayPlan ReadLeverReplay(const ConfigMap& config, const MachineModel& model) {
  const std::filesystem::path file = config.File("csv");
  const std::string time_column = config.Text("time_column", "t_ns");
  std::vector<std::string> columns;
  std::vector<int> levers;
  std::vector<std::string> header = HeaderOf(config, file);
  // Without a time column, which is reported as a fault, the other columns are not read.
  if (std::find(header.begin(), header.end(), time_column) == header.end()) header.clear();
  for (const std::string& name : header) {
    if (name == time_column) continue;
    const int lever = model.LeverIndex(name);
    if (lever < 0) {
      config.Fault("csv", {FaultKind::kNoSuchName,
                           "column '" + name + "' is not a lever of machine '" + model.kind + "'"});
      continue;
    }
    columns.push_back(name);
    levers.push_back(lever);
  }
  CommandTable table = ReadCommands(config, file, time_column, columns);
  CheckLevers(config, file, columns, &table);
  return {std::make_shared<const CommandTable>(std::move(table)), levers};
}

TwistReplayPlan ReadTwistReplay(const ConfigMap& config, const MachineModel& model) {
  const std::filesystem::path file = config.File("csv");
  const std::string time = config.Text("time_column", "t_s");
  const std::string forward = config.Text("forward_column", "forward_mps");
  const std::string yaw_rate = config.Text("yaw_rate_column", "yaw_rate_radps");
  auto table =
      std::make_shared<const CommandTable>(ReadCommands(config, file, time, {forward, yaw_rate}));
  return {std::move(table), ReadSkidSteerLevers(config, model)};
}

}  // namespace tera
