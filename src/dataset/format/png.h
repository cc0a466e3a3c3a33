#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/types/measurement.h"

namespace tera {

/// Initialises the codecs; call before the first encoding thread starts. OpenCV's first use
/// registers the drivers of GDAL. This is unsafe while another thread also registers them for a
/// GeoTIFF.
void PreparePng();

// Lossless PNG of each kind of camera image.
std::string EncodeRgbPng(const Image<std::uint8_t>& rgb);
std::string EncodeGreyPng(const Image<std::uint8_t>& grey);
std::string EncodeGrey16Png(const Image<std::uint16_t>& grey);
/// A picture of one or three components, of 8 or 16 bits.
std::string EncodePng(const Image<std::uint8_t>& image);
std::string EncodePng(const Image<std::uint16_t>& image);

/// Depth in whole millimetres, 0 without a measurement or beyond kMaxDepth_m, the limit of 16 bits.
Image<std::uint16_t> DepthMillimetres(const Image<float>& depth_m);
Image<float> DepthMetres(const Image<std::uint16_t>& depth_mm);
inline constexpr double kMaxDepth_m = 65.535;

// Read the same back. Throw InputError with the file if it is empty, truncated, not a PNG, or has
// other channels or depth.
Image<std::uint8_t> ReadRgbPng(const std::filesystem::path& file);
Image<std::uint8_t> ReadGreyPng(const std::filesystem::path& file);
Image<std::uint16_t> ReadGrey16Png(const std::filesystem::path& file);
/// The picture with `components` of EncodePng.
void ReadPng(const std::filesystem::path& file, int components, Image<std::uint8_t>* image);
void ReadPng(const std::filesystem::path& file, int components, Image<std::uint16_t>* image);

}  // namespace tera
