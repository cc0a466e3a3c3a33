#include "app/arguments/misspelt.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/config/spelling.h"

namespace tera {
namespace {

/// As DidYouMean, but prefers a candidate that begins with the word, or with which the word begins.
std::string Resembling(const std::string& word, const std::vector<std::string>& candidates) {
  const auto begins = std::find_if(candidates.begin(), candidates.end(), [&](const auto& known) {
    return word.starts_with(known) || known.starts_with(word);
  });
  return begins == candidates.end() ? DidYouMean(word, candidates)
                                    : fmt::format(" (did you mean '{}'?)", *begins);
}

std::string UnknownCommand(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return fmt::format("'{}': no such command{}", word, Resembling(word, names));
}

std::string UnknownOption(const CLI::App& command, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string name = word.substr(0, word.find('='));
  return fmt::format("{}: no such option of '{}'{}", name, command.get_name(),
                     Resembling(name, names));
}

}  // namespace

std::string UnknownArgument(const CLI::App& app) {
  const bool has_commands = !app.get_subcommands([](const CLI::App*) { return true; }).empty();
  const std::vector<CLI::App*> given = app.get_subcommands();
  if (has_commands && given.empty()) {
    const std::vector<std::string> unknown = app.remaining();
    return unknown.empty() || unknown[0].starts_with("-") ? "" : UnknownCommand(app, unknown[0]);
  }
  const CLI::App& command = has_commands ? *given[0] : app;
  for (const std::string& unknown : command.remaining()) {
    if (unknown.size() > 1 && unknown.starts_with("-")) return UnknownOption(command, unknown);
  }
  return "";
}

}  // namespace tera
