#pragma once

#include <optional>

#include "render/gl/gl_objects.h"
#include "render/gl/passes/sky.h"

namespace tera {

/// The sky on the GPU, and the exposure of the image.
///
/// Model   exposure = 1 / (1.2 2^EV100): the luminance that saturates an ISO 100 sensor maps to 1.
///         Extinction of the fog = -ln(0.02) / visibility (Koschmieder).
/// Source  Lagarde, de Rousiers 2014, "Moving Frostbite to physically based rendering", section
///         5.1; ISO 12232 for saturation-based speed.
class Daylight {
 public:
  explicit Daylight(const Environment& environment);

  const Sky& sky() const { return sky_; }
  /// Sets the luminance that maps to 1. If empty, the scene's exposure determines it.
  void SetWhite(std::optional<double> white_cdpm2);
  /// Factor from luminance to image value, in 1 / (cd/m^2).
  double exposure() const { return exposure_; }
  /// Sets the uniforms of light.glsl.
  void Light(const Program& program) const;
  /// Binds the sky texture to `unit` and sets the uniform of its exposure.
  void BindSky(unsigned unit, const Program& program) const;

 private:
  Sky sky_;
  float scene_exposure_;
  float exposure_;
  float extinction_1pm_;
  GlObject texture_;
};

}  // namespace tera
