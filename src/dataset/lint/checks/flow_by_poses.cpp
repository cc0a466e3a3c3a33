#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/types/image_flow.h"
#include "dataset/format/png.h"
#include "dataset/lint/checks/frames.h"
#include "dataset/lint/checks/lens_projection.h"
#include "dataset/lint/checks/sensor_poses.h"
#include "dataset/lint/lint_job.h"

// Compares optical flow of the ground with flow computed from distance and camera poses.

namespace tera {
namespace fs = std::filesystem;
namespace {

/// Number of images compared per camera, spread over the recording, and spacing of the compared
/// pixels. A wrong sign, order or pose affects every pixel.
constexpr std::size_t kMostFlowPictures = 20;
constexpr int kPixelStep = 5;
/// Covers rounding of flow (1/64 px) and distance (1 mm), and interpolation of poses. Interpolation
/// causes an error of a tenth of a pixel at 1 rad/s^2 and 50 Hz.
constexpr double kTolerance_px = 0.5, kToleranceShare = 0.1, kLeastAgreeing = 0.5;
constexpr int kFewestPixels = 50;

struct FlowAgreement {
  int compared = 0, agreeing = 0;
};

/// Images of the ground at one time, with the camera's motion since the previous image.
struct FlowView {
  Image<std::uint16_t> flow, distance, instance;
  Image<std::uint8_t> semantic;
  Pose X_PreviousNow;  ///< in the sensor frame S of the camera

  bool IsGround(int x, int y) const {
    return instance.at(x, y) == 0 &&
           semantic.at(x, y) == static_cast<std::uint8_t>(SemanticClass::kTerrain);
  }
};

void Compare(const FlowView& view, const CameraLens& lens, FlowAgreement* agreement) {
  for (int y = 0; y < lens.height_px; y += kPixelStep) {
    for (int x = 0; x < lens.width_px; x += kPixelStep) {
      const PixelFlow flow = FlowAt(view.flow, x, y);
      const int mm = view.distance.at(x, y);
      if (!view.IsGround(x, y) || mm == 0 || flow.state != FlowState::kSeen) continue;
      const auto ray_C = RayOf(Vec2(x, y), lens);
      if (!ray_C) continue;
      const Vec3 before_C_m = OpticalOf(view.X_PreviousNow * SensorOf(1e-3 * mm * *ray_C));
      const auto before_px = Project(before_C_m, lens);
      if (!before_px) continue;
      const Vec2 expected_px = *before_px - Vec2(x, y);
      ++agreement->compared;
      const double tolerance_px = kTolerance_px + kToleranceShare * expected_px.norm();
      if ((flow.flow_px - expected_px).norm() <= tolerance_px) ++agreement->agreeing;
    }
  }
}

/// Returns false if an image is damaged or has another size. Other rules report it.
bool Read(const LintJob& job, const std::string& camera, TimeNs t_ns, const CameraLens& lens,
          FlowView* view) {
  const auto file = [&](std::string_view folder) {
    return job.Path(FrameFile(camera, {folder, "png"}, t_ns));
  };
  try {
    ReadPng(file("flow_to_previous"), 3, &view->flow);
    ReadPng(file("distance"), 1, &view->distance);
    ReadPng(file("instance"), 1, &view->instance);
    ReadPng(file("semantic"), 1, &view->semantic);
  } catch (const InputError&) {
    return false;
  }
  const auto fits = [&](const auto& picture) {
    return picture.width_px == lens.width_px && picture.height_px == lens.height_px;
  };
  return fits(view->flow) && fits(view->distance) && fits(view->instance) && fits(view->semantic);
}

bool HasFolders(const LintJob& job, const std::string& camera) {
  const std::vector<FrameFolder> used = UsedPictureFolders(job, camera);
  const auto has = [&](std::string_view name) {
    return std::any_of(used.begin(), used.end(),
                       [&](const FrameFolder& folder) { return folder.name == name; });
  };
  return has("flow_to_previous") && has("distance") && has("instance") && has("semantic");
}

void CheckFlowOf(LintJob* job, const std::string& camera) {
  const std::optional<SensorSheet> sheet = job->SheetOf(camera);
  if (!sheet || !sheet->lens || !IsProjectable(*sheet->lens) || !HasFolders(*job, camera)) return;
  const std::optional<SensorPoses> sensor = FindSensorPoses(*job, camera);
  if (!sensor || sensor->of_root) return;
  const std::vector<FrameRow> frames = FramesOf(*job, camera);
  const std::size_t step = frames.size() / kMostFlowPictures + 1;
  FlowAgreement agreement;
  for (std::size_t i = 1; i < frames.size(); i += step) {
    const auto X_WS = PoseAt(sensor->poses, frames[i].t_ns);
    const auto X_WPrevious = PoseAt(sensor->poses, frames[i - 1].t_ns);
    FlowView view;
    if (!X_WS || !X_WPrevious || !Read(*job, camera, frames[i].t_ns, *sheet->lens, &view)) continue;
    view.X_PreviousNow = X_WPrevious->inverse() * *X_WS;
    Compare(view, *sheet->lens, &agreement);
  }
  if (agreement.compared < kFewestPixels) return;
  job->Applies("pictures.motion");
  if (agreement.agreeing >= kLeastAgreeing * agreement.compared) return;
  job->Find("pictures.motion", camera,
            {camera + "/flow_to_previous", 0,
             fmt::format("{} of {} ground pixels have the flow that the camera poses give",
                         agreement.agreeing, agreement.compared)});
}

}  // namespace

void CheckFlowByPoses(LintJob* job) {
  for (const std::string& camera : job->recording().SensorsOf(ChannelForm::kPictures)) {
    job->Try(camera, [&] { CheckFlowOf(job, camera); });
  }
}

}  // namespace tera
