#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

// Reads every #include line under src/ and holds it against the architecture: which folder may see
// which, and which folder alone may see a third-party library.

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file, folder, header;
};

std::vector<Include> AllIncludes(const fs::path& root) {
  std::vector<Include> includes;
  const std::regex line_form(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    const fs::path relative = entry.path().lexically_relative(root);
    std::ifstream stream(entry.path());
    std::smatch match;
    for (std::string line; std::getline(stream, line);) {
      if (std::regex_search(line, match, line_form)) {
        includes.push_back({relative.generic_string(), relative.begin()->string(), match[1]});
      }
    }
  }
  return includes;
}

const std::map<std::string, std::set<std::string>> kMaySee = {
    {"core", {}},
    {"physics", {"core"}},
    {"soil", {"core"}},
    {"render", {"core"}},
    {"dataset", {"core"}},
    {"sensors", {"core", "render"}},
    {"sim", {"core", "physics", "soil", "render", "dataset", "sensors"}},
    {"app", {"core", "physics", "soil", "render", "dataset", "sensors", "sim"}},
};

/// Headers of a library by their beginning, and the folders that may include them.
const std::vector<std::pair<std::string, std::set<std::string>>> kLibraries = {
    {"yaml-cpp/", {"core"}},
    {"Random123/", {"core"}},
    {"bt", {"physics"}},
    {"BulletDynamics", {"physics"}},
    {"urdf", {"physics"}},
    {"gdal", {"soil"}},
    {"ogr", {"soil"}},
    {"assimp/", {"render"}},
    {"tiny_gltf", {"render"}},
    {"EGL/", {"render"}},
    {"epoxy/", {"render"}},
    {"embree3/", {"render"}},
    {"GeographicLib/", {"sensors"}},
    {"opencv2/", {"dataset"}},
    {"lzf", {"dataset"}},
    {"nlohmann/", {"dataset"}},
    {"sqlite3", {"dataset"}},
    {"pcl/", {"dataset"}},
    {"CLI/", {"app"}},
    {"spdlog/", {"app"}},
};

TEST(Includes, FollowTheArrowsBetweenFolders) {
  const auto includes = AllIncludes("src");
  ASSERT_GT(includes.size(), 100u);
  for (const Include& include : includes) {
    const std::string target = include.header.substr(0, include.header.find('/'));
    if (!kMaySee.contains(target) || target == include.folder) continue;
    ASSERT_TRUE(kMaySee.contains(include.folder)) << include.file;
    EXPECT_TRUE(kMaySee.at(include.folder).contains(target))
        << include.file << " includes " << include.header;
  }
}

TEST(Includes, KeepEachLibraryInItsFolder) {
  for (const Include& include : AllIncludes("src")) {
    for (const auto& [beginning, folders] : kLibraries) {
      if (!include.header.starts_with(beginning)) continue;
      EXPECT_TRUE(folders.contains(include.folder))
          << include.file << " includes " << include.header;
    }
  }
}

TEST(Includes, KeepThirdPartyLibrariesOutOfHeaders) {
  for (const Include& include : AllIncludes("src")) {
    if (!include.file.ends_with(".h") || include.folder == "app") continue;
    for (const std::string beginning : {"bt", "opencv2/", "pcl/", "yaml-cpp/", "gdal"}) {
      EXPECT_FALSE(include.header.starts_with(beginning))
          << include.file << " includes " << include.header;
    }
  }
}

}  // namespace
