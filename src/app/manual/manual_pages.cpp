#include "app/manual/manual_pages.h"

#include <fmt/format.h>

#include <string_view>

namespace tera {
namespace {

/// Escapes a text for roff.
std::string Plain(std::string_view text) {
  std::string plain;
  if (text.starts_with(".") || text.starts_with("'")) plain = "\\&";
  for (const char c : text) {
    if (c == '\\') {
      plain += "\\e";
    } else if (c == '-') {
      plain += "\\-";
    } else {
      plain += c;
    }
  }
  return plain;
}

std::string Bold(std::string_view text) { return "\\fB" + Plain(text) + "\\fR"; }
std::string Italic(std::string_view text) { return "\\fI" + Plain(text) + "\\fR"; }

/// Ends a description with a full stop unless it has one.
std::string Sentence(const std::string& text) {
  return Plain(text) + (text.ends_with('.') || text.ends_with('?') ? "\n" : ".\n");
}

std::string Value(const OptionHelp& option) {
  if (option.words.empty()) return Italic(option.type);
  std::string words;
  for (const std::string& word : option.words) words += (words.empty() ? "" : "|") + Bold(word);
  return words;
}

std::string SynopsisOf(const CommandHelp& command) {
  std::string text = Bold(command.Joined(" "));
  if (!command.commands.empty()) return text + " " + Italic("COMMAND");
  const auto part = [](const OptionHelp& option) {
    const std::string several = option.is_repeated ? "..." : "";
    if (option.is_argument) return Italic(option.names.front()) + several;
    return Bold(option.names.back()) + " " + Value(option) + several;
  };
  for (const OptionHelp& option : command.options) {
    if (option.is_required) text += " " + part(option);
  }
  for (const OptionHelp& option : command.options) {
    if (option.is_argument && !option.is_required) text += " [" + part(option) + "]";
  }
  return text + " [" + Italic("OPTION") + "]...";
}

std::string ItemOf(const OptionHelp& option) {
  std::string names;
  for (const std::string& name : option.names) {
    names += (names.empty() ? "" : ", ") + (option.is_argument ? Italic(name) : Bold(name));
  }
  if (!option.is_argument && !option.type.empty()) names += " " + Value(option);
  if (option.is_repeated) names += " ...";
  std::string text = option.description;
  if (!option.need.empty() && option.words.empty()) text += " (a " + option.need + ")";
  if (option.is_required && !option.is_argument) text += "; required";
  return ".TP\n" + names + "\n" + Sentence(text);
}

/// A section with its heading; empty if there are no items.
std::string Section(const std::string& heading, const std::string& items) {
  return items.empty() ? "" : ".SH " + heading + "\n" + items;
}

std::string SeeAlso(const CommandHelp& program, const CommandHelp& command) {
  std::string text;
  for (const CommandHelp* other : AllOf(program)) {
    const bool is_parent = other->path.size() + 1 == command.path.size() &&
                           command.Joined(" ").starts_with(other->Joined(" ") + " ");
    const bool is_below = other->path.size() == command.path.size() + 1 &&
                          other->Joined(" ").starts_with(command.Joined(" ") + " ");
    if (!is_parent && !is_below) continue;
    text += (text.empty() ? "" : ",\n") + (".BR " + Plain(other->Joined("-"))) + " (1)";
  }
  return text;
}

std::string PageOf(const CommandHelp& program, const CommandHelp& command,
                   const std::string& version) {
  std::string arguments, options, commands;
  for (const OptionHelp& option : command.options) {
    (option.is_argument ? arguments : options) += ItemOf(option);
  }
  for (const CommandHelp& below : command.commands) {
    commands += ".TP\n" + Bold(below.path.back()) + "\n" + Sentence(below.description);
  }
  std::string title = command.Joined("-");
  for (char& c : title) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return fmt::format(
             ".TH \"{}\" 1 \"\" \"tera {}\" \"TERA\"\n"
             ".SH NAME\n{} \\- {}\n"
             ".SH SYNOPSIS\n{}\n",
             Plain(title), version, Plain(command.Joined("-")), Plain(command.description),
             SynopsisOf(command)) +
         Section("ARGUMENTS", arguments) + Section("COMMANDS", commands) +
         Section("OPTIONS", options) +
         Section("EXIT STATUS",
                 ".TP\n0\nSuccess.\n.TP\n1\nThe answer is no (\\fBtera lint\\fR has findings), or "
                 "the program has an internal error.\n.TP\n2\nAn input cannot be used; the message "
                 "gives the place, the found value, the required value and the remedy.\n.TP\n3 and "
                 "more\nSee the description of the command.\n") +
         Section("SEE ALSO", SeeAlso(program, command) + "\n");
}

}  // namespace

std::map<std::string, std::string> ManualPages(const CommandHelp& program,
                                               const std::string& version) {
  std::map<std::string, std::string> pages;
  for (const CommandHelp* command : AllOf(program)) {
    pages[command->Joined("-") + ".1"] = PageOf(program, *command, version);
  }
  return pages;
}

}  // namespace tera
