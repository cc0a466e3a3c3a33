#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "core/error.h"
#include "dataset/format/epoch.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/logs/log_time.h"
#include "dataset/import/logs/number_table.h"

namespace tera {
namespace {

/// Fields in order, after the two fields of the time.
constexpr std::array<const char*, 13> kSolutionFields = {
    "latitude", "longitude", "height", "Q",    "ns",  "sdn",  "sde",
    "sdu",      "sdne",      "sdeu",   "sdun", "age", "ratio"};
constexpr std::size_t kTimeFields = 2, kNeeded = kTimeFields + 8;  // required fields, up to sdu

enum class TimeSystem { kUtc, kGps, kJapan };

/// GGA quality for RTKLIB's quality: fixed, float, SBAS, differential, single, precise point.
double QualityOf(double q) {
  constexpr std::array<double, 7> kQuality = {0, 4, 5, 2, 2, 1, 5};
  // A truncated line may have a number of another column here.
  if (!(q >= 0 && q < static_cast<double>(kQuality.size())) || q != std::floor(q)) return -1;
  return kQuality[static_cast<std::size_t>(q)];
}

/// Parses "2026/05/01 12:00:00.000", or a GPS week and the seconds in it.
std::optional<TimeNs> TimeOf(std::string_view first, std::string_view second, TimeSystem system) {
  constexpr int kMostWeeks = 10'000;
  constexpr TimeNs kJapanAhead_ns = 9 * 3600 * kNsPerSecond;
  const auto week = WholeNumber(first);
  if (week) {
    const auto seconds_ns = SecondsOfText(second);
    if (!seconds_ns || *week < 0 || *week > kMostWeeks) return std::nullopt;
    const TimeNs gps_ns = GpsWeek(static_cast<int>(*week)) + *seconds_ns;
    return gps_ns - GpsAheadOfUtc(gps_ns);
  }
  const auto day_ns = DateOfText(first), time_ns = TimeOfDayText(second);
  if (!day_ns || !time_ns) return std::nullopt;
  const TimeNs t_ns = *day_ns + *time_ns;
  if (system == TimeSystem::kGps) return t_ns - GpsAheadOfUtc(t_ns);
  return system == TimeSystem::kJapan ? t_ns - kJapanAhead_ns : t_ns;
}

/// Reads the time system from the line with the column names. Throws InputError for other kinds of
/// coordinates.
TimeSystem ReadHeader(const std::string& line, const std::filesystem::path& file, int number) {
  for (const char* other : {"x-ecef", "e-baseline"}) {
    if (line.find(other) == std::string::npos) continue;
    throw InputError(fmt::format(
        "{}:{}: its solution is in {}; need latitude, longitude and height: out-solformat = llh of "
        "RTKLIB's options",
        file.string(), number, other));
  }
  if (line.find("latitude(d'") != std::string::npos) {
    throw InputError(
        fmt::format("{}:{}: its angles are in degrees, minutes and seconds; need "
                    "degrees: out-degform = deg of RTKLIB's options",
                    file.string(), number));
  }
  if (line.find("GPST") != std::string::npos) return TimeSystem::kGps;
  return line.find("JST") != std::string::npos ? TimeSystem::kJapan : TimeSystem::kUtc;
}

/// True if a comment line names the columns. Other comments describe the program and its input.
bool NamesColumns(const std::string& line) {
  if (line.find(" : ") != std::string::npos || line.find("(lat/lon") != std::string::npos ||
      line.find("(x/y/z") != std::string::npos) {
    return false;
  }
  return line.find("height") != std::string::npos || line.find("-ecef") != std::string::npos ||
         line.find("-baseline") != std::string::npos;
}

void AddSolution(const std::vector<std::string_view>& fields, TimeSystem system,
                 const LogLines& lines, LeftOutRows* left_out, NumberTable* table) {
  if (fields.size() < kNeeded) {
    lines.Fault(fmt::format("found {} fields, need {}", fields.size(), kNeeded), left_out);
    return;
  }
  const auto t_ns = TimeOf(fields[0], fields[1], system);
  if (!t_ns) {
    lines.Fault(fmt::format("'{} {}' is no time", fields[0], fields[1]), left_out);
    return;
  }
  std::vector<NumberTable::Cell> cells;
  for (std::size_t f = 0; f < kSolutionFields.size() && kTimeFields + f < fields.size(); ++f) {
    const std::string_view text = fields[kTimeFields + f];
    const auto value = WholeNumber(text);
    if (!value) {
      lines.Fault(fmt::format("{} is '{}', need a number", kSolutionFields[f], text), left_out);
      return;
    }
    cells.push_back({kSolutionFields[f], *value});
  }
  constexpr std::size_t kQ = 3, kSdn = 5, kSde = 6, kSdu = 7;
  const auto squared = [&](std::size_t k) { return cells[k].value * cells[k].value; };
  cells.insert(cells.end(), {{"fix", QualityOf(cells[kQ].value)},
                             {"var_n", squared(kSdn)},
                             {"var_e", squared(kSde)},
                             {"var_u", squared(kSdu)}});
  table->AddRow(lines.number(), *t_ns, cells);
}

}  // namespace

std::unique_ptr<const RowTable> ReadPosLog(const std::filesystem::path& file,
                                           LeftOutRows* left_out) {
  std::vector<std::string> columns(kSolutionFields.begin(), kSolutionFields.end());
  columns.insert(columns.end(), {"fix", "var_n", "var_e", "var_u"});
  auto table = std::make_unique<NumberTable>(file, columns);
  std::optional<TimeSystem> system;
  LogLines lines(file);
  for (std::string line; lines.Next(&line);) {
    if (line.starts_with('%')) {
      if (NamesColumns(line)) system = ReadHeader(line, file, lines.number());
      continue;
    }
    const char separator = line.find(',') != std::string::npos ? ',' : ' ';
    const std::vector<std::string_view> fields = FieldsOf(line, separator);
    if (fields.empty()) continue;
    if (!system) {
      throw InputError(
          fmt::format("{}:{}: no line of column names precedes it; need the header that RTKLIB "
                      "writes, which names the time scale",
                      file.string(), lines.number()));
    }
    AddSolution(fields, *system, lines, left_out, table.get());
  }
  return table;
}

}  // namespace tera
