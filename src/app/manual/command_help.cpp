#include "app/manual/command_help.h"

#include <string_view>

namespace tera {
namespace {

/// Words listed in a text like "one of lz4, none, zstd" (from OneOf); empty for any other text.
std::vector<std::string> WordsOf(std::string_view need) {
  constexpr std::string_view kOneOf = "one of ", kBetween = ", ";
  std::vector<std::string> words;
  if (!need.starts_with(kOneOf)) return words;
  std::string_view rest = need.substr(kOneOf.size());
  while (true) {
    const std::size_t end = rest.find(kBetween);
    words.emplace_back(rest.substr(0, end));
    if (end == std::string_view::npos) return words;
    rest.remove_prefix(end + kBetween.size());
  }
}

OptionHelp HelpOf(const CLI::Option& option) {
  OptionHelp help;
  help.is_argument = option.get_positional();
  if (help.is_argument) {
    help.names = {option.get_name(/*positional=*/true)};
  } else {
    for (const std::string& name : option.get_snames()) help.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) help.names.push_back("--" + name);
  }
  help.description = option.get_description();
  if (option.get_expected_max() > 0) {
    // The text is a type, or a type and a condition: "FLOAT:number > 0, in seconds".
    const std::string type = option.get_type_name();
    const std::size_t colon = type.find(':');
    help.type = type.substr(0, colon);
    if (colon != std::string::npos) help.need = type.substr(colon + 1);
    help.words = WordsOf(help.need);
  }
  help.is_required = option.get_required();
  help.is_repeated = option.get_items_expected_max() > 1;
  return help;
}

CommandHelp HelpBelow(const CLI::App& app, std::vector<std::string> path) {
  CommandHelp help;
  help.path = std::move(path);
  help.description = app.get_description();
  for (const CLI::Option* option : app.get_options()) help.options.push_back(HelpOf(*option));
  const auto is_shown = [](const CLI::App* command) { return !command->get_group().empty(); };
  for (const CLI::App* command : app.get_subcommands(is_shown)) {
    std::vector<std::string> below = help.path;
    below.push_back(command->get_name());
    help.commands.push_back(HelpBelow(*command, std::move(below)));
  }
  return help;
}

}  // namespace

std::string CommandHelp::Joined(const std::string& separator) const {
  std::string joined;
  for (const std::string& word : path) joined += (joined.empty() ? "" : separator) + word;
  return joined;
}

CommandHelp HelpOf(const CLI::App& app) { return HelpBelow(app, {app.get_name()}); }

std::vector<const CommandHelp*> AllOf(const CommandHelp& command) {
  std::vector<const CommandHelp*> all = {&command};
  for (const CommandHelp& below : command.commands) {
    for (const CommandHelp* each : AllOf(below)) all.push_back(each);
  }
  return all;
}

}  // namespace tera
