#include "render/gl/rasterizer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/check.h"
#include "render/gl/amodal_boxes.h"
#include "render/gl/boxes.h"
#include "render/gl/egl_context.h"
#include "render/gl/gl_objects.h"
#include "render/gl/object_boxes.h"
#include "render/gl/passes/body_pass.h"
#include "render/gl/passes/daylight.h"
#include "render/gl/passes/dust_pass.h"
#include "render/gl/passes/grain_renderer.h"
#include "render/gl/passes/lamp_lights.h"
#include "render/gl/passes/lens.h"
#include "render/gl/passes/light_pass.h"
#include "render/gl/passes/node_renderer.h"
#include "render/gl/passes/rain_pass.h"
#include "render/gl/passes/shadow_map.h"
#include "render/gl/pictures.h"
#include "render/gl/read_labels.h"
#include "render/gl/read_pictures.h"
#include "render/gl/view.h"
#include "render/ground/terrain_renderer.h"

namespace tera {
namespace {

/// Uniforms that turn pixels and depths of a view back into positions.
void SetView(const View& view, const Program& program) {
  // Ray (x, y, 1) of window position p: (p - 1/2 - c) / f.
  program.Set("u_pixel_to_ray", Eigen::Vector4f(Eigen::Vector4d(-(view.cx_px + 0.5) / view.fx_px,
                                                                -(view.cy_px + 0.5) / view.fy_px,
                                                                1 / view.fx_px, 1 / view.fy_px)
                                                    .cast<float>()));
  program.Set("u_R_WC", Eigen::Matrix3f(view.R_WC.cast<float>()));
  program.Set("u_eye_W", Eigen::Vector3f(view.eye_W_m.cast<float>()));
  program.Set("u_near_m", static_cast<float>(view.near_m));
}

GlObject FarBelow() {
  GlObject texture = MakeTexture(GL_R32F, 1, 1, Filter::kNearest, Wrap::kClamp);
  const float height_m = -1e9f;
  glTextureSubImage2D(texture.id(), 0, 0, 0, 1, 1, GL_RED, GL_FLOAT, &height_m);
  return texture;
}

void AddTo(std::vector<std::int64_t>* sums, const std::vector<std::int64_t>& counts) {
  sums->resize(std::max(sums->size(), counts.size()), 0);
  for (std::size_t i = 0; i < counts.size(); ++i) (*sums)[i] += counts[i];
}

}  // namespace

struct Rasterizer::Impl {
  SceneModel model;
  EglContext context;
  EglContext::Current current;  // while the objects below are made, and again while they go
  Daylight daylight;
  NodeRenderer nodes;
  TerrainRenderer terrain;
  GrainRenderer grains;
  ShadowMap shadow_map;
  LampLights lamps;
  Silhouettes silhouettes;
  Program node_program{"node.vert", "node.frag"};
  Program textured_program{"node.vert", "node.frag", {"TEXTURED"}};
  Program occlusion_program{"fullscreen.vert", "occlusion.frag"};
  Program blur_program{"fullscreen.vert", "blur.frag"};
  Program shade_program;
  Program sky_program{"fullscreen.vert", "sky.frag"};
  Program emissive_program{"node.vert", "emissive.frag"};
  Program glass_program{"node.vert", "glass.frag"};
  Program glass_label_program{"node.vert", "label.frag"};
  Program tone_program{"fullscreen.vert", "tone.frag"};
  Program linear_program{"fullscreen.vert", "linear.frag"};
  Program edge_program{"fullscreen.vert", "edges.frag"};
  Program lens_program{"fullscreen.vert", "distort.frag"};
  Program lens_normals_program{"fullscreen.vert", "distort.frag", {"NORMALS"}};
  std::optional<BodyPass> bodies;  // of the first picture that asks for them
  std::optional<DustPass> dust;    // of the first picture with dust in the air
  std::optional<RainPass> rain;    // where it rains
  std::optional<LightPass> light_pass;
  bool wants_light = false;  // of the picture that is being drawn
  GlObject no_vertices = MakeVertexArray();
  GlObject far_below = FarBelow();
  bool has_ground = false;
  std::vector<Pictures> pictures;  // one for each size and kind of colour met
  std::vector<LensPictures> lens_pictures;
  std::vector<Lens> lenses;
  PassWatch watch;

