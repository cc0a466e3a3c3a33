#include "layout/report/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tera {
namespace {

constexpr double kPercentOfOne = 100;

/// The parts of a name between slashes.
std::vector<std::string> Parts(const std::string& name) {
  std::vector<std::string> parts = {""};
  for (const char c : name) {
    if (c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::string ZoneText(const std::string& zone) {
  return zone == "around" ? "space around the machine" : "zone '" + Spaced(zone) + "'";
}

std::string DescribeZone(const std::vector<std::string>& parts) {
  const std::string& what = parts[2];
  if (what == "blind_m3") return ZoneText(parts[1]) + ": volume that no sensor sees";
  const char least = what.back();
  return fmt::format("{} seen by {} or more sensors", ZoneText(parts[1]), least);
}

std::string DescribePerson(const std::vector<std::string>& parts) {
  const std::string person = "a " + Spaced(parts[1]) + " person ";
  if (parts[2] == "detected_within_12m") {
    return person + "is detected: share of the places up to 12 m from the machine";
  }
  const std::string where = parts[2].substr(parts[2].rfind('_') + 1);
  if (parts[2].starts_with("probability_within_12m")) {
    return fmt::format("probability that lidars detect {}: mean over the places up to 12 m{}",
                       person.substr(0, person.size() - 1), where == "12m" ? "" : ", " + where);
  }
  const std::string quarter = " in every direction of the quarter " + where;
  if (parts[2].starts_with("detected_from")) {
    return person + "is detected" + quarter + ": nearest distance from the machine's outline";
  }
  if (parts[2].starts_with("detected_over")) {
    return person + "is detected" + quarter + ": metres of distance in all";
  }
  return person + "is detected" + quarter + ": farthest distance from the machine's outline";
}

std::string DescribePixels(const std::vector<std::string>& parts) {
  const std::string purpose = fmt::format("cameras that {} a person (IEC 62676-4): ", parts[1]);
  if (parts[2] == "share_to_12m") return purpose + "share of the area out to 12 m";
  return purpose +
         "farthest place from the upper structure, mean over the directions of the "
         "quarter " +
         parts[2].substr(parts[2].rfind('_') + 1);
}

std::string DescribeEye(const std::vector<std::string>& parts) {
  const std::string line = parts[1] == "circle" ? "test circle" : "rectangular boundary";
  if (parts[2] == "masked_share") return "from the eye: share of the " + line + " that is masked";
  if (parts[2] == "exceeds_limit") return "from the eye: the limit is exceeded on the " + line;
  return "from the eye: widest masking on the " + line;
}

std::string DescribeInformation(const std::string& what) {
  if (what == "smig") return "information gain S-MIG, whatever is in the way";
  if (what == "smig_occluded") return "information gain S-MIG of what is in sight";
  return "perception entropy of a person in the first posture";
}

std::string UnitText(std::string unit) {
  for (const auto& [from, to] : {std::pair{"^2", "²"}, std::pair{"^3", "³"}}) {
    if (const auto at = unit.find(from); at != unit.npos) unit.replace(at, 2, to);
  }
  return unit;
}

}  // namespace

std::string Describe(const Figure& figure) {
  const std::vector<std::string> parts = Parts(figure.name);
  if (parts.size() == 3 && parts[0] == "zone") return DescribeZone(parts);
  if (parts.size() == 3 && parts[0] == "person") return DescribePerson(parts);
  if (parts.size() == 3 && parts[0] == "map") {
    const std::string to = parts[2].substr(parts[2].rfind('_') + 1);
    return fmt::format("area {} above the ground that no sensor sees, out to {} m", parts[1],
                       to.substr(0, to.size() - 1));
  }
  if (parts.size() == 3 && parts[0] == "dig") {
    return parts[2] == "edge_seen" ? Spaced(parts[1]) + ": share of its cutting edge that is seen"
                                   : Spaced(parts[1]) + ": share of its mouth that is seen";
  }
  if (parts.size() == 3 && parts[0] == "pixels") return DescribePixels(parts);
  if (parts.size() == 3 && parts[0] == "eye") return DescribeEye(parts);
  if (parts.size() == 2 && parts[0] == "information") return DescribeInformation(parts[1]);
  if (parts.size() == 3 && parts[0] == "sky") {
    return fmt::format("share of the sky that {} hides from {}",
                       parts[2] == "hidden" ? "the machine" : "the site", parts[1]);
  }
  if (parts.size() == 3 && parts[0] == "state") {
    return fmt::format("how well the {} is known, 1 sigma, by {}", Spaced(parts[1]),
                       parts[1] == "heading_of_pair" ? "one sample of two antennas"
                                                     : "units, encoders and antennas");
  }
  if (figure.name == "elevation/gaps") return "elevation map ahead: share of cells without a point";
  if (figure.name == "elevation/sigma_m") return "elevation map ahead: error of a cell's height";
  return Spaced(figure.name);
}

std::string ValueText(const Figure& figure, double value) {
  if (figure.unit.empty()) return fmt::format("{:.1f} %", kPercentOfOne * value);
  constexpr double kSmall = 0.1;  // below, digits that count and not decimals
  const double size = std::abs(value);
  const std::string number = size < kSmall ? fmt::format("{:.2g}", value + 0.0)
                                           : fmt::format("{:.{}f}", value, size < 10 ? 2 : 1);
  return number + " " + UnitText(figure.unit);
}

std::string MeanAndWorstText(const LayoutReport& report, const Figure& figure) {
  return fmt::format("{} on average and {} at the worst moment, at {:.4g} s",
                     ValueText(figure, MeanOf(figure)), ValueText(figure, WorstOf(figure)),
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
      "{}, {}, {:.3g} MB/s of data as measured",
      part("cost", fmt::format("{:.6g}", expense.cost), expense.priced, "priced"),
      part("power", fmt::format("{:.4g} W", expense.power_w), expense.powered, "with a power"),
      expense.data_mbyteps);
}

std::string Escape(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace tera
