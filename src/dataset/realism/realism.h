#pragma once

#include <cstdint>
#include <filesystem>
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

/// Measures one of `every_frame` colour pictures of all cameras of a dataset, by class if there are
/// labels. Throws InputError without colour pictures, for one smaller than 64 px, and as Recording
/// does.
Realism MeasureRealism(const std::filesystem::path& dataset, int every_frame);

/// A table with comparison figures of photographs and their sources.
std::string RealismTable(const Realism& realism);
/// The same numbers as JSON.
std::string RealismJson(const Realism& realism);

}  // namespace tera
