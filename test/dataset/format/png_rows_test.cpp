#include "dataset/format/png_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace tera {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Form of the test files.
struct Form {
  int width = 0, height = 0;
  int colour = 0;  ///< 0 grey, 2 red, green, blue
  int bits = 8;
  int interlaced = 0;

  std::size_t pixel() const { return static_cast<std::size_t>((colour == 2 ? 3 : 1) * bits / 8); }
  std::size_t row() const { return pixel() * static_cast<std::size_t>(width); }
};

std::string Number(std::uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xff);
  return text;
}

std::string Chunk(const std::string& name, const std::string& content) {
  const std::string summed = name + content;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(summed.data()), static_cast<uInt>(summed.size()));
  return Number(static_cast<std::uint32_t>(content.size())) + summed +
         Number(static_cast<std::uint32_t>(sum));
}

/// The guess of a filter of the standard's table 9-1: Sub, Up, Average, Paeth.
int Guess(int filter, int left, int up, int corner) {
  const int p = left + up - corner;
  const int pa = std::abs(p - left), pb = std::abs(p - up), pc = std::abs(p - corner);
  switch (filter) {
    case 1:
      return left;
    case 2:
      return up;
    case 3:
      return (left + up) / 2;
    case 4:
      return pa <= pb && pa <= pc ? left : pb <= pc ? up : corner;
    default:
      return 0;
  }
}

/// The standard's encoding: row y has filter y % 5.
std::string Filtered(const Form& form, const Bytes& bytes) {
  const std::size_t row = form.row(), pixel = form.pixel();
  std::string filtered;
  for (std::size_t y = 0; y < static_cast<std::size_t>(form.height); ++y) {
    const int filter = static_cast<int>(y % 5);
    filtered += static_cast<char>(filter);
    const auto at = [&](std::size_t line, std::size_t k) { return bytes[line * row + k]; };
    for (std::size_t k = 0; k < row; ++k) {
      const int left = k >= pixel ? at(y, k - pixel) : 0;
      const int up = y > 0 ? at(y - 1, k) : 0;
      const int corner = k >= pixel && y > 0 ? at(y - 1, k - pixel) : 0;
      filtered += static_cast<char>(at(y, k) - Guess(filter, left, up, corner));
    }
  }
  return filtered;
}

std::string Deflated(const std::string& plain) {
  uLongf size = compressBound(plain.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(plain.data()), plain.size());
  packed.resize(size);
  return packed;
}

std::string Header(const Form& form) {
  return Number(static_cast<std::uint32_t>(form.width)) +
         Number(static_cast<std::uint32_t>(form.height)) + static_cast<char>(form.bits) +
         static_cast<char>(form.colour) + std::string(2, '\0') + static_cast<char>(form.interlaced);
}

/// The pixels in pieces, as written by libpng.
std::string PngOf(const Form& form, const std::string& packed, const std::string& between = "") {
  const std::size_t half = packed.size() / 2;
  return "\x89PNG\r\n\x1a\n" + Chunk("IHDR", Header(form)) + between +
         Chunk("IDAT", packed.substr(0, half)) + Chunk("IDAT", packed.substr(half)) +
         Chunk("IEND", "");
}

/// Slopes with slight noise, so that every filter has an effect.
Bytes PixelsOf(const Form& form) {
  Bytes bytes(form.row() * static_cast<std::size_t>(form.height));
  std::uint32_t noise = 1;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    noise = noise * 1664525u + 1013904223u;
    bytes[k] =
        static_cast<std::uint8_t>(7 * (k % form.row()) + 3 * (k / form.row()) + (noise >> 29));
  }
  return bytes;
}

const std::vector<Form> kForms = {{5, 11, 0, 8}, {4, 10, 0, 16}, {7, 12, 2, 8}, {3, 10, 2, 16}};

TEST(PngRows, AreThePixelsOfEveryFilterAndForm) {
  for (const Form& form : kForms) {
    const Bytes bytes = PixelsOf(form);
    const auto rows = DecodePngRows(PngOf(form, Deflated(Filtered(form, bytes))));
    ASSERT_TRUE(rows) << form.bits << " " << form.colour;
    EXPECT_EQ(rows->width_px, form.width);
    EXPECT_EQ(rows->height_px, form.height);
    EXPECT_EQ(rows->component_bits, form.bits);
    EXPECT_EQ(rows->components, form.colour == 2 ? 3 : 1);
    EXPECT_EQ(rows->bytes, bytes) << form.bits << " " << form.colour;
  }
}

