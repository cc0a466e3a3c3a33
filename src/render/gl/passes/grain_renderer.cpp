#include "render/gl/passes/grain_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/types/labels.h"
#include "render/ground/soil_colour.h"
#include "render/meshes/grain_shape.h"

namespace tera {
namespace {

// Vertex attributes of node.vert.
constexpr GLuint kPosition = 0, kNormal = 1, kAlbedo = 2, kRoughness = 3, kFirstRow = 4, kLabel = 7;
constexpr GLuint kCornerBuffer = 0, kPoseBuffer = 1;
constexpr float kRough = 0.95f;

using PoseRows = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;

struct Corner {
  Eigen::Vector3f position, normal;
};

/// Three corners per face, with the face normal.
std::vector<Corner> FlatCorners() {
  std::vector<Corner> corners;
  const GrainShape& grain = UnitGrain();
  for (const auto& [a, b, c] : grain.faces) {
    const Eigen::Vector3f normal = (grain.corners[b] - grain.corners[a])
                                       .cross(grain.corners[c] - grain.corners[a])
                                       .normalized();
    for (const std::uint8_t corner : {a, b, c}) corners.push_back({grain.corners[corner], normal});
  }
  return corners;
}

}  // namespace

GrainRenderer::GrainRenderer(const std::vector<SoilAppearance>& soils)
    : soils_(soils), array_(MakeVertexArray()) {
  if (soils_.empty()) soils_.emplace_back();
  const std::vector<Corner> corners = FlatCorners();
  corners_ = MakeBuffer(corners.size() * sizeof(Corner), corners.data());
  const auto attribute = [&](GLuint index, GLint size, GLuint offset, GLuint buffer) {
    glEnableVertexArrayAttrib(array_.id(), index);
    glVertexArrayAttribFormat(array_.id(), index, size, GL_FLOAT, GL_FALSE, offset);
    glVertexArrayAttribBinding(array_.id(), index, buffer);
  };
  attribute(kPosition, 3, 0, kCornerBuffer);
  attribute(kNormal, 3, sizeof(Eigen::Vector3f), kCornerBuffer);
  for (GLuint row = 0; row < 3; ++row) {
    attribute(kFirstRow + row, 4, row * 4 * static_cast<GLuint>(sizeof(float)), kPoseBuffer);
  }
  glVertexArrayBindingDivisor(array_.id(), kPoseBuffer, 1);
  glVertexArrayVertexBuffer(array_.id(), kCornerBuffer, corners_.id(), 0, sizeof(Corner));
}

void GrainRenderer::Place(const TerrainSurface& terrain, const Vec3& eye_W_m) {
  std::map<std::pair<int, int>, std::vector<PoseRows>> by_colour;  // key: soil and moisture
  for (const TerrainSurface::Grain& grain : terrain.grains()) {
    Eigen::Affine3f X_WG = GrainToWorld(grain);
    X_WG.pretranslate(-eye_W_m.cast<float>());
    by_colour[{grain.soil, grain.moisture}].push_back(X_WG.matrix().topRows<3>());
  }
  batches_.clear();
  std::vector<PoseRows> poses;
  for (const auto& [colour, rows] : by_colour) {
    const auto [soil, moisture] = colour;
    const Vec3 albedo = soils_[std::min<std::size_t>(soil, soils_.size() - 1)].albedo *
                        SoilTone(moisture / 255.0, 1.0);
    Batch batch;
    batch.albedo_root_opacity << albedo.cwiseMax(0.0).cwiseSqrt().cast<float>(), 1.0f;
    batch.first = static_cast<int>(poses.size());
    batch.count = static_cast<int>(rows.size());
    batches_.push_back(batch);
    poses.insert(poses.end(), rows.begin(), rows.end());
  }
  if (poses.empty()) return;
  if (poses.size() > capacity_) {
    capacity_ = 2 * poses.size();
    poses_ = MakeBuffer(capacity_ * sizeof(PoseRows), nullptr);
    glVertexArrayVertexBuffer(array_.id(), kPoseBuffer, poses_.id(), 0, sizeof(PoseRows));
  }
  glNamedBufferSubData(poses_.id(), 0, static_cast<GLsizeiptr>(poses.size() * sizeof(PoseRows)),
                       poses.data());
}

void GrainRenderer::Draw() const {
  if (batches_.empty()) return;
  glBindVertexArray(array_.id());
  glVertexAttrib4f(kRoughness, kRough, 0, 0, 0);
  glVertexAttribI4ui(kLabel, static_cast<GLuint>(SemanticClass::kTerrain), 0, 0, 0);
  const int corners = 3 * static_cast<int>(UnitGrain().faces.size());
  for (const Batch& batch : batches_) {
    glVertexAttrib4fv(kAlbedo, batch.albedo_root_opacity.data());
    glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, corners, batch.count,
                                      static_cast<GLuint>(batch.first));
    triangles_drawn_ += static_cast<std::int64_t>(batch.count) * corners / 3;
  }
}

}  // namespace tera
