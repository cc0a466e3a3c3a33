#include "render/gl/passes/lamp_lights.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

constexpr int kSide_px = 512;
constexpr double kNear_m = 0.25, kFar_m = 120;  // range in which lamps cast shadows

/// Transform from W to clip coordinates of a lamp's image. Depth 0 is nearest, 1 farthest.
Eigen::Matrix4d ClipFromWorld(const Lamp& lamp, const Pose& X_WL) {
  // The lamp looks along x of L; the image's right is -y, its up is z.
  Eigen::Matrix4d view_L = Eigen::Matrix4d::Zero();
  view_L(0, 1) = -1;
  view_L(1, 2) = 1;
  view_L(2, 0) = 1;
  view_L(3, 3) = 1;
  const double spread = std::tan(lamp.half_angle_rad);
  Eigen::Matrix4d clip_view = Eigen::Matrix4d::Zero();
  clip_view(0, 0) = clip_view(1, 1) = 1 / spread;
  clip_view(2, 2) = kFar_m / (kFar_m - kNear_m);
  clip_view(2, 3) = -kFar_m * kNear_m / (kFar_m - kNear_m);
  clip_view(3, 2) = 1;
  return clip_view * view_L * X_WL.inverse().matrix();
}

}  // namespace

LampLights::LampLights(const std::vector<Lamp>& lamps) : lamps_(lamps) {
  TERA_CHECK(lamps.size() <= kMostLamps, lamps.size());
  const int count = std::max(1, static_cast<int>(lamps.size()));
  texture_ =
      MakeTexture(GL_DEPTH_COMPONENT16, count * kSide_px, kSide_px, Filter::kShadow, Wrap::kClamp);
  framebuffer_ = MakeFramebuffer({}, texture_.id());
}

void LampLights::Update(const SceneState& state, NodeRenderer* nodes) {
  if (lamps_.empty() || drawn_.IsOf(state)) return;
  drawn_ = DrawnScene(state);
  X_WL_.clear();
  for (const Lamp& lamp : lamps_) {
    X_WL_.push_back(lamp.body < 0 ? lamp.X_BL : state.X_WB[lamp.body] * lamp.X_BL);
  }
  nodes->Place(state, Vec3::Zero(), nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthMask(GL_TRUE);
  const float farthest = 1;
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5f, 2.0f);
  program_.Use();
  for (std::size_t k = 0; k < lamps_.size(); ++k) {
    glViewport(static_cast<int>(k) * kSide_px, 0, kSide_px, kSide_px);
    program_.Set("u_clip_from_W",
                 Eigen::Matrix4f(ClipFromWorld(lamps_[k], X_WL_[k]).cast<float>()));
    const Vec3 eye_W_m = X_WL_[k].translation(), beam_W = X_WL_[k].linear().col(0);
    const auto ahead_m = [&](const Vec3& p_W_m) { return (p_W_m - eye_W_m).dot(beam_W); };
    nodes->DrawOpaqueIf([&](const SceneNode&, const Vec3& centre_W_m,
                            double radius_m) { return ahead_m(centre_W_m) > -radius_m; },
                        [&](const SceneNode&, const Vec3& centre_W_m, double radius_m) {
                          return ahead_m(centre_W_m) - radius_m > kNear_m;
                        });
  }
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void LampLights::Bind(unsigned unit, const Vec3& eye_W_m, double exposure,
                      const Program& program) const {
  glBindTextureUnit(unit, texture_.id());
  program.Set("u_lamp_shadow", static_cast<int>(unit));
  program.Set("u_lamp_count", static_cast<int>(lamps_.size()));
  std::vector<Eigen::Vector3f> place, beam, strength;
  Pose X_WR = MakePose(eye_W_m);
  for (std::size_t k = 0; k < lamps_.size(); ++k) {
    place.push_back((X_WL_[k].translation() - eye_W_m).cast<float>());
    beam.push_back(X_WL_[k].linear().col(0).cast<float>());
    strength.emplace_back(static_cast<float>(PeakIntensity_cd(lamps_[k]) * exposure),
                          static_cast<float>(lamps_[k].half_angle_rad),
                          static_cast<float>(2 * std::tan(lamps_[k].half_angle_rad) / kSide_px));
    const std::string name = "u_lamp_clip[" + std::to_string(k) + "]";
    program.Set(
        name.c_str(),
        Eigen::Matrix4f((ClipFromWorld(lamps_[k], X_WL_[k]) * X_WR.matrix()).cast<float>()));
  }
  if (lamps_.empty()) return;
  program.Set("u_lamp_place", place);
  program.Set("u_lamp_beam", beam);
  program.Set("u_lamp_strength", strength);
}

}  // namespace tera
