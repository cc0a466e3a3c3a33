#include "app/manual/completion_words.h"

namespace tera {

std::vector<std::string> PathsBelow(const CommandHelp& program) {
  std::vector<std::string> paths;
  for (const CommandHelp* command : AllOf(program)) {
    if (command->path.size() > 1) paths.push_back("'" + command->Joined(" ") + "'");
  }
  return paths;
}

std::vector<std::string> NamesOfCommands(const CommandHelp& command) {
  std::vector<std::string> names;
  for (const CommandHelp& below : command.commands) names.push_back(below.path.back());
  return names;
}

std::string Quoted(std::string_view text, std::string_view quote_within) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string(quote_within) : std::string(1, c);
  return quoted + "'";
}

}  // namespace tera
