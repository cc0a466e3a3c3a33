#pragma once

#include <cstdint>

#include "core/types/measurement.h"
#include "resimulate/simulated_return.h"

namespace tera {

/// A simulated picture, pixel by pixel.
struct SimulatedPicture {
  Image<float> grey;            ///< 0 to 1, as stored (sRGB)
  Image<float> depth_m;         ///< along the optical axis; 0: nothing, as in the sky
  Image<std::uint8_t> surface;  ///< a Surface: kMachine moves with the camera's link
};

}  // namespace tera
