#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

// The benchmark must be independent of its subject: of this project it includes a few plain headers
// of the core, and links only the core.

namespace {

namespace fs = std::filesystem;

const std::set<std::string> kMayInclude = {"core/check.h", "core/error.h", "core/random.h",
                                           "core/stopwatch.h"};
const std::set<std::string> kMayLink = {"core"};

std::string TextOf(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> AllMatches(const std::string& text, const std::regex& form) {
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), form), end; it != end; ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

std::vector<std::string> IncludesIn(const std::string& text) {
  return AllMatches(text, std::regex("#\\s*include\\s*[<\"]([^>\"]+)[>\"]"));
}

/// A non-free header of this project outside blind/.
bool IsForbidden(const std::string& header) {
  if (header.starts_with("blind/") || kMayInclude.contains(header)) return false;
  return fs::exists("src/" + header);
}

/// The forbidden links of the library; the program tera-prove links both it and the diagnosis.
std::vector<std::string> ForbiddenLinks(const std::string& cmake) {
  std::vector<std::string> links;
  for (const std::string& linked :
       AllMatches(cmake, std::regex("target_link_libraries\\(tera_blind\\s([^)]*)\\)"))) {
    for (const std::string& link : AllMatches(linked, std::regex("tera(?:::|_)([a-z0-9_]+)"))) {
      links.push_back(link);
    }
  }
  std::erase_if(links, [](const std::string& link) { return kMayLink.contains(link); });
  return links;
}

TEST(Independence, BlindIncludesNothingOfSimulatorAndDiagnosis) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator("blind")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    ++files;
    for (const std::string& header : IncludesIn(TextOf(entry.path()))) {
      EXPECT_FALSE(IsForbidden(header)) << entry.path() << " includes " << header;
    }
  }
  EXPECT_GT(files, 20);
  EXPECT_TRUE(IsForbidden("physics/actuation/lever_map.h"));
  EXPECT_TRUE(IsForbidden("diagnose/diagnosis.h"));
  EXPECT_TRUE(IsForbidden("core/types/effects.h"));
  EXPECT_FALSE(IsForbidden("cvode/cvode.h"));
}

TEST(Independence, BlindLinksNothingOfThisProjectButTheCore) {
  const std::string cmake = TextOf("blind/CMakeLists.txt");
  EXPECT_THAT(cmake, testing::HasSubstr("target_link_libraries(tera_blind PUBLIC tera::core"));
  EXPECT_TRUE(ForbiddenLinks(cmake).empty());
  EXPECT_EQ(ForbiddenLinks("target_link_libraries(tera_blind PRIVATE tera::physics)").size(), 1u);
  EXPECT_EQ(ForbiddenLinks("target_link_libraries(tera_blind PRIVATE tera_diagnose)").size(), 1u);
}

/// The core itself depends on no other folder (test/architecture), so that it adds no dependence.
TEST(Independence, NothingButTheProgramSeesBlind) {
  for (const auto& entry : fs::recursive_directory_iterator("src")) {
    const fs::path& path = entry.path();
    if (path.extension() != ".h" && path.extension() != ".cpp") continue;
    if (path.lexically_relative("src").begin()->string() == "app") continue;
    for (const std::string& header : IncludesIn(TextOf(path))) {
      EXPECT_FALSE(header.starts_with("blind/")) << path << " includes " << header;
    }
  }
}

}  // namespace
