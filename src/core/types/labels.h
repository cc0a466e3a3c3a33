#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace tera {

/// Semantic class of a surface. Label images and scans store these numbers, so existing values
/// never change; new classes get the next value.
enum class SemanticClass : std::uint8_t {
  kSky = 0,      ///< no surface
  kTerrain = 1,  ///< undisturbed or disturbed ground
  kUndercarriage = 2,
  kUpperStructure = 3,
  kBoom = 4,
  kArm = 5,
  kBucket = 6,
  kBlade = 7,
  kTrack = 8,
  kVehicle = 9,  ///< a machine of another kind, labelled as a whole
  kTruck = 10,
  kPerson = 11,
  kRock = 12,
  kBarrier = 13,
  kCone = 14,
  kStructure = 15,
  kSoilInBucket = 16,
  kVegetation = 17,
  kDust = 18,  ///< airborne dust; only in scans
  kRain = 19,  ///< falling drops; only in scans
};

struct SemanticClassInfo {
  SemanticClass label;
  std::string_view name;            ///< name in YAML and dataset.yaml
  std::array<std::uint8_t, 3> rgb;  ///< colour in overview images
};

/// All classes, in order of value.
inline constexpr std::array<SemanticClassInfo, 20> kSemanticClasses = {{
    {SemanticClass::kSky, "sky", {135, 190, 235}},
    {SemanticClass::kTerrain, "terrain", {134, 96, 67}},
    {SemanticClass::kUndercarriage, "undercarriage", {90, 90, 100}},
    {SemanticClass::kUpperStructure, "upper_structure", {230, 60, 40}},
    {SemanticClass::kBoom, "boom", {250, 170, 30}},
    {SemanticClass::kArm, "arm", {150, 220, 50}},
    {SemanticClass::kBucket, "bucket", {30, 190, 200}},
    {SemanticClass::kBlade, "blade", {60, 90, 220}},
    {SemanticClass::kTrack, "track", {40, 40, 45}},
    {SemanticClass::kVehicle, "vehicle", {200, 120, 200}},
    {SemanticClass::kTruck, "truck", {130, 60, 190}},
    {SemanticClass::kPerson, "person", {255, 40, 160}},
    {SemanticClass::kRock, "rock", {150, 150, 150}},
    {SemanticClass::kBarrier, "barrier", {240, 240, 120}},
    {SemanticClass::kCone, "cone", {255, 110, 0}},
    {SemanticClass::kStructure, "structure", {180, 170, 150}},
    {SemanticClass::kSoilInBucket, "soil_in_bucket", {90, 60, 30}},
    {SemanticClass::kVegetation, "vegetation", {60, 140, 60}},
    {SemanticClass::kDust, "dust", {235, 205, 150}},
    {SemanticClass::kRain, "rain", {120, 160, 255}},
}};

constexpr std::string_view NameOf(SemanticClass label) {
  return kSemanticClasses[static_cast<std::size_t>(label)].name;
}

constexpr std::optional<SemanticClass> SemanticClassFromName(std::string_view name) {
  for (const SemanticClassInfo& info : kSemanticClasses) {
    if (info.name == name) return info.label;
  }
  return std::nullopt;
}

}  // namespace tera
