#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/compare/frame_pairs.h"
#include "dataset/realism/realism_figures.h"

namespace tera {

/// Colour pictures of a camera in one recording.
struct PictureSide {
  int width_px = 0, height_px = 0;
  Realism realism;
  double mean_dn = 0;           ///< luminance, 0 to 255
  double dark = 0, bright = 0;  ///< shares of pixels at 0 and at 255 in all colours
};

/// A camera in two recordings: `a` is the reference.
struct PictureComparison {
  SensorInBoth sensor;
  std::optional<PictureSide> a, b;      ///< none without pairs of colour pictures
  std::optional<double> difference_dn;  ///< mean |luminance of b - a|; none if sizes differ
  std::vector<WorstFrame> worst;        ///< by that difference of one pair, in DN
};

/// Compares the colour pictures of cameras that both machines have, by the figures of `tera
/// realism`, exposure and the difference pixel by pixel. Throws InputError as RealismSums does.
std::vector<PictureComparison> ComparePictures(const RecordedMachine& a, const RecordedMachine& b,
                                               std::size_t every);

std::string PictureTable(const PictureComparison& comparison);

}  // namespace tera
