#include "dataset/files/whole_folder.h"

#include <system_error>

#include "core/config/fault_text.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/folder_lock.h"

namespace tera {
namespace fs = std::filesystem;

fs::path IncompleteOf(const fs::path& directory) {
  fs::path root = directory.has_filename() ? directory : directory.parent_path();
  root += ".incomplete";
  return root;
}

WholeFolder::WholeFolder(const fs::path& folder, Left left)
    : folder_(folder.has_filename() ? folder : folder.parent_path()),
      temporary_(IncompleteOf(folder)) {
  MakeFolder(temporary_);
  lock_ = std::make_unique<FolderLock>(temporary_);
  if (left == Left::kIsRefused) RequireNoneStopped(folder);
  kept_ = HoldsSomething(temporary_);
}

WholeFolder::~WholeFolder() {
  std::error_code ignored;
  if (!committed_ && !kept_) fs::remove_all(temporary_, ignored);
}

void WholeFolder::Clear() {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(temporary_)) {
    fs::remove_all(entry.path(), error);
    if (error) FailFile(entry.path(), "cannot be removed", error.value());
  }
  kept_ = false;
}

void WholeFolder::Commit() {
  GiveName(temporary_, folder_);
  committed_ = true;
}

void RequireNoneStopped(const fs::path& folder) {
  if (!HoldsSomething(IncompleteOf(folder))) return;
  throw InputError(IncompleteOf(folder).string(),
                   {FaultKind::kUnwritable,
                    "holds the rest of an interrupted run; choose another place or delete it"});
}

bool HoldsSomething(const fs::path& path) {
  std::error_code error;
  const bool empty = fs::is_directory(path, error) && fs::is_empty(path, error);
  return fs::exists(path, error) && !empty;
}

void GiveName(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) FailFile(to, "cannot be given its name", error.value());
}

void RequireNothingAt(const fs::path& path) {
  if (!HoldsSomething(path)) return;
  throw InputError(path.string(), fault::NotAnEmptyFolder());
}

}  // namespace tera
