#include "app/arguments/argument_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>

#include "core/parse_number.h"

namespace tera {
namespace {

/// Parses the whole text as a finite number; nullopt otherwise.
template <typename T>
std::optional<T> NumberIn(const std::string& text) {
  const auto number = ParseNumber<T>(text);
  return number && std::isfinite(static_cast<double>(*number)) ? number : std::nullopt;
}

template <typename T>
CLI::Validator Need(const std::string& need, std::function<bool(T)> holds) {
  const auto check = [=](std::string& text) -> std::string {
    const std::optional<T> number = NumberIn<T>(text);
    return number && holds(*number) ? "" : fmt::format("'{}'; need a {}", text, need);
  };
  return CLI::Validator(check, need);
}

}  // namespace

CLI::Validator PositiveNumber(const std::string& unit) {
  return Need<double>(fmt::format("number > 0, in {}", unit), [](double x) { return x > 0; });
}

CLI::Validator NumberBetween(double least, double most, const std::string& unit) {
  return Need<double>(fmt::format("number from {:g} to {:g}, in {}", least, most, unit),
                      [=](double x) { return x >= least && x <= most; });
}

CLI::Validator WholeNumberFrom0() {
  return Need<std::int64_t>("whole number >= 0", [](std::int64_t n) { return n >= 0; });
}

CLI::Validator WholeNumberBetween(int least, int most) {
  return Need<std::int64_t>(fmt::format("whole number from {} to {}", least, most),
                            [=](std::int64_t n) { return n >= least && n <= most; });
}

void AddMovedOption(CLI::App* command, std::vector<std::string>* moved, const std::string& of) {
  command
      ->add_option("--moved", *moved,
                   of + "OLD=NEW: new place of an input or folder that dataset.yaml lists as OLD; "
                        "may be repeated")
      ->take_all();
}

}  // namespace tera
