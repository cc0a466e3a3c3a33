#include "render/gl/passes/node_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/check.h"
#include "render/meshes/weld.h"

namespace tera {
namespace {

struct Vertex {
  float position_m[3];
  std::int16_t normal[4];
  std::uint8_t albedo_opacity[4];      // square roots: the steps of a byte then suit the eye
  std::uint8_t roughness_metallic[4];  // only the first two bytes are used
  float uv[2];
};

struct NodeInstance {
  float pose_rows[3][4];  // mesh coordinates to eye-relative W axes
  std::uint32_t label;
};

void AppendVertices(const MeshPart& part, std::vector<Vertex>* vertices) {
  const Material& m = part.material;
  for (std::size_t i = 0; i < part.positions_m.size(); ++i) {
    const Vec3 albedo = part.albedos.empty() ? m.albedo : Vec3(part.albedos[i].cast<double>());
    Vertex v{};
    for (int k = 0; k < 3; ++k) {
      v.position_m[k] = part.positions_m[i][k];
      v.normal[k] = static_cast<std::int16_t>(std::lround(part.normals[i][k] * 32767.0f));
      v.albedo_opacity[k] = Unorm8(std::sqrt(std::max(albedo[k], 0.0)));
    }
    v.albedo_opacity[3] = Unorm8(m.opacity);
    v.roughness_metallic[0] = Unorm8(m.roughness);
    v.roughness_metallic[1] = Unorm8(m.metallic);
    for (int k = 0; k < 2 && !part.uvs.empty(); ++k) v.uv[k] = part.uvs[i][k];
    vertices->push_back(v);
  }
}

void AppendIndices(const MeshPart& part, std::uint32_t first_vertex,
                   std::vector<std::uint32_t>* indices) {
  for (std::uint32_t index : part.indices) indices->push_back(first_vertex + index);
}

/// Instance attributes: rows of the pose.
void DescribePoses(GLuint array) {
  for (GLuint row = 0; row < 3; ++row) {
    glEnableVertexArrayAttrib(array, 4 + row);
    glVertexArrayAttribFormat(array, 4 + row, 4, GL_FLOAT, GL_FALSE,
                              row * 4 * static_cast<GLuint>(sizeof(float)));
    glVertexArrayAttribBinding(array, 4 + row, 1);
  }
  glVertexArrayBindingDivisor(array, 1, 1);
}

void DescribeVertices(GLuint array) {
  const auto attribute = [&](GLuint index, GLint size, GLenum type, bool normalized,
                             std::size_t offset, GLuint binding) {
    glEnableVertexArrayAttrib(array, index);
    glVertexArrayAttribFormat(array, index, size, type, normalized, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(array, index, binding);
  };
  attribute(0, 3, GL_FLOAT, false, offsetof(Vertex, position_m), 0);
  attribute(1, 4, GL_SHORT, true, offsetof(Vertex, normal), 0);
  attribute(2, 4, GL_UNSIGNED_BYTE, true, offsetof(Vertex, albedo_opacity), 0);
  attribute(3, 4, GL_UNSIGNED_BYTE, true, offsetof(Vertex, roughness_metallic), 0);
  attribute(8, 2, GL_FLOAT, false, offsetof(Vertex, uv), 0);
  DescribePoses(array);
  glEnableVertexArrayAttrib(array, 7);
  glVertexArrayAttribIFormat(array, 7, 1, GL_UNSIGNED_INT, offsetof(NodeInstance, label));
  glVertexArrayAttribBinding(array, 7, 1);
}

void DescribeBareVertices(GLuint array) {
  glEnableVertexArrayAttrib(array, 0);
  glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array, 0, 0);
  DescribePoses(array);
}

/// Mesh coordinates to W.
Eigen::Affine3d NodeToWorld(const SceneNode& node, const SceneState& state) {
  return state.X_WB[node.body] * node.X_BG * Eigen::Scaling(node.scale);
}

}  // namespace

/// Vertices and indices to upload.
struct NodeRenderer::Collected {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Eigen::Vector3f> bare_vertices;
  std::vector<std::uint32_t> bare_indices;

