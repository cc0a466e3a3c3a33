#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace tera {

/// Cache of YAML file texts. A file keeps the text of its first read even if the file changes
/// later. Thread-safe.
class KeptTexts {
 public:
  /// While a Reading exists, all configurations of its thread read their files from `texts`.
  class Reading {
   public:
    explicit Reading(KeptTexts* texts);
    ~Reading();
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

   private:
    KeptTexts* outer_;
  };

  /// Text of `file` from the cache that this thread reads, or from disk without one. Returns
  /// nullopt if the file is unreadable.
  static std::optional<std::string> TextOf(const std::filesystem::path& file);

 private:
  std::mutex mutex_;
  std::map<std::filesystem::path, std::string> texts_;
};

}  // namespace tera
