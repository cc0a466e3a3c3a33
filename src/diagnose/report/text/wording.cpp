#include "diagnose/report/text/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tera {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// The decimal exponent of a value that is not 0: 2 for 523, -1 for 0.18.
int ExponentOf(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)))); }

/// A value rounded to a power of ten and written without an exponent; halves go away from 0, as a
/// reader would round what was written with more digits, also where a double lies just below one.
std::string Fixed(double value, int lowest_power) {
  constexpr double kBelowHalf = 1e-12;  // relative: thousands of times a double's resolution
  value *= 1 + kBelowHalf;
  if (lowest_power <= 0) return fmt::format("{:.{}f}", value, -lowest_power);
  const double unit = std::pow(10.0, lowest_power);
  return fmt::format("{:.0f}", std::round(value / unit) * unit);
}

void DropZerosAtTheEnd(std::string* number) {
  if (number->find('.') == std::string::npos) return;
  number->erase(number->find_last_not_of('0') + 1);
  if (number->ends_with('.')) number->pop_back();
}

/// Quantities by the endings of names of columns and parameters, the longer endings first.
constexpr std::pair<std::string_view, std::string_view> kQuantityOfEnding[] = {
    {"_radps2", "angular acceleration"},
    {"_mps2", "acceleration"},
    {"_degps", "rate"},
    {"_radps", "rate"},
    {"_mps", "speed"},
    {"_rad", "angle"},
    {"_deg", "angle"},
    {"_nm", "torque"},
    {"_n", "force"},
    {"_m", "position"}};

/// Endings of names that are units.
constexpr std::string_view kUnitEndings[] = {
    "_nmsprad", "_radpnm", "_radps2", "_radps", "_degps", "_degpk", "_mps2", "_degc",
    "_1ps",     "_mps",    "_mpk",    "_rad",   "_deg",   "_ppm",   "_nm",   "_kg",
    "_hz",      "_pa",     "_s",      "_m",     "_n",     "_w"};

/// The quantity of a column of an inertial unit or a receiver, "rate about x" of "wx_radps",
/// "specific force along z" of "az_mps2", "east position" of "east_m"; empty for other columns.
std::string TriadQuantityOf(std::string_view column) {
  if (column == "east_m" || column == "north_m" || column == "up_m") {
    return std::string(column.substr(0, column.size() - 2)) + " position";
  }
  if (column.size() < 2 || column[1] < 'x' || column[1] > 'z') return "";
  const std::string axis(1, column[1]);
  if (column.substr(2) == "_radps" && column[0] == 'w') return "rate about " + axis;
  if (column.substr(2) == "_mps2" && column[0] == 'a') return "specific force along " + axis;
  return "";
}

}  // namespace

ReadableUnit ReadableUnitOf(std::string_view unit) {
  if (unit == "1") return {1, ""};
  if (unit == "rad") return {kDegrees, "deg"};
  if (unit == "rad/s") return {kDegrees, "deg/s"};
  if (unit == "rad/s2" || unit == "rad/s^2") return {kDegrees, "deg/s²"};
  if (unit == "m/s2" || unit == "m/s^2") return {1, "m/s²"};
  return {1, std::string(unit)};
}

ReadableUnit ReadableUnitOf(const ParameterEstimate& parameter) {
  const bool is_frequency = parameter.name == "eta_radps" || parameter.name == "natural_radps";
  return is_frequency ? ReadableUnit{1, parameter.unit} : ReadableUnitOf(parameter.unit);
}

std::string WithUnit(const std::string& number, const ReadableUnit& unit) {
  return unit.name.empty() ? number : number + " " + unit.name;
}

std::string Significant(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return fmt::format("{}", value == 0 ? 0.0 : value);
  const int exponent = ExponentOf(value);
  if (exponent < -4 || exponent > 6) return fmt::format("{:.{}g}", value, digits);
  std::string text = Fixed(value, exponent - digits + 1);
  DropZerosAtTheEnd(&text);
  return text;
}

std::string Readable(double value, const ReadableUnit& unit) {
  return WithUnit(Significant(value * unit.factor, 2), unit);
}

std::string Readable(double value, std::string_view si_unit) {
  return Readable(value, ReadableUnitOf(si_unit));
}