  GpuMesh Add(const std::vector<MeshPart>& parts, TextureBank* textures) {
    GpuMesh mesh;
    mesh.first_vertex = static_cast<int>(vertices.size());
    for (const Surface surface : {Surface::kOpaque, Surface::kGlass}) {
      Batch plain = Begin(surface, TextureBank::kPlain);
      std::vector<std::pair<int, const MeshPart*>> rich;
      for (const MeshPart& part : parts) {
        const bool is_glass = part.material.opacity < 1.0;
        if (is_glass != (surface == Surface::kGlass)) continue;
        const int look = is_glass ? TextureBank::kPlain : textures->Add(part.material);
        if (look != TextureBank::kPlain) {
          rich.emplace_back(look, &part);
        } else {
          AddTo(&plain, part, &mesh);
        }
      }
      if (plain.index_count > 0) mesh.batches.push_back(plain);
      for (const auto& [look, part] : rich) {
        Batch batch = Begin(surface, look);
        AddTo(&batch, *part, &mesh);
        mesh.batches.push_back(batch);
      }
    }
    AddBare(parts, &mesh);
    return mesh;
  }

 private:
  Batch Begin(Surface surface, int look) const {
    return {surface, look, static_cast<int>(indices.size()), 0};
  }
  void AddTo(Batch* batch, const MeshPart& part, GpuMesh* mesh) {
    AppendIndices(part, static_cast<std::uint32_t>(vertices.size() - mesh->first_vertex), &indices);
    AppendVertices(part, &vertices);
    for (const Eigen::Vector3f& p : part.positions_m) mesh->box_G_m.extend(p.cast<double>());
    batch->index_count = static_cast<int>(indices.size()) - batch->first_index;
  }
  void AddBare(const std::vector<MeshPart>& parts, GpuMesh* mesh) {
    mesh->first_bare_vertex = static_cast<int>(bare_vertices.size());
    for (const Surface surface : {Surface::kOpaque, Surface::kGlass}) {
      std::vector<const MeshPart*> chosen;
      for (const MeshPart& part : parts) {
        if ((part.material.opacity < 1.0) == (surface == Surface::kGlass)) chosen.push_back(&part);
      }
      const Welded welded = Weld(chosen);
      const auto first = static_cast<int>(bare_indices.size());
      const auto closed = static_cast<int>(welded.closed),
                 all = static_cast<int>(welded.indices.size());
      (surface == Surface::kOpaque ? mesh->bare_opaque : mesh->bare_glass) = {
          {surface, TextureBank::kPlain, first, closed},
          {surface, TextureBank::kPlain, first + closed, all - closed}};
      const auto shift = static_cast<std::uint32_t>(bare_vertices.size() - mesh->first_bare_vertex);
      for (const std::uint32_t index : welded.indices) bare_indices.push_back(shift + index);
      bare_vertices.insert(bare_vertices.end(), welded.positions_m.begin(),
                           welded.positions_m.end());
    }
  }
};

NodeRenderer::NodeRenderer(const SceneModel& model)
    : model_(model),
      shapes_(model.shape_count),
      instances_(MakeBuffer(model.nodes.size() * sizeof(NodeInstance), nullptr)) {
  if (std::ranges::any_of(model.nodes, [](const SceneNode& n) { return n.wear != nullptr; })) {
    worn_.emplace();
  }
  Collected collected;
  for (const Mesh& mesh : model.meshes) meshes_.push_back(collected.Add(mesh.parts, &textures_));
  constant_ = Upload(collected);
  for (GpuMesh& mesh : meshes_) {
    mesh.array = &constant_.array;
    mesh.bare_array = &constant_.bare_array;
    for (const Batch& batch : mesh.batches) {
      has_lights_ = has_lights_ || textures_.gives_light(batch.look);
    }
  }
}

NodeRenderer::GpuBuffers NodeRenderer::Upload(const Collected& collected) const {
  GpuBuffers buffers;
  buffers.vertices =
      MakeBuffer(collected.vertices.size() * sizeof(Vertex), collected.vertices.data());
  buffers.indices =
      MakeBuffer(collected.indices.size() * sizeof(std::uint32_t), collected.indices.data());
  buffers.array = MakeVertexArray();
  const GLuint array = buffers.array.id();
  DescribeVertices(array);
  glVertexArrayVertexBuffer(array, 0, buffers.vertices.id(), 0, sizeof(Vertex));
  glVertexArrayVertexBuffer(array, 1, instances_.id(), 0, sizeof(NodeInstance));
  glVertexArrayElementBuffer(array, buffers.indices.id());

  buffers.bare_vertices = MakeBuffer(collected.bare_vertices.size() * sizeof(Eigen::Vector3f),
                                     collected.bare_vertices.data());
  buffers.bare_indices = MakeBuffer(collected.bare_indices.size() * sizeof(std::uint32_t),
                                    collected.bare_indices.data());
  buffers.bare_array = MakeVertexArray();
  const GLuint bare = buffers.bare_array.id();
  DescribeBareVertices(bare);
  glVertexArrayVertexBuffer(bare, 0, buffers.bare_vertices.id(), 0, sizeof(Eigen::Vector3f));
  glVertexArrayVertexBuffer(bare, 1, instances_.id(), 0, sizeof(NodeInstance));
  glVertexArrayElementBuffer(bare, buffers.bare_indices.id());
  return buffers;
}

void NodeRenderer::Reshape(const SceneState& state) {
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    GpuShape& shape = shapes_[k];
    const ShapedMesh* now = ShapeAt(state.shapes, static_cast<int>(k));
    if (AreAlike(now, shape.taken.get())) continue;
    shape = {};
    if (now == nullptr) continue;
    Collected collected;
    shape.taken = state.shapes[k];
    shape.mesh = collected.Add(now->parts, &textures_);
    shape.buffers = Upload(collected);
    shape.mesh.array = &shape.buffers.array;
    shape.mesh.bare_array = &shape.buffers.bare_array;
  }
}

