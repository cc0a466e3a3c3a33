#pragma once

#include <filesystem>
#include <memory>

namespace tera {

class FolderLock;

/// Path of an unfinished recording or another folder, without a trailing slash.
std::filesystem::path IncompleteOf(const std::filesystem::path& directory);

/// A folder that is written to `<folder>.incomplete` and renamed when complete. Folders that cannot
/// be resumed, such as reports, are removed if not completed.
class WholeFolder {
 public:
  /// Policy for files of a stopped run.
  enum class Left {
    kIsRefused,
    kIsKept  ///< kept for resumption, also without Commit
  };

  /// Creates the temporary folder with its parents. Throws InputError if it cannot be created, if
  /// another run writes it, or if it holds refused files of a stopped run.
  explicit WholeFolder(const std::filesystem::path& folder, Left left = Left::kIsRefused);
  /// Removes the temporary folder unless Commit or Keep was called.
  ~WholeFolder();
  WholeFolder(const WholeFolder&) = delete;
  WholeFolder& operator=(const WholeFolder&) = delete;

  /// Path to write to before Commit.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Removes the contents. Without Commit or Keep, later contents are removed too.
  void Clear();
  /// Keeps the contents, also without Commit.
  void Keep() { kept_ = true; }
  /// Renames the folder. Throws InputError.
  void Commit();

 private:
  std::filesystem::path folder_, temporary_;
  std::unique_ptr<FolderLock> lock_;
  bool committed_ = false, kept_ = false;
};

/// Throws InputError if a stopped run has left files next to the folder.
void RequireNoneStopped(const std::filesystem::path& folder);

/// Whether there is a file, or a folder that is not empty.
bool HoldsSomething(const std::filesystem::path& path);
/// Throws InputError if HoldsSomething: the path is about to be written.
void RequireNothingAt(const std::filesystem::path& path);

/// Renames a folder. Throws InputError.
void GiveName(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace tera
