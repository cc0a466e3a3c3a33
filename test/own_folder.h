#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

namespace tera {

/// A folder of this test in this process alone, since tests run in parallel and in sequence. Calls
/// outside of tests share one folder. All are removed when the process ends.
inline const std::filesystem::path& OwnFolder() {
  struct Folder {
    std::filesystem::path path;
    Folder() {
      std::string name = (std::filesystem::temp_directory_path() / "tera_test_XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
      path = name;
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static std::map<const testing::TestInfo*, Folder> folders;
  return folders[testing::UnitTest::GetInstance()->current_test_info()].path;
}

}  // namespace tera
