#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "physics/actuation/actuation_mechanisms.h"
#include "physics/traction/ground_mechanisms.h"
#include "sensors/sensor_kinds.h"
#include "sensors/sensor_mechanisms.h"

// docs/reference/mechanisms.md lists exactly what the program accepts for every mechanism of the
// three libraries: chapter, name, parameters, units, ranges, defaults.

namespace tera {
namespace {

using ::testing::IsEmpty;

/// One row: "sensor_static/bias (imu) gyro_x_degps | deg/s | -100 to 100 | 0".
using Rows = std::set<std::string>;

std::string Row(std::string_view slot, std::string_view id, std::string_view targets,
                std::string_view parameter, std::string_view rest) {
  return fmt::format("{}/{} ({}) {} | {}", slot, id, targets, parameter, rest);
}

/// Names as in the sensors' tables; mechanisms of machines are in chapters by target.
std::string TargetsOf(const Mechanism& mechanism) {
  std::vector<std::string_view> names;
  for (const EffectTarget target : mechanism.targets) {
    for (const SensorKind* kind : kSensorKinds) {
      if (target == kind->target) names.push_back(kind->name);
    }
    if (target == EffectTarget::kEncoderAxis) names.push_back("axis");
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

Rows Registered() {
  Rows rows;
  for (const auto library : {ActuationMechanisms(), GroundMechanisms(), SensorMechanisms()}) {
    for (const Mechanism& m : library) {
      const std::string targets = TargetsOf(m);
      if (m.parameters.empty()) rows.insert(Row(NameOf(m.slot), m.id, targets, "none", " |  | "));
      for (const EffectParameter& p : m.parameters) {
        const std::string otherwise = p.otherwise ? fmt::format("{:g}", *p.otherwise) : "";
        rows.insert(
            Row(NameOf(m.slot), m.id, targets, p.name,
                fmt::format("{} | {:g} to {:g} | {}", p.unit, p.lower, p.upper, otherwise)));
      }
    }
  }
  return rows;
}

/// The cells of a table's row, without blanks at their ends.
std::vector<std::string> CellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] != '|' || line[i - 1] == '\\') {
      cell += line[i];
      continue;
    }
    const std::size_t first = cell.find_first_not_of(' ');
    cells.push_back(
        first == cell.npos ? "" : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    cell.clear();
  }
  return cells;
}

/// All that stands in backquotes.
std::vector<std::string> Quoted(const std::string& text) {
  std::vector<std::string> words;
  std::size_t first = text.find('`');
  while (first != text.npos) {
    const std::size_t second = text.find('`', first + 1);
    words.push_back(text.substr(first + 1, second - first - 1));
    first = second == text.npos ? second : text.find('`', second + 1);
  }
  return words;
}

struct Document {
  Rows rows;
  std::set<std::string> described;  ///< "sensor_static/bias", with its own text or row
};

/// Machines: chapters `## slot`, mechanisms "### `id`", rows of name, unit, range, default,
/// meaning. Sensors: chapters `### sensor_...`; rows of mechanism, targets, effect; and rows of
/// mechanism, targets, names, unit, range, default.
Document Documented() {
  Document document;
  std::string slot, id;
  std::ifstream file("docs/reference/mechanisms.md");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) slot = line.substr(3);
    if (line.starts_with("### sensor_")) slot = line.substr(4);
    if (line.starts_with("#")) id.clear();
    const bool of_sensors = slot.starts_with("sensor_");
    if (line.starts_with("### `")) {
      id = Quoted(line).at(0);
      document.described.insert(slot + "/" + id);
    }
    if (!line.starts_with("| `")) continue;
    const std::vector<std::string> cells = CellsOf(line);
    if (!id.empty() && cells.size() == 5) {
      document.rows.insert(Row(slot, id, "", Quoted(cells[0]).at(0),
                               fmt::format("{} | {} | {}", cells[1], cells[2], cells[3])));
    } else if (of_sensors && cells.size() == 5) {
      document.described.insert(slot + "/" + Quoted(cells[0]).at(0));
    } else if (of_sensors && cells.size() == 6) {
      std::vector<std::string> names = Quoted(cells[2]);
      if (names.empty()) names = {cells[2]};
      for (const std::string& name : names) {
        document.rows.insert(Row(slot, Quoted(cells[0]).at(0), cells[1], name,
                                 fmt::format("{} | {} | {}", cells[3], cells[4], cells[5])));
      }
    }
  }
  return document;
}

std::vector<std::string> Missing(const std::set<std::string>& wanted,
                                 const std::set<std::string>& found) {
  std::vector<std::string> missing;
  for (const std::string& row : wanted) {
    if (!found.contains(row)) missing.push_back(row);
  }
  return missing;
}

TEST(MechanismDocument, HasEveryParameterThatTheProgramTakes) {
  const Rows registered = Registered();
  EXPECT_GT(registered.size(), 150u);
  EXPECT_THAT(Missing(registered, Documented().rows), IsEmpty());
}

TEST(MechanismDocument, HasNoParameterThatTheProgramDoesNotTake) {
  EXPECT_THAT(Missing(Documented().rows, Registered()), IsEmpty());
}

TEST(MechanismDocument, DescribesEveryMechanismInTheChapterOfItsSlotAndNoOther) {
  std::set<std::string> registered;
  for (const auto library : {ActuationMechanisms(), GroundMechanisms(), SensorMechanisms()}) {
    for (const Mechanism& m : library) {
      registered.insert(fmt::format("{}/{}", NameOf(m.slot), m.id));
    }
  }
  const std::set<std::string> described = Documented().described;
  EXPECT_THAT(Missing(registered, described), IsEmpty());
  EXPECT_THAT(Missing(described, registered), IsEmpty());
}

}  // namespace
}  // namespace tera
