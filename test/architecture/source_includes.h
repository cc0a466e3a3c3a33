#pragma once

#include <filesystem>
#include <fstream>
#include <istream>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// The #include lines of the files under src/ and blind/, for the tests of the architecture.

namespace testing_architecture {

struct Include {
  std::string file;    ///< as written: "render/gl/passes/lens.h", "blind/plant/plant.h"
  std::string folder;  ///< first folder of its path
  std::string header;
  std::string Text() const { return file + " includes " + header; }
};

inline std::vector<Include> IncludesIn(const std::string& file, std::istream& text) {
  std::vector<Include> includes;
  const std::regex line_form(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::smatch match;
  for (std::string line; std::getline(text, line);) {
    if (line.find('#') == line.npos) continue;  // the regular expression is slow
    if (std::regex_search(line, match, line_form)) {
      includes.push_back({file, file.substr(0, file.find('/')), match[1]});
    }
  }
  return includes;
}

inline std::vector<Include> AllIncludes() {
  std::vector<Include> includes;
  for (const auto& [root, named_from] : {std::pair{"src", "src"}, std::pair{"blind", "."}}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream stream(entry.path());
      const std::string file = entry.path().lexically_relative(named_from).generic_string();
      const auto some = IncludesIn(file, stream);
      includes.insert(includes.end(), some.begin(), some.end());
    }
  }
  return includes;
}

inline std::vector<Include> IncludesOf(const std::string& file, const std::string& header) {
  std::istringstream text("#include <" + header + ">\n");
  return IncludesIn(file, text);
}

}  // namespace testing_architecture
