#include "render/rasterizer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/check.h"
#include "render/egl_context.h"
#include "render/gl_objects.h"
#include "render/node_renderer.h"
#include "render/terrain_renderer.h"
#include "render/view.h"

namespace tera {
namespace {

/// Images on the GPU for one picture size.
struct Targets {
  int width_px = 0, height_px = 0;
  GlObject albedo, normal, label, depth, geometry;  // what is where
  GlObject colour, shaded;                          // what it looks like

  Targets() = default;
  Targets(int width, int height) : width_px(width), height_px(height) {
    const auto texture = [&](unsigned format) {
      return MakeTexture(format, width, height, Filter::kNearest, Wrap::kClamp);
    };
    albedo = texture(GL_RGBA8);
    normal = texture(GL_RGBA16);
    label = texture(GL_R32UI);
    depth = texture(GL_DEPTH_COMPONENT32F);
    colour = texture(GL_RGBA8);
    geometry = MakeFramebuffer({albedo.id(), normal.id(), label.id()}, depth.id());
    shaded = MakeFramebuffer({colour.id()}, 0);
  }
};

}  // namespace

struct Rasterizer::Impl {
  SceneModel model;
  EglContext context;
  EglContext::Current current;  // while the objects below are made
  NodeRenderer nodes;
  TerrainRenderer terrain;
  Program node_program{"node.vert", "node.frag"};
  Program terrain_program{"terrain.vert", "terrain.frag"};
  Program shade_program{"fullscreen.vert", "shade.frag"};
  GlObject no_vertices = MakeVertexArray();
  Targets targets;

  Impl(const SceneModel& scene, const EglOptions& options)
      : model(scene), context(options), current(context), nodes(model), terrain(model) {}

  void DrawGeometry(const View& view);
  void Shade(const View& view);
  void ReadBack(const CameraIntrinsics& camera, CameraFrame* frame);
};

Rasterizer::Rasterizer(const SceneModel& model, const EglOptions& options)
    : impl_(std::make_unique<Impl>(model, options)) {}

Rasterizer::~Rasterizer() = default;

const GlInfo& Rasterizer::info() const { return impl_->context.info(); }

void Rasterizer::Impl::DrawGeometry(const View& view) {
  glBindFramebuffer(GL_FRAMEBUFFER, targets.geometry.id());
  glViewport(0, 0, view.width_px, view.height_px);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  const float black[4] = {0, 0, 0, 0};
  const std::uint32_t sky[4] = {0, 0, 0, 0};
  const float infinity = 0;
  glDepthMask(GL_TRUE);
  glClearBufferfv(GL_COLOR, 0, black);
  glClearBufferfv(GL_COLOR, 1, black);
  glClearBufferuiv(GL_COLOR, 2, sky);
  glClearBufferfv(GL_DEPTH, 0, &infinity);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  node_program.Use();
  node_program.Set("u_clip_from_relative", view.ClipFromRelative());
  nodes.Draw(NodeRenderer::Surface::kOpaque);
  nodes.Draw(NodeRenderer::Surface::kGlass);
  terrain_program.Use();
  terrain_program.Set("u_clip_from_relative", view.ClipFromRelative());
  terrain_program.Set("u_eye_W", Eigen::Vector3f(view.eye_W_m.cast<float>()));
  terrain_program.Set("u_albedo", 0);
  terrain_program.Set("u_shape", 1);
  terrain.Draw(view, terrain_program);
}

void Rasterizer::Impl::Shade(const View& view) {
  glBindFramebuffer(GL_FRAMEBUFFER, targets.shaded.id());
  glDisable(GL_DEPTH_TEST);
  shade_program.Use();
  glBindTextureUnit(0, targets.albedo.id());
  glBindTextureUnit(1, targets.normal.id());
  glBindTextureUnit(2, targets.depth.id());
  shade_program.Set("u_albedo", 0);
  shade_program.Set("u_normal", 1);
  shade_program.Set("u_depth", 2);
  shade_program.Set("u_to_sun_W", Eigen::Vector3f(model.environment.to_sun_W.cast<float>()));
  shade_program.Set("u_R_WC", Eigen::Matrix3f(view.R_WC.cast<float>()));
  glBindVertexArray(no_vertices.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Rasterizer::Impl::ReadBack(const CameraIntrinsics& camera, CameraFrame* frame) {
  const int width = camera.width_px, height = camera.height_px;
  const std::size_t count = static_cast<std::size_t>(width) * height;
  frame->rgb = Image<std::uint8_t>(width, height, 3);
  frame->depth_m = Image<float>(width, height);
  frame->semantic = Image<std::uint8_t>(width, height);
  frame->instance = Image<std::uint16_t>(width, height);
  std::vector<std::uint32_t> words(count);
  const auto bytes = static_cast<GLsizei>(count * sizeof(std::uint32_t));
  glGetTextureImage(targets.colour.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes, words.data());
  for (std::size_t p = 0; p < count; ++p) {
    std::memcpy(&frame->rgb.data[p * 3], &words[p], 3);
  }
  glGetTextureImage(targets.label.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, bytes, words.data());
  for (std::size_t p = 0; p < count; ++p) {
    frame->semantic.data[p] = static_cast<std::uint8_t>(words[p]);
    frame->instance.data[p] = static_cast<std::uint16_t>(words[p] >> 8);
  }
  glGetTextureImage(targets.depth.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, bytes,
                    frame->depth_m.data.data());
  const auto near_m = static_cast<float>(camera.near_m), far_m = static_cast<float>(camera.far_m);
  for (float& d : frame->depth_m.data) {
    const float z_m = d > 0 ? near_m / d : 0.0f;
    d = z_m <= far_m ? z_m : 0.0f;
  }
}

CameraFrame Rasterizer::Render(const CameraIntrinsics& camera, const Pose& X_WC,
                               const SceneState& state) {
  Impl& impl = *impl_;
  const EglContext::Current current(impl.context);
  if (impl.targets.width_px != camera.width_px || impl.targets.height_px != camera.height_px) {
    impl.targets = Targets(camera.width_px, camera.height_px);
  }
  const View view(camera, X_WC);
  if (state.terrain != nullptr) impl.terrain.Update(*state.terrain);
  impl.nodes.Place(state, view.eye_W_m, &view);
  impl.DrawGeometry(view);
  impl.Shade(view);
  CameraFrame frame;
  frame.t_ns = state.t_ns;
  frame.t_available_ns = state.t_ns;
  impl.ReadBack(camera, &frame);
  return frame;
}

}  // namespace tera
