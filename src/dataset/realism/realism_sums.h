#pragma once

#include <filesystem>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/realism/picture_statistics.h"
#include "dataset/realism/realism_figures.h"

namespace tera {

/// Accumulates statistics over any number of images.
class RealismSums {
 public:
  RealismSums();

  /// Adds a colour image, by class if it has labels. Throws InputError that names the camera's
  /// `folder` if the image is smaller than 64 px or the labels have another size.
  void Add(const std::filesystem::path& folder, const CameraFrame& frame);
  int pictures() const { return told_.pictures; }
  /// Requires at least one image.
  Realism Told() const;

 private:
  Realism told_;  ///< holds sums where the result has means
  SurfaceSums whole_;
  std::vector<SurfaceSums> of_class_;
};

}  // namespace tera
