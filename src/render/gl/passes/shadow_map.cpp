#include "render/gl/passes/shadow_map.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr int kNearSide_px = 1536, kFarSide_px = 1024;
constexpr double kNearRadius_m = 9.0;
// Grid of the fine image's centre; few camera motions thus require a redraw.
constexpr double kSnap_m = 4.0;
constexpr double kMargin_m = 0.5;
constexpr std::size_t kKept = 6;  ///< number of cached shadows; a rig has cameras at few places
constexpr int kWidth_px = kNearSide_px + kFarSide_px,
              kHeight_px = std::max(kNearSide_px, kFarSide_px);

GlObject ShadowTexture() {
  return MakeTexture(GL_DEPTH_COMPONENT16, kWidth_px, kHeight_px, Filter::kShadow, Wrap::kClamp);
}

Mat3 SunFrame(const Vec3& to_sun_W) {
  const Vec3 z = to_sun_W.normalized();
  const Vec3 x = (std::abs(z.z()) > 0.999 ? Vec3::UnitX() : Vec3(-z.y(), z.x(), 0)).normalized();
  const Vec3 y = z.cross(x).normalized();
  Mat3 R;
  R.row(0) = y.cross(z).transpose();
  R.row(1) = y.transpose();
  R.row(2) = z.transpose();
  return R;
}

bool Same(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
  return a.min() == b.min() && a.max() == b.max();
}

}  // namespace

ShadowMap::ShadowMap(const Vec3& to_sun_W)
    : R_LW_(SunFrame(to_sun_W)),
      texture_(ShadowTexture()),
      framebuffer_(MakeFramebuffer({}, texture_.id())),
      near_{0, kNearSide_px, {}},
      far_{kNearSide_px, kFarSide_px, {}} {}

void ShadowMap::Update(const SceneState& state, const Vec3& eye_W_m, NodeRenderer* nodes) {
  Vec3 centre_W_m;
  for (int k = 0; k < 3; ++k) centre_W_m[k] = std::round(eye_W_m[k] / kSnap_m) * kSnap_m;
  if (centre_W_m == drawn_centre_W_m_ && drawn_.IsOf(state)) return;
  if (TakeMoved(state)) standing_.clear();
  Cover(centre_W_m, nodes->BoundsAlong(R_LW_, state));
  nodes->Place(state, Vec3::Zero(), nullptr);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthMask(GL_TRUE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5f, 2.0f);
  program_.Use();
  glCopyImageSubData(StandingFor(*nodes).texture.id(), GL_TEXTURE_2D, 0, 0, 0, 0, texture_.id(),
                     GL_TEXTURE_2D, 0, 0, 0, 0, kWidth_px, kHeight_px, 1);
  Draw(framebuffer_, *nodes, false);
  glDisable(GL_POLYGON_OFFSET_FILL);
  drawn_ = DrawnScene(state);
  drawn_centre_W_m_ = centre_W_m;
}

/// Sets the volumes of the fine image, around `centre_W_m`, and of the coarse image, around all
/// nodes.
void ShadowMap::Cover(const Vec3& centre_W_m, const Eigen::AlignedBox3d& all_L_m) {
  Eigen::AlignedBox3d all = all_L_m;
  if (all.isEmpty()) all.extend(Vec3::Zero());
  far_.box_L_m = {all.min() - Vec3::Constant(kMargin_m), all.max() + Vec3::Constant(kMargin_m)};
  const Vec3 centre_L_m = R_LW_ * centre_W_m;
  near_.box_L_m = far_.box_L_m;  // along the light: includes all possible occluders
  for (int k = 0; k < 2; ++k) {
    near_.box_L_m.min()[k] = std::max(centre_L_m[k] - kNearRadius_m, far_.box_L_m.min()[k]);
    near_.box_L_m.max()[k] = std::min(centre_L_m[k] + kNearRadius_m, far_.box_L_m.max()[k]);
    if (near_.box_L_m.min()[k] >= near_.box_L_m.max()[k]) {  // no node is near
      near_.box_L_m.min()[k] = centre_L_m[k] - kNearRadius_m;
      near_.box_L_m.max()[k] = centre_L_m[k] + kNearRadius_m;
    }
  }
}

/// Marks the bodies that have moved. True if a body moves for the first time.
bool ShadowMap::TakeMoved(const SceneState& state) {
  if (first_poses_.size() != state.X_WB.size()) {
    first_poses_ = state.X_WB;
    has_moved_.assign(first_poses_.size(), false);
    return true;
  }
  bool more = false;
  for (std::size_t b = 0; b < first_poses_.size(); ++b) {
    if (has_moved_[b] || state.X_WB[b].matrix() == first_poses_[b].matrix()) continue;
    has_moved_[b] = more = true;
  }
  return more;
}

