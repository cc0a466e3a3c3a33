#pragma once

#include <filesystem>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/realism/picture_statistics.h"
#include "dataset/realism/realism_figures.h"

namespace tera {

/// Sums over any number of pictures.
class RealismSums {
 public:
  RealismSums();

  /// Adds a colour picture, by class if it has labels. Throws InputError, with the camera's
  /// `folder`, for a picture smaller than 64 px and for labels of another size.
  void Add(const std::filesystem::path& folder, const CameraFrame& frame);
  int pictures() const { return told_.pictures; }
  /// Needs at least one picture.
  Realism Told() const;

 private:
  Realism told_;  ///< sums where Told has means
  SurfaceSums whole_;
  std::vector<SurfaceSums> of_class_;
};

}  // namespace tera
