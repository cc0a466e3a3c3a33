#include "render/gl/rasterizer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/check.h"
#include "render/gl/amodal_boxes.h"
#include "render/gl/boxes.h"
#include "render/gl/egl_context.h"
#include "render/gl/object_boxes.h"
#include "render/gl/passes/body_pass.h"
#include "render/gl/passes/lens.h"
#include "render/gl/passes/lens_pass.h"
#include "render/gl/passes/light_pass.h"
#include "render/gl/pictures.h"
#include "render/gl/pinhole_painter.h"
#include "render/gl/pixel_buffer.h"
#include "render/gl/read_labels.h"
#include "render/gl/read_pictures.h"
#include "render/gl/view.h"

namespace tera {
namespace {

void AddTo(std::vector<std::int64_t>* sums, const std::vector<std::int64_t>& counts) {
  sums->resize(std::max(sums->size(), counts.size()), 0);
  for (std::size_t i = 0; i < counts.size(); ++i) (*sums)[i] += counts[i];
}

/// The entry of `all` with this size and colour format; created if absent.
template <typename AnyPictures>
AnyPictures& FittingOf(int width_px, int height_px, bool linear, std::vector<AnyPictures>* all) {
  for (AnyPictures& p : *all) {
    if (p.width_px == width_px && p.height_px == height_px && p.linear == linear) return p;
  }
  return all->emplace_back(width_px, height_px, linear);
}

}  // namespace

struct Rasterizer::Impl {
  SceneModel model;
  Workers workers;
  PassWatch watch;
  EglContext context;
  EglContext::Current current;  // current during construction and destruction of the members below
  PinholePainter painter;
  Silhouettes silhouettes;
  LensPass lens_pass;
  std::optional<BodyPass> bodies;  // created by the first request
  std::optional<LightPass> light_pass;
  std::vector<Pictures> pictures;  // one per size and colour format
  std::vector<LensPictures> lens_pictures;
  std::vector<Lens> lenses;
  PixelBuffer colour_copy, word_copy, normal_copy, depth_copy;

  Impl(const SceneModel& scene, const EglOptions& options, int threads)
      : model(scene),
        workers(threads),
        context(options),
        current(context),
        painter(model, &workers, [this](const char* pass) { Done(pass); }),
        silhouettes(model) {}

