#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/gl/gl_objects.h"
#include "render/meshes/mesh.h"

namespace tera {

/// Material textures on the GPU, with mipmaps. Materials with equal images share a texture.
class TextureBank {
 public:
  /// Adds a material and returns its index. A material with neither textures nor emission has the
  /// index kPlain.
  static constexpr int kPlain = -1;
  int Add(const Material& material);

  bool gives_light(int number) const { return number != kPlain && looks_[number].gives_light; }
  /// Sets the material inputs of node.frag (with TEXTURED) and of emissive.frag. The material must
  /// not be kPlain.
  void Bind(int number, const Program& program) const;

 private:
  enum class Coding { kLinear, kSrgb };
  struct Look {
    unsigned base_colour = 0, metallic_roughness = 0, normal = 0, occlusion = 0, emissive = 0;
    Eigen::Vector3f emission;
    float normal_scale, occlusion_strength;
    bool gives_light;
  };
  unsigned Upload(const std::shared_ptr<const Texture>& texture, Coding coding);

  std::map<std::string, GlObject> textures_;  ///< by name and coding
  std::vector<Look> looks_;
};

}  // namespace tera