  Impl(const SceneModel& scene, const EglOptions& options)
      : model(scene),
        context(options),
        current(context),
        daylight(model.environment),
        nodes(model),
        terrain(model, daylight.sky().to_sun_W()),
        grains(model.soils),
        shadow_map(daylight.sky().to_sun_W()),
        lamps(model.lamps),
        silhouettes(model),
        shade_program("fullscreen.vert", "shade.frag",
                      model.lamps.empty() ? Switches{} : Switches{"LAMPS"}) {
    const Weather& weather = model.environment.weather;
    if (weather.rain_mmph > 0) rain.emplace(weather);
  }

  Pictures& PicturesOf(int width_px, int height_px, bool linear);
  LensPictures& LensPicturesOf(int width_px, int height_px, bool linear);
  const Lens& LensOf(const CameraIntrinsics& camera);
  void DrawPinhole(const View& view, const SceneState& state, const Pictures& p);
  void DrawGeometry(const View& view, const Pictures& p);
  void Occlude(const View& view, const Pictures& p);
  void Shade(const View& view, const Pictures& p);
  void DrawSky(const View& view, const Pictures& p);
  void DrawLights(const View& view, const Pictures& p);
  void DrawGlass(const View& view, const Pictures& p);
  void Develop(const Pictures& p);
  void Distort(const Lens& lens, int view, bool normals, const Pictures& from,
               const LensPictures& to);
  void FillScreen() const;
  void Done(const char* pass) const {
    if (!watch) return;
    glFinish();
    watch(pass);
  }
  /// Where the picture that a camera sees lies, and what it was made from.
  struct Shown {
    const GlObject& colour;
    LabelOutputs labels;
    const GlObject& depth;
    unsigned depth_format;
    std::vector<View> views;
    std::vector<std::int64_t> seen;  ///< pixels of each instance in all views, behind a lens
  };
  /// Of a picture, beside colour, depth and the label word.
  struct Wanted {
    bool normals = false;
    bool counts = false;                   ///< of the pixels of each instance
    Image<std::uint16_t>* body = nullptr;  ///< the place for bodies, if any
    Image<float>* light = nullptr;         ///< and for the light on what is seen
  };
  Shown Show(const CameraIntrinsics& camera, const Pose& X_WC, const SceneState& state,
             const LuminancePicture* luminance, const Wanted& wanted);
  void Clear(const LensPictures& p, bool normals) const;
  void Measure(const Shown& shown, const SceneState& state, CameraFrame* frame);
};

Rasterizer::Rasterizer(const SceneModel& model, const EglOptions& options)
    : impl_(std::make_unique<Impl>(model, options)) {
  impl_->current.Release();
}

Rasterizer::~Rasterizer() { impl_->current.Take(); }

const GlInfo& Rasterizer::info() const { return impl_->context.info(); }

const SceneModel& Rasterizer::model() const { return impl_->model; }

Vec3 Rasterizer::sun_illuminance_lx() const {
  return impl_->daylight.sky().sun_illuminance_lx().cast<double>();
}

std::int64_t Rasterizer::uploaded_tiles() const { return impl_->terrain.uploaded_tiles(); }

void Rasterizer::Watch(PassWatch done) { impl_->watch = std::move(done); }

std::int64_t Rasterizer::triangles_drawn() const {
  return impl_->nodes.triangles_drawn() + impl_->terrain.triangles_drawn() +
         impl_->grains.triangles_drawn();
}

Pictures& Rasterizer::Impl::PicturesOf(int width_px, int height_px, bool linear) {
  for (Pictures& p : pictures) {
    if (p.width_px == width_px && p.height_px == height_px && p.linear == linear) return p;
  }
  return pictures.emplace_back(width_px, height_px, linear);
}

LensPictures& Rasterizer::Impl::LensPicturesOf(int width_px, int height_px, bool linear) {
  for (LensPictures& p : lens_pictures) {
    if (p.width_px == width_px && p.height_px == height_px && p.linear == linear) return p;
  }
  return lens_pictures.emplace_back(width_px, height_px, linear);
}

const Lens& Rasterizer::Impl::LensOf(const CameraIntrinsics& camera) {
  for (const Lens& lens : lenses) {
    if (lens.camera() == camera) return lens;
  }
  return lenses.emplace_back(camera);
}

void Rasterizer::Impl::FillScreen() const {
  glBindVertexArray(no_vertices.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Rasterizer::Impl::DrawGeometry(const View& view, const Pictures& p) {
  glBindFramebuffer(GL_FRAMEBUFFER, p.geometry_target.id());
  glViewport(0, 0, view.width_px, view.height_px);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  const float blank[4] = {0, 0, 0, 0};
  const std::uint32_t sky[4] = {0, 0, 0, 0};
  glDepthMask(GL_TRUE);
  glClearBufferfv(GL_COLOR, 0, blank);
  glClearBufferfv(GL_COLOR, 1, blank);
  glClearBufferuiv(GL_COLOR, 2, sky);
  glClearBufferfv(GL_DEPTH, 0, blank);  // infinitely far
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  for (const Program* program : {&node_program, &textured_program}) {
    program->Set("u_clip_from_relative", view.ClipFromRelative());
  }
  nodes.DrawOpaque(node_program, textured_program, view);
  Done("machines and obstacles");
  if (has_ground) {
    node_program.Use();
    grains.Draw();
    terrain.Draw(view);
    Done("ground");
  }
  glDisable(GL_DEPTH_TEST);
}

void Rasterizer::Impl::Occlude(const View& view, const Pictures& p) {
  glViewport(0, 0, (view.width_px + 1) / 2, (view.height_px + 1) / 2);
  glBindFramebuffer(GL_FRAMEBUFFER, p.open_target.id());
  occlusion_program.Use();
  glBindTextureUnit(0, p.depth.id());
  glBindTextureUnit(1, p.normal.id());
  occlusion_program.Set("u_depth", 0);
  occlusion_program.Set("u_normal", 1);
  occlusion_program.Set("u_focal_px", static_cast<float>(view.fx_px));
  SetView(view, occlusion_program);
  FillScreen();
  glBindFramebuffer(GL_FRAMEBUFFER, p.open_blurred_target.id());
  blur_program.Use();
  glBindTextureUnit(0, p.open.id());
  blur_program.Set("u_occlusion", 0);
  FillScreen();
  glViewport(0, 0, view.width_px, view.height_px);
}

void Rasterizer::Impl::Shade(const View& view, const Pictures& p) {
  glBindFramebuffer(GL_FRAMEBUFFER, wants_light ? light_pass->TargetOf(p) : p.sky_target.id());
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_LESS);  // only where something was drawn
  shade_program.Use();
  constexpr unsigned kGround = 4, kShadow = 7;
  glBindTextureUnit(0, p.albedo.id());
  glBindTextureUnit(1, p.normal.id());
  glBindTextureUnit(2, p.depth.id());
  glBindTextureUnit(3, p.open_blurred.id());
  shade_program.Set("u_albedo", 0);
  shade_program.Set("u_normal", 1);
  shade_program.Set("u_depth", 2);
  shade_program.Set("u_occlusion", 3);
  constexpr unsigned kLabel = 8;
  glBindTextureUnit(kLabel, p.label.id());
  shade_program.Set("u_label", static_cast<int>(kLabel));
  shade_program.Set("u_ground_shadow", static_cast<int>(kGround) + 2);
  shade_program.Set("u_shadow", static_cast<int>(kShadow));
  if (has_ground) {
    terrain.textures().Bind(kGround, shade_program);
  } else {
    glBindTextureUnit(kGround + 2, far_below.id());
  }
  const double penumbra_m = has_ground ? terrain.textures().penumbra_m() : 1.0;
  shade_program.Set("u_ground_penumbra_m", static_cast<float>(penumbra_m));
  shadow_map.Bind(kShadow, view.eye_W_m, shade_program);
  constexpr unsigned kLampShadow = 9;
  lamps.Bind(kLampShadow, view.eye_W_m, daylight.exposure(), shade_program);
  daylight.Light(shade_program);
  SetView(view, shade_program);
  FillScreen();
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

void Rasterizer::Impl::DrawSky(const View& view, const Pictures& p) {
  glBindFramebuffer(GL_FRAMEBUFFER, p.sky_target.id());
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_EQUAL);  // only where nothing was drawn
  sky_program.Use();
  daylight.BindSky(0, sky_program);
  daylight.Light(sky_program);
  SetView(view, sky_program);
  FillScreen();
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

/// Adds the light that surfaces give themselves, where they are what is seen.
void Rasterizer::Impl::DrawLights(const View& view, const Pictures& p) {
  if (!nodes.has_lights()) return;
  glBindFramebuffer(GL_FRAMEBUFFER, p.sky_target.id());
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GEQUAL);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  emissive_program.Use();
  emissive_program.Set("u_clip_from_relative", view.ClipFromRelative());
  daylight.Light(emissive_program);
  nodes.DrawLights(emissive_program);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

void Rasterizer::Impl::DrawGlass(const View& view, const Pictures& p) {
  if (!nodes.has_glass()) return;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glBindFramebuffer(GL_FRAMEBUFFER, p.sky_target.id());
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glass_program.Use();
  glass_program.Set("u_clip_from_relative", view.ClipFromRelative());
  daylight.Light(glass_program);
  nodes.Draw(NodeRenderer::Surface::kGlass);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glBindFramebuffer(GL_FRAMEBUFFER, p.glass_label_target.id());
  glass_label_program.Use();
  glass_label_program.Set("u_clip_from_relative", view.ClipFromRelative());
  nodes.Draw(NodeRenderer::Surface::kGlass);
  glDisable(GL_DEPTH_TEST);
}

/// From radiance to sRGB, or to itself, with smooth edges.
void Rasterizer::Impl::Develop(const Pictures& p) {
  glBindFramebuffer(GL_FRAMEBUFFER, p.tone_target.id());
  const Program& program = p.linear ? linear_program : tone_program;
  program.Use();
  glBindTextureUnit(0, p.radiance.id());
  program.Set("u_radiance", 0);
  FillScreen();
  glBindFramebuffer(GL_FRAMEBUFFER, p.colour_target.id());
  edge_program.Use();
  glBindTextureUnit(0, p.toned.id());
  edge_program.Set("u_colour", 0);
  FillScreen();
}

void Rasterizer::Impl::DrawPinhole(const View& view, const SceneState& state, const Pictures& p) {
  has_ground = state.terrain != nullptr;
  if (has_ground) {
    terrain.Update(*state.terrain);
    grains.Place(*state.terrain, view.eye_W_m);
  }
  nodes.Reshape(state);
  Done("changed ground");
  shadow_map.Update(state, view.eye_W_m, &nodes);
  lamps.Update(state, &nodes);
  Done("shadow pictures");
  nodes.Place(state, view.eye_W_m, &view);
  DrawGeometry(view, p);
  Occlude(view, p);
  Done("ambient occlusion");
  Shade(view, p);
  Done("shading");
  DrawLights(view, p);
  DrawSky(view, p);
  DrawGlass(view, p);
  Done("sky, glass, lights");
  if (state.dust != nullptr) {
    if (!dust) dust.emplace();
    dust->Draw(view, *state.dust, daylight, p, no_vertices);
  }
  if (rain) rain->Draw(view, state, daylight, p);
  Done("dust, rain");
  Develop(p);
  Done("tone and edges");
}

/// Fills what of the camera's picture comes from that view of its lens.
void Rasterizer::Impl::Distort(const Lens& lens, int view, bool normals, const Pictures& from,
                               const LensPictures& to) {
  glBindFramebuffer(GL_FRAMEBUFFER, (normals ? to.target : to.target_without_normals).id());
  glViewport(0, 0, to.width_px, to.height_px);
  const Program& program = normals ? lens_normals_program : lens_program;
  program.Use();
  glBindTextureUnit(0, from.colour.id());
  glBindTextureUnit(1, from.depth.id());
  glBindTextureUnit(2, from.label.id());
  glBindTextureUnit(3, lens.map().id());
  glBindTextureUnit(4, from.normal.id());
  program.Set("u_colour", 0);
  program.Set("u_depth", 1);
  program.Set("u_label", 2);
  program.Set("u_map", 3);
  program.Set("u_normal", 4);
  program.Set("u_view", view);
  FillScreen();
}

/// Share of each box's object that is seen. Behind a lens it is counted in the pinhole pictures.
void Rasterizer::Impl::Measure(const Shown& shown, const SceneState& state, CameraFrame* frame) {
  std::vector<std::uint16_t> visible;
  for (const ObjectBox& box : frame->boxes) visible.push_back(box.instance);
  std::vector<std::int64_t> alone(visible.size(), 0);
  for (const View& view : shown.views) {
    if (shown.views.size() > 1) nodes.Place(state, view.eye_W_m, &view);
    const std::vector<std::int64_t> in_view = silhouettes.Count(view, state, nodes, visible);
    for (std::size_t k = 0; k < alone.size(); ++k) alone[k] += in_view[k];
  }
  for (std::size_t k = 0; k < visible.size(); ++k) {
    ObjectBox& box = frame->boxes[k];
    const std::int64_t seen_px = shown.seen.empty() ? box.visible_px : shown.seen[box.instance];
    const auto alone_px = static_cast<double>(std::max<std::int64_t>(alone[k], 1));
    box.visibility = std::min(1.0, static_cast<double>(seen_px) / alone_px);
  }
}

void Rasterizer::Impl::Clear(const LensPictures& p, bool normals) const {
  const float dark[4] = {0, 0, 0, 0};
  const std::uint32_t nothing[4] = {0, 0, 0, 0};
  glBindFramebuffer(GL_FRAMEBUFFER, (normals ? p.target : p.target_without_normals).id());
  glClearBufferfv(GL_COLOR, 0, dark);
  glClearBufferuiv(GL_COLOR, 1, nothing);
  glClearBufferfv(GL_COLOR, 2, dark);
  if (normals) glClearBufferfv(GL_COLOR, 3, dark);
}

Rasterizer::Impl::Shown Rasterizer::Impl::Show(const CameraIntrinsics& camera, const Pose& X_WC,
                                               const SceneState& state,
                                               const LuminancePicture* luminance,
                                               const Wanted& wanted) {
  TERA_CHECK(static_cast<int>(state.X_WB.size()) >= model.body_count, state.X_WB.size());
  daylight.SetWhite(luminance ? std::optional(luminance->white_cdpm2) : std::nullopt);
  const bool linear = luminance != nullptr;
  if (wanted.body != nullptr && !bodies) bodies.emplace();
  wants_light = wanted.light != nullptr;
  if (wants_light && !light_pass) light_pass.emplace();
  if (!camera.Distorted()) {
    const Pictures& p = PicturesOf(camera.width_px, camera.height_px, linear);
    const View view(camera, X_WC);
    DrawPinhole(view, state, p);
    if (wanted.body != nullptr) {
      bodies->Draw(view, p, nodes, has_ground ? &grains : nullptr);
      *wanted.body = bodies->Read();
    }
    if (wants_light) *wanted.light = light_pass->Read(daylight.exposure());
    return {p.colour, {p.label, p.normal}, p.depth, GL_DEPTH_COMPONENT, {view}, {}};
  }
  const Lens& lens = LensOf(camera);
  const LensPictures& q = LensPicturesOf(camera.width_px, camera.height_px, linear);
  Shown shown{q.colour, {q.label, q.normal}, q.depth, GL_RED, {}, {}};
  Clear(q, wanted.normals);
  if (wanted.body != nullptr) bodies->ClearLens(q.width_px, q.height_px);
  if (wants_light) light_pass->ClearLens(q.width_px, q.height_px);
  for (std::size_t v = 0; v < lens.views().size(); ++v) {
    const auto& [R_CV, pinhole] = lens.views()[v];
    const Pictures& p = PicturesOf(pinhole.width_px, pinhole.height_px, linear);
    shown.views.emplace_back(pinhole, X_WC * MakePose(Vec3::Zero(), R_CV));
    DrawPinhole(shown.views.back(), state, p);
    Distort(lens, static_cast<int>(v), wanted.normals, p, q);
    Done("lens");
    if (wanted.body != nullptr) {
      bodies->Draw(shown.views.back(), p, nodes, has_ground ? &grains : nullptr);
      bodies->UseLens(lens, static_cast<int>(v));
      FillScreen();
    }
    if (wants_light) {
      light_pass->UseLens(lens, static_cast<int>(v));
      FillScreen();
    }
    if (wanted.counts) {
      AddTo(&shown.seen, CountPixels(ReadInstances(p.label, p.width_px, p.height_px), model));
    }
  }
  if (wanted.body != nullptr) *wanted.body = bodies->ReadLens();
  if (wants_light) *wanted.light = light_pass->ReadLens(daylight.exposure());
  return shown;
}

CameraFrame Rasterizer::Render(const CameraIntrinsics& camera, const Pose& X_WC,
                               const SceneState& state, LabelSet labels,
                               LuminancePicture* luminance, Image<std::uint16_t>* body,
                               Image<float>* light) {
  Impl& impl = *impl_;
  const EglContext::Current current(impl.context);
  const int width = camera.width_px, height = camera.height_px;
  const Impl::Shown shown =
      impl.Show(camera, X_WC, state, luminance, {labels[kNormalChannel], true, body, light});
  CameraFrame frame;
  frame.t_ns = state.t_ns;
  frame.t_available_ns = state.t_ns;
  if (luminance) {
    luminance->cdpm2 = ReadLuminance(shown.colour, width, height, luminance->white_cdpm2);
  } else {
    frame.rgb = ReadColour(shown.colour, width, height);
  }
  labels |= UsualLabels();  // boxes need the instances
  ReadLabels(shown.labels, width, height, X_WC.linear(), labels, &frame);
  frame.depth_m = ReadDepth(shown.depth, shown.depth_format, camera);
  impl.Done("read-back");
  frame.boxes = FindBoxes(impl.model, state, X_WC, frame.instance);
  impl.Done("boxes");
  impl.Measure(shown, state, &frame);
  impl.Done("silhouettes");
  AddWholeObjects(impl.model, state, camera, X_WC, frame, &frame.boxes);
  impl.Done("whole objects");
  return frame;
}

void Rasterizer::RenderLuminance(const CameraIntrinsics& camera, const Pose& X_WC,
                                 const SceneState& state, LuminancePicture* luminance) {
  const EglContext::Current current(impl_->context);
  const Impl::Shown shown = impl_->Show(camera, X_WC, state, luminance, {});
  luminance->cdpm2 =
      ReadLuminance(shown.colour, camera.width_px, camera.height_px, luminance->white_cdpm2);
}

}  // namespace tera
