#pragma once

#include <cstdint>

#include "core/types/measurement.h"
#include "render/gl/egl_options.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// A small picture of a scenario's first instant, seen from above in the south-west. It is centred
/// on the machines and wide enough to show nearby objects.
///
/// Model   machines as placed, before settling.
/// Throws  InputError if a mesh cannot be loaded or OpenGL is not available.
Image<std::uint8_t> FirstLook(const Scenario& scenario, int width_px, int height_px,
                              const EglOptions& egl);

}  // namespace tera
