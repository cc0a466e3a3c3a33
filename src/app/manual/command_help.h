#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// The command line as data. It is the source of manual pages and completions, so that they agree
/// with `--help`.

namespace tera {

/// An option or an argument of a command.
struct OptionHelp {
  std::vector<std::string> names;  ///< "-h", "--help"; an argument has a single name, "SCENARIO"
  std::string description;
  std::string type;                ///< type of its value, "FLOAT", "TEXT"; empty: flag
  std::string need;                ///< constraint on its value, "number > 0, in seconds"
  std::vector<std::string> words;  ///< exhaustive list of accepted words, or empty
  bool is_argument = false;        ///< identified by position
  bool is_required = false;
  bool is_repeated = false;  ///< accepts several values

  /// True if its value may be a path: unconstrained text.
  bool TakesPath() const { return type == "TEXT" && need.empty(); }
};

/// The program or one of its commands.
struct CommandHelp {
  std::vector<std::string> path;  ///< "tera", "layout", "evaluate"
  std::string description;
  std::vector<OptionHelp> options;  ///< including arguments, in order of definition
  std::vector<CommandHelp> commands;

  /// "tera-layout-evaluate" for the separator "-".
  std::string Joined(const std::string& separator) const;
};

/// Lists the options and commands of `app`, which must have a name. Hidden commands are omitted.
CommandHelp HelpOf(const CLI::App& app);

/// `command` and all commands below it, parents first.
std::vector<const CommandHelp*> AllOf(const CommandHelp& command);

}  // namespace tera
