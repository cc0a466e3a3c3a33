#pragma once

#include "render/gl/gl_objects.h"
#include "render/ground/surroundings.h"

namespace tera {

/// The land around the site on the GPU.
class Apron {
 public:
  Apron() = default;
  explicit Apron(Surroundings surroundings);
  /// Takes over the border's heights.
  void Update(const TerrainSurface& terrain);
  /// Attributes: 0 position in W, 1 normal, 2 albedo (square roots).
  void Draw() const;
  int triangles() const { return static_cast<int>(land_.indices().size() / 3); }

 private:
  Surroundings land_;
  GlObject vertex_buffer_, indices_, array_;
};

}  // namespace tera