std::string Change(double before, double after, const ReadableUnit& unit) {
  return Significant(before * unit.factor, 2) + " → " + Readable(after, unit);
}

std::string Change(double before, double after, std::string_view si_unit) {
  return Change(before, after, ReadableUnitOf(si_unit));
}

std::string WithSigma(double value, const std::optional<double>& sigma) {
  if (!sigma || !(*sigma > 0) || !std::isfinite(*sigma)) return Significant(value, 3);
  int power = ExponentOf(*sigma);
  if (std::round(*sigma / std::pow(10.0, power)) < 2) --power;
  if (power < -6) return fmt::format("{:.6g} ± {:.1g}", value, *sigma);
  return Fixed(value, power) + " ± " + Fixed(*sigma, power);
}

std::string ProbabilityText(double p) { return p < 1e-4 ? "p < 0.0001" : "p " + Significant(p, 2); }

std::string PercentText(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::string TimeText(double time_s, double span_s) {
  return fmt::format("{:.{}f}", time_s, span_s >= 10 ? 0 : span_s >= 1 ? 1 : 2);
}

std::string IntervalsText(double from_s, double to_s, std::size_t more) {
  const double span_s = to_s - from_s;
  const std::string text = fmt::format("{}–{} s", TimeText(from_s, span_s), TimeText(to_s, span_s));
  if (more == 0) return text;
  return fmt::format("{} and {} more interval{}", text, more, more == 1 ? "" : "s");
}

std::string Spaced(std::string_view identifier) {
  std::string text(identifier);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string WithoutUnit(std::string_view key) {
  for (const std::string_view ending : kUnitEndings) {
    if (key.ends_with(ending) && key.size() > ending.size()) {
      return Spaced(key.substr(0, key.size() - ending.size()));
    }
  }
  return Spaced(key);
}

std::string QuantityOf(const std::string& channel) {
  const std::string_view column = std::string_view(channel).substr(channel.rfind('/') + 1);
  if (column == "left_mps") return "sideways speed";
  if (channel.ends_with("/poses/" + std::string(column)) && column.size() <= 2) {
    const std::string axis(1, column.back());
    return column.size() == 2 ? "turn of the poses about " + axis
                              : "place of the poses along " + axis;
  }
  if (const std::string triad = TriadQuantityOf(column); !triad.empty()) {
    const std::string folder = channel.substr(0, channel.size() - column.size() - 1);
    return Spaced(folder.substr(folder.rfind('/') + 1)) + " " + triad;
  }
  for (const auto& [ending, quantity] : kQuantityOfEnding) {
    if (column.ends_with(ending) && column.size() > ending.size()) {
      return Spaced(column.substr(0, column.size() - ending.size())) + " " + std::string(quantity);
    }
  }
  return Spaced(column);
}

std::string VariableText(const std::string& variable, const ReplayBlock& block) {
  const std::size_t slash = variable.find('/');
  if (slash == std::string::npos) return Spaced(variable);
  std::string kind = Spaced(variable.substr(0, slash));
  if (kind == "position" && UnitOfVariable(variable, block.channels.front().unit) == "rad") {
    kind = "angle";
  }
  const std::string owner = variable.substr(slash + 1);
  return owner == block.name ? kind : Spaced(owner) + " " + kind;
}

std::string UnitOfVariable(const std::string& variable, const std::string& channel_unit) {
  const bool slides = channel_unit == "m/s" || channel_unit == "m" || channel_unit == "N";
  const std::string kind = variable.substr(0, variable.find('/'));
  if (kind == "position") return slides ? "m" : "rad";
  if (kind == "load") return slides ? "N" : "N m";
  if (kind == "time") return "s";
  if (kind == "speed" || kind == "turning") return "m/s";
  if (kind == "rate") return slides ? "m/s" : "rad/s";
  if (kind == "acceleration") return slides ? "m/s^2" : "rad/s^2";
  if (kind == "force") return "m/s^2";
  if (kind == "pitch" || kind == "roll" || kind == "yaw" || kind == "slope") return "rad";
  if (kind == "yaw_rate") return "rad/s";
  return "1";
}

std::string Capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text;
}

std::string Listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}

}  // namespace tera
