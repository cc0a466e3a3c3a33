#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

/// Validators of option values, with their message: "--seed: '-1'; need a whole number >= 0".

namespace tera {

/// A number above 0 in `unit`, a plural: "seconds".
CLI::Validator PositiveNumber(const std::string& unit);
/// A number in `unit`, a plural.
CLI::Validator NumberBetween(double least, double most, const std::string& unit);
CLI::Validator WholeNumberFrom0();
CLI::Validator WholeNumberBetween(int least, int most);

/// A word of a set; each stands for an enumeration value. For use with `transform`.
template <typename Enum>
CLI::Validator OneOf(const std::map<std::string, Enum>& words) {
  std::string all;
  for (const auto& [word, value] : words) all += (all.empty() ? "" : ", ") + word;
  const auto to_value = [=](std::string& text) -> std::string {
    const auto found = words.find(text);
    if (found == words.end()) return "'" + text + "'; need one of " + all;
    text = std::to_string(static_cast<int>(found->second));
    return "";
  };
  return CLI::Validator(to_value, "one of " + all);
}

/// Adds the option --moved. `of` is a prefix of its description.
void AddMovedOption(CLI::App* command, std::vector<std::string>* moved, const std::string& of = "");

}  // namespace tera
