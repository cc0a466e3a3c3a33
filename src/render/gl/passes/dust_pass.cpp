#include "render/gl/passes/dust_pass.h"

#include <epoxy/gl.h>

#include "render/air/sun_through_dust.h"

namespace tera {
namespace {

GlObject MakeVolume(unsigned format, int nx, int ny, int nz, int wrap) {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_3D, 1, &id);
  GlObject texture(id, [](unsigned name) { glDeleteTextures(1, &name); });
  glTextureStorage3D(id, 1, format, nx, ny, nz);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    glTextureParameteri(id, axis, wrap);
  }
  const float nothing[4] = {0, 0, 0, 0};
  glTextureParameterfv(id, GL_TEXTURE_BORDER_COLOR, nothing);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  return texture;
}

/// Displacement modulo the period of the eddies.
Vec3 WithinPeriod(const Vec3& p_m) {
  constexpr double kPeriod_m = DustEddies::kPeriod_m;
  return p_m - kPeriod_m * (p_m / kPeriod_m).array().floor().matrix();
}

}  // namespace

DustPass::DustPass() = default;

void DustPass::Send(const DustVolume& dust, const Vec3& to_sun_W) {
  if (nx_ != dust.nx || ny_ != dust.ny || nz_ != dust.nz) {
    nx_ = dust.nx, ny_ = dust.ny, nz_ = dust.nz;
    version_ = 0;
    cells_ = MakeVolume(GL_RG32F, nx_, ny_, nz_, GL_CLAMP_TO_BORDER);
    base_ = MakeTexture(GL_R32F, nx_, ny_, Filter::kLinear, Wrap::kClamp);
    glTextureSubImage2D(base_.id(), 0, 0, 0, nx_, ny_, GL_RED, GL_FLOAT, dust.base_m.data());
    constexpr int kSide = DustEddies::kSide;
    eddies_ = MakeVolume(GL_R32F, kSide, kSide, kSide, GL_REPEAT);
    std::vector<float> factors(static_cast<std::size_t>(kSide) * kSide * kSide, 1.0f);
    if (dust.eddies) factors = dust.eddies->factors();
    glTextureSubImage3D(eddies_.id(), 0, 0, 0, 0, kSide, kSide, kSide, GL_RED, GL_FLOAT,
                        factors.data());
  }
  if (version_ == dust.version && version_ != 0) return;
  version_ = dust.version;
  const std::vector<float> to_sun = OpticalDepthsToSun(dust, to_sun_W);
  texels_.resize(2 * to_sun.size());
  for (std::size_t i = 0; i < to_sun.size(); ++i) {
    texels_[2 * i] = dust.extinction_1pm[i];
    texels_[2 * i + 1] = to_sun[i];
  }
  glTextureSubImage3D(cells_.id(), 0, 0, 0, 0, nx_, ny_, nz_, GL_RG, GL_FLOAT, texels_.data());
}

const DustPass::HalfPicture& DustPass::HalfOf(const Pictures& p) {
  const int width_px = (p.width_px + 1) / 2, height_px = (p.height_px + 1) / 2;
  for (const HalfPicture& half : halves_) {
    if (half.width_px == width_px && half.height_px == height_px) return half;
  }
  HalfPicture half{width_px, height_px, {}, {}};
  half.light = MakeTexture(GL_RGBA16F, width_px, height_px, Filter::kNearest, Wrap::kClamp);
  half.target = MakeFramebuffer({half.light.id()}, 0);
  halves_.push_back(std::move(half));
  return halves_.back();
}

void DustPass::Draw(const View& view, const DustVolume& dust, const Daylight& daylight,
                    const Pictures& p) {
  const Eigen::AlignedBox3d& box = dust.occupied_W_m;
  if (box.isEmpty() || !view.Sees(box.min(), box.max())) return;
  Send(dust, daylight.sky().to_sun_W());
  const HalfPicture& half = HalfOf(p);
  glBindFramebuffer(GL_FRAMEBUFFER, half.target.id());
  glViewport(0, 0, half.width_px, half.height_px);
  march_.Use();
  glBindTextureUnit(0, p.depth.id());
  glBindTextureUnit(1, cells_.id());
  glBindTextureUnit(2, base_.id());
  glBindTextureUnit(3, eddies_.id());
  march_.Set("u_depth", 0);
  march_.Set("u_cells", 1);
  march_.Set("u_base", 2);
  march_.Set("u_eddies", 3);
  const Vec3 origin_W_m(dust.origin_W_m.x(), dust.origin_W_m.y(), 0);
  march_.Set("u_eye", Eigen::Vector3f((view.eye_W_m - origin_W_m).cast<float>()));
  march_.Set("u_box_low", Eigen::Vector3f((box.min() - view.eye_W_m).cast<float>()));
  march_.Set("u_box_high", Eigen::Vector3f((box.max() - view.eye_W_m).cast<float>()));
  march_.Set("u_eddy_eye",
             Eigen::Vector3f(WithinPeriod(view.eye_W_m - dust.drift_m).cast<float>()));
  march_.Set("u_eddy_period_m", static_cast<float>(DustEddies::kPeriod_m));
  march_.Set("u_cell_m", static_cast<float>(dust.cell_m));
  march_.Set("u_step_m", static_cast<float>(MarchStep_m(dust)));
  march_.Set("u_size", Eigen::Vector3f(static_cast<float>(nx_), static_cast<float>(ny_),
                                       static_cast<float>(nz_)));
  march_.Set("u_scattered", DustVolume::kScattered);
  march_.Set("u_asymmetry", static_cast<float>(DustVolume::kAsymmetry));
  march_.Set("u_diffuse_loss", static_cast<float>(kDiffuseLoss));
  SetView(view, march_);
  daylight.Light(march_);
  screen_.Draw();

  glBindFramebuffer(GL_FRAMEBUFFER, p.sky_target.id());
  glDepthMask(GL_FALSE);  // the shader reads the depth
  glViewport(0, 0, view.width_px, view.height_px);
  blend_.Use();
  glBindTextureUnit(1, half.light.id());
  blend_.Set("u_depth", 0);
  blend_.Set("u_light", 1);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ONE, GL_SRC_ALPHA, GL_ZERO, GL_ONE);
  screen_.Draw();
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

}  // namespace tera
