#include <array>

#include "dataset/import/cloud/cloud_bytes.h"

// Reads LAS files.

namespace tera {
namespace {

// Offsets of numbers in the public header block.
constexpr std::size_t kVersionAt = 24, kHeaderSizeAt = 94, kPointsAt = 96, kRecordsAt = 100,
                      kFormatAt = 104, kPointBytesAt = 105, kLegacyCountAt = 107, kScaleAt = 131,
                      kOffsetAt = 155, kExtendedAt = 235, kExtendedCountAt = 243, kCountAt = 247;
constexpr std::size_t kLeastHeader = 227, kHeaderOf14 = 375;
constexpr std::size_t kRecordHeader = 54, kExtendedHeader = 60, kUserBytes = 16;

/// Least record length of each point format.
constexpr std::array<std::uint16_t, 11> kPointBytes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

class LasReader {
 public:
  LasReader(const std::filesystem::path& file, std::string_view bytes)
      : file_(file), bytes_(bytes) {}

  PointCloud Read() {
    RequireHeader();
    PointCloud cloud;
    cloud.map = MapOf();
    ReadPoints(&cloud);
    return cloud;
  }

 private:
  [[noreturn]] void Refuse(const std::string& finding) const { RefuseCloud(file_, finding); }

  /// Number at an offset in the file. Throws InputError beyond the end.
  template <typename T>
  T At(std::uint64_t at) const {
    if (at > bytes_.size() || bytes_.size() - at < sizeof(T)) {
      Refuse(fmt::format("cut off: byte {} is needed, {} are there; copy the file again",
                         at + sizeof(T), bytes_.size()));
    }
    return NumberAt<T>(bytes_.data() + at);
  }

  void RequireHeader() const {
    if (!bytes_.starts_with("LASF")) Refuse("does not begin with 'LASF', the signature of LAS");
    const int major = At<std::uint8_t>(kVersionAt), minor = At<std::uint8_t>(kVersionAt + 1);
    if (major != 1 || minor > 4) {
      Refuse(fmt::format("LAS {}.{} found, need 1.0 to 1.4", major, minor));
    }
    const auto size = At<std::uint16_t>(kHeaderSizeAt);
    if (size < (Is14() ? kHeaderOf14 : kLeastHeader)) {
      Refuse(fmt::format("its header is {} bytes long, need at least {}", size,
                         Is14() ? kHeaderOf14 : kLeastHeader));
    }
    At<std::uint8_t>(size - 1U);
  }

  bool Is14() const { return At<std::uint8_t>(kVersionAt + 1) >= 4; }

  std::uint64_t Count() const {
    const std::uint64_t count =
        Is14() ? At<std::uint64_t>(kCountAt) : At<std::uint32_t>(kLegacyCountAt);
    RequirePointCount(file_, count);
    return count;
  }

  /// Coordinate reference system from WKT, or else from GeoTIFF keys; empty if there is none.
  std::string MapOf() const {
    std::string wkt, keys;
    const auto take = [&](std::uint64_t at, std::uint64_t header, std::uint64_t length) {
      constexpr std::uint16_t kWkt = 2112, kGeoKeys = 34735;
      const std::string_view user = bytes_.substr(at + 2, kUserBytes);
      if (!user.starts_with("LASF_Projection")) return;
      const auto id = At<std::uint16_t>(at + 2 + kUserBytes);
      const std::string_view body = bytes_.substr(at + header, length);
      if (id == kWkt) wkt = std::string(body.substr(0, body.find('\0')));
      if (id == kGeoKeys) keys = GeoKeys(body);
    };
    std::uint64_t at = At<std::uint16_t>(kHeaderSizeAt);
    for (std::uint32_t k = 0; k < At<std::uint32_t>(kRecordsAt); ++k) {
      const auto length = At<std::uint16_t>(at + 2 + kUserBytes + 2);
      RequireRecord(at, kRecordHeader + length);
      take(at, kRecordHeader, length);
      at += kRecordHeader + length;
    }
    at = Is14() ? At<std::uint64_t>(kExtendedAt) : 0;
    for (std::uint32_t k = 0; Is14() && k < At<std::uint32_t>(kExtendedCountAt); ++k) {
      const auto length = At<std::uint64_t>(at + 2 + kUserBytes + 2);
      RequireRecord(at, kExtendedHeader);
      RequireRecord(at + kExtendedHeader, length);
      take(at, kExtendedHeader, length);
      at += kExtendedHeader + length;
    }
    return wkt.empty() ? keys : wkt;
  }

