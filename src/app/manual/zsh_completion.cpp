#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "app/manual/completion.h"
#include "app/manual/completion_words.h"

namespace tera {
namespace {

using Words = std::vector<std::string>;

std::string QuotedForSh(std::string_view text) { return Quoted(text, "'\\''"); }

/// Description of an option or argument for zsh's _arguments.
Words ZshSpecs(const OptionHelp& option) {
  const auto escaped = [](std::string_view text, std::string_view signs) {
    std::string out;
    for (const char c : text) {
      if (signs.find(c) != std::string_view::npos) out += '\\';
      out += c;
    }
    return out;
  };
  const std::string action = !option.words.empty()
                                 ? fmt::format("({})", fmt::join(option.words, " "))
                             : option.TakesPath() ? "_files"
                                                  : " ";
  const std::string text = escaped(option.description, "\\[]:");
  if (option.is_argument) {
    return {QuotedForSh(fmt::format("{}:{}:{}", option.is_repeated ? "*" : "",
                                    escaped(option.names.front(), ":"), action))};
  }
  Words specs;
  for (const std::string& name : option.names) {
    std::string spec = (option.is_repeated ? "*" : "") + name;
    if (!option.type.empty() && name.starts_with("--")) spec += "=";
    spec += "[" + text + "]";
    if (!option.type.empty()) spec += ":" + option.type + ":" + action;
    specs.push_back(QuotedForSh(spec));
  }
  return specs;
}

std::string ZshCases(const CommandHelp& program) {
  std::string cases;
  for (const CommandHelp* command : AllOf(program)) {
    Words specs;
    for (const OptionHelp& option : command->options) {
      for (const std::string& spec : ZshSpecs(option)) specs.push_back(spec);
    }
    if (!command->commands.empty()) {
      specs.push_back(
          QuotedForSh(fmt::format(":command:({})", fmt::join(NamesOfCommands(*command), " "))));
    }
    cases += fmt::format("    '{}')\n      _arguments -S {}\n      ;;\n", command->Joined(" "),
                         fmt::join(specs, " \\\n        "));
  }
  return cases;
}

}  // namespace

std::string ZshScript(const CommandHelp& program) {
  return fmt::format(
      R"(#compdef tera
# Completion of tera for zsh; written by `tera completion zsh`.
_tera() {{
  local command=tera
  integer k last=1
  for ((k = 2; k < CURRENT; ++k)); do
    case "$command ${{words[k]}}" in
      {}) command+=" ${{words[k]}}" last=k ;;
    esac
  done
  # What follows is of the command alone.
  words=("${{(@)words[last,-1]}}")
  ((CURRENT -= last - 1))
  case $command in
{}  esac
}}

# Run by the completion system as the body of _tera, or read by a user's .zshrc.
if [[ $funcstack[1] == _tera ]]; then
  _tera "$@"
elif (($+functions[compdef])); then
  compdef _tera tera
fi
)",
      fmt::join(PathsBelow(program), " | "), ZshCases(program));
}

}  // namespace tera
