#pragma once

#include "render/gl/gl_objects.h"
#include "render/ground/surroundings.h"

namespace tera {

/// The land around the site, as a mesh on the GPU.
class Apron {
 public:
  Apron() = default;
  explicit Apron(Surroundings surroundings);
  /// Adjusts the inner edge to the heights of the site's border.
  void Update(const TerrainSurface& terrain);
  /// Vertex attributes: 0 position in W, 1 normal, 2 square root of the albedo.
  void Draw() const;
  int triangles() const { return static_cast<int>(land_.indices().size() / 3); }

 private:
  Surroundings land_;
  GlObject vertex_buffer_, indices_, array_;
};

}  // namespace tera
