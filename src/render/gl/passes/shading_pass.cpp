#include "render/gl/passes/shading_pass.h"

#include <epoxy/gl.h>

namespace tera {
namespace {

GlObject FarBelow() {
  GlObject texture = MakeTexture(GL_R32F, 1, 1, Filter::kNearest, Wrap::kClamp);
  const float height_m = -1e9f;
  glTextureSubImage2D(texture.id(), 0, 0, 0, 1, 1, GL_RED, GL_FLOAT, &height_m);
  return texture;
}

}  // namespace

ShadingPass::ShadingPass(bool has_lamps)
    : shade_("fullscreen.vert", "shade.frag", has_lamps ? Switches{"LAMPS"} : Switches{}),
      no_ground_(FarBelow()) {}

void ShadingPass::Occlude(const View& view, const Pictures& p) const {
  glViewport(0, 0, (view.width_px + 1) / 2, (view.height_px + 1) / 2);
  glBindFramebuffer(GL_FRAMEBUFFER, p.open_target.id());
  occlusion_.Use();
  glBindTextureUnit(0, p.depth.id());
  glBindTextureUnit(1, p.normal.id());
  occlusion_.Set("u_depth", 0);
  occlusion_.Set("u_normal", 1);
  occlusion_.Set("u_focal_px", static_cast<float>(view.fx_px));
  SetView(view, occlusion_);
  screen_.Draw();
  glBindFramebuffer(GL_FRAMEBUFFER, p.open_blurred_target.id());
  blur_.Use();
  glBindTextureUnit(0, p.open.id());
  blur_.Set("u_occlusion", 0);
  screen_.Draw();
  glViewport(0, 0, view.width_px, view.height_px);
}

void ShadingPass::Shade(const View& view, const Lights& lights, const Pictures& p,
                        unsigned target) const {
  constexpr unsigned kGround = 4, kShadow = 7, kLabel = 8, kLampShadow = 9;
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_LESS);  // only pixels with a surface
  shade_.Use();
  glBindTextureUnit(0, p.albedo.id());
  glBindTextureUnit(1, p.normal.id());
  glBindTextureUnit(2, p.depth.id());
  glBindTextureUnit(3, p.open_blurred.id());
  glBindTextureUnit(kLabel, p.label.id());
  shade_.Set("u_albedo", 0);
  shade_.Set("u_normal", 1);
  shade_.Set("u_depth", 2);
  shade_.Set("u_occlusion", 3);
  shade_.Set("u_label", static_cast<int>(kLabel));
  shade_.Set("u_ground_shadow", static_cast<int>(kGround) + 2);
  shade_.Set("u_shadow", static_cast<int>(kShadow));
  if (lights.ground != nullptr) {
    lights.ground->Bind(kGround, shade_);
  } else {
    glBindTextureUnit(kGround + 2, no_ground_.id());
  }
  const double penumbra_m = lights.ground != nullptr ? lights.ground->penumbra_m() : 1.0;
  shade_.Set("u_ground_penumbra_m", static_cast<float>(penumbra_m));
  lights.sun_shadows.Bind(kShadow, view.eye_W_m, shade_);
  lights.lamps.Bind(kLampShadow, view.eye_W_m, lights.daylight.exposure(), shade_);
  lights.daylight.Light(shade_);
  SetView(view, shade_);
  screen_.Draw();
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace tera
