#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/config/config_layers.h"
#include "core/parse_number.h"

/// Ranges and scalar values: number, text or choice.

namespace tera {
namespace internal {
namespace {

bool Contains(const Range& range, double value) {
  return std::isfinite(value) && value <= range.max &&
         (range.min_excluded ? value > range.min : value >= range.min);
}

}  // namespace

std::string Need(const Range& range) {
  const std::string unit = range.unit.empty() || range.unit == "1" ? "" : " " + range.unit;
  const bool has_min = std::isfinite(range.min), has_max = std::isfinite(range.max);
  if (has_min && has_max && range.min_excluded) {
    return fmt::format("more than {0}{2}, at most {1}{2}", range.min, range.max, unit);
  }
  if (has_min && has_max) return fmt::format("{} to {}{}", range.min, range.max, unit);
  if (has_min) {
    return fmt::format("{} {}{}", range.min_excluded ? "more than" : "at least", range.min, unit);
  }
  if (has_max) return fmt::format("at most {}{}", range.max, unit);
  return fmt::format("a number{}", unit.empty() ? "" : " in" + unit);
}

std::optional<double> ParseNumber(const std::string& text) {
  return tera::ParseNumber<double>(std::string_view(text).substr(text.starts_with('+') ? 1 : 0));
}

std::optional<double> NumberAt(ConfigNode& node, std::string_view key, const Found& found,
                               const Range& range) {
  const auto value = found.node.IsScalar() ? ParseNumber(found.node.Scalar()) : std::nullopt;
  if (!value) {
    AddFault(node, key, found, fault::NotANumber(Shown(found.node), Need(range)));
    return std::nullopt;
  }
  if (!Contains(range, *value)) {
    AddFault(node, key, found, fault::OutOfRange(found.node.Scalar(), Need(range)));
    return std::nullopt;
  }
  return value;
}

double Harmless(const Range& range) {
  if (Contains(range, 1.0)) return 1.0;
  if (std::isfinite(range.min) && std::isfinite(range.max)) return 0.5 * (range.min + range.max);
  return std::isfinite(range.min) ? range.min + 1.0 : range.max - 1.0;
}

std::string NumberText(double value) { return fmt::format("{}", value); }

}  // namespace internal

using internal::AddFault;
using internal::AddMissing;
using internal::Find;
using internal::Harmless;
using internal::Need;
using internal::NumberAt;
using internal::NumberText;
using internal::Record;
using internal::Shown;

Range Any(std::string unit) { return {.unit = std::move(unit)}; }
Range Positive(std::string unit) {
  return {.min = 0, .min_excluded = true, .unit = std::move(unit)};
}
Range AtLeast(double min, std::string unit) { return {.min = min, .unit = std::move(unit)}; }
Range Between(double min, double max, std::string unit) {
  return {.min = min, .max = max, .unit = std::move(unit)};
}

double ConfigMap::Number(std::string_view key, const Range& range) const {
  const auto value = OptionalNumber(key, range);
  if (value) return *value;
  if (!Has(key)) AddMissing(*node_, key, Need(range));
  return Harmless(range);
}

double ConfigMap::Number(std::string_view key, const Range& range, double otherwise) const {
  if (const auto value = OptionalNumber(key, range)) return *value;
  Record(*node_, key, NumberText(otherwise));
  return otherwise;
}

std::optional<double> ConfigMap::OptionalNumber(std::string_view key, const Range& range) const {
  const auto found = Find(*node_, key);
  if (!found) return std::nullopt;
  const auto value = NumberAt(*node_, key, *found, range);
  if (!value) return Harmless(range);
  Record(*node_, key, NumberText(*value));
  return value;
}

std::int64_t ConfigMap::Integer(std::string_view key, const Range& range) const {
  const double value = Number(key, range);
  if (value != std::floor(value)) Fault(key, fault::NotAWholeNumber(value));
  return std::llround(value);
}

std::int64_t ConfigMap::Integer(std::string_view key, const Range& range,
                                std::int64_t otherwise) const {
  if (Has(key)) return Integer(key, range);
  Record(*node_, key, fmt::format("{}", otherwise));
  return otherwise;
}

bool ConfigMap::Boolean(std::string_view key, bool otherwise) const {
  const auto found = Find(*node_, key);
  bool value = otherwise;
  if (found && !YAML::convert<bool>::decode(found->node, value)) {
    AddFault(*node_, key, *found, fault::NotABoolean(Shown(found->node)));
    value = otherwise;
  }
  Record(*node_, key, value ? "true" : "false");
  return value;
}

std::string ConfigMap::Text(std::string_view key) const {
  const auto found = Find(*node_, key);
  if (!found) {
    AddMissing(*node_, key, "a text");
    return {};
  }
  if (!found->node.IsScalar() || found->node.Scalar().empty()) {
    AddFault(*node_, key, *found, fault::NotAText(Shown(found->node)));
    return {};
  }
  Record(*node_, key, found->node.Scalar());
  return found->node.Scalar();
}

std::string ConfigMap::Text(std::string_view key, std::string_view otherwise) const {
  if (Has(key)) return Text(key);
  Record(*node_, key, std::string(otherwise));
  return std::string(otherwise);
}

std::string ConfigMap::Choice(std::string_view key,
                              std::initializer_list<std::string_view> allowed) const {
  if (!Has(key)) {
    AddMissing(*node_, key, fmt::format("one of {}", fmt::join(allowed, ", ")));
    return std::string(*allowed.begin());
  }
  const std::string value = Text(key);
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return value;
  if (!value.empty()) {
    Fault(key, fault::NotKnown(value, {allowed.begin(), allowed.end()}));
  }
  return std::string(*allowed.begin());
}

std::string ConfigMap::Choice(std::string_view key, std::initializer_list<std::string_view> allowed,
                              std::string_view otherwise) const {
  if (Has(key)) return Choice(key, allowed);
  Record(*node_, key, std::string(otherwise));
  return std::string(otherwise);
}
}  // namespace tera
