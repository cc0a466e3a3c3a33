#include "dataset/import/suggest/guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/units.h"
#include "dataset/format/dataset_description.h"
#include "dataset/import/import_options.h"

namespace tera {
namespace {

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double MedianSize(const NumbersOfColumn& column) {
  std::vector<double> sizes;
  for (const double value : column.values) sizes.push_back(std::abs(value));
  return Median(std::move(sizes));
}

double LargestOf(const std::vector<const NumbersOfColumn*>& columns) {
  double largest = 0;
  for (const NumbersOfColumn* column : columns) largest = std::max(largest, column->LargestSize());
  return largest;
}

struct Ending {
  std::string_view text;
  const char* unit;
};

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

/// The unit that a name ends in, "gx_dps", "lat [deg]"; none where it says nothing.
template <std::size_t n>
const char* UnitOfName(const std::string& name, const std::array<Ending, n>& endings) {
  std::string lower = Lower(name);
  while (!lower.empty() && (lower.back() == ']' || lower.back() == ')')) lower.pop_back();
  for (const Ending& ending : endings) {
    if (!lower.ends_with(ending.text) || lower.size() == ending.text.size()) continue;
    if (std::isalnum(static_cast<unsigned char>(lower[lower.size() - ending.text.size() - 1])) ==
        0) {
      return ending.unit;
    }
  }
  return nullptr;
}

constexpr std::array<Ending, 9> kTimeEndings = {{{"ns", "ns"},
                                                 {"nsec", "ns"},
                                                 {"us", "us"},
                                                 {"usec", "us"},
                                                 {"ms", "ms"},
                                                 {"msec", "ms"},
                                                 {"s", "s"},
                                                 {"sec", "s"},
                                                 {"seconds", "s"}}};
constexpr std::array<Ending, 8> kRateEndings = {{{"dps", "deg/s"},
                                                 {"deg/s", "deg/s"},
                                                 {"degps", "deg/s"},
                                                 {"deg_s", "deg/s"},
                                                 {"rad/s", "rad/s"},
                                                 {"radps", "rad/s"},
                                                 {"rad_s", "rad/s"},
                                                 {"rpm", "rpm"}}};
constexpr std::array<Ending, 5> kAccelerationEndings = {
    {{"g", "g"}, {"m/s2", "m/s2"}, {"m/s^2", "m/s2"}, {"mps2", "m/s2"}, {"m_s2", "m/s2"}}};
constexpr std::array<Ending, 3> kAngleEndings = {
    {{"deg", "deg"}, {"degrees", "deg"}, {"rad", "rad"}}};

/// The unit of an epoch's times by their size; none of others.
const char* EpochUnit(double size) {
  const double ms = 1e3, us = 1e6, ns = 1e9, latest_s = 1e10;
  if (size < kLeastEpoch_s) return nullptr;
  if (size < latest_s) return "s";
  if (size > kLeastEpoch_s * ms && size < latest_s * ms) return "ms";
  if (size > kLeastEpoch_s * us && size < latest_s * us) return "us";
  if (size > kLeastEpoch_s * ns && size < latest_s * ns) return "ns";
  return nullptr;
}

}  // namespace

double NumbersOfColumn::LargestSize() const {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

double NumbersOfColumn::MedianStep() const {
  std::vector<double> steps;
  for (std::size_t k = 1; k < values.size(); ++k) steps.push_back(values[k] - values[k - 1]);
  return Median(std::move(steps));
}

UnitGuess GuessTimeUnit(const NumbersOfColumn& time) {
  if (const char* unit = EpochUnit(MedianSize(time))) return {unit, 1.0, ""};
  if (const char* unit = UnitOfName(time.name, kTimeEndings)) return {unit, 1.0, ""};
  const double step = time.MedianStep();
  const double slowest = 2.0, thousand = 1e3;
  const char* unit = step < slowest                         ? "s"
                     : step < slowest * thousand            ? "ms"
                     : step < slowest * thousand * thousand ? "us"
                                                            : "ns";
  return {unit, 1.0, fmt::format("the median step is {:.4g}", step)};
}

double SecondsOf(const UnitGuess& unit) {
  return unit.unit == "ns" ? 1e-9 : unit.unit == "us" ? 1e-6 : unit.unit == "ms" ? 1e-3 : 1.0;
}

UnitGuess GuessRateUnit(const std::vector<const NumbersOfColumn*>& rates) {
  if (const char* unit = UnitOfName(rates.front()->name, kRateEndings)) return {unit, 1.0, ""};
  const double largest = LargestOf(rates);
  const bool is_deg = largest > kFastestJoint_radps;
  return {is_deg ? "deg/s" : "rad/s", 1.0, fmt::format("the largest is {:.4g}", largest)};
}

UnitGuess GuessAccelerationUnit(const std::vector<const NumbersOfColumn*>& axes) {
  if (const char* unit = UnitOfName(axes.front()->name, kAccelerationEndings)) {
    return {unit, 1.0, ""};
  }
  double squares = 0;
  for (const NumbersOfColumn* axis : axes) squares += std::pow(Median(axis->values), 2);
  const double length = std::sqrt(squares), least = 0.7, most = 1.3;
  const auto is_about = [&](double gravity) {
    return length > least * gravity && length < most * gravity;
  };
  if (is_about(kStandardGravity_mps2)) return {"m/s2", 1.0, ""};
  if (is_about(1.0)) return {"g", 1.0, ""};
  if (is_about(1e3)) return {"g", 1e-3, ""};
  return {"m/s2", 1.0,
          fmt::format("the median vector is {:.4g} long, as gravity is in no unit", length)};
}

UnitGuess GuessAngleUnit(const std::vector<const NumbersOfColumn*>& angles) {
  if (const char* unit = UnitOfName(angles.front()->name, kAngleEndings)) return {unit, 1.0, ""};
  const double largest = LargestOf(angles);
  // A joint of a slewing machine may turn on, but not by this much.
  if (largest > 8 * kPi) return {"deg", 1.0, ""};
  return {largest > 2 * kPi ? "deg" : "rad", 1.0, fmt::format("the largest is {:.4g}", largest)};
}

std::string YamlWord(std::string_view text) {
  const bool is_plain =
      !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
      std::all_of(text.begin(), text.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
      });
  constexpr std::array<std::string_view, 8> kWords = {"y",    "n",     "yes", "no",
                                                      "true", "false", "on",  "null"};
  const bool is_word = std::find(kWords.begin(), kWords.end(), Lower(text)) != kWords.end();
  return is_plain && !is_word && Lower(text) != "off" ? std::string(text)
                                                      : YamlQuoted(std::string(text));
}

std::string PlainNameOf(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool fits = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (fits) name += c;
    if (!fits && !name.empty() && name.back() != '_') name += '_';
  }
  while (name.ends_with('_')) name.pop_back();
  return name.empty() ? "unnamed" : name;
}

std::string ColumnYaml(std::string_view column, const UnitGuess& unit) {
  const std::string shown_unit =
      unit.unit == "1" || unit.unit == "%" ? "'" + unit.unit + "'" : unit.unit;
  const std::string scale = unit.scale == 1.0 ? "" : fmt::format(", scale: {}", unit.scale);
  return fmt::format("{{column: {}, unit: {}{}}}", YamlWord(column), shown_unit, scale);
}

std::string DoubtRemark(const UnitGuess& unit) {
  return unit.doubt.empty() ? "" : "   # guessed: " + unit.doubt;
}

}  // namespace tera
