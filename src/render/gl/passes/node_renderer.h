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
/// Model   all meshes lie in one vertex and one index buffer, each that changes in buffers of its
///         own; each node drawn is one entry of an instance buffer that holds its pose relative to
///         the eye and its label. Where only places matter (shadows, silhouettes), the triangles
///         are drawn from positions alone, of which each is there once (Weld).
class NodeRenderer {
 public:
  explicit NodeRenderer(const SceneModel& model);

  enum class Surface { kOpaque, kGlass };

  /// Takes meshes that change as they are in `state`.
  void Reshape(const SceneState& state);

  /// Nodes as they stand in `state`, relative to `eye_W_m`; those that `view` (if any) cannot see
  /// are left out. Opaque nodes are ordered from near to far, glass from far to near.
  void Place(const SceneState& state, const Vec3& eye_W_m, const View* view);
  /// Draws what Place found, with the program in use: attributes 0 position, 1 normal, 2 albedo
  /// (square roots) and opacity, 3 roughness and metallic; 4 to 6 rows of the pose, 7 the label,
  /// 8 texture coordinates.
  void Draw(Surface surface) const;
  /// Draws the opaque ones as `view` shows them with `plain` and, where a material has textures,
  /// with `textured`, both of which know the view; worn ones with programs of their own.
  void DrawOpaque(const Program& plain, const Program& textured, const View& view) const;
  /// Draws what gives light, with `program`, which is in use.
  void DrawLights(const Program& program) const;
  /// Draws what Place found, opaque and glass, each node with its body's number plus 1 as `u_body`
  /// of `program`, which is in use.
  void DrawBodies(const Program& program) const;
  /// Draws the opaque nodes that `wanted` accepts by themselves and their bounding spheres:
  /// attributes 0 and 4 to 6 only. Of the closed surfaces of those that `is_whole`, none of which
  /// the near plane cuts, only triangles are drawn that run counter-clockwise in the picture.
  using Wanted =
      std::function<bool(const SceneNode& node, const Vec3& centre_W_m, double radius_m)>;
  void DrawOpaqueIf(const Wanted& wanted, const Wanted& is_whole) const;
  /// Draws the nodes of one instance only, glass and opaque, into its silhouette in `view`:
  /// attributes 0 and 4 to 6 only.
  void DrawInstance(std::uint16_t instance, const View& view) const;

  /// Whether anything of glass was placed.
  bool has_glass() const { return !placed_glass_.empty(); }
  /// Whether anything in the scene gives light.
  bool has_lights() const { return has_lights_; }
  /// Since construction.
  std::int64_t triangles_drawn() const { return triangles_drawn_; }

  /// The box of all nodes of the scene along the axes of `R_LW`, over all of `state`.
  Eigen::AlignedBox3d BoundsAlong(const Mat3& R_LW, const SceneState& state) const;

 private:
  /// Triangles of one material, or of all plain ones of a surface.
  struct Batch {
    Surface surface = Surface::kOpaque;
    int look = TextureBank::kPlain;  ///< in the bank of textures
    int first_index = 0, index_count = 0;
  };
  /// Triangles of positions alone, those of closed surfaces apart.
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
    const GlObject* array = nullptr;  ///< of the buffers that it lies in
    Bare bare_opaque, bare_glass;
    int first_bare_vertex = 0;
    const GlObject* bare_array = nullptr;
  };
  struct GpuBuffers {
    GlObject vertices, indices, array;
    GlObject bare_vertices, bare_indices, bare_array;
  };
  /// A mesh that changes, as it was taken last.
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

  /// The mesh of a node, which is nothing where its shape is.
  const GpuMesh& MeshOf(const SceneNode& node) const {
    return node.shape >= 0 ? shapes_[node.shape].mesh : meshes_[node.mesh];
  }
  GpuBuffers Upload(const Collected& collected) const;
  void DrawNode(int node, Surface surface) const;
  void DrawBare(int node, Surface surface, bool half_of_closed) const;
  void DrawBatch(int node, int first_vertex, const Batch& batch) const;

  const SceneModel& model_;
  TextureBank textures_;
  std::optional<WornSurfaces> worn_;  ///< where a node is
  bool has_lights_ = false;
  std::vector<GpuMesh> meshes_;
  std::vector<GpuShape> shapes_;
  GlObject instances_;
  GpuBuffers constant_;  ///< of the meshes that do not change
  std::vector<Placed> placed_opaque_, placed_glass_;
  mutable std::int64_t triangles_drawn_ = 0;
};

/// Label word of a pixel: class in the low 8 bits, instance in the next 16.
constexpr std::uint32_t LabelWord(SemanticClass label, std::uint16_t instance) {
  return static_cast<std::uint32_t>(label) | (static_cast<std::uint32_t>(instance) << 8);
}

}  // namespace tera