void NodeRenderer::Place(const SceneState& state, const Vec3& eye_W_m, const View* view) {
  placed_opaque_.clear();
  placed_glass_.clear();
  std::vector<NodeInstance> instances(model_.nodes.size());
  for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
    const SceneNode& node = model_.nodes[n];
    const GpuMesh& mesh = MeshOf(node);
    if (mesh.box_G_m.isEmpty()) continue;
    const Eigen::Affine3d X_WG = NodeToWorld(node, state);
    const Vec3 centre_W_m = X_WG * mesh.box_G_m.center();
    const double radius_m =
        0.5 * mesh.box_G_m.diagonal().norm() * std::cbrt(std::abs(X_WG.linear().determinant()));
    if (view != nullptr && !view->SeesSphere(centre_W_m, radius_m)) continue;
    NodeInstance& instance = instances[n];
    for (int row = 0; row < 3; ++row) {
      for (int k = 0; k < 3; ++k) {
        instance.pose_rows[row][k] = static_cast<float>(X_WG.linear()(row, k));
      }
      instance.pose_rows[row][3] = static_cast<float>(X_WG.translation()[row] - eye_W_m[row]);
    }
    instance.label = LabelWord(node.label, node.instance);
    const Placed placed{static_cast<int>(n), (centre_W_m - eye_W_m).norm() - radius_m, centre_W_m,
                        radius_m};
    if (mesh.has(Surface::kOpaque)) placed_opaque_.push_back(placed);
    if (mesh.has(Surface::kGlass)) placed_glass_.push_back(placed);
  }
  std::stable_sort(placed_opaque_.begin(), placed_opaque_.end(),
                   [](const Placed& a, const Placed& b) { return a.distance_m < b.distance_m; });
  std::stable_sort(placed_glass_.begin(), placed_glass_.end(),
                   [](const Placed& a, const Placed& b) { return a.distance_m > b.distance_m; });
  if (instances.empty()) return;
  glNamedBufferSubData(instances_.id(), 0,
                       static_cast<GLsizeiptr>(instances.size() * sizeof(NodeInstance)),
                       instances.data());
}

/// Draws a node's triangles with the bound array.
void NodeRenderer::DrawBatch(int node, int first_vertex, const Batch& batch) const {
  const auto offset = static_cast<std::uintptr_t>(batch.first_index) * sizeof(std::uint32_t);
  glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, batch.index_count, GL_UNSIGNED_INT,
                                                reinterpret_cast<const void*>(offset), 1,
                                                first_vertex, static_cast<GLuint>(node));
  triangles_drawn_ += batch.index_count / 3;
}

void NodeRenderer::DrawNode(int node, Surface surface) const {
  const GpuMesh& mesh = MeshOf(model_.nodes[node]);
  glBindVertexArray(mesh.array->id());
  for (const Batch& batch : mesh.batches) {
    if (batch.surface == surface) DrawBatch(node, mesh.first_vertex, batch);
  }
}

