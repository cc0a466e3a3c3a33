#include "render/gl/passes/worn_surfaces.h"

#include <epoxy/gl.h>

#include "render/gl/passes/wear_noise.h"
#include "render/ground/soil_colour.h"

namespace tera {
namespace {

constexpr unsigned kNoiseUnit = 9;  // materials use the texture units above
constexpr double kMudSaturation = 0.35;
// Share of grey in the colour of fine dust; the rest is the soil's colour.
constexpr double kGreyDust = 0.35;

GlObject NoiseTexture() {
  const WearNoise noise = MakeWearNoise();
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_3D, 1, &id);
  GlObject texture(id, [](unsigned name) { glDeleteTextures(1, &name); });
  constexpr int kSide = WearNoise::kSide, kLevels = 6;
  glTextureStorage3D(id, kLevels, GL_RG8, kSide, kSide, kSide);
  glTextureSubImage3D(id, 0, 0, 0, 0, kSide, kSide, kSide, GL_RG, GL_UNSIGNED_BYTE,
                      noise.rg.data());
  glGenerateTextureMipmap(id);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    glTextureParameteri(id, axis, GL_REPEAT);
  }
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

Eigen::Vector3f Root(const Vec3& albedo) {
  return albedo.cwiseMax(0.0).cwiseMin(1.0).cwiseSqrt().cast<float>();
}

/// Offset of a body's marks in the noise, so that equal parts look different.
Eigen::Vector3f PlaceInNoise(int body) {
  // Irrational steps: no two bodies coincide.
  const Vec3 steps(0.7548776662, 0.5698402909, 0.3819660113);
  const Vec3 at = (body + 1) * steps;
  return (at - Vec3(at.array().floor())).cast<float>();
}

}  // namespace

WornSurfaces::WornSurfaces() : noise_(NoiseTexture()) {}

void WornSurfaces::SetView(const Eigen::Matrix4f& clip_from_relative) const {
  for (const Program* program : {&plain_, &textured_}) {
    program->Set("u_clip_from_relative", clip_from_relative);
  }
}

const Program& WornSurfaces::Use(const SceneNode& node, bool textured) const {
  const Program& program = textured ? textured_ : plain_;
  const NodeWear& worn = *node.wear;
  program.Use();
  glBindTextureUnit(kNoiseUnit, noise_.id());
  program.Set("u_wear_noise", static_cast<int>(kNoiseUnit));
  program.Set("u_wear", Eigen::Vector4f(Eigen::Vector4d(worn.wear.dust, worn.wear.mud,
                                                        worn.wear.scratches, worn.wear.rust)
                                            .cast<float>()));
  const Vec3 dry = SoilTone(0, 1) * worn.soil_albedo;
  const Vec3 grey = Vec3::Constant(dry.mean());
  program.Set("u_dust_root", Root(dry + kGreyDust * (grey - dry)));
  program.Set("u_mud_root", Root(SoilTone(kMudSaturation, 0) * worn.soil_albedo));
  Eigen::Vector4f from_soil;
  from_soil << worn.from_soil_normal_B.cast<float>(), static_cast<float>(worn.from_soil_offset_m);
  program.Set("u_from_soil", from_soil);
  constexpr double kNowhere_m = 1e3;
  const Vec2 edge_B_m = worn.edge_B_m.value_or(Vec2::Constant(kNowhere_m));
  program.Set("u_edge", Eigen::Vector2f(edge_B_m.cast<float>()));
  program.Set("u_place_in_noise", PlaceInNoise(node.body));
  Eigen::Affine3d X_BG = node.X_BG * Eigen::Scaling(node.scale);
  program.Set("u_body_from_mesh", Eigen::Matrix4f(X_BG.matrix().cast<float>()));
  return program;
}

}  // namespace tera
