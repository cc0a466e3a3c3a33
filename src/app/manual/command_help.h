#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// The command line as data. Manual pages and completion scripts are generated from it, so they
/// agree with `--help`.

namespace tera {

/// An option or an argument of a command.
struct OptionHelp {
  std::vector<std::string> names;  ///< such as "-h", "--help"; an argument has one name, such as
                                   ///< "SCENARIO"
  std::string description;
  std::string type;  ///< type of the value, such as "FLOAT" or "TEXT"; empty for a flag
  std::string need;  ///< condition on the value, such as "number > 0, in seconds"
  std::vector<std::string> words;  ///< all accepted words; empty if other values are accepted
  bool is_argument = false;        ///< an argument, identified by its position
  bool is_required = false;
  bool is_repeated = false;  ///< accepts several values

  /// True if the value may be a path: a text without a condition.
  bool TakesPath() const { return type == "TEXT" && need.empty(); }
};

struct CommandHelp {
  std::vector<std::string> path;  ///< such as "tera", "layout", "evaluate"
  std::string description;
  std::vector<OptionHelp> options;  ///< options and arguments, in the order of definition
  std::vector<CommandHelp> commands;

  /// The path joined by `separator`, such as "tera-layout-evaluate".
  std::string Joined(const std::string& separator) const;
};

/// Options and commands of `app`, which must have a name. Hidden commands are left out.
CommandHelp HelpOf(const CLI::App& app);

/// `command` and all commands below it; a parent comes before its children.
std::vector<const CommandHelp*> AllOf(const CommandHelp& command);

}  // namespace tera
