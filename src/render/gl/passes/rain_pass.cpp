#include "render/gl/passes/rain_pass.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace tera {
namespace {

/// Adds the two triangles of a streak.
void AddStreak(const View& view, const FallingDrops::Streak& streak,
               std::vector<Eigen::Vector4f>* corners) {
  constexpr double kFaintest = 0.002;
  const auto place = [&](const Vec3& p_C_m) {
    return Vec2(view.fx_px * p_C_m.x() / p_C_m.z() + view.cx_px + 0.5,
                view.fy_px * p_C_m.y() / p_C_m.z() + view.cy_px + 0.5);
  };
  const Vec2 a = place(streak.from_C_m), b = place(streak.to_C_m);
  const double z_m = 0.5 * (streak.from_C_m.z() + streak.to_C_m.z());
  const double diameter_px = view.fx_px * streak.diameter_m / z_m;
  const double width_px = std::max(diameter_px, FallingDrops::kLeastWidth_px);
  const Vec2 along = (b - a).norm() > 1e-9 ? Vec2((b - a).normalized()) : Vec2(0, 1);
  const Vec2 end = 0.5 * width_px * along, side(-end.y(), end.x());
  const double cover = FallingDrops::Cover(diameter_px, width_px, (b - a).norm() + width_px);
  if (cover < kFaintest) return;
  const Vec2 low = a.cwiseMin(b), high = a.cwiseMax(b);
  if (high.x() < 0 || high.y() < 0 || low.x() > view.width_px || low.y() > view.height_px) return;
  const auto corner = [&](const Vec2& p) {
    return Eigen::Vector4f(static_cast<float>(2 * p.x() / view.width_px - 1),
                           static_cast<float>(2 * p.y() / view.height_px - 1),
                           static_cast<float>(std::min(view.near_m / z_m, 1.0)),
                           static_cast<float>(cover));
  };
  const Eigen::Vector4f q[4] = {corner(a - end - side), corner(a - end + side),
                                corner(b + end + side), corner(b + end - side)};
  for (const int k : {0, 1, 2, 0, 2, 3}) corners->push_back(q[k]);
}

}  // namespace

RainPass::RainPass(const Weather& weather) : drops_(Rain(weather.rain_mmph), weather.wind) {}

void RainPass::Draw(const View& view, const SceneState& state, const Daylight& daylight,
                    const Pictures& p) {
  const Pose X_WC = MakePose(view.eye_W_m, view.R_WC);
  corners_.clear();
  for (const FallingDrops::Streak& streak : drops_.Seen(X_WC, state.t_ns, state.exposure_s)) {
    AddStreak(view, streak, &corners_);
  }
  if (corners_.empty()) return;
  if (corners_.size() > room_) {
    room_ = 2 * corners_.size();
    vertices_ = MakeBuffer(room_ * sizeof(corners_[0]), nullptr);
    glEnableVertexArrayAttrib(array_.id(), 0);
    glVertexArrayAttribFormat(array_.id(), 0, 4, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array_.id(), 0, 0);
    glVertexArrayVertexBuffer(array_.id(), 0, vertices_.id(), 0, sizeof(corners_[0]));
  }
  glNamedBufferSubData(vertices_.id(), 0,
                       static_cast<GLsizeiptr>(corners_.size() * sizeof(corners_[0])),
                       corners_.data());
  glBindFramebuffer(GL_FRAMEBUFFER, p.sky_target.id());
  glViewport(0, 0, view.width_px, view.height_px);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GREATER);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  program_.Use();
  program_.Set("u_share", static_cast<float>(kShare));
  daylight.Light(program_);
  glBindVertexArray(array_.id());
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners_.size()));
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace tera
