#include "dataset/import/pictures/camera_topic.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <vector>

#include "core/error.h"
#include "dataset/import/bag/topic_table.h"
#include "dataset/import/scans/message_cursor.h"

namespace tera {
namespace {

struct CameraInfoFields {
  std::uint32_t height_px = 0, width_px = 0, binning_x = 0, binning_y = 0;
  std::string model;
  std::vector<double> d;
  std::array<double, 9> k{}, r{};
  std::array<double, 12> p{};
  std::array<std::uint32_t, 4> region{};  ///< x, y, height and width of a cropped region
};

CameraInfoFields ReadFields(std::string_view encoding, std::string_view bytes) {
  MessageCursor cursor(encoding, bytes);
  CameraInfoFields info;
  cursor.HeaderStamp();
  info.height_px = cursor.Number<std::uint32_t>();
  info.width_px = cursor.Number<std::uint32_t>();
  info.model = std::string(cursor.Text());
  const auto count = cursor.Number<std::uint32_t>();
  constexpr std::uint32_t kMostCoefficients = 14;
  if (count > kMostCoefficients) {
    throw BadBytes{
        fmt::format("it has {} coefficients, need at most {}", count, kMostCoefficients)};
  }
  for (std::uint32_t k = 0; k < count; ++k) info.d.push_back(cursor.Number<double>());
  for (double& value : info.k) value = cursor.Number<double>();
  for (double& value : info.r) value = cursor.Number<double>();
  for (double& value : info.p) value = cursor.Number<double>();
  info.binning_x = cursor.Number<std::uint32_t>();
  info.binning_y = cursor.Number<std::uint32_t>();
  for (std::uint32_t& value : info.region) value = cursor.Number<std::uint32_t>();
  return info;
}

/// A distortion model: its name in ROS, its law, and its coefficients in the order of D.
struct KnownModel {
  std::string_view name, law;
  std::vector<double CameraLens::*> coefficients;
};

const std::array<KnownModel, 5>& KnownModels() {
  using L = CameraLens;
  static const std::array<KnownModel, 5> kModels = {
      {{"plumb_bob", "brown_conrady", {&L::k1, &L::k2, &L::p1, &L::p2, &L::k3}},
       {"rational_polynomial",
        "rational",
        {&L::k1, &L::k2, &L::p1, &L::p2, &L::k3, &L::k4, &L::k5, &L::k6}},
       {"equidistant", "kannala_brandt", {&L::k1, &L::k2, &L::k3, &L::k4}},
       {"fisheye", "kannala_brandt", {&L::k1, &L::k2, &L::k3, &L::k4}},
       {"", "brown_conrady", {}}}};
  return kModels;
}

/// Sets the lens from the matrix K and the coefficients D.
void TakeDistortion(const CameraInfoFields& info, const std::string& place, CameraLens* lens) {
  for (const KnownModel& model : KnownModels()) {
    if (model.name != info.model) continue;
    lens->law = model.law;
    for (std::size_t k = 0; k < info.d.size(); ++k) {
      if (k < model.coefficients.size()) {
        lens->*model.coefficients[k] = info.d[k];
      } else if (info.d[k] != 0) {
        break;
      }
      if (k + 1 == info.d.size()) return;
    }
    if (info.d.empty()) return;
  }
  throw InputError(place, {FaultKind::kUnsupported,
                           fmt::format("its distortion is '{}' with {} coefficients; need "
                                       "plumb_bob (up to 5), rational_polynomial (8) or "
                                       "equidistant (4); write the camera's 'lens' instead",
                                       info.model, info.d.size())});
}

CameraLens LensOf(const CameraInfoFields& info, const std::string& place, bool is_rectified) {
  const bool is_part = info.binning_x > 1 || info.binning_y > 1 || info.region[0] != 0 ||
                       info.region[1] != 0 ||
                       (info.region[2] != 0 && info.region[2] != info.height_px) ||
                       (info.region[3] != 0 && info.region[3] != info.width_px);
  if (is_part) {
    throw InputError(place, {FaultKind::kUnsupported,
                             "its pictures are binned or cropped; need full pictures, or write "
                             "their own 'lens' instead of 'info'"});
  }
  CameraLens lens{.width_px = static_cast<int>(info.width_px),
                  .height_px = static_cast<int>(info.height_px)};
  lens.fx_px = is_rectified ? info.p[0] : info.k[0];
  lens.cx_px = is_rectified ? info.p[2] : info.k[2];
  lens.fy_px = is_rectified ? info.p[5] : info.k[4];
  lens.cy_px = is_rectified ? info.p[6] : info.k[5];
  if (!is_rectified) TakeDistortion(info, place, &lens);
  if (lens.fx_px > 0 && lens.fy_px > 0) return lens;
  throw InputError(place,
                   {FaultKind::kOutOfRange,
                    fmt::format("its focal lengths are {} and {} px, as of an uncalibrated camera; "
                                "calibrate it, write its 'lens', or set 'uncalibrated: true'",
                                lens.fx_px, lens.fy_px)});
}

class FirstMessage : public BagVisitor {
 public:
  explicit FirstMessage(const BagTopic& topic) : topic_(topic) {}

