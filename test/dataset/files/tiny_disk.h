#pragma once

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace tera {

/// Puts this process, which must have one thread, into a user and mount namespace of its own,
/// where it may mount. Whether the kernel lets it.
inline bool EnterOwnNamespace() {
  const std::string user = "0 " + std::to_string(geteuid()) + " 1";
  const std::string group = "0 " + std::to_string(getegid()) + " 1";
  if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
  const auto write_to = [](const char* file, const std::string& text) {
    const int descriptor = open(file, O_WRONLY | O_CLOEXEC);
    const bool written =
        write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    close(descriptor);
    return written;
  };
  return write_to("/proc/self/setgroups", "deny") && write_to("/proc/self/uid_map", user) &&
         write_to("/proc/self/gid_map", group);
}

/// A file system in memory of a stated size, for tests of full and of read-only disks. Root may
/// mount one; others in a namespace of their own, unless kernel.unprivileged_userns_clone is 0.
class TinyDisk {
 public:
  /// `size` as tmpfs takes it: "256k".
  TinyDisk(const std::filesystem::path& place, const std::string& size) : place_(place) {
    std::filesystem::create_directory(place);
    const auto mount_it = [&] {
      return mount("tmpfs", place.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
    };
    mounted_ = mount_it() || (EnterOwnNamespace() && mount_it());
  }
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;
  ~TinyDisk() {
    if (mounted_) umount2(place_.c_str(), MNT_DETACH);
  }
  bool mounted() const { return mounted_; }

  bool Grow(const std::string& size) { return Remount(0, size); }
  bool MakeReadOnly(const std::string& size) { return Remount(MS_RDONLY, size); }

 private:
  bool Remount(unsigned long flags, const std::string& size) {
    const std::string options = "size=" + size;
    return mount("tmpfs", place_.c_str(), "tmpfs", MS_REMOUNT | flags, options.c_str()) == 0;
  }

  std::filesystem::path place_;
  bool mounted_ = false;
};

}  // namespace tera
