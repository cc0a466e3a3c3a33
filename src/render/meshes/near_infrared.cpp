#include "render/meshes/near_infrared.h"

#include <algorithm>

#include "render/meshes/picture_file.h"

namespace tera {

double SoilNearInfrared(const Vec3& albedo) {
  constexpr double kSlope = 1.2, kOffset = 0.04;
  return std::min(1.0, kSlope * albedo.x() + kOffset);
}

double NearInfrared(const Material& material, SemanticClass label) {
  if (material.lidar_reflectance >= 0) return material.lidar_reflectance;
  if (label == SemanticClass::kVegetation) return kLeafNearInfrared;
  Vec3 albedo = material.albedo;
  if (material.textures.base_colour) {
    albedo = albedo.cwiseProduct(MeanAlbedo(*material.textures.base_colour));
  }
  const bool is_soil = label == SemanticClass::kTerrain || label == SemanticClass::kSoilInBucket;
  return is_soil ? SoilNearInfrared(albedo) : albedo.mean();
}

}  // namespace tera
