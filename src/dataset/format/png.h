#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/types/measurement.h"

namespace tera {

/// Makes the codecs ready, before the first thread that encodes is started. OpenCV's first use of
/// them registers the drivers of GDAL, which is no safe thing to do while another thread registers
/// them too, for a GeoTIFF.
void PreparePng();

// Lossless PNG of each kind of image of a camera.
std::string EncodeRgbPng(const Image<std::uint8_t>& rgb);
std::string EncodeGreyPng(const Image<std::uint8_t>& grey);
std::string EncodeGrey16Png(const Image<std::uint16_t>& grey);
/// A picture of one or three components, of 8 or 16 bits.
std::string EncodePng(const Image<std::uint8_t>& image);
std::string EncodePng(const Image<std::uint16_t>& image);

/// Depth in whole millimetres, 0 where there is no measurement. Beyond kMaxDepth_m, which 16 bits
/// cannot hold, there is none.
Image<std::uint16_t> DepthMillimetres(const Image<float>& depth_m);
Image<float> DepthMetres(const Image<std::uint16_t>& depth_mm);
inline constexpr double kMaxDepth_m = 65.535;

// Read the same back. Throw InputError naming the file if it is empty, truncated, no PNG, or has
// other channels or depth than it must.
Image<std::uint8_t> ReadRgbPng(const std::filesystem::path& file);
Image<std::uint8_t> ReadGreyPng(const std::filesystem::path& file);
Image<std::uint16_t> ReadGrey16Png(const std::filesystem::path& file);
/// The picture with `components` as EncodePng wrote it.
void ReadPng(const std::filesystem::path& file, int components, Image<std::uint8_t>* image);
void ReadPng(const std::filesystem::path& file, int components, Image<std::uint16_t>* image);

}  // namespace tera
