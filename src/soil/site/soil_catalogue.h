#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"
#include "soil/soil.h"

namespace tera {

/// The soils that a site names, each listed once.
class SoilCatalogue {
 public:
  /// Starts with the soils of `custom_soils`.
  explicit SoilCatalogue(const ConfigMap& config);

  /// Index of the soil `name`. Loads a shipped soil at its first use. An unknown name is a fault of
  /// `key` in `at`.
  std::uint8_t Index(const ConfigMap& at, std::string_view key, const std::string& name);

  const std::vector<SoilType>& soils() const { return soils_; }

 private:
  std::optional<std::uint8_t> Find(const std::string& name) const;

  std::vector<SoilType> soils_;
};

}  // namespace tera