/// Draws the position-only triangles of a node. `half_of_closed` culls the back faces of closed
/// surfaces.
void NodeRenderer::DrawBare(int node, Surface surface, bool half_of_closed) const {
  const GpuMesh& mesh = MeshOf(model_.nodes[node]);
  const Bare& bare = surface == Surface::kOpaque ? mesh.bare_opaque : mesh.bare_glass;
  glBindVertexArray(mesh.bare_array->id());
  if (bare.closed.index_count > 0) {
    if (half_of_closed) glEnable(GL_CULL_FACE);
    if (model_.nodes[node].scale < 0) glFrontFace(GL_CW);  // mirrored
    DrawBatch(node, mesh.first_bare_vertex, bare.closed);
    glFrontFace(GL_CCW);
    glDisable(GL_CULL_FACE);
  }
  if (bare.open.index_count > 0) DrawBatch(node, mesh.first_bare_vertex, bare.open);
}

void NodeRenderer::Draw(Surface surface) const {
  for (const Placed& placed : surface == Surface::kGlass ? placed_glass_ : placed_opaque_) {
    DrawNode(placed.node, surface);
  }
}

void NodeRenderer::DrawOpaque(const Program& plain, const Program& textured,
                              const View& view) const {
  if (worn_) worn_->SetView(view.ClipFromRelative());
  for (const Placed& placed : placed_opaque_) {
    const GpuMesh& mesh = MeshOf(model_.nodes[placed.node]);
    glBindVertexArray(mesh.array->id());
    for (const Batch& batch : mesh.batches) {
      if (batch.surface != Surface::kOpaque) continue;
      const bool is_plain = batch.look == TextureBank::kPlain;
      const SceneNode& node = model_.nodes[placed.node];
      const Program& fresh = is_plain ? plain : textured;
      const Program& program = node.wear ? worn_->Use(node, !is_plain) : fresh;
      program.Use();
      if (!is_plain) textures_.Bind(batch.look, program);
      DrawBatch(placed.node, mesh.first_vertex, batch);
    }
  }
}

void NodeRenderer::DrawLights(const Program& program) const {
  for (const Placed& placed : placed_opaque_) {
    const GpuMesh& mesh = MeshOf(model_.nodes[placed.node]);
    glBindVertexArray(mesh.array->id());
    for (const Batch& batch : mesh.batches) {
      if (!textures_.gives_light(batch.look)) continue;
      textures_.Bind(batch.look, program);
      DrawBatch(placed.node, mesh.first_vertex, batch);
    }
  }
}

void NodeRenderer::DrawBodies(const Program& program) const {
  const auto draw = [&](const std::vector<Placed>& placed, Surface surface) {
    for (const Placed& one : placed) {
      program.Set("u_body", model_.nodes[one.node].body + 1);
      DrawNode(one.node, surface);
    }
  };
  draw(placed_opaque_, Surface::kOpaque);
  draw(placed_glass_, Surface::kGlass);
}

void NodeRenderer::DrawOpaqueIf(const Wanted& wanted, const Wanted& is_whole) const {
  for (const Placed& placed : placed_opaque_) {
    const SceneNode& node = model_.nodes[placed.node];
    if (!wanted(node, placed.centre_W_m, placed.radius_m)) continue;
    DrawBare(placed.node, Surface::kOpaque, is_whole(node, placed.centre_W_m, placed.radius_m));
  }
}

void NodeRenderer::DrawInstance(std::uint16_t instance, const View& view) const {
  const auto draw = [&](const std::vector<Placed>& placed, Surface surface) {
    for (const Placed& one : placed) {
      if (model_.nodes[one.node].instance != instance) continue;
      // A surface cut by the near plane is no longer closed.
      const double ahead_m = (one.centre_W_m - view.eye_W_m).dot(view.R_WC.col(2));
      DrawBare(one.node, surface, ahead_m - one.radius_m > view.near_m);
    }
  };
  draw(placed_opaque_, Surface::kOpaque);
  draw(placed_glass_, Surface::kGlass);
}

Eigen::AlignedBox3d NodeRenderer::BoundsAlong(const Mat3& R_LW, const SceneState& state) const {
  Eigen::AlignedBox3d bounds;
  for (const SceneNode& node : model_.nodes) {
    const Eigen::AlignedBox3d& box = MeshOf(node).box_G_m;
    if (box.isEmpty()) continue;
    const Eigen::Affine3d X_LG = R_LW * NodeToWorld(node, state);
    for (int corner = 0; corner < 8; ++corner) {
      bounds.extend(X_LG * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    }
  }
  return bounds;
}

}  // namespace tera
