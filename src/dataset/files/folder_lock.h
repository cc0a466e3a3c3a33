#pragma once

#include <filesystem>

namespace tera {

/// Holds a folder for one writer, as long as it lives; a killed process lets go of it. Throws
/// InputError if somebody else holds it.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace tera
