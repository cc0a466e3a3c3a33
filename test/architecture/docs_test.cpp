#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

// A page that sends its reader to a file names one that is there.

namespace {

namespace fs = std::filesystem;

/// Files that the reader of a page writes, by a command on it.
const std::set<std::string> kWrittenByTheReader = {"config/scenarios/replay.yaml"};

std::string TextOf(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Paths from the project's root in a text. Those with a word in capitals are patterns.
std::set<std::string> PathsIn(const std::string& text) {
  const std::regex form(
      R"((^|[^\w/.\-])((src|test|blind|scripts|config|docs|shaders|assets|examples|cmake|proto|bench)/[\w./\-]*\w))");
  const std::regex pattern("[A-Z]{4}");
  std::set<std::string> paths;
  for (std::sregex_iterator m(text.begin(), text.end(), form), end; m != end; ++m) {
    const std::string path = (*m)[2];
    if (!std::regex_search(path, pattern)) paths.insert(path);
  }
  return paths;
}

/// Whether the path leads somewhere from the root or the page; a source may go without its ending.
bool Exists(const std::string& path, const fs::path& page) {
  for (const char* ending : {"", ".h", ".cpp"}) {
    if (fs::exists(path + ending)) return true;
  }
  return fs::exists(page.parent_path() / path);
}

std::vector<fs::path> Pages() {
  std::vector<fs::path> pages;
  for (const char* folder : {"docs", "src", "blind", "assets", "examples"}) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() == ".md") pages.push_back(entry.path());
    }
  }
  for (const char* page : {"README.md", "CONTRIBUTING.md"}) pages.emplace_back(page);
  return pages;
}

TEST(Docs, NameFilesThatAreThere) {
  int found = 0;
  for (const fs::path& page : Pages()) {
    for (const std::string& path : PathsIn(TextOf(page))) {
      ++found;
      EXPECT_TRUE(Exists(path, page) || kWrittenByTheReader.contains(path))
          << page.string() << " names " << path;
    }
  }
  EXPECT_GT(found, 100);
}

TEST(Docs, APathIsFoundInAnyPlaceButNotInThatOfABuild) {
  EXPECT_EQ(PathsIn("see `src/soil/soil.h`, (config/soils/NAME.yaml)"),
            std::set<std::string>{"src/soil/soil.h"});
  EXPECT_TRUE(PathsIn("build/release/test/sim/sim_test").empty());
  EXPECT_FALSE(Exists("src/soil/nothing.h", "README.md"));
  EXPECT_TRUE(Exists("src/soil/track/tread", "README.md"));
}

}  // namespace