const ShadowMap::Standing& ShadowMap::StandingFor(const NodeRenderer& nodes) {
  const auto found = std::find_if(standing_.begin(), standing_.end(), [&](const Standing& s) {
    return Same(s.near_box_L_m, near_.box_L_m) && Same(s.far_box_L_m, far_.box_L_m);
  });
  if (found != standing_.end()) {
    std::rotate(found, found + 1, standing_.end());
    return standing_.back();
  }
  Standing made;
  if (standing_.size() == kKept) {
    made = std::move(standing_.front());
    standing_.erase(standing_.begin());
  } else {
    made.texture = ShadowTexture();
    made.framebuffer = MakeFramebuffer({}, made.texture.id());
  }
  made.near_box_L_m = near_.box_L_m;
  made.far_box_L_m = far_.box_L_m;
  glBindFramebuffer(GL_FRAMEBUFFER, made.framebuffer.id());
  const float farthest = 1;
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  Draw(made.framebuffer, nodes, true);
  return standing_.emplace_back(std::move(made));
}

/// Draws the static nodes (`standing`) or the moving nodes, seen from the sun.
void ShadowMap::Draw(const GlObject& framebuffer, const NodeRenderer& nodes, bool standing) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  const auto is_wanted = [&](const SceneNode& node) {
    return standing == (node.shape < 0 && !has_moved_[static_cast<std::size_t>(node.body)]);
  };
  // Distance of a point from the fine image's border, positive inside. Seen from the sun, a shadow
  // lies exactly behind its node. The coarse image therefore omits nodes that lie completely within
  // the fine image. Nodes outside the fine image cast no shadow within it.
  const auto gap_m = [&](const Vec3& centre_W_m) {
    const Vec2 p_L = (R_LW_ * centre_W_m).head<2>();
    const Vec2 low = p_L - near_.box_L_m.min().head<2>(),
               high = near_.box_L_m.max().head<2>() - p_L;
    return std::min(low.minCoeff(), high.minCoeff());
  };
  // The volumes contain each node completely along the light, so the near plane cuts no node.
  const auto is_whole = [](const SceneNode&, const Vec3&, double) { return true; };
  AimAt(near_);
  nodes.DrawOpaqueIf([&](const SceneNode& node, const Vec3& c,
                         double r) { return is_wanted(node) && gap_m(c) > -r; },
                     is_whole);
  AimAt(far_);
  nodes.DrawOpaqueIf([&](const SceneNode& node, const Vec3& c,
                         double r) { return is_wanted(node) && gap_m(c) < r + kMargin_m; },
                     is_whole);
}

void ShadowMap::AimAt(const Picture& picture) const {
  glViewport(picture.left_px, 0, picture.side_px, picture.side_px);
  const Vec3 size = picture.box_L_m.sizes(), low = picture.box_L_m.min();
  Eigen::Matrix4d clip_L = Eigen::Matrix4d::Identity();
  for (int k = 0; k < 2; ++k) {
    clip_L(k, k) = 2 / size[k];
    clip_L(k, 3) = -1 - 2 * low[k] / size[k];
  }
  clip_L(2, 2) = -1 / size.z();  // nearest to the sun: 0
  clip_L(2, 3) = 1 + low.z() / size.z();
  Eigen::Matrix4d X_LW = Eigen::Matrix4d::Identity();
  X_LW.topLeftCorner<3, 3>() = R_LW_;
  program_.Set("u_clip_from_W", Eigen::Matrix4f((clip_L * X_LW).cast<float>()));
}

void ShadowMap::Bind(unsigned unit, const Vec3& eye_W_m, const Program& program) const {
  glBindTextureUnit(unit, texture_.id());
  const double width_px = kWidth_px, height_px = kHeight_px;
  const auto matrix = [&](const Picture& picture) {
    const Vec3 size = picture.box_L_m.sizes(), low = picture.box_L_m.min();
    Eigen::Matrix4d unit_L = Eigen::Matrix4d::Identity();  // maps the image's box to [0, 1]
    for (int k = 0; k < 3; ++k) {
      unit_L(k, k) = 1 / size[k];
      unit_L(k, 3) = -low[k] / size[k];
    }
    unit_L.row(2) = Eigen::RowVector4d::Unit(3) - unit_L.row(2);
    Eigen::Matrix4d X_LR = Eigen::Matrix4d::Identity();
    X_LR.topLeftCorner<3, 3>() = R_LW_;
    X_LR.topRightCorner<3, 1>() = R_LW_ * eye_W_m;
    return Eigen::Matrix4f((unit_L * X_LR).cast<float>());
  };
  const auto square = [&](const Picture& picture) {  // scale and offset in the texture
    return Eigen::Vector4f(static_cast<float>(picture.side_px / width_px),
                           static_cast<float>(picture.side_px / height_px),
                           static_cast<float>(picture.left_px / width_px), 0.0f);
  };
  program.Set("u_shadow_near", matrix(near_));
  program.Set("u_shadow_far", matrix(far_));
  program.Set("u_shadow_near_square", square(near_));
  program.Set("u_shadow_far_square", square(far_));
  const Vec2 near_texel = near_.box_L_m.sizes().head<2>() / near_.side_px;
  const Vec2 far_texel = far_.box_L_m.sizes().head<2>() / far_.side_px;
  program.Set("u_shadow_texel_m", Eigen::Vector2f(static_cast<float>(near_texel.maxCoeff()),
                                                  static_cast<float>(far_texel.maxCoeff())));
  program.Set("u_shadow_texel",
              Eigen::Vector2f(static_cast<float>(1 / width_px), static_cast<float>(1 / height_px)));
}

}  // namespace tera
