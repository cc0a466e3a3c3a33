#pragma once

#include <algorithm>
#include <functional>
#include <optional>

#include "render/gl/gl_objects.h"
#include "render/gl/passes/texture_bank.h"
#include "render/gl/passes/worn_surfaces.h"
#include "render/gl/view.h"
#include "render/scene.h"

namespace tera {

/// Draws the meshes of the scene's nodes.
///
/// Model   all constant meshes share one vertex and one index buffer; each deforming mesh has its
///         own. An instance buffer holds the eye-relative pose and the label of each drawn node.
///         Passes that need only positions (shadows, pixel counts) draw welded meshes (Weld).
class NodeRenderer {
 public:
  explicit NodeRenderer(const SceneModel& model);

  enum class Surface { kOpaque, kGlass };

  /// Uploads the deforming meshes of `state` that have changed.
  void Reshape(const SceneState& state);

  /// Computes the poses of the nodes relative to `eye_W_m`. With `view`, nodes outside it are
  /// omitted. Opaque nodes are ordered near to far, glass nodes far to near. Draw functions draw
  /// the nodes placed last.
  void Place(const SceneState& state, const Vec3& eye_W_m, const View* view);
  /// Draws with the current program. Vertex attributes: 0 position, 1 normal, 2 square root of
  /// albedo and opacity, 3 roughness and metallic, 4 to 6 rows of the pose, 7 label, 8 texture
  /// coordinates.
  void Draw(Surface surface) const;
  /// Draws the opaque nodes as seen in `view`: textured materials with `textured`, others with
  /// `plain`. Both programs must have the view's uniforms. Worn nodes use other programs.
  void DrawOpaque(const Program& plain, const Program& textured, const View& view) const;
  /// Draws emissive surfaces with `program`, which must be current.
  void DrawLights(const Program& program) const;
  /// Draws opaque and glass nodes with `program`, which must be current. Sets its uniform `u_body`
  /// to the node's body index plus 1.
  void DrawBodies(const Program& program) const;
  /// Draws the opaque nodes for which `wanted` is true; its arguments are the node and its bounding
  /// sphere. Only attributes 0 and 4 to 6 are set. `is_whole` is true for a node that the near
  /// plane does not cut; back faces of its closed surfaces are culled.
  using Wanted =
      std::function<bool(const SceneNode& node, const Vec3& centre_W_m, double radius_m)>;
  void DrawOpaqueIf(const Wanted& wanted, const Wanted& is_whole) const;
  /// Draws the opaque and glass nodes of one instance. Only attributes 0 and 4 to 6 are set. `view`
  /// decides which nodes the near plane cuts.
  void DrawInstance(std::uint16_t instance, const View& view) const;

  /// True if a glass node is placed.
  bool has_glass() const { return !placed_glass_.empty(); }
  /// True if the scene has emissive surfaces.
  bool has_lights() const { return has_lights_; }
  /// Triangles since construction.
  std::int64_t triangles_drawn() const { return triangles_drawn_; }

  /// Bounding box of all nodes of `state` in the axes that `R_LW` rotates to.
  Eigen::AlignedBox3d BoundsAlong(const Mat3& R_LW, const SceneState& state) const;

 private:
  /// Triangles of one textured material, or of all plain materials of one surface type.
  struct Batch {
    Surface surface = Surface::kOpaque;
    int look = TextureBank::kPlain;  ///< index in the texture bank
    int first_index = 0, index_count = 0;
  };
  /// Triangles of positions only; closed and open surfaces are separate.
  struct Bare {
    Batch closed, open;
  };
  struct GpuMesh {
    std::vector<Batch> batches;
    int first_vertex = 0;
    bool has(Surface surface) const {
      return std::any_of(batches.begin(), batches.end(),
                         [&](const Batch& batch) { return batch.surface == surface; });
    }
    Eigen::AlignedBox3d box_G_m;
    const GlObject* array = nullptr;  ///< vertex array of its buffers
    Bare bare_opaque, bare_glass;
    int first_bare_vertex = 0;
    const GlObject* bare_array = nullptr;
  };
  struct GpuBuffers {
    GlObject vertices, indices, array;
    GlObject bare_vertices, bare_indices, bare_array;
  };
  /// A deforming mesh as last uploaded.
  struct GpuShape {
    std::shared_ptr<const ShapedMesh> taken;
    GpuMesh mesh;
    GpuBuffers buffers;
  };
  struct Collected;
  struct Placed {
    int node;
    double distance_m;
    Vec3 centre_W_m;
    double radius_m;
  };

  /// The mesh of a node. It is empty for an invisible shape.
  const GpuMesh& MeshOf(const SceneNode& node) const {
    return node.shape >= 0 ? shapes_[node.shape].mesh : meshes_[node.mesh];
  }
  GpuBuffers Upload(const Collected& collected) const;
  void DrawNode(int node, Surface surface) const;
  void DrawBare(int node, Surface surface, bool half_of_closed) const;
  void DrawBatch(int node, int first_vertex, const Batch& batch) const;

  const SceneModel& model_;
  TextureBank textures_;
  std::optional<WornSurfaces> worn_;  ///< empty if no node is worn
  bool has_lights_ = false;
  std::vector<GpuMesh> meshes_;
  std::vector<GpuShape> shapes_;
  GlObject instances_;
  GpuBuffers constant_;  ///< buffers of the constant meshes
  std::vector<Placed> placed_opaque_, placed_glass_;
  mutable std::int64_t triangles_drawn_ = 0;
};

/// Label of a pixel as one word: class in the low 8 bits, instance in the next 16.
constexpr std::uint32_t LabelWord(SemanticClass label, std::uint16_t instance) {
  return static_cast<std::uint32_t>(label) | (static_cast<std::uint32_t>(instance) << 8);
}

}  // namespace tera
