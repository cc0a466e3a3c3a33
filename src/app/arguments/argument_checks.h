#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

/// Validators of option values. Their messages have the form "--seed: '-1'; need a whole number >=
/// 0".

namespace tera {

/// Accepts a number above 0. `unit` is a plural, such as "seconds".
CLI::Validator PositiveNumber(const std::string& unit);
/// Accepts a number in a range. `unit` is a plural.
CLI::Validator NumberBetween(double least, double most, const std::string& unit);
CLI::Validator WholeNumberFrom0();
CLI::Validator WholeNumberBetween(int least, int most);

/// Accepts a word of a set and converts it to an enumerator. For use with CLI11's `transform`.
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

/// Adds the option --moved. `of` is put in front of its description.
void AddMovedOption(CLI::App* command, std::vector<std::string>* moved, const std::string& of = "");

}  // namespace tera
