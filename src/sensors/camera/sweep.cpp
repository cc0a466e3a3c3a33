#include "sensors/camera/sweep.h"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "render/gl/amodal_boxes.h"
#include "render/gl/image_motion.h"
#include "render/gl/object_boxes.h"

namespace tera {
namespace {

/// Copies the rows of `from` for which `picture` is the middle of the exposure.
template <typename T>
void TakeRows(const Exposures& exposures, int picture, const Image<T>& from, Image<T>* to) {
  const auto row_values = static_cast<std::ptrdiff_t>(from.width_px) * from.channels;
  for (int y = 0; y < from.height_px; ++y) {
    if (exposures.MiddleOf(y) != picture) continue;
    std::copy_n(from.data.begin() + y * row_values, row_values, to->data.begin() + y * row_values);
  }
}

void TakeRows(const Exposures& exposures, int picture, const CameraFrame& from, CameraFrame* to) {
  TakeRows(exposures, picture, from.depth_m, &to->depth_m);
  for (const LabelChannel& channel : kLabelChannels) {
    std::visit([&](const auto label) { TakeRows(exposures, picture, from.*label, &(to->*label)); },
               channel.picture);
  }
}

void AddLight(const Exposures& exposures, int picture, const Image<float>& from, Image<float>* to) {
  const std::size_t row_values = static_cast<std::size_t>(from.width_px) * from.channels;
  for (int y = 0; y < from.height_px; ++y) {
    const auto share = static_cast<float>(exposures.Share(y, picture));
    if (share == 0) continue;
    const std::size_t first = static_cast<std::size_t>(y) * row_values;
    for (std::size_t i = first; i < first + row_values; ++i) to->data[i] += share * from.data[i];
  }
}

bool HasRows(const Exposures& exposures, int picture, int rows) {
  for (int y = 0; y < rows; ++y) {
    if (exposures.MiddleOf(y) == picture) return true;
  }
  return false;
}

/// Largest image motion over all exposures.
double Motion_px(const SweptView& view, const SceneModel& model, const SeenScene& middle,
                 const CameraFrame& frame, TimeNs t_ns) {
  const TimeNs reach_ns = FromSeconds(Exposures::Reach_s(view.shutter, view.exposure_s));
  double motion_px = 0;
  for (const TimeNs end_ns : {t_ns - reach_ns, t_ns + reach_ns}) {
    const SeenScene end = view.scene_at(end_ns);
    motion_px += ImageMotion_px(model, view.lens, frame, {middle.X_WC, middle.state.X_WB},
                                {end.X_WC, end.state.X_WB});
  }
  return motion_px;
}

/// Boxes around the objects of the composed image. Each object's visibility comes from its first
/// entry in `known`.
std::vector<ObjectBox> BoxesOf(const SceneModel& model, const CameraIntrinsics& lens,
                               const SeenScene& middle, const CameraFrame& frame,
                               const std::vector<ObjectBox>& known, Workers* workers) {
  std::vector<ObjectBox> boxes =
      FindBoxes(model, middle.state, middle.X_WC, frame.instance, workers);
  for (ObjectBox& box : boxes) {
    const auto same = std::find_if(known.begin(), known.end(), [&](const ObjectBox& other) {
      return other.instance == box.instance;
    });
    if (same != known.end()) box.visibility = same->visibility;
  }
  AddWholeObjects(model, middle.state, lens, middle.X_WC, frame, workers, &boxes);
  return boxes;
}

}  // namespace

CameraFrame Sweep(const SweptView& view, TimeNs t_ns, Rasterizer* rasterizer,
                  LuminancePicture* luminance, Image<std::uint16_t>* body, Image<float>* light_on) {
  const SeenScene middle = view.scene_at(t_ns);
  CameraFrame frame = rasterizer->Render(view.lens, middle.X_WC, middle.state, view.labels,
                                         luminance, body, light_on);
  const double motion_px = Motion_px(view, rasterizer->model(), middle, frame, t_ns);
  const Exposures exposures(view.shutter, view.exposure_s, view.lens.height_px,
                            Exposures::PicturesFor(view.shutter, motion_px));
  if (exposures.pictures() == 1) return frame;
  Image<float> light(view.lens.width_px, view.lens.height_px, 3);
  std::vector<ObjectBox> known = frame.boxes;
  for (int i = 0; i < exposures.pictures(); ++i) {
    if (i == exposures.pictures() / 2) {  // already rendered
      AddLight(exposures, i, luminance->cdpm2, &light);
      continue;
    }
    const SeenScene seen = view.scene_at(t_ns + exposures.Instant_ns(i));
    LuminancePicture at_instant{.white_cdpm2 = luminance->white_cdpm2};
    if (HasRows(exposures, i, view.lens.height_px)) {
      const CameraFrame rows =
          rasterizer->Render(view.lens, seen.X_WC, seen.state, view.labels, &at_instant);
      TakeRows(exposures, i, rows, &frame);
      known.insert(known.end(), rows.boxes.begin(), rows.boxes.end());
    } else {
      rasterizer->RenderLuminance(view.lens, seen.X_WC, seen.state, &at_instant);
    }
    AddLight(exposures, i, at_instant.cdpm2, &light);
  }
  luminance->cdpm2 = std::move(light);
  frame.boxes =
      BoxesOf(rasterizer->model(), view.lens, middle, frame, known, rasterizer->workers());
  return frame;
}

}  // namespace tera
