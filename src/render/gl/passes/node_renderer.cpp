#include "render/gl/passes/node_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/check.h"

namespace tera {
namespace {

struct Vertex {
  float position_m[3];
  std::int16_t normal[4];
  std::uint8_t albedo_opacity[4];      // albedo as square roots, to spend 8 bits where eyes see
  std::uint8_t roughness_metallic[4];  // the last two are unused
};

struct NodeInstance {
  float pose_rows[3][4];  // (x, y, z) along W relative to the eye, from mesh coordinates
  std::uint32_t label;
};

std::uint8_t Unorm8(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0));
}

void AppendVertices(const MeshPart& part, std::vector<Vertex>* vertices) {
  const Material& m = part.material;
  for (std::size_t i = 0; i < part.positions_m.size(); ++i) {
    Vertex v{};
    for (int k = 0; k < 3; ++k) {
      v.position_m[k] = part.positions_m[i][k];
      v.normal[k] = static_cast<std::int16_t>(std::lround(part.normals[i][k] * 32767.0f));
      v.albedo_opacity[k] = Unorm8(std::sqrt(std::max(m.albedo[k], 0.0)));
    }
    v.albedo_opacity[3] = Unorm8(m.opacity);
    v.roughness_metallic[0] = Unorm8(m.roughness);
    v.roughness_metallic[1] = Unorm8(m.metallic);
    vertices->push_back(v);
  }
}

void AppendIndices(const MeshPart& part, std::uint32_t first_vertex,
                   std::vector<std::uint32_t>* indices) {
  for (std::uint32_t index : part.indices) indices->push_back(first_vertex + index);
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
  for (GLuint row = 0; row < 3; ++row) {
    attribute(4 + row, 4, GL_FLOAT, false, row * 4 * sizeof(float), 1);
  }
  glEnableVertexArrayAttrib(array, 7);
  glVertexArrayAttribIFormat(array, 7, 1, GL_UNSIGNED_INT, offsetof(NodeInstance, label));
  glVertexArrayAttribBinding(array, 7, 1);
  glVertexArrayBindingDivisor(array, 1, 1);
}

float BodyScale(const SceneState& state, int body) {
  return state.body_scale.empty() ? 1.0f : state.body_scale[body];
}

/// Mesh coordinates to W.
Eigen::Affine3d NodeToWorld(const SceneNode& node, const SceneState& state) {
  return state.X_WB[node.body] * Eigen::Scaling(static_cast<double>(BodyScale(state, node.body))) *
         node.X_BG * Eigen::Scaling(node.scale);
}

}  // namespace

NodeRenderer::NodeRenderer(const SceneModel& model) : model_(model) {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  for (const Mesh& mesh : model.meshes) {
    GpuMesh gpu;
    gpu.first_vertex = static_cast<int>(vertices.size());
    for (const bool glass : {false, true}) {
      Range& range = glass ? gpu.glass : gpu.opaque;
      range.first_index = static_cast<int>(indices.size());
      for (const MeshPart& part : mesh.parts) {
        if ((part.material.opacity < 1.0) != glass) continue;
        AppendIndices(part, static_cast<std::uint32_t>(vertices.size() - gpu.first_vertex),
                      &indices);
        AppendVertices(part, &vertices);
        for (const Eigen::Vector3f& p : part.positions_m) gpu.box_G_m.extend(p.cast<double>());
      }
      range.index_count = static_cast<int>(indices.size()) - range.first_index;
    }
    meshes_.push_back(gpu);
  }
  vertices_ = MakeBuffer(vertices.size() * sizeof(Vertex), vertices.data());
  indices_ = MakeBuffer(indices.size() * sizeof(std::uint32_t), indices.data());
  instances_ = MakeBuffer(model.nodes.size() * sizeof(NodeInstance), nullptr);
  array_ = MakeVertexArray();
  DescribeVertices(array_.id());
  glVertexArrayVertexBuffer(array_.id(), 0, vertices_.id(), 0, sizeof(Vertex));
  glVertexArrayVertexBuffer(array_.id(), 1, instances_.id(), 0, sizeof(NodeInstance));
  glVertexArrayElementBuffer(array_.id(), indices_.id());
}

void NodeRenderer::Place(const SceneState& state, const Vec3& eye_W_m, const View* view) {
  placed_opaque_.clear();
  placed_glass_.clear();
  std::vector<NodeInstance> instances(model_.nodes.size());
  for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
    const SceneNode& node = model_.nodes[n];
    const GpuMesh& mesh = meshes_[node.mesh];
    if (BodyScale(state, node.body) <= 0 || mesh.box_G_m.isEmpty()) continue;
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
    if (mesh.opaque.index_count > 0) placed_opaque_.push_back(placed);
    if (mesh.glass.index_count > 0) placed_glass_.push_back(placed);
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

void NodeRenderer::DrawNode(int node, const Range& range) const {
  const auto offset = static_cast<std::uintptr_t>(range.first_index) * sizeof(std::uint32_t);
  glDrawElementsInstancedBaseVertexBaseInstance(
      GL_TRIANGLES, range.index_count, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset), 1,
      meshes_[model_.nodes[node].mesh].first_vertex, static_cast<GLuint>(node));
  triangles_drawn_ += range.index_count / 3;
}

void NodeRenderer::Draw(Surface surface) const {
  glBindVertexArray(array_.id());
  const bool glass = surface == Surface::kGlass;
  for (const Placed& placed : glass ? placed_glass_ : placed_opaque_) {
    const GpuMesh& mesh = meshes_[model_.nodes[placed.node].mesh];
    DrawNode(placed.node, glass ? mesh.glass : mesh.opaque);
  }
}

void NodeRenderer::DrawOpaqueIf(
    const std::function<bool(const Vec3& centre_W_m, double radius_m)>& wanted) const {
  glBindVertexArray(array_.id());
  for (const Placed& placed : placed_opaque_) {
    if (!wanted(placed.centre_W_m, placed.radius_m)) continue;
    DrawNode(placed.node, meshes_[model_.nodes[placed.node].mesh].opaque);
  }
}

void NodeRenderer::DrawInstance(std::uint16_t instance) const {
  glBindVertexArray(array_.id());
  for (const Placed& placed : placed_opaque_) {
    if (model_.nodes[placed.node].instance != instance) continue;
    DrawNode(placed.node, meshes_[model_.nodes[placed.node].mesh].opaque);
  }
  for (const Placed& placed : placed_glass_) {
    if (model_.nodes[placed.node].instance != instance) continue;
    DrawNode(placed.node, meshes_[model_.nodes[placed.node].mesh].glass);
  }
}

Eigen::AlignedBox3d NodeRenderer::BoundsAlong(const Mat3& R_LW, const SceneState& state) const {
  Eigen::AlignedBox3d bounds;
  for (const SceneNode& node : model_.nodes) {
    const Eigen::AlignedBox3d& box = meshes_[node.mesh].box_G_m;
    if (BodyScale(state, node.body) <= 0 || box.isEmpty()) continue;
    const Eigen::Affine3d X_LG = R_LW * NodeToWorld(node, state);
    for (int corner = 0; corner < 8; ++corner) {
      bounds.extend(X_LG * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    }
  }
  return bounds;
}

}  // namespace tera
