#pragma once

#include <cstdint>

#include "core/types/measurement.h"
#include "core/uniform_bits.h"
#include "core/workers.h"

namespace tera {

/// Divides each non-zero depth z by 1 - s z n, with n standard normal. s is the disparity noise
/// over focal length and baseline. Where the noise exceeds the disparity, far away, depth becomes
/// 0. `air` is the optical depth per pixel and may be empty; the noise grows as air reduces the
/// contrast. Pixel i uses draw `first` + i.
void AddDisparityNoise(double scale_1pm, const UniformBits& noise, std::uint64_t first,
                       const Image<float>& air, Workers* workers, Image<float>* depth_m);

/// Adds N(0, sigma^2), in levels of 255, to each colour, and clips. Pixel i uses draw `first` + i.
void AddRgbNoise(double sigma, const UniformBits& noise, std::uint64_t first, Workers* workers,
                 Image<std::uint8_t>* rgb);

}  // namespace tera
