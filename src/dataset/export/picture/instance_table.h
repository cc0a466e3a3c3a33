#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "core/types/labels.h"
#include "dataset/format/recording.h"

namespace tera {

/// Objects listed in a recording's dataset.yaml.
class InstanceTable {
 public:
  struct Entry {
    std::string name;
    SemanticClass label = SemanticClass::kSky;
    std::uint16_t parent = 0;  ///< 0 for an object that is not part of another
  };

  /// Throws InputError if an object has an unknown class or is contained in itself.
  explicit InstanceTable(const Recording& recording);

  /// Entry of an instance that occurs in `file`. Throws InputError if dataset.yaml does not list
  /// it.
  const Entry& Of(std::uint16_t instance, const std::filesystem::path& file) const;
  /// The object, then its parent, the parent's parent and so on.
  const std::vector<std::uint16_t>& WithWholes(std::uint16_t instance,
                                               const std::filesystem::path& file) const;

 private:
  void FindWholes(const std::filesystem::path& yaml);

  std::map<std::uint16_t, Entry> entries_;
  std::map<std::uint16_t, std::vector<std::uint16_t>> with_wholes_;
};

}  // namespace tera
