#pragma once

#include <filesystem>
#include <memory>

namespace tera {

class FolderLock;

/// Path of the unfinished folder: `<directory>.incomplete`, without a trailing slash.
std::filesystem::path IncompleteOf(const std::filesystem::path& directory);

/// A result folder that is written as `<folder>.incomplete` and renamed when complete. A folder
/// that cannot be resumed, such as a report, is deleted if it is not completed.
class WholeFolder {
 public:
  /// Treatment of files that a stopped run left.
  enum class Left {
    kIsRefused,
    kIsKept  ///< kept, to resume the run; the folder also stays if it is not completed
  };

  /// Creates the temporary folder and its parents. Throws InputError if that fails, if another
  /// process writes the folder, or if a stopped run left files and `left` refuses them.
  explicit WholeFolder(const std::filesystem::path& folder, Left left = Left::kIsRefused);
  /// Deletes the temporary folder unless Commit or Keep was called.
  ~WholeFolder();
  WholeFolder(const WholeFolder&) = delete;
  WholeFolder& operator=(const WholeFolder&) = delete;

  /// Folder to write into until Commit.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Deletes the content. The folder is then deleted by the destructor unless Commit or Keep
  /// follows.
  void Clear();
  /// The destructor keeps the content even without Commit.
  void Keep() { kept_ = true; }
  /// Renames the folder to its final name. Throws InputError on failure.
  void Commit();

 private:
  std::filesystem::path folder_, temporary_;
  std::unique_ptr<FolderLock> lock_;
  bool committed_ = false, kept_ = false;
};

/// Throws InputError if a stopped run left an incomplete folder for `folder`.
void RequireNoneStopped(const std::filesystem::path& folder);

/// True for a file or a folder that is not empty.
bool HoldsSomething(const std::filesystem::path& path);
/// Throws InputError if the path already holds a file or a non-empty folder.
void RequireNothingAt(const std::filesystem::path& path);

/// Renames a folder. Throws InputError on failure.
void GiveName(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace tera
