#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// A first mapping (YAML) of a log, for `tera import`: a bag by its topics' types, a text table by
/// its columns' names and numbers. What is a guess stands with a remark "guessed:" that says why;
/// what is not known is left out as a remark. Throws InputError where the log cannot be read.
std::string SuggestMapping(const std::filesystem::path& log);

// Of each kind of log.
std::string SuggestForBag(const std::filesystem::path& log);
std::string SuggestForTable(const std::filesystem::path& log);

}  // namespace tera