  /// The GPU images of a rendered camera image.
  struct Shown {
    const GlObject& colour;
    LabelOutputs labels;
    const GlObject& depth;
    unsigned depth_format;
    std::vector<View> views;
    /// With a lens: visible pixels of each instance, summed over the pinhole views.
    std::vector<std::int64_t> seen;
  };
  /// Requested outputs besides colour, depth and the label word.
  struct Wanted {
    bool normals = false;
    bool counts = false;                   ///< pixel count of each instance
    Image<std::uint16_t>* body = nullptr;  ///< output for bodies, or null
    Image<float>* light = nullptr;         ///< output for the illuminance, or null
  };
  const Lens& LensOf(const CameraIntrinsics& camera);
  Shown Show(const CameraIntrinsics& camera, const Pose& X_WC, const SceneState& state,
             const LuminancePicture* luminance, const Wanted& wanted);
  Shown ShowPinhole(const CameraIntrinsics& camera, const Pose& X_WC, const SceneState& state,
                    bool linear, const Wanted& wanted);
  Shown ShowThroughLens(const Lens& lens, const Pose& X_WC, const SceneState& state, bool linear,
                        const Wanted& wanted);
  LightPass* LightFor(const Wanted& wanted) {
    return wanted.light != nullptr ? &*light_pass : nullptr;
  }
  void BeginReading(const Shown& shown, const CameraIntrinsics& camera, bool normals);
  void TakeLabels(const CameraIntrinsics& camera, const Mat3& R_WC, LabelSet labels,
                  CameraFrame* frame);
  void Measure(const Shown& shown, const SceneState& state, CameraFrame* frame);
  void Done(const char* pass) const {
    if (!watch) return;
    glFinish();
    watch(pass);
  }
};

Rasterizer::Rasterizer(const SceneModel& model, const EglOptions& options, int threads)
    : impl_(std::make_unique<Impl>(model, options, threads)) {
  impl_->current.Release();
}

Rasterizer::~Rasterizer() { impl_->current.Take(); }

const GlInfo& Rasterizer::info() const { return impl_->context.info(); }

const SceneModel& Rasterizer::model() const { return impl_->model; }

Workers* Rasterizer::workers() const { return &impl_->workers; }

Vec3 Rasterizer::sun_illuminance_lx() const {
  return impl_->painter.daylight().sky().sun_illuminance_lx().cast<double>();
}

std::int64_t Rasterizer::uploaded_tiles() const {
  return impl_->painter.terrain().uploaded_tiles();
}

void Rasterizer::Watch(PassWatch done) { impl_->watch = std::move(done); }

std::int64_t Rasterizer::triangles_drawn() const { return impl_->painter.triangles_drawn(); }

const Lens& Rasterizer::Impl::LensOf(const CameraIntrinsics& camera) {
  for (const Lens& lens : lenses) {
    if (lens.camera() == camera) return lens;
  }
  return lenses.emplace_back(camera);
}

/// Computes the visible fraction of each box. With a lens, the pinhole images supply the counts.
void Rasterizer::Impl::Measure(const Shown& shown, const SceneState& state, CameraFrame* frame) {
  NodeRenderer& nodes = painter.nodes();
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

Rasterizer::Impl::Shown Rasterizer::Impl::Show(const CameraIntrinsics& camera, const Pose& X_WC,
                                               const SceneState& state,
                                               const LuminancePicture* luminance,
                                               const Wanted& wanted) {
  TERA_CHECK(static_cast<int>(state.X_WB.size()) >= model.body_count, state.X_WB.size());
  painter.SetWhite(luminance ? std::optional(luminance->white_cdpm2) : std::nullopt);
  if (wanted.body != nullptr && !bodies) bodies.emplace();
  if (wanted.light != nullptr && !light_pass) light_pass.emplace();
  const bool linear = luminance != nullptr;
  if (!camera.Distorted()) return ShowPinhole(camera, X_WC, state, linear, wanted);
  return ShowThroughLens(LensOf(camera), X_WC, state, linear, wanted);
}

Rasterizer::Impl::Shown Rasterizer::Impl::ShowPinhole(const CameraIntrinsics& camera,
                                                      const Pose& X_WC, const SceneState& state,
                                                      bool linear, const Wanted& wanted) {
  const Pictures& p = FittingOf(camera.width_px, camera.height_px, linear, &pictures);
  const View view(camera, X_WC);
  painter.Draw(view, state, p, LightFor(wanted));
  if (wanted.body != nullptr) {
    bodies->Draw(view, p, painter.nodes(), painter.grains());
    *wanted.body = bodies->Read();
  }
  if (wanted.light != nullptr) *wanted.light = light_pass->Read(painter.daylight().exposure());
  return {p.colour, {p.label, p.normal}, p.depth, GL_DEPTH_COMPONENT, {view}, {}};
}

Rasterizer::Impl::Shown Rasterizer::Impl::ShowThroughLens(const Lens& lens, const Pose& X_WC,
                                                          const SceneState& state, bool linear,
                                                          const Wanted& wanted) {
  const CameraIntrinsics& camera = lens.camera();
  const LensPictures& q = FittingOf(camera.width_px, camera.height_px, linear, &lens_pictures);
  Shown shown{q.colour, {q.label, q.normal}, q.depth, GL_RED, {}, {}};
  lens_pass.Clear(q, wanted.normals);
  if (wanted.body != nullptr) bodies->ClearLens(q.width_px, q.height_px);
  if (wanted.light != nullptr) light_pass->ClearLens(q.width_px, q.height_px);
  for (std::size_t v = 0; v < lens.views().size(); ++v) {
    const auto& [R_CV, pinhole] = lens.views()[v];
    const auto number = static_cast<int>(v);
    const Pictures& p = FittingOf(pinhole.width_px, pinhole.height_px, linear, &pictures);
    const View& view = shown.views.emplace_back(pinhole, X_WC * MakePose(Vec3::Zero(), R_CV));
    painter.Draw(view, state, p, LightFor(wanted));
    lens_pass.Draw(lens, number, wanted.normals, p, q);
    Done("lens");
    if (wanted.body != nullptr) {
      bodies->Draw(view, p, painter.nodes(), painter.grains());
      bodies->DrawLens(lens, number);
    }
    if (wanted.light != nullptr) light_pass->DrawLens(lens, number);
    if (wanted.counts) {
      AddTo(&shown.seen, CountPixels(ReadInstances(p.label, p.width_px, p.height_px), model));
    }
  }
  if (wanted.body != nullptr) *wanted.body = bodies->ReadLens();
  if (wanted.light != nullptr) *wanted.light = light_pass->ReadLens(painter.daylight().exposure());
  return shown;
}

/// Starts the copies. They complete in this order, and the reader uses them in this order.
void Rasterizer::Impl::BeginReading(const Shown& shown, const CameraIntrinsics& camera,
                                    bool normals) {
  const std::size_t pixels = static_cast<std::size_t>(camera.width_px) * camera.height_px;
  word_copy.Begin(shown.labels.word, GL_RED_INTEGER, GL_UNSIGNED_INT, pixels,
                  sizeof(std::uint32_t));
  if (normals) {
    normal_copy.Begin(shown.labels.normal, GL_RGBA, GL_UNSIGNED_SHORT, pixels,
                      4 * sizeof(std::uint16_t));
  }
  depth_copy.Begin(shown.depth, shown.depth_format, GL_FLOAT, pixels, sizeof(float));
}

void Rasterizer::Impl::TakeLabels(const CameraIntrinsics& camera, const Mat3& R_WC, LabelSet labels,
                                  CameraFrame* frame) {
  ReadLabelOutputs outputs{word_copy.Read<std::uint32_t>(), {}};
  if (labels[kNormalChannel]) outputs.normal = normal_copy.Read<std::uint16_t>();
  FillLabels(outputs, camera.width_px, camera.height_px, R_WC, labels, &workers, frame);
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
  labels |= UsualLabels();  // boxes need the instances
  impl.BeginReading(shown, camera, labels[kNormalChannel]);
  if (luminance) {
    luminance->cdpm2 = ReadLuminance(shown.colour, width, height, luminance->white_cdpm2);
  } else {
    impl.colour_copy.Begin(shown.colour, GL_RGBA, GL_UNSIGNED_BYTE,
                           static_cast<std::size_t>(width) * height, 4);
  }
  impl.TakeLabels(camera, X_WC.linear(), labels, &frame);
  frame.depth_m = DepthOf(impl.depth_copy.Read<float>(), camera, &impl.workers);
  if (!luminance) {
    frame.rgb = ColourOf(impl.colour_copy.Read<std::uint8_t>(), width, height, &impl.workers);
  }
  impl.Done("read-back");
  frame.boxes = FindBoxes(impl.model, state, X_WC, frame.instance, &impl.workers);
  impl.Done("boxes");
  impl.Measure(shown, state, &frame);
  impl.Done("silhouettes");
  AddWholeObjects(impl.model, state, camera, X_WC, frame, &impl.workers, &frame.boxes);
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
