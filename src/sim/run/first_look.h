#pragma once

#include <cstdint>

#include "core/types/measurement.h"
#include "render/gl/egl_options.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// A small picture of a scenario's first instant, from outside: from the south-west and above, its
/// machines in the middle and so much about them that what stands near is seen.
///
/// Model   machines as they are placed, before they settle.
/// Throws  InputError where a mesh cannot be loaded or nothing can be drawn.
Image<std::uint8_t> FirstLook(const Scenario& scenario, int width_px, int height_px,
                              const EglOptions& egl);

}  // namespace tera
