#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "core/types/labels.h"
#include "dataset/format/recording.h"

namespace tera {

/// The objects in a recording's dataset.yaml.
class InstanceTable {
 public:
  struct Entry {
    std::string name;
    SemanticClass label = SemanticClass::kSky;
    std::uint16_t parent = 0;  ///< 0: top-level object
  };

  /// Throws InputError if an object has an unknown class, or is a part of itself.
  explicit InstanceTable(const Recording& recording);

  /// Throws InputError about `file`, which has the number, if dataset.yaml lists no such object.
  const Entry& Of(std::uint16_t instance, const std::filesystem::path& file) const;
  /// The object and the wholes that contain it, smallest first.
  const std::vector<std::uint16_t>& WithWholes(std::uint16_t instance,
                                               const std::filesystem::path& file) const;

 private:
  void FindWholes(const std::filesystem::path& yaml);

  std::map<std::uint16_t, Entry> entries_;
  std::map<std::uint16_t, std::vector<std::uint16_t>> with_wholes_;
};

}  // namespace tera
