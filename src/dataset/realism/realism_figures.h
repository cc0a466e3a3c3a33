#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tera {

/// Statistics of the pixels of one class, from SurfaceSums.
struct SurfaceRealism {
  std::string name;  ///< class name, or "all"
  std::int64_t pixels = 0;
  double mscn_shape = 0, gradient_kurtosis = 0, chroma = 0, noise_dn = 0;
};

/// Similarity of a dataset's pictures to photographs.
struct Realism {
  int pictures = 0;
  double slope_mean = 0, slope_least = 0, slope_most = 0;  ///< slopes of amplitude spectra
  double colourfulness = 0;                                ///< mean
  std::vector<SurfaceRealism> surfaces;                    ///< all, then classes
};

}  // namespace tera
