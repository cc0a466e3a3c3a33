#pragma once

#include <cstdint>

#include "core/types/measurement.h"
#include "core/uniform_bits.h"
#include "core/workers.h"

namespace tera {

/// Divides each depth z that is not 0 by 1 - s z n, n standard normal, s being the noise of the
/// disparity over focal length and baseline: far away, where the noise is larger than the disparity
/// itself, there is no measurement. Behind dust, of which `dust` has the optical depth at each
/// pixel or nothing, it grows as the contrast falls. Pixel i has draw `first` + i.
void AddDisparityNoise(double scale_1pm, const UniformBits& noise, std::uint64_t first,
                       const Image<float>& dust, Workers* workers, Image<float>* depth_m);

/// Adds N(0, sigma^2), in steps of a value of 255, to each colour, and clips. Pixel i has draw
/// `first` + i.
void AddRgbNoise(double sigma, const UniformBits& noise, std::uint64_t first, Workers* workers,
                 Image<std::uint8_t>* rgb);

}  // namespace tera