  void RequireRecord(std::uint64_t at, std::uint64_t length) const {
    if (at <= bytes_.size() && length <= bytes_.size() - at) return;
    Refuse(fmt::format(
        "cut off: a record of its header exceeds the {} bytes of the file; copy the file again",
        bytes_.size()));
  }

  /// "EPSG:n" if the GeoTIFF keys name a projected or geographic system by code; words for a
  /// projected system without a code.
  std::string GeoKeys(std::string_view body) const {
    constexpr std::uint16_t kProjected = 3072, kGeographic = 2048, kVerticalUnits = 4099;
    constexpr std::uint16_t kMetre = 9001, kUserDefined = 32767;
    constexpr std::size_t kEntry = 4 * sizeof(std::uint16_t);
    std::string projected, geographic;
    for (std::size_t at = kEntry; at + kEntry <= body.size(); at += kEntry) {
      const auto key = NumberAt<std::uint16_t>(body.data() + at);
      const auto place = NumberAt<std::uint16_t>(body.data() + at + 2);
      const auto value = NumberAt<std::uint16_t>(body.data() + at + 6);
      if (key == kProjected && value == kUserDefined) {
        return "one of GeoTIFF keys without a code";
      }
      if (place != 0 || value == kUserDefined) continue;
      if (key == kVerticalUnits && value != kMetre) {
        Refuse(
            fmt::format("its heights are in EPSG unit {}, need metres (9001); convert them, "
                        "e.g. with pdal translate",
                        value));
      }
      if (key == kProjected) projected = fmt::format("EPSG:{}", value);
      if (key == kGeographic) geographic = fmt::format("EPSG:{}", value);
    }
    return projected.empty() ? geographic : projected;
  }

  void ReadPoints(PointCloud* cloud) const {
    constexpr std::uint8_t kPacked = 0x80, kFormatBits = 0x3f;
    const auto stated = At<std::uint8_t>(kFormatAt);
    const auto format = static_cast<std::uint8_t>(stated & kFormatBits);
    if (stated & kPacked) Refuse("its points are packed as LAZ; write it as LAS first");
    if (format >= kPointBytes.size()) {
      Refuse(fmt::format("point format {} found, need 0 to 10", format));
    }
    const auto record = At<std::uint16_t>(kPointBytesAt);
    if (record < kPointBytes[format]) {
      Refuse(fmt::format("its points are {} bytes long, format {} needs {}", record, format,
                         kPointBytes[format]));
    }
    const std::uint64_t first = At<std::uint32_t>(kPointsAt), count = Count();
    if (first > bytes_.size() || count * record > bytes_.size() - first) {
      Refuse(fmt::format("cut off: {} points need {} bytes, {} are there; copy the file again",
                         count, first + count * record, bytes_.size()));
    }
    const Vec3 scale = VectorAt(kScaleAt), offset = VectorAt(kOffsetAt);
    cloud->step_m = scale.cwiseAbs();
    for (std::uint64_t k = 0; k < count; ++k) {
      const char* point = bytes_.data() + first + k * record;
      if (IsMarked(format, point)) {
        ++cloud->marked;
        continue;
      }
      Vec3 p_m;
      for (int axis = 0; axis < 3; ++axis) {
        p_m[axis] = offset[axis] + scale[axis] * NumberAt<std::int32_t>(point + 4 * axis);
      }
      AddPoint(p_m, cloud);
    }
  }

  Vec3 VectorAt(std::size_t at) const {
    return {At<double>(at), At<double>(at + sizeof(double)), At<double>(at + 2 * sizeof(double))};
  }

  /// True for noise and withheld points.
  static bool IsMarked(std::uint8_t format, const char* point) {
    constexpr std::uint8_t kLowNoise = 7, kHighNoise = 18;
    constexpr std::uint8_t kLegacyClass = 0x1f, kLegacyWithheld = 0x80, kWithheld = 0x04;
    const auto flags = NumberAt<std::uint8_t>(point + 15);
    if (format < 6) return (flags & kLegacyWithheld) || (flags & kLegacyClass) == kLowNoise;
    const auto kind = NumberAt<std::uint8_t>(point + 16);
    return (flags & kWithheld) || kind == kLowNoise || kind == kHighNoise;
  }

  const std::filesystem::path& file_;
  std::string_view bytes_;
};

}  // namespace

PointCloud ParseLas(const std::filesystem::path& file, std::string_view bytes) {
  return LasReader(file, bytes).Read();
}

}  // namespace tera
