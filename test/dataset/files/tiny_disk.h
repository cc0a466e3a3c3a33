#pragma once

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace tera {

/// Moves this single-threaded process into its own user and mount namespace, where it may mount.
/// Returns whether the kernel allows it.
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

/// A file system in memory of a stated size, for tests of full and read-only disks. Root may mount
/// one directly. Other users need their own namespace, which kernel.unprivileged_userns_clone = 0
/// forbids.
class TinyDisk {
 public:
  /// `size` in tmpfs's notation: "256k".
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
