#include "render/gl/passes/daylight.h"

#include <epoxy/gl.h>

#include <cmath>

namespace tera {

Daylight::Daylight(const Environment& environment)
    : sky_(environment),
      scene_exposure_(static_cast<float>(1.0 / (1.2 * std::exp2(environment.exposure_ev100)))),
      exposure_(scene_exposure_),
      extinction_1pm_(static_cast<float>(-std::log(0.02) / environment.fog_visibility_m)),
      texture_(MakeTexture(GL_RGB16F, Sky::kWidth, Sky::kHeight, Filter::kLinear, Wrap::kRepeat)) {
  glTextureParameteri(texture_.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTextureSubImage2D(texture_.id(), 0, 0, 0, Sky::kWidth, Sky::kHeight, GL_RGB, GL_FLOAT,
                      sky_.texels().data());
}

void Daylight::SetWhite(std::optional<double> white_cdpm2) {
  exposure_ = white_cdpm2 ? static_cast<float>(1 / *white_cdpm2) : scene_exposure_;
}

void Daylight::Light(const Program& program) const {
  std::vector<Eigen::Vector3f> diffuse, airlight;
  for (const Eigen::Vector3f& c : sky_.diffuse()) diffuse.push_back(c * exposure_);
  for (const Eigen::Vector3f& c : sky_.airlight()) airlight.push_back(c * exposure_);
  program.Set("u_to_sun_W", Eigen::Vector3f(sky_.to_sun_W().cast<float>()));
  program.Set("u_sun", Eigen::Vector3f(sky_.sun_illuminance_lx() * exposure_));
  program.Set("u_diffuse", diffuse);
  program.Set("u_airlight", airlight);
  program.Set("u_zenith", Eigen::Vector3f(sky_.zenith() * exposure_));
  program.Set("u_bounce", Eigen::Vector3f(sky_.ground() * exposure_));
  constexpr float kFullSun_lx = 90000;
  program.Set("u_full_sun", kFullSun_lx * exposure_);
  program.Set("u_extinction_1pm", extinction_1pm_);
}

void Daylight::BindSky(unsigned unit, const Program& program) const {
  glBindTextureUnit(unit, texture_.id());
  program.Set("u_sky", static_cast<int>(unit));
  program.Set("u_exposure", exposure_);
}

}  // namespace tera
