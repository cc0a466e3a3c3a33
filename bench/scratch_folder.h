#pragma once

#include <filesystem>
#include <string>

namespace tera::bench {

/// A folder for one benchmark's files, under the system's temporary folder; gone with the object.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void Empty() const;

 private:
  std::filesystem::path path_;
};

}  // namespace tera::bench
