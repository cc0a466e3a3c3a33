#include "soil/site/soil_catalogue.h"

#include <fmt/format.h>

#include "soil/columns/soil_type.h"

namespace tera {
namespace {

constexpr std::size_t kMostSoils = 255;

}  // namespace

SoilCatalogue::SoilCatalogue(const ConfigMap& config) {
  for (const ConfigMap& custom : config.List("custom_soils")) {
    custom.ApplyPreset("preset");
    const SoilType soil = ReadSoilType(custom);
    if (Find(soil.name))
      custom.Fault("name",
                   {FaultKind::kRepeated, fmt::format("second soil named '{}'", soil.name)});
    soils_.push_back(soil);
  }
}

std::uint8_t SoilCatalogue::Index(const ConfigMap& at, std::string_view key,
                                  const std::string& name) {
  if (const auto known = Find(name)) return *known;
  if (soils_.size() >= kMostSoils) {
    at.Fault(key, {FaultKind::kOutOfRange, fmt::format("more than {} soils", kMostSoils)});
    return 0;
  }
  const auto file = ShippedSoilFile(name);
  if (!file) {
    at.Fault(key, {FaultKind::kNoSuchName,
                   fmt::format("no soil named '{}'; need one of {} or a name in custom_soils", name,
                               ShippedSoilNames())});
    return 0;
  }
  const Config preset = Config::FromFile(*file);
  soils_.push_back(ReadSoilType(preset.root()));
  preset.Finish();
  return static_cast<std::uint8_t>(soils_.size() - 1);
}

std::optional<std::uint8_t> SoilCatalogue::Find(const std::string& name) const {
  for (std::size_t k = 0; k < soils_.size(); ++k) {
    if (soils_[k].name == name) return static_cast<std::uint8_t>(k);
  }
  return std::nullopt;
}

}  // namespace tera
