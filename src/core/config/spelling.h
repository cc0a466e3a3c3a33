#pragma once

#include <string>
#include <vector>

namespace tera {

/// " (did you mean 'x'?)" with the candidate nearest to `word`; empty if no candidate is near.
std::string DidYouMean(const std::string& word, const std::vector<std::string>& candidates);

/// Converts ASCII capitals to lower case.
std::string LowerCase(std::string text);

}  // namespace tera
