#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "blind/mujoco/plant/ground.h"
#include "core/error.h"

// TIFF 6.0 with one strip of floats, and the keys of GeoTIFF 1.1 (OGC 19-008) for UTM 32 N. Numbers
// are written as this computer has them, which the header says.

namespace tera::blind::mujoco {
namespace {

constexpr double kPixel_m = 0.25;

template <typename T>
void Append(T value, std::string* out) {
  out->append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename T>
std::string BytesOf(const std::vector<T>& values) {
  std::string bytes;
  for (const T& value : values) Append(value, &bytes);
  return bytes;
}

/// One entry of the directory: short numbers stand in it, longer ones behind it.
struct Field {
  std::uint16_t tag, type;
  std::uint32_t count;
  std::string bytes;
};
Field Short(std::uint16_t tag, std::uint16_t value) {
  return {tag, 3, 1, BytesOf<std::uint16_t>({value, 0})};
}
Field Long(std::uint16_t tag, std::uint32_t value) {
  return {tag, 4, 1, BytesOf<std::uint32_t>({value})};
}
Field Doubles(std::uint16_t tag, const std::vector<double>& values) {
  return {tag, 12, static_cast<std::uint32_t>(values.size()), BytesOf(values)};
}
Field Shorts(std::uint16_t tag, const std::vector<std::uint16_t>& values) {
  return {tag, 3, static_cast<std::uint32_t>(values.size()), BytesOf(values)};
}

/// UTM northing: the meridian's arc from the equator (Snyder 1987, eq. 3-21), times 0.9996.
double Northing_m() {
  const double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f), e4 = e2 * e2, e6 = e4 * e2;
  const double phi = kLatitude_deg * std::numbers::pi / 180;
  return 0.9996 * a *
         ((1 - e2 / 4 - 3 * e4 / 64 - 5 * e6 / 256) * phi -
          (3 * e2 / 8 + 3 * e4 / 32 + 45 * e6 / 1024) * std::sin(2 * phi) +
          (15 * e4 / 256 + 45 * e6 / 1024) * std::sin(4 * phi) -
          (35 * e6 / 3072) * std::sin(6 * phi));
}

/// Rows from north to south.
std::vector<float> Heights_m(const Ground& ground, int half) {
  std::vector<float> heights;
  for (int row = half; row >= -half; --row) {
    for (int column = -half; column <= half; ++column) {
      heights.push_back(
          static_cast<float>(kHeight_m + ground.Height_m(column * kPixel_m, row * kPixel_m)));
    }
  }
  return heights;
}

}  // namespace

void WriteGeoTiff(const Ground& ground, double half_m, const std::filesystem::path& file) {
  const int half = static_cast<int>(half_m / kPixel_m);
  const auto side = static_cast<std::uint32_t>(2 * half + 1);
  const std::string heights = BytesOf(Heights_m(ground, half));
  constexpr std::uint32_t kHeader = 8;
  const double edge_m = (half + 0.5) * kPixel_m;
  const std::vector<Field> fields = {
      Long(256, side), Long(257, side), Short(258, 32), Short(259, 1), Short(262, 1),
      Long(273, kHeader), Short(277, 1), Long(278, side),
      Long(279, static_cast<std::uint32_t>(heights.size())), Short(339, 3),
      Doubles(33550, {kPixel_m, kPixel_m, 0}),
      Doubles(33922, {0, 0, 0, 500000 - edge_m, Northing_m() + edge_m, 0}),
      // Version 1.1.0, three keys: projected, pixels are areas, EPSG:32632.
      Shorts(34735, {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32632})};
  const auto directory = static_cast<std::uint32_t>(kHeader + heights.size());
  std::string bytes = std::endian::native == std::endian::little ? "II" : "MM";
  Append<std::uint16_t>(42, &bytes);
  Append<std::uint32_t>(directory, &bytes);
  bytes += heights;
  std::string behind;
  const auto behind_at = static_cast<std::uint32_t>(directory + 2 + 12 * fields.size() + 4);
  Append(static_cast<std::uint16_t>(fields.size()), &bytes);
  for (const Field& field : fields) {
    Append(field.tag, &bytes);
    Append(field.type, &bytes);
    Append(field.count, &bytes);
    if (field.bytes.size() <= 4) {
      bytes += field.bytes;
    } else {
      Append(static_cast<std::uint32_t>(behind_at + behind.size()), &bytes);
      behind += field.bytes;
    }
  }
  Append<std::uint32_t>(0, &bytes);
  bytes += behind;
  std::ofstream stream(file, std::ios::binary);
  stream << bytes;
  stream.close();
  if (!stream)
    throw InputError(fmt::format("{}: cannot be written; check the disk", file.string()));
}

}  // namespace tera::blind::mujoco
