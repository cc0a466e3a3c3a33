#include "render/air/wet_surface.h"

namespace tera {
namespace {

constexpr double kIndex = 1.33;     // refractive index of water, also at 905 nm
constexpr double kMirrored = 0.02;  // water's reflectance at normal incidence
constexpr double kDiffuse = 0.066;  // water's reflectance of diffuse light from outside
constexpr double kHeldBack = 1 - (1 - kDiffuse) / (kIndex * kIndex);

}  // namespace

double WetReflectance(double dry) {
  return (1 - kMirrored) * (1 - kHeldBack) * dry / (1 - kHeldBack * dry);
}

}  // namespace tera
