#pragma once

#include <optional>
#include <string>

#include "core/config/model_archive.h"

namespace tera {

/// Light that a lens scatters (glare.h).
struct GlareModel {
  double scattered = 0.02;  ///< share of the light
  double core_deg = 0.2;    ///< angle within which it is even
  double slope = 2;         ///< of its fall beyond, as a power of the angle
};

/// Pictures of the pupil that light makes on its way to and fro between a lens's surfaces
/// (flare.h).
struct FlareModel {
  int ghosts = 6;
  double reflectance = 0.01;  ///< of each of the two surfaces that make one
};

/// What lies on the glass before a lens (soiling.h).
struct SoilingModel {
  double distance_mm = 15;  ///< from the pupil to the glass
  double film = 0;          ///< mean share of the light that a film of dust takes
  int specks = 0;
  double speck_mm = 0.8;  ///< median diameter
  int drops = 0;
  double drop_mm = 2;  ///< median diameter
};

/// What a lens does to a picture beside projecting it; what is not there is ideal.
struct OpticsModel {
  std::optional<double> focus_m;  ///< distance that is in focus; none: all
  std::optional<GlareModel> glare;
  std::optional<FlareModel> flare;
  std::optional<SoilingModel> soiling;
};

void Serialize(ModelArchive* archive, OpticsModel* model);

}  // namespace tera
