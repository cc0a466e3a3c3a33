#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

// test/ mirrors src/, so that a reader of a source finds its test: test/soil/track/tread_test.cpp
// is of src/soil/track/tread.cpp. Two rules: a test's folder exists in src/, and a test with a
// source's name lies in that source's folder. A source may lack a test, and a test may have its own
// name.

namespace {

namespace fs = std::filesystem;

/// Folders of test/ that src/ lacks, and why.
const std::map<std::string, std::string> kOfTestsAlone = {
    {"accuracy", "whole simulations, against the bounds of docs/evidence/accuracy.md"},
    {"architecture", "the sources themselves, as text"},
    {"diagnose/null", "how often the whole diagnosis finds something in nothing"},
};

std::vector<std::string> FilesUnder(const fs::path& root, const std::string& ending) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string file = entry.path().lexically_relative(root).generic_string();
    if (file.ends_with(ending)) files.push_back(file);
  }
  return files;
}

std::string FolderOf(const std::string& file) { return fs::path(file).parent_path().string(); }

/// The subject of a test of this name: "tread" for "soil/track/tread_test.cpp".
std::string SubjectOf(const std::string& test) {
  const std::string name = fs::path(test).stem().string();
  return name.substr(0, name.size() - std::string("_test").size());
}

/// src/ and blind/ under one root, as test/ has them.
std::vector<std::string> Sources() {
  std::vector<std::string> sources = FilesUnder("src", ".cpp");
  for (const std::string& file : FilesUnder("src", ".h")) sources.push_back(file);
  for (const std::string& file : FilesUnder("blind", ".cpp")) sources.push_back("blind/" + file);
  return sources;
}

std::vector<std::string> TestsWithoutAFolder(const std::vector<std::string>& tests,
                                             const std::vector<std::string>& sources) {
  std::set<std::string> folders = {"blind"};
  for (const std::string& source : sources) folders.insert(FolderOf(source));
  std::vector<std::string> faults;
  for (const std::string& test : tests) {
    const std::string folder = FolderOf(test);
    if (!folders.contains(folder) && !kOfTestsAlone.contains(folder)) faults.push_back(test);
  }
  return faults;
}

/// Tests named after a source in another folder.
std::vector<std::string> TestsFarFromTheirSource(const std::vector<std::string>& tests,
                                                 const std::vector<std::string>& sources) {
  std::map<std::string, std::set<std::string>> folders;
  for (const std::string& s : sources) folders[fs::path(s).stem().string()].insert(FolderOf(s));
  std::vector<std::string> faults;
  for (const std::string& test : tests) {
    const auto found = folders.find(SubjectOf(test));
    if (found != folders.end() && !found->second.contains(FolderOf(test))) faults.push_back(test);
  }
  return faults;
}

void ExpectNone(const std::vector<std::string>& faults, const std::string& what) {
  for (const std::string& fault : faults) ADD_FAILURE() << "test/" << fault << " " << what;
}

TEST(Mirror, EveryTestLiesInAFolderOfTheSources) {
  const auto tests = FilesUnder("test", "_test.cpp"), sources = Sources();
  ASSERT_GT(tests.size(), 100u);
  ASSERT_GT(sources.size(), 300u);
  ExpectNone(TestsWithoutAFolder(tests, sources), "has no folder of that name in src/");
  EXPECT_EQ(TestsWithoutAFolder({"soil/weather/rain_test.cpp"}, sources).size(), 1u);
}

TEST(Mirror, ATestWithTheNameOfASourceLiesWhereTheSourceDoes) {
  const auto tests = FilesUnder("test", "_test.cpp"), sources = Sources();
  ExpectNone(TestsFarFromTheirSource(tests, sources), "is named after a source of another folder");
  EXPECT_EQ(TestsFarFromTheirSource({"sim/tread_test.cpp"}, sources).size(), 1u);
  EXPECT_EQ(TestsFarFromTheirSource({"soil/track/tread_test.cpp"}, sources).size(), 0u);
}

TEST(Mirror, NoFolderIsExemptThatIsNotThere) {
  for (const auto& [folder, why] : kOfTestsAlone) {
    EXPECT_TRUE(fs::is_directory("test/" + folder)) << folder << ": " << why;
    EXPECT_FALSE(fs::is_directory("src/" + folder)) << folder << " need not be exempt";
  }
}

}  // namespace
