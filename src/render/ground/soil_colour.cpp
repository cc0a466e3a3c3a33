#include "render/ground/soil_colour.h"

#include <cmath>

namespace tera {
namespace {

constexpr double kSaturatedShare = 0.42;  // fraction of the dry albedo at full saturation
constexpr double kMoistureRate = 3.2;     // c of the moisture model
constexpr double kLooseLighter = 0.10;

}  // namespace

double SoilTone(double saturation, double looseness) {
  const double wet =
      kSaturatedShare + (1 - kSaturatedShare) * std::exp(-kMoistureRate * saturation);
  return wet * (1 + kLooseLighter * looseness);
}

}  // namespace tera
