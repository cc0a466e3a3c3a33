#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/types/measurement.h"

namespace tera {

/// Initialises the image codecs. Must be called before the first encoding thread starts: OpenCV
/// registers GDAL drivers on first use, which is unsafe while another thread registers them for a
/// GeoTIFF.
void PreparePng();

// Lossless PNG encodings of the image kinds of a camera.
std::string EncodeRgbPng(const Image<std::uint8_t>& rgb);
std::string EncodeGreyPng(const Image<std::uint8_t>& grey);
std::string EncodeGrey16Png(const Image<std::uint16_t>& grey);
/// An image with one or three channels.
std::string EncodePng(const Image<std::uint8_t>& image);
std::string EncodePng(const Image<std::uint16_t>& image);

/// Converts depth to whole millimetres. Depth 0 means no measurement or more than kMaxDepth_m, the
/// limit of 16 bits.
Image<std::uint16_t> DepthMillimetres(const Image<float>& depth_m);
Image<float> DepthMetres(const Image<std::uint16_t>& depth_mm);
inline constexpr double kMaxDepth_m = 65.535;

// Read PNG files of this kind. Throw InputError with the file name if the file is empty, truncated
// or not a PNG, or has another number of channels or bits.
Image<std::uint8_t> ReadRgbPng(const std::filesystem::path& file);
Image<std::uint8_t> ReadGreyPng(const std::filesystem::path& file);
Image<std::uint16_t> ReadGrey16Png(const std::filesystem::path& file);
/// Reads an image with `components` channels, as EncodePng writes it.
void ReadPng(const std::filesystem::path& file, int components, Image<std::uint8_t>* image);
void ReadPng(const std::filesystem::path& file, int components, Image<std::uint16_t>* image);

}  // namespace tera
