#include "layout/report/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/check.h"
#include "layout/measures/quarter.h"
#include "layout/study/zone.h"

namespace tera {
namespace {

constexpr double kPercentOfOne = 100;

/// Descriptions of figures in the order of Measure. {0} is the subject, {1} the quarter, {2} the
/// sensors.
constexpr std::array<const char*, 28> kWords = {
    "{0} seen by 1 or more sensors",
    "{0} seen by 2 or more sensors",
    "{0} seen by 3 or more sensors",
    "{0}: volume that no sensor sees",
    "area {0} m above the ground that no sensor sees, out to 12 m",
    "area {0} m above the ground that no sensor sees, out to 24 m",
    "a {0} person is detected in every direction of the quarter {1}: nearest distance from the "
    "machine's outline",
    "a {0} person is detected in every direction of the quarter {1}: farthest distance from the "
    "machine's outline",
    "a {0} person is detected in every direction of the quarter {1}: total length of these "
    "distances",
    "a {0} person is detected: share of the places up to 12 m from the machine",
    "probability that lidars detect a {0} person: mean over the places up to 12 m",
    "probability that lidars detect a {0} person: mean over the places up to 12 m, {1}",
    "{0}: share of its cutting edge that is seen",
    "{0}: share of its mouth that is seen",
    "elevation map ahead: share of cells without a point",
    "elevation map ahead: error of a cell's height",
    "cameras {0} a person (IEC 62676-4): share of the area out to 12 m",
    "cameras {0} a person (IEC 62676-4): farthest place from the upper structure, mean over the "
    "directions of the quarter {1}",
    "share of the sky that the machine hides from {0}",
    "share of the sky that the site hides from {0}",
    "information gain S-MIG without occlusion",
    "information gain S-MIG with occlusion",
    "perception entropy of a person in the first posture",
    "from the eye: widest masking on the {0}",
    "from the eye: share of the {0} that is masked",
    "from the eye: the limit is exceeded on the {0}",
    "standard deviation of the {0}, 1 sigma, from {2}",
    "standard deviation of the {0}, 1 sigma, from {2}"};

/// A figure's subject in words.
std::string SubjectText(const FigureId& id) {
  switch (SubjectOf(id.measure)) {
    case Subject::kZone:
      return id.of == kAroundZone ? "space around the machine" : "zone '" + Spaced(id.of) + "'";
    case Subject::kEye:
      return id.of == "circle" ? "test circle" : "rectangular boundary";
    case Subject::kAntenna:
      return id.of;
    default:
      return Spaced(id.of);
  }
}

std::string UnitText(std::string_view of) {
  std::string unit(of);
  for (const auto& [from, to] : {std::pair{"^2", "²"}, std::pair{"^3", "³"}}) {
    if (const auto at = unit.find(from); at != unit.npos) unit.replace(at, 2, to);
  }
  return unit;
}

}  // namespace

std::string Describe(const FigureId& id) {
  const std::size_t measure = static_cast<std::size_t>(id.measure);
  TERA_CHECK(measure < kWords.size(), measure);
  return fmt::format(fmt::runtime(kWords[measure]), SubjectText(id),
                     id.quarter ? kQuarters[*id.quarter].name : "",
                     id.of == "heading_of_pair" ? "one sample of two antennas"
                                                : "inertial units, encoders and antennas");
}

std::string ValueText(const FigureId& id, double value) {
  const std::string_view unit = UnitOf(id.measure);
  if (unit.empty()) return fmt::format("{:.1f} %", kPercentOfOne * value);
  constexpr double kSmall = 0.1;  // below this, significant digits instead of decimals
  const double size = std::abs(value);
  const std::string number = size < kSmall ? fmt::format("{:.2g}", value + 0.0)
                                           : fmt::format("{:.{}f}", value, size < 10 ? 2 : 1);
  return number + " " + UnitText(unit);
}

std::string MeanAndWorstText(const LayoutReport& report, const Figure& figure) {
  return fmt::format("{} on average, {} at the worst moment ({:.4g} s)",
                     ValueText(figure.id, MeanOf(figure)), ValueText(figure.id, WorstOf(figure)),
                     report.t_s[WorstMomentOf(figure)]);
}

std::string Spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string ExpenseText(const Expense& expense) {
  const auto part = [&](const char* what, const std::string& sum, int said, const char* how) {
    if (said == 0) return fmt::format("{} unknown (no sensor {})", what, how);
    return fmt::format("{} {} ({} of {} sensors {})", what, sum, said, expense.sensors, how);
  };
  return fmt::format(
      "{}, {}, {:.3g} MB/s of raw data",
      part("cost", fmt::format("{:.6g}", expense.cost), expense.priced, "priced"),
      part("power", fmt::format("{:.4g} W", expense.power_w), expense.powered, "with a power"),
      expense.data_mbyteps);
}

}  // namespace tera
