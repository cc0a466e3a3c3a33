#pragma once

#include <optional>
#include <string>

#include "core/config/model_archive.h"

namespace tera {

/// Veiling glare of a lens (glare.h).
struct GlareModel {
  double scattered = 0.02;  ///< share of the light that is scattered
  double core_deg = 0.2;    ///< angle within which scattered light is uniform
  double slope = 2;         ///< exponent of the decay beyond the core
};

/// Ghosts by double reflection between lens surfaces (flare.h).
struct FlareModel {
  int ghosts = 6;
  double reflectance = 0.01;  ///< of each surface that forms a ghost
};

/// Matter on the glass in front of a lens (soiling.h).
struct SoilingModel {
  double distance_mm = 15;  ///< from the pupil to the glass
  double film = 0;          ///< mean share of the light that a dust film removes
  int specks = 0;
  double speck_mm = 0.8;  ///< median diameter
  int drops = 0;
  double drop_mm = 2;  ///< median diameter
};

/// Optical effects of a lens apart from projection. An absent effect is ideal.
struct OpticsModel {
  std::optional<double> focus_m;  ///< focus distance; none: sharp at any distance
  std::optional<GlareModel> glare;
  std::optional<FlareModel> flare;
  std::optional<SoilingModel> soiling;
};

void Serialize(ModelArchive* archive, OpticsModel* model);

}  // namespace tera
