#pragma once

#include <string>
#include <vector>

namespace tera {

/// " (did you mean 'x'?)" with the candidate nearest to `word`, or nothing where none is near.
std::string DidYouMean(const std::string& word, const std::vector<std::string>& candidates);

/// The text with small letters for the capital ones of ASCII.
std::string LowerCase(std::string text);

}  // namespace tera
