#include "dataset/files/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/error.h"

namespace tera {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) {
    throw InputError(folder.string(),
                     {FaultKind::kUnreadable,
                      fmt::format("cannot be opened: {}", std::generic_category().message(errno))});
  }
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  // Some network file systems do not support locks. There the user must prevent concurrent writers.
  if (errno != EWOULDBLOCK) return;
  close(descriptor_);
  throw InputError(folder.string(),
                   {FaultKind::kUnwritable,
                    "another run is writing it; wait until it ends, or choose another place"});
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace tera