// Other programs read the files of these tests with the same pixels.
TEST(PngRows, AreWhatOpenCvReads) {
  for (const Form& form : kForms) {
    const std::string png = PngOf(form, Deflated(Filtered(form, PixelsOf(form))));
    const cv::Mat image =
        cv::imdecode(cv::Mat(1, static_cast<int>(png.size()), CV_8U, const_cast<char*>(png.data())),
                     cv::IMREAD_UNCHANGED);
    ASSERT_FALSE(image.empty());
    const auto rows = DecodePngRows(png);
    ASSERT_TRUE(rows);
    const auto components = static_cast<std::size_t>(rows->components);
    for (std::size_t k = 0; k < rows->bytes.size() * 8 / static_cast<std::size_t>(form.bits); ++k) {
      // Blue first, and numbers of 16 bits as the computer has them.
      const std::size_t other = k - k % components + (components - 1 - k % components);
      const int theirs =
          form.bits == 8 ? image.ptr<std::uint8_t>()[other] : image.ptr<std::uint16_t>()[other];
      const int ours =
          form.bits == 8 ? rows->bytes[k] : rows->bytes[2 * k] << 8 | rows->bytes[2 * k + 1];
      EXPECT_EQ(ours, theirs) << k;
    }
  }
}

TEST(PngRows, AreNothingOfAFileThatIsNotWhole) {
  const Form form = kForms[2];
  const std::string png = PngOf(form, Deflated(Filtered(form, PixelsOf(form))));
  ASSERT_TRUE(DecodePngRows(png));
  for (std::size_t size = 0; size < png.size(); ++size) {
    EXPECT_FALSE(DecodePngRows(png.substr(0, size))) << size;
  }
  for (std::size_t k = 0; k < png.size(); ++k) {
    std::string damaged = png;
    damaged[k] = static_cast<char>(damaged[k] ^ 0x10);
    EXPECT_FALSE(DecodePngRows(damaged)) << k;
  }
  EXPECT_FALSE(DecodePngRows(png + "more"));
}

TEST(PngRows, AreNothingOfOtherForms) {
  const Form form = kForms[0];
  const std::string packed = Deflated(Filtered(form, PixelsOf(form)));
  ASSERT_TRUE(DecodePngRows(PngOf(form, packed)));
  EXPECT_FALSE(DecodePngRows(PngOf({5, 11, 0, 8, 1}, packed)));  // interlaced
  EXPECT_FALSE(DecodePngRows(PngOf({5, 11, 3, 8}, packed)));     // of a palette
  EXPECT_FALSE(DecodePngRows(PngOf({5, 11, 6, 8}, packed)));     // with an alpha channel
  EXPECT_FALSE(DecodePngRows(PngOf({5, 11, 0, 4}, packed)));
  EXPECT_FALSE(DecodePngRows(PngOf(form, packed, Chunk("tRNS", "12"))));
  EXPECT_FALSE(DecodePngRows(PngOf(form, packed, Chunk("IHDR", Header(form)))));
}

TEST(PngRows, AreNothingWhereSizeAndPixelsDisagree) {
  const Form form = kForms[0];
  const std::string packed = Deflated(Filtered(form, PixelsOf(form)));
  EXPECT_FALSE(DecodePngRows(PngOf({5, 12, 0, 8}, packed)));
  EXPECT_FALSE(DecodePngRows(PngOf({5, 10, 0, 8}, packed)));
  EXPECT_FALSE(DecodePngRows(PngOf({0, 11, 0, 8}, packed)));
  // A few bytes that claim 2 TB do not cause their allocation.
  EXPECT_FALSE(DecodePngRows(PngOf({1 << 20, 1 << 20, 2, 16}, packed)));
  std::string filtered = Filtered(form, PixelsOf(form));
  filtered[0] = 5;
  EXPECT_FALSE(DecodePngRows(PngOf(form, Deflated(filtered))));
}

}  // namespace
}  // namespace tera
