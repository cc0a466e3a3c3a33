#pragma once

#include <filesystem>

namespace tera {

/// Locks a folder against other writers for the lifetime of the object. The system releases the
/// lock of a killed process. Throws InputError if another process holds the lock.
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
