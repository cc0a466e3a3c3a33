#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// The command line as data: what manual pages and completions are made of, so that neither says
/// anything else than `--help`.

namespace tera {

/// An option or an argument of a command.
struct OptionHelp {
  std::vector<std::string> names;  ///< "-h", "--help"; of an argument its one name, "SCENARIO"
  std::string description;
  std::string type;                ///< of its value, "FLOAT", "TEXT"; empty: a flag takes none
  std::string need;                ///< of its value, "number > 0, in seconds"
  std::vector<std::string> words;  ///< where these are all that it takes
  bool is_argument = false;        ///< told by its place, not by a name
  bool is_required = false;
  bool is_repeated = false;  ///< takes several

  /// Whether its value may be a path: it is text, and nothing more is asked of it.
  bool TakesPath() const { return type == "TEXT" && need.empty(); }
};

/// The program or one of its commands.
struct CommandHelp {
  std::vector<std::string> path;  ///< "tera", "layout", "evaluate"
  std::string description;
  std::vector<OptionHelp> options;  ///< arguments, too, in the order in which they are given
  std::vector<CommandHelp> commands;

  /// "tera-layout-evaluate", with "-" between.
  std::string Joined(const std::string& separator) const;
};

/// Lists what `app`, which has a name, and all below it take. Commands that its help hides are left
/// out.
CommandHelp HelpOf(const CLI::App& app);

/// `command` and all below it, each before those below it.
std::vector<const CommandHelp*> AllOf(const CommandHelp& command);

}  // namespace tera