  Wish Wants(const BagTopic& topic) override {
    return topic.name == topic_.name ? Wish::kTake : Wish::kSkip;
  }
  bool Take(std::size_t, const BagMessage& message) override {
    bytes_ = std::string(message.bytes);
    return false;
  }
  const std::optional<std::string>& bytes() const { return bytes_; }

 private:
  const BagTopic& topic_;
  std::optional<std::string> bytes_;
};

}  // namespace

StampedPicture ReadPictureMessage(const BagTopic& topic, const BagMessage& message,
                                  const std::string& place, bool by_log_time) {
  MessageCursor cursor(topic.message_encoding, message.bytes);
  const TimeNs stamp_ns = cursor.HeaderStamp();
  StampedPicture stamped{.t_ns = by_log_time ? message.log_ns : stamp_ns, .picture = {}};
  if (topic.type == kCompressedImageType) {
    const std::string_view format = cursor.Text();
    const auto bytes = cursor.Number<std::uint32_t>();
    if (format.find("compressedDepth") != format.npos) {
      throw InputError(place, {FaultKind::kUnsupported,
                               "has image_transport's compressedDepth; need the raw depth topic, "
                               "as from 'ros2 run image_transport republish'"});
    }
    stamped.picture = DecodePictureFile(cursor.Bytes(bytes), place);
    return stamped;
  }
  RawPixels pixels;
  constexpr std::uint32_t kMostSide_px = 1 << 20;  // larger sizes are reported together with the
                                                   // number of bytes
  pixels.height_px = static_cast<int>(std::min(cursor.Number<std::uint32_t>(), kMostSide_px));
  pixels.width_px = static_cast<int>(std::min(cursor.Number<std::uint32_t>(), kMostSide_px));
  pixels.encoding = cursor.Text();
  pixels.is_big_endian = cursor.Number<std::uint8_t>() != 0;
  pixels.step_bytes = cursor.Number<std::uint32_t>();
  const auto bytes = cursor.Number<std::uint32_t>();
  pixels.bytes = cursor.Bytes(bytes);
  stamped.picture = DecodePixels(pixels, place);
  return stamped;
}

std::string FaultOfFirstPicture(const std::filesystem::path& bag, const BagTopic& topic,
                                UnpackedFiles* unpacked) {
  FirstMessage first(topic);
  ReadBag(bag, unpacked, &first, /*to_the_damage=*/true);
  if (!first.bytes()) return "no message";
  try {
    ReadPictureMessage(topic, {.log_ns = 0, .bytes = *first.bytes()}, "", /*by_log_time=*/true);
    return "";
  } catch (const InputError& fault) {
    return fault.AsFinding().finding;
  } catch (const BadBytes& bad) {
    return bad.finding;
  }
}

CameraLens ReadCameraInfo(const std::filesystem::path& bag, const BagTopic& topic,
                          UnpackedFiles* unpacked, bool is_rectified) {
  FirstMessage first(topic);
  ReadBag(bag, unpacked, &first, /*to_the_damage=*/true);
  const std::string place = MessagePlace(bag, topic, 1);
  if (!first.bytes()) {
    throw InputError(
        place,
        {FaultKind::kMissing,
         "the topic has no message; write the camera's 'lens', or set 'uncalibrated: true'"});
  }
  try {
    return LensOf(ReadFields(topic.message_encoding, *first.bytes()), place, is_rectified);
  } catch (const BadBytes& bad) {
    throw InputError(place, {FaultKind::kMalformed, bad.finding + "; write the camera's 'lens'"});
  }
}

}  // namespace tera
