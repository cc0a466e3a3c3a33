#include "render/rays/body_shape.h"

#include <algorithm>
#include <cstdint>

#include "render/air/wet_surface.h"
#include "render/meshes/near_infrared.h"

namespace tera {
namespace {

/// A water film does not change the reflectance of glass and bare metal.
double ReflectanceOf(const Material& material, SemanticClass label, bool is_wet) {
  const double dry = NearInfrared(material, label);
  const bool is_diffuse = material.opacity >= 1 && material.metallic < 0.5;
  return is_wet && is_diffuse ? WetReflectance(dry) : dry;
}

void AttachPart(RTCDevice device, const MeshPart& part, const Pose& X_BG, double scale,
                RTCScene scene) {
  const EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), part.positions_m.size()));
  for (std::size_t i = 0; i < part.positions_m.size(); ++i) {
    const Eigen::Vector3f p_B = (X_BG * (scale * part.positions_m[i].cast<double>())).cast<float>();
    std::copy_n(p_B.data(), 3, vertices + 3 * i);
  }
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), part.indices.size() / 3));
  std::copy(part.indices.begin(), part.indices.end(), indices);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene, geometry.get());
}

}  // namespace

bool BodyShape::Alike(const BodyShape& o) const {
  if (meshes != o.meshes || labels != o.labels || scale != o.scale) return false;
  for (std::size_t i = 0; i < X_BG.size(); ++i) {
    if (X_BG[i].matrix() != o.X_BG[i].matrix()) return false;
  }
  return true;
}

EmbreeScene NewScene(RTCDevice device) {
  EmbreeScene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  return scene;
}

void AttachParts(RTCDevice device, const std::vector<MeshPart>& parts, int node, bool is_wet,
                 BodyShape* shape) {
  for (const MeshPart& part : parts) {
    if (part.material.opacity <= 0 || part.indices.empty()) continue;
    AttachPart(device, part, shape->X_BG[node], shape->scale[node], shape->scene.get());
    shape->parts.push_back(
        {node, static_cast<float>(ReflectanceOf(part.material, shape->labels[node], is_wet)),
         static_cast<float>(part.material.opacity)});
  }
}

}  // namespace tera
