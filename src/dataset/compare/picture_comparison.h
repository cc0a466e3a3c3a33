#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/compare/frame_pairs.h"
#include "dataset/realism/realism_figures.h"

namespace tera {

/// Statistics of a camera's colour images in one recording.
struct PictureSide {
  int width_px = 0, height_px = 0;
  Realism realism;
  double mean_dn = 0;           ///< mean luminance, 0 to 255
  double dark = 0, bright = 0;  ///< fractions of pixels that are 0 or 255 in all channels
};

/// Comparison of a camera in two recordings. `a` is the reference.
struct PictureComparison {
  SensorInBoth sensor;
  std::optional<PictureSide> a, b;      ///< absent if there are no pairs of colour images
  std::optional<double> difference_dn;  ///< mean |luminance of b - luminance of a|; absent if the
                                        ///< sizes differ
  std::vector<WorstFrame> worst;        ///< pairs with the largest mean difference, in DN
};

/// Compares the colour images of every camera that both machines have: the statistics of `tera
/// realism`, exposure, and the difference per pixel. Throws InputError as RealismSums does.
std::vector<PictureComparison> ComparePictures(const RecordedMachine& a, const RecordedMachine& b,
                                               std::size_t every);

std::string PictureTable(const PictureComparison& comparison);

}  // namespace tera
