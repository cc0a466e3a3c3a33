#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace tera {

/// Texts of YAML files, each as it was when it was first read. Any thread may use it.
class KeptTexts {
 public:
  /// While it exists, configurations of this thread read their files through `texts`.
  class Reading {
   public:
    explicit Reading(KeptTexts* texts);
    ~Reading();
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

   private:
    KeptTexts* outer_;
  };

  /// The text of `file` by this thread's Reading, or from the disk. Returns nullopt if unreadable.
  static std::optional<std::string> TextOf(const std::filesystem::path& file);

 private:
  std::mutex mutex_;
  std::map<std::filesystem::path, std::string> texts_;
};

}  // namespace tera
