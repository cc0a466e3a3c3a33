#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tera {

/// Statistics of the pixels of one class (see SurfaceSums).
struct SurfaceRealism {
  std::string name;  ///< class name, or "all"
  std::int64_t pixels = 0;
  double mscn_shape = 0, gradient_kurtosis = 0, chroma = 0, noise_dn = 0;
};

/// Statistics by which the images of a dataset can be compared with photographs.
struct Realism {
  int pictures = 0;
  double slope_mean = 0, slope_least = 0, slope_most = 0;  ///< slopes of amplitude spectra
  double colourfulness = 0;                                ///< mean over images
  std::vector<SurfaceRealism> surfaces;                    ///< all pixels first, then each class
};

}  // namespace tera
