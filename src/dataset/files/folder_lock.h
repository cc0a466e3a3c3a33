#pragma once

#include <filesystem>

namespace tera {

/// Locks a folder for one writer during its lifetime; a killed process releases it. Throws
/// InputError if another process holds it.
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
