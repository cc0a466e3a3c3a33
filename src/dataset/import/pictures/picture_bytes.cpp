#include "dataset/import/pictures/picture_bytes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/error.h"

namespace tera {
namespace {

constexpr int kAsItIs = -1;
constexpr double kDepthUnit_m = 0.001;

/// A colour encoding of ROS.
struct ColourEncoding {
  std::string_view name;
  int type;    ///< OpenCV type of a pixel
  int to_rgb;  ///< OpenCV conversion code
};

// Bayer patterns are named differently: OpenCV uses the second and third pixel of the second row,
// ROS the first two pixels of the first row.
constexpr std::array<ColourEncoding, 16> kColours = {
    {{"rgb8", CV_8UC3, kAsItIs},
     {"bgr8", CV_8UC3, cv::COLOR_BGR2RGB},
     {"8UC3", CV_8UC3, cv::COLOR_BGR2RGB},
     {"rgba8", CV_8UC4, cv::COLOR_RGBA2RGB},
     {"bgra8", CV_8UC4, cv::COLOR_BGRA2RGB},
     {"8UC4", CV_8UC4, cv::COLOR_BGRA2RGB},
     {"mono8", CV_8UC1, cv::COLOR_GRAY2RGB},
     {"8UC1", CV_8UC1, cv::COLOR_GRAY2RGB},
     {"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2RGB},
     {"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2RGB},
     {"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2RGB},
     {"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2RGB},
     {"uyvy", CV_8UC2, cv::COLOR_YUV2RGB_UYVY},
     {"yuv422", CV_8UC2, cv::COLOR_YUV2RGB_UYVY},
     {"yuyv", CV_8UC2, cv::COLOR_YUV2RGB_YUY2},
     {"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2RGB_YUY2}}};

[[noreturn]] void RefusePicture(const std::string& place, FaultKind kind,
                                const std::string& finding) {
  throw InputError(place, {kind, finding});
}

template <typename T>
Image<T> CopyOf(const cv::Mat& pixels) {
  Image<T> image(pixels.cols, pixels.rows, pixels.channels());
  cv::Mat view(pixels.rows, pixels.cols, pixels.type(), image.data.data());
  pixels.copyTo(view);
  return image;
}

/// Raw pixels as an OpenCV matrix. Throws InputError unless size and number of bytes agree.
cv::Mat RowsOf(const RawPixels& p, int type, const std::string& place) {
  constexpr int kMostSide_px = 65535;
  const bool is_picture = p.width_px >= 1 && p.height_px >= 1 && p.width_px <= kMostSide_px &&
                          p.height_px <= kMostSide_px;
  const std::size_t row = static_cast<std::size_t>(p.width_px) * CV_ELEM_SIZE(type);
  if (!is_picture || p.step_bytes < row || p.step_bytes % CV_ELEM_SIZE1(type) != 0 ||
      p.bytes.size() / p.step_bytes < static_cast<std::size_t>(p.height_px)) {
    RefusePicture(place, FaultKind::kMalformed,
                  fmt::format("{} x {} px of {} in rows of {} bytes, with {} bytes; need sides of "
                              "1 to {} px and {} bytes a row, or skip it with --skip-bad-rows",
                              p.width_px, p.height_px, p.encoding, p.step_bytes, p.bytes.size(),
                              kMostSide_px, row));
  }
  return {p.height_px, p.width_px, type, const_cast<char*>(p.bytes.data()), p.step_bytes};
}

Image<float> DepthOf(const cv::Mat& pixels, double unit_m) {
  cv::Mat depth_m;
  pixels.convertTo(depth_m, CV_32F, unit_m);
  Image<float> image = CopyOf<float>(depth_m);
  for (float& z_m : image.data) {
    if (!std::isfinite(z_m) || z_m < 0) z_m = 0;
  }
  return image;
}

/// Raw depth in native byte order.
cv::Mat InOwnOrder(const cv::Mat& rows, bool is_big_endian) {
  cv::Mat own = rows.clone();
  if (!is_big_endian) return own;
  const std::size_t bytes = own.elemSize();
  for (std::size_t at = 0; at < own.total() * bytes; at += bytes) {
    std::reverse(own.data + at, own.data + at + bytes);
  }
  return own;
}

/// Some cameras append zeros after the end marker. The marker must be at the end, because an
/// embedded thumbnail has one too.
bool EndsAsJpeg(std::string_view bytes) {
  const std::size_t last = bytes.find_last_not_of('\0');
  return last != bytes.npos && bytes.substr(0, last + 1).ends_with("\xff\xd9");
}

/// Decodes with OpenCV. Returns an empty matrix on failure, including sizes beyond OpenCV's limits,
/// for which it throws.
cv::Mat Decoded(std::string_view bytes) {
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  try {
    return cv::imdecode(raw, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace

ImportedPicture DecodePixels(const RawPixels& pixels, const std::string& place) {
  if (pixels.encoding == "16UC1") {
    const cv::Mat rows = RowsOf(pixels, CV_16UC1, place);
    return {.rgb = {}, .depth_m = DepthOf(InOwnOrder(rows, pixels.is_big_endian), kDepthUnit_m)};
  }
  if (pixels.encoding == "32FC1") {
    const cv::Mat rows = RowsOf(pixels, CV_32FC1, place);
    return {.rgb = {}, .depth_m = DepthOf(InOwnOrder(rows, pixels.is_big_endian), 1)};
  }
  const auto colour = std::find_if(kColours.begin(), kColours.end(), [&](const ColourEncoding& c) {
    return c.name == pixels.encoding;
  });
  if (colour == kColours.end()) {
    std::vector<std::string_view> names;
    for (const ColourEncoding& one : kColours) names.push_back(one.name);
    RefusePicture(place, FaultKind::kUnsupported,
                  fmt::format("its pixels are '{}'; need {}, or 16UC1 or 32FC1 of depth; convert "
                              "them, as by image_proc, and record again",
                              pixels.encoding, fmt::join(names, ", ")));
  }
  const cv::Mat rows = RowsOf(pixels, colour->type, place);
  if (colour->to_rgb == kAsItIs) return {.rgb = CopyOf<std::uint8_t>(rows), .depth_m = {}};
  const bool is_pattern = pixels.encoding.starts_with("bayer") || colour->type == CV_8UC2;
  if (is_pattern && (pixels.width_px % 2 != 0 || pixels.height_px < 2)) {
    RefusePicture(place, FaultKind::kMalformed,
                  fmt::format("{} x {} px of {}; need an even width and two rows", pixels.width_px,
                              pixels.height_px, pixels.encoding));
  }
  cv::Mat rgb;
  cv::cvtColor(rows, rgb, colour->to_rgb);
  return {.rgb = CopyOf<std::uint8_t>(rgb), .depth_m = {}};
}

ImportedPicture DecodePictureFile(std::string_view bytes, const std::string& place) {
  // Other decoders of OpenCV and GDAL are unsafe for untrusted files.
  const bool is_png = bytes.starts_with("\x89PNG\r\n\x1a\n"),
             is_jpeg = bytes.starts_with("\xff\xd8");
  if (!is_png && !is_jpeg) {
    RefusePicture(
        place, FaultKind::kUnsupported,
        fmt::format("{} bytes that are neither PNG nor JPEG; convert the pictures to one of them",
                    bytes.size()));
  }
  const bool is_whole = is_png ? bytes.find("IEND") != bytes.npos : EndsAsJpeg(bytes);
  const cv::Mat read = is_whole ? Decoded(bytes) : cv::Mat();
  if (read.empty()) {
    RefusePicture(
        place, FaultKind::kMalformed,
        fmt::format("not a complete {} ({} bytes); copy it again, or skip it with --skip-bad-rows",
                    is_png ? "PNG" : "JPEG", bytes.size()));
  }
  if (read.type() == CV_16UC1) return {.rgb = {}, .depth_m = DepthOf(read, kDepthUnit_m)};
  const int channels = read.channels();
  if (read.depth() != CV_8U || (channels != 1 && channels != 3 && channels != 4)) {
    RefusePicture(
        place, FaultKind::kUnsupported,
        fmt::format("{} channels of {} bits; need colour or grey of 8 bits, or depth in mm "
                    "as grey of 16",
                    channels, 8 * read.elemSize1()));
  }
  cv::Mat rgb;
  cv::cvtColor(read, rgb,
               channels == 1   ? cv::COLOR_GRAY2RGB
               : channels == 3 ? cv::COLOR_BGR2RGB
                               : cv::COLOR_BGRA2RGB);
  return {.rgb = CopyOf<std::uint8_t>(rgb), .depth_m = {}};
}

}  // namespace tera
