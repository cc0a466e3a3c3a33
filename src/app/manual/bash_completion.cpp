#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "app/manual/completion.h"
#include "app/manual/completion_words.h"

namespace tera {
namespace {

using Words = std::vector<std::string>;

Words NamesOfOptions(const CommandHelp& command) {
  Words names;
  for (const OptionHelp& option : command.options) {
    if (option.is_argument) continue;
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

/// Words that the first argument accepts; empty if it accepts any text.
Words WordsOfArgument(const CommandHelp& command) {
  for (const OptionHelp& option : command.options) {
    if (option.is_argument) return option.words;
  }
  return {};
}

/// A case "    'tera export --to') _tera_words ... ;;" for each option that has a value.
std::string BashValues(const CommandHelp& program) {
  std::string cases;
  for (const CommandHelp* command : AllOf(program)) {
    for (const OptionHelp& option : command->options) {
      if (option.is_argument || option.type.empty()) continue;
      Words places;
      for (const std::string& name : option.names) {
        places.push_back(fmt::format("'{} {}'", command->Joined(" "), name));
      }
      const std::string what = !option.words.empty()
                                   ? fmt::format("_tera_words {}", fmt::join(option.words, " "))
                               : option.TakesPath() ? "_tera_files"
                                                    : ":";
      cases += fmt::format("    {})\n      {}\n      return\n      ;;\n", fmt::join(places, " | "),
                           what);
    }
  }
  return cases;
}

std::string BashOptions(const CommandHelp& program) {
  std::string cases;
  for (const CommandHelp* command : AllOf(program)) {
    cases += fmt::format("        '{}') _tera_words {} ;;\n", command->Joined(" "),
                         fmt::join(NamesOfOptions(*command), " "));
  }
  return cases;
}

/// Words at argument positions: commands, or the words that an argument accepts.
std::string BashArguments(const CommandHelp& program) {
  std::string cases;
  for (const CommandHelp* command : AllOf(program)) {
    const Words words =
        command->commands.empty() ? WordsOfArgument(*command) : NamesOfCommands(*command);
    if (words.empty()) continue;
    cases +=
        fmt::format("    '{}') _tera_words {} ;;\n", command->Joined(" "), fmt::join(words, " "));
  }
  return cases;
}

}  // namespace

std::string BashScript(const CommandHelp& program) {
  return fmt::format(
      R"(# Completion of tera for bash; written by `tera completion bash`.
_tera_words() {{
  mapfile -t COMPREPLY < <(compgen -W "$*" -- "$current")
}}

_tera_files() {{
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$current")
}}

_tera() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} command=tera k
  # bash takes the sign of --option=value for a word.
  if [[ $current == = ]]; then
    current=
  elif [[ $before == = ]]; then
    before=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  for ((k = 1; k < COMP_CWORD; ++k)); do
    case "$command ${{COMP_WORDS[k]}}" in
      {}) command+=" ${{COMP_WORDS[k]}}" ;;
    esac
  done
  COMPREPLY=()
  case "$command $before" in
{}  esac
  case $current in
    -*)
      case $command in
{}      esac
      return
      ;;
  esac
  case $command in
{}    *) _tera_files ;;
  esac
}}

complete -F _tera tera
)",
      fmt::join(PathsBelow(program), " | "), BashValues(program), BashOptions(program),
      BashArguments(program));
}

}  // namespace tera
