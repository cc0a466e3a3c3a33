#pragma once

#include <filesystem>
#include <fstream>
#include <istream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

/// The #include lines of the files under src/, for the tests of the architecture.

namespace testing_architecture {

struct Include {
  std::string file;    ///< named from src/: "render/gl/passes/lens.cpp"
  std::string folder;  ///< the first of its path
  std::string header;
  std::string Text() const { return file + " includes " + header; }
};

/// The includes of one file.
inline std::vector<Include> IncludesIn(const std::string& file, std::istream& text) {
  std::vector<Include> includes;
  const std::regex line_form(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::smatch match;
  for (std::string line; std::getline(text, line);) {
    if (std::regex_search(line, match, line_form)) {
      includes.push_back({file, file.substr(0, file.find('/')), match[1]});
    }
  }
  return includes;
}

inline std::vector<Include> AllIncludes() {
  std::vector<Include> includes;
  for (const auto& entry : std::filesystem::recursive_directory_iterator("src")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream stream(entry.path());
    const auto some = IncludesIn(entry.path().lexically_relative("src").generic_string(), stream);
    includes.insert(includes.end(), some.begin(), some.end());
  }
  return includes;
}

inline std::vector<Include> IncludesOf(const std::string& file, const std::string& header) {
  std::istringstream text("#include <" + header + ">\n");
  return IncludesIn(file, text);
}

}  // namespace testing_architecture
