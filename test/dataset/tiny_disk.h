#pragma once

#include <sys/mount.h>

#include <filesystem>
#include <string>

namespace tera {

/// A file system in memory of a stated size, for tests of full and of read-only disks, where the
/// tests may mount one (as root they may).
class TinyDisk {
 public:
  /// `size` as tmpfs takes it: "256k".
  TinyDisk(const std::filesystem::path& place, const std::string& size) : place_(place) {
    std::filesystem::create_directory(place);
    mounted_ = mount("tmpfs", place.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
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
