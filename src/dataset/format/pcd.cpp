#include "dataset/format/pcd.h"

#include <fmt/format.h>
#include <liblzf/lzf.h>

#include <cstring>
#include <limits>
#include <sstream>

#include "core/check.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

constexpr char kFields[] = "x y z intensity time ring instance label";
constexpr char kSizes[] = "4 4 4 4 4 2 2 1";
constexpr char kTypes[] = "F F F F U U U U";
constexpr char kCounts[] = "1 1 1 1 1 1 1 1";
constexpr std::size_t kPointBytes = 4 * 5 + 2 * 2 + 1;
/// Space for the output of LZF: incompressible input grows by at most one byte in 32, and the
/// compressor needs some working space.
constexpr std::size_t kLzfSpareBytes = 64, kLzfGrowth = 16;

static_assert(std::endian::native == std::endian::little, "PCD data is little-endian");

std::string Header(std::size_t count) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {}\nSIZE {}\nTYPE {}\n"
      "COUNT {}\nWIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary_compressed\n",
      kFields, kSizes, kTypes, kCounts, count, count);
}

/// Calls `visit` with each member of a point, in the order of kFields.
template <typename Visit>
void ForEachField(const Visit& visit) {
  visit(&LidarPoint::x_m);
  visit(&LidarPoint::y_m);
  visit(&LidarPoint::z_m);
  visit(&LidarPoint::intensity);
  visit(&LidarPoint::time_offset_ns);
  visit(&LidarPoint::ring);
  visit(&LidarPoint::instance);
  visit(&LidarPoint::label);
}

std::string Columns(const std::vector<LidarPoint>& points) {
  std::string columns(points.size() * kPointBytes, '\0');
  char* out = columns.data();
  ForEachField([&](auto member) {
    for (const LidarPoint& point : points) {
      std::memcpy(out, &(point.*member), sizeof(point.*member));
      out += sizeof(point.*member);
    }
  });
  return columns;
}

std::vector<LidarPoint> FromColumns(const std::string& columns) {
  std::vector<LidarPoint> points(columns.size() / kPointBytes);
  const char* in = columns.data();
  ForEachField([&](auto member) {
    for (LidarPoint& point : points) {
      std::memcpy(&(point.*member), in, sizeof(point.*member));
      in += sizeof(point.*member);
    }
  });
  return points;
}

std::string Compress(const std::string& plain) {
  std::string packed(plain.size() + plain.size() / kLzfGrowth + kLzfSpareBytes, '\0');
  const unsigned size = lzf_compress(plain.data(), static_cast<unsigned>(plain.size()),
                                     packed.data(), static_cast<unsigned>(packed.size()));
  TERA_CHECK(size > 0, plain.size());
  packed.resize(size);
  return packed;
}

std::string Little(std::uint32_t value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

[[noreturn]] void Fail(const std::string& place, const std::string& finding) {
  throw InputError(place,
                   {FaultKind::kMalformed, fmt::format("{}; write the file again", finding)});
}

/// Returns the number of points in the header and sets `body` to the start of the data.
std::size_t ParseHeader(const std::string& place, const std::string& bytes, std::size_t* body) {
  const std::string last = "DATA binary_compressed\n";
  const std::size_t end = bytes.find(last);
  if (end == std::string::npos) Fail(place, "need a PCD header that ends in " + last.substr(0, 22));
  *body = end + last.size();
  std::stringstream header(bytes.substr(0, end));
  std::size_t count = 0;
  bool counted = false;
  int number = 0;
  for (std::string line; std::getline(header, line);) {
    ++number;
    const std::string key = line.substr(0, line.find(' '));
    const std::string value = line.size() > key.size() ? line.substr(key.size() + 1) : "";
    const auto need = [&](const char* expected) {
      if (value != expected) {
        Fail(fmt::format("{}:{}", place, number),
             fmt::format("found '{}', need '{} {}'", line, key, expected));
      }
    };
    if (key == "FIELDS") need(kFields);
    if (key == "SIZE") need(kSizes);
    if (key == "TYPE") need(kTypes);
    if (key == "COUNT") need(kCounts);
    if (key == "POINTS") counted = static_cast<bool>(std::stringstream(value) >> count);
  }
  if (!counted) Fail(place, "the PCD header lacks a number of POINTS");
  return count;
}

}  // namespace

std::string EncodePcd(const std::vector<LidarPoint>& points) {
  TERA_CHECK(points.size() < std::numeric_limits<std::uint32_t>::max() / (2 * kPointBytes),
             points.size());
  const std::string plain = Columns(points);
  const std::string packed = plain.empty() ? "" : Compress(plain);
  return Header(points.size()) + Little(static_cast<std::uint32_t>(packed.size())) +
         Little(static_cast<std::uint32_t>(plain.size())) + packed;
}

std::vector<LidarPoint> ReadPcd(const std::filesystem::path& file) {
  const std::string bytes = ReadWholeFile(file);
  std::size_t body = 0;
  const std::size_t count = ParseHeader(file.string(), bytes, &body);
  std::uint32_t sizes[2] = {0, 0};
  if (bytes.size() < body + sizeof sizes) Fail(file.string(), "truncated after the header");
  std::memcpy(sizes, bytes.data() + body, sizeof sizes);
  body += sizeof sizes;
  if (sizes[1] != count * kPointBytes) {
    Fail(file.string(), fmt::format("{} points need {} bytes of data, it holds {}", count,
                                    count * kPointBytes, sizes[1]));
  }
  if (bytes.size() != body + sizes[0]) {
    Fail(file.string(), fmt::format("truncated: need {} bytes of packed data, found {}", sizes[0],
                                    bytes.size() - body));
  }
  std::string columns(sizes[1], '\0');
  if (!columns.empty() &&
      lzf_decompress(bytes.data() + body, sizes[0], columns.data(), sizes[1]) != sizes[1]) {
    Fail(file.string(), "its packed data are damaged");
  }
  return FromColumns(columns);
}

}  // namespace tera
