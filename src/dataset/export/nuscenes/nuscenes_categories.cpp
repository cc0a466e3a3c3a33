#include "dataset/export/nuscenes/nuscenes_categories.h"

#include <algorithm>

#include "core/check.h"

namespace tera {
namespace {

constexpr std::string_view NameOfCategory(SemanticClass label) {
  switch (label) {
    case SemanticClass::kSky:  // no ray hits the sky
    case SemanticClass::kDust:
    case SemanticClass::kRain:
      return "noise";
    case SemanticClass::kTerrain:
      return "flat.terrain";
    case SemanticClass::kUndercarriage:
    case SemanticClass::kUpperStructure:
    case SemanticClass::kBoom:
    case SemanticClass::kArm:
    case SemanticClass::kBucket:
    case SemanticClass::kBlade:
    case SemanticClass::kTrack:
    case SemanticClass::kVehicle:
      return "vehicle.construction";
    case SemanticClass::kTruck:
      return "vehicle.truck";
    case SemanticClass::kPerson:
      return "human.pedestrian.construction_worker";
    case SemanticClass::kRock:
      return "movable_object.debris";
    case SemanticClass::kBarrier:
      return "movable_object.barrier";
    case SemanticClass::kCone:
      return "movable_object.trafficcone";
    case SemanticClass::kStructure:
      return "static.manmade";
    case SemanticClass::kSoilInBucket:
      return "static.other";
    case SemanticClass::kVegetation:
      return "static.vegetation";
  }
  return "";
}

}  // namespace

std::uint8_t NuScenesCategoryOf(SemanticClass label) {
  const auto found =
      std::find(kNuScenesCategories.begin(), kNuScenesCategories.end(), NameOfCategory(label));
  TERA_CHECK(found != kNuScenesCategories.end());
  return static_cast<std::uint8_t>(found - kNuScenesCategories.begin());
}

}  // namespace tera
