#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/config/model_archive.h"
#include "core/motion.h"

namespace tera {

/// Two wedge prisms that turn about the axis x of S and deflect the beam in sum.
struct RisleyPrisms {
  std::vector<double> deflection_rad;  ///< by each prism
  std::vector<double> speed_rpm;       ///< of each prism, positive from y to z
};

void Serialize(ModelArchive* archive, RisleyPrisms* prisms);

/// Directions of successive pulses of a lidar without a spinning head.
///
/// Frames  S sensor, x forward, y left, z up.
/// Model   pulse i leaves at i / pulses_per_s. Prisms: the beam leans from x by the vector
///         sum_k d_k (cos a_k, sin a_k) in y and z, with the deflections d_k and the angles
///         a_k = 2 pi speed_k t. A file: one pulse a row, from the first row again after the last.
/// Omits   refraction of thick prisms beyond the first order; the file's column of time.
/// Source  Brazeal, Wilkinson, Hochmair 2021, "A rigorous observation model for the Risley
///         prism-based Livox Mid-40 lidar sensor", to first order.
struct ScanPattern {
  double pulses_per_s = 0;
  std::optional<RisleyPrisms> prisms;
  std::optional<std::filesystem::path> csv;
  std::vector<Eigen::Vector3f> d_S;  ///< rows of the file, unit vectors

  Vec3 Direction(std::uint64_t pulse) const;
};

/// A file has the columns azimuth_deg and elevation_deg, or Azimuth/deg and Zenith/deg, as
/// Livox-SDK/livox_laser_simulation has them. Azimuths turn from x to y.
void Serialize(ModelArchive* archive, ScanPattern* pattern);

}  // namespace tera
