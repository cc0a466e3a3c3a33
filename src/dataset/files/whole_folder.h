#pragma once

#include <filesystem>
#include <memory>

namespace tera {

class FolderLock;

/// Where a recording or another folder is until it is finished, without a slash at the end.
std::filesystem::path IncompleteOf(const std::filesystem::path& directory);

/// A folder that is written beside its place and appears there when it is whole.
///
/// It goes to `<folder>.incomplete`, as recordings do; what cannot be gone on with, such
/// as a report, is gone again where it is not completed.
class WholeFolder {
 public:
  /// What is done where a stopped run has left something.
  enum class Left {
    kIsRefused,
    kIsKept  ///< it is there to be gone on with, and stays also without Commit
  };

  /// Makes the folder beside, with its parents. Throws InputError where it cannot be made, where
  /// another run writes it, or where a stopped one has left something that is refused.
  explicit WholeFolder(const std::filesystem::path& folder, Left left = Left::kIsRefused);
  /// Without Commit or Keep, removes what was written.
  ~WholeFolder();
  WholeFolder(const WholeFolder&) = delete;
  WholeFolder& operator=(const WholeFolder&) = delete;

  /// Where to write before Commit.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Removes what is in it, and without Commit or Keep also what comes.
  void Clear();
  /// What is in it stays, also without Commit.
  void Keep() { kept_ = true; }
  /// Gives the folder its name. Throws InputError.
  void Commit();

 private:
  std::filesystem::path folder_, temporary_;
  std::unique_ptr<FolderLock> lock_;
  bool committed_ = false, kept_ = false;
};

/// Throws InputError where a run that was stopped has left something beside a folder.
void RequireNoneStopped(const std::filesystem::path& folder);

/// Whether there is a file, or a folder that is not empty.
bool HoldsSomething(const std::filesystem::path& path);
/// Throws InputError where there is such a thing: something is about to be written there.
void RequireNothingAt(const std::filesystem::path& path);

/// Renames a folder. Throws InputError.
void GiveName(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace tera
