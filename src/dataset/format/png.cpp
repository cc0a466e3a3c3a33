#include "dataset/format/png.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/png_rows.h"

namespace tera {
namespace {

constexpr double kMillimetresPerMetre = 1000.0;

/// Run-length strategy with OpenCV's default zlib level 1; rows are filtered by the left neighbour.
/// An explicit level would make libpng try every filter. That takes 50 % longer and makes files
/// only 8 % smaller.
constexpr int kStrategy = cv::IMWRITE_PNG_STRATEGY_RLE;

std::string Encode(const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  const bool done = cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_STRATEGY, kStrategy});
  TERA_CHECK(done, image.cols, image.rows, image.type());
  return std::string(bytes.begin(), bytes.end());
}

template <typename T>
cv::Mat View(const Image<T>& image, int type) {
  return cv::Mat(image.height_px, image.width_px, type, const_cast<T*>(image.data.data()));
}

/// OpenCV and GDAL select a decoder by the first bytes. Their other decoders are unsafe for
/// untrusted files, so only PNG is accepted.
bool BeginsAsPng(const std::string& bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

/// Checks that the end chunk is present, because libpng reports truncation only as a warning.
bool EndsAsPng(const std::string& bytes) {
  static constexpr char kEnd[] = "IEND\xae\x42\x60\x82";
  constexpr std::size_t kEndBytes = sizeof kEnd - 1;
  return bytes.size() > kEndBytes && bytes.compare(bytes.size() - kEndBytes, kEndBytes, kEnd) == 0;
}

/// Decodes with OpenCV, which reports faults and supports more formats than DecodePngRows.
cv::Mat Decode(const std::filesystem::path& file, const std::string& bytes, int type,
               const char* need) {
  cv::Mat image;
  if (BeginsAsPng(bytes) && EndsAsPng(bytes)) {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    image = cv::imdecode(raw, cv::IMREAD_UNCHANGED);
  }
  if (image.empty()) {
    throw InputError(file.string(),
                     {FaultKind::kMalformed,
                      fmt::format("not a whole PNG ({} bytes); need {}, write the file again",
                                  bytes.size(), need)});
  }
  if (image.type() != type) {
    throw InputError(file.string(), {FaultKind::kMistyped,
                                     fmt::format("has {} channels of {} bits; need {}",
                                                 image.channels(), 8 * image.elemSize1(), need)});
  }
  return image;
}

template <typename T>
Image<T> FromMat(const cv::Mat& mat) {
  TERA_CHECK(mat.isContinuous());
  Image<T> image(mat.cols, mat.rows, mat.channels());
  std::memcpy(image.data.data(), mat.data, image.data.size() * sizeof(T));
  return image;
}

constexpr char kRgb[] = "8-bit RGB", kGrey[] = "8-bit grey", kRgb16[] = "16-bit RGB",
               kGrey16[] = "16-bit grey";

/// PNG stores RGB; OpenCV expects BGR.
template <typename T>
std::string EncodeAny(const Image<T>& image, int depth) {
  TERA_CHECK(image.channels == 1 || image.channels == 3, image.channels);
  const cv::Mat view = View(image, CV_MAKETYPE(depth, image.channels));
  if (image.channels == 1) return Encode(view);
  cv::Mat bgr;
  cv::cvtColor(view, bgr, cv::COLOR_RGB2BGR);
  return Encode(bgr);
}

template <typename T>
Image<T> FromRows(const PngRows& rows) {
  Image<T> image(rows.width_px, rows.height_px, rows.components);
  if constexpr (sizeof(T) == 1) {
    std::copy(rows.bytes.begin(), rows.bytes.end(), image.data.begin());
  } else {
    for (std::size_t k = 0; k < image.data.size(); ++k) {
      image.data[k] = static_cast<T>(rows.bytes[2 * k] << 8 | rows.bytes[2 * k + 1]);
    }
  }
  return image;
}

template <typename T>
Image<T> ReadAny(const std::filesystem::path& file, int depth, int components, const char* need) {
  const std::string bytes = ReadWholeFile(file);
  const std::optional<PngRows> rows = DecodePngRows(bytes);
  constexpr int kBits = 8 * sizeof(T);
  if (rows && rows->components == components && rows->component_bits == kBits) {
    return FromRows<T>(*rows);
  }
  cv::Mat image = Decode(file, bytes, CV_MAKETYPE(depth, components), need);
  if (components == 3) cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
  return FromMat<T>(image);
}

}  // namespace

void PreparePng() { TERA_CHECK(cv::haveImageWriter(".png"), "OpenCV"); }

std::string EncodePng(const Image<std::uint8_t>& image) { return EncodeAny(image, CV_8U); }

std::string EncodePng(const Image<std::uint16_t>& image) { return EncodeAny(image, CV_16U); }

std::string EncodeRgbPng(const Image<std::uint8_t>& rgb) {
  TERA_CHECK(rgb.channels == 3, rgb.channels);
  return EncodePng(rgb);
}

std::string EncodeGreyPng(const Image<std::uint8_t>& grey) {
  TERA_CHECK(grey.channels == 1, grey.channels);
  return EncodePng(grey);
}

std::string EncodeGrey16Png(const Image<std::uint16_t>& grey) {
  TERA_CHECK(grey.channels == 1, grey.channels);
  return EncodePng(grey);
}

Image<std::uint16_t> DepthMillimetres(const Image<float>& depth_m) {
  Image<std::uint16_t> depth_mm(depth_m.width_px, depth_m.height_px, 1);
  for (std::size_t i = 0; i < depth_m.data.size(); ++i) {
    const double d_m = static_cast<double>(depth_m.data[i]);
    TERA_CHECK(d_m >= 0.0, d_m, i);
    depth_mm.data[i] =
        d_m > kMaxDepth_m ? 0 : static_cast<std::uint16_t>(std::lround(kMillimetresPerMetre * d_m));
  }
  return depth_mm;
}

Image<float> DepthMetres(const Image<std::uint16_t>& depth_mm) {
  Image<float> depth_m(depth_mm.width_px, depth_mm.height_px, 1);
  for (std::size_t i = 0; i < depth_mm.data.size(); ++i) {
    depth_m.data[i] = static_cast<float>(depth_mm.data[i] / kMillimetresPerMetre);
  }
  return depth_m;
}

void ReadPng(const std::filesystem::path& file, int components, Image<std::uint8_t>* image) {
  *image = ReadAny<std::uint8_t>(file, CV_8U, components, components == 3 ? kRgb : kGrey);
}

void ReadPng(const std::filesystem::path& file, int components, Image<std::uint16_t>* image) {
  *image = ReadAny<std::uint16_t>(file, CV_16U, components, components == 3 ? kRgb16 : kGrey16);
}

Image<std::uint8_t> ReadRgbPng(const std::filesystem::path& file) {
  return ReadAny<std::uint8_t>(file, CV_8U, 3, kRgb);
}

Image<std::uint8_t> ReadGreyPng(const std::filesystem::path& file) {
  return ReadAny<std::uint8_t>(file, CV_8U, 1, kGrey);
}

Image<std::uint16_t> ReadGrey16Png(const std::filesystem::path& file) {
  return ReadAny<std::uint16_t>(file, CV_16U, 1, kGrey16);
}

}  // namespace tera
