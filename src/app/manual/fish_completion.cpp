#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "app/manual/completion.h"
#include "app/manual/completion_words.h"

namespace tera {
namespace {

using Words = std::vector<std::string>;

std::string QuotedForFish(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped += c == '\\' ? "\\\\" : std::string(1, c);
  return Quoted(escaped, "\\'");
}

std::string FishOption(const std::string& at, const OptionHelp& option) {
  std::string line = "complete -c tera -n " + at;
  if (option.is_argument) {
    if (option.words.empty()) return "";
    return line + fmt::format(" -f -a '{}' -d {}\n", fmt::join(option.words, " "),
                              QuotedForFish(option.description));
  }
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.words.empty()) {
    line += fmt::format(" -x -a '{}'", fmt::join(option.words, " "));
  } else if (option.TakesPath()) {
    line += " -r -F";
  } else if (!option.type.empty()) {
    line += " -x";
  }
  return line + " -d " + QuotedForFish(option.description) + "\n";
}

}  // namespace

std::string FishScript(const CommandHelp& program) {
  std::string text = fmt::format(
      R"(# Completion of tera for fish; written by `tera completion fish`.
function __tera_at --description 'Whether the command that is being typed is this one'
    set -l command tera
    for word in (commandline -opc)[2..-1]
        switch "$command $word"
            case {}
                set command "$command $word"
        end
    end
    test "$command" = "$argv"
end

)",
      fmt::join(PathsBelow(program), " "));
  for (const CommandHelp* command : AllOf(program)) {
    const std::string at = QuotedForFish("__tera_at " + command->Joined(" "));
    for (const CommandHelp& below : command->commands) {
      text += fmt::format("complete -c tera -n {} -f -a {} -d {}\n", at, below.path.back(),
                          QuotedForFish(below.description));
    }
    for (const OptionHelp& option : command->options) text += FishOption(at, option);
  }
  return text;
}

}  // namespace tera
