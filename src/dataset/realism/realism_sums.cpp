#include "dataset/realism/realism_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/types/labels.h"

namespace tera {
namespace {

constexpr int kSmallest_px = 64;
constexpr std::int64_t kFewestPixels = 1000;  ///< classes with fewer pixels are not reported

SurfaceRealism ToldOf(const std::string& name, const SurfaceSums& sums) {
  return {name,          sums.pixels(),  sums.mscn_shape(), sums.step_kurtosis(),
          sums.chroma(), sums.noise_dn()};
}

void RequireSize(const std::filesystem::path& folder, const CameraFrame& frame) {
  const Image<std::uint8_t>& semantic = frame.semantic;
  if (!semantic.empty() &&
      (semantic.width_px != frame.rgb.width_px || semantic.height_px != frame.rgb.height_px)) {
    throw InputError(
        folder.string(),
        fmt::format(
            "a picture of {} x {} px with classes of {} x {} px; need classes of the same size",
            frame.rgb.width_px, frame.rgb.height_px, semantic.width_px, semantic.height_px));
  }
  const int least_px = std::min(frame.rgb.width_px, frame.rgb.height_px);
  if (least_px >= kSmallest_px) return;
  throw InputError(
      folder.string(),
      {FaultKind::kOutOfRange, fmt::format("pictures of {} x {} px are too small, need at least {} "
                                           "px a side for a spectrum; record larger ones",
                                           frame.rgb.width_px, frame.rgb.height_px, kSmallest_px)});
}

}  // namespace

RealismSums::RealismSums() : of_class_(kSemanticClasses.size()) {
  told_.slope_least = std::numeric_limits<double>::infinity();
  told_.slope_most = -told_.slope_least;
}

void RealismSums::Add(const std::filesystem::path& folder, const CameraFrame& frame) {
  RequireSize(folder, frame);
  AddPicture(frame.rgb, frame.semantic, &whole_, &of_class_);
  const double slope = AmplitudeSlope(Luminance(frame.rgb));
  told_.slope_mean += slope;
  told_.slope_least = std::min(told_.slope_least, slope);
  told_.slope_most = std::max(told_.slope_most, slope);
  told_.colourfulness += Colourfulness(frame.rgb);
  ++told_.pictures;
}

Realism RealismSums::Told() const {
  Realism told = told_;
  told.slope_mean /= told.pictures;
  told.colourfulness /= told.pictures;
  told.surfaces.push_back(ToldOf("all", whole_));
  for (std::size_t c = 0; c < of_class_.size(); ++c) {
    if (of_class_[c].pixels() < kFewestPixels) continue;
    told.surfaces.push_back(ToldOf(std::string(kSemanticClasses[c].name), of_class_[c]));
  }
  return told;
}

}  // namespace tera
