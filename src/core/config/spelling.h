#pragma once

#include <string>
#include <vector>

namespace tera {

/// The text " (did you mean 'x'?)" with the candidate closest to `word`; empty if none is close.
std::string DidYouMean(const std::string& word, const std::vector<std::string>& candidates);

/// Converts ASCII capitals to lower case.
std::string LowerCase(std::string text);

}  // namespace tera
