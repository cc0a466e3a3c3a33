#include "dataset/import/scans/ouster_sheet.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

using Json = nlohmann::json;

constexpr double kMetre_mm = 1000;
constexpr std::uint32_t k20Bits = 0xfffff, k19Bits = 0x7ffff, k15Bits = 0x7fff;
constexpr double kMillimetre_m = 0.001, kEightMillimetres_m = 0.008;

const std::map<std::string, OusterPixel>& Profiles() {
  static const std::map<std::string, OusterPixel> profiles = {
      {"LEGACY", {12, k20Bits, kMillimetre_m, {{0, 4}}}},
      {"RNG19_RFL8_SIG16_NIR16", {12, k19Bits, kMillimetre_m, {{0, 4}}}},
      {"RNG19_RFL8_SIG16_NIR16_DUAL", {16, k19Bits, kMillimetre_m, {{0, 3}, {4, 7}}}},
      {"RNG15_RFL8_NIR8", {4, k15Bits, kEightMillimetres_m, {{0, 2}}}},
      {"RNG15_RFL8_NIR8_DUAL", {8, k15Bits, kEightMillimetres_m, {{0, 2}, {4, 6}}}},
      {"FUSA_RNG15_RFL8_NIR8_DUAL", {8, k15Bits, kEightMillimetres_m, {{0, 2}, {4, 6}}}}};
  return profiles;
}

/// Finds keys at the top level, or in the groups of newer firmware.
class SheetReader {
 public:
  explicit SheetReader(const std::filesystem::path& file) : file_(file.string()) {
    json_ = Json::parse(ReadWholeFile(file), nullptr, /*allow_exceptions=*/false);
    if (!json_.is_object()) {
      Fail("", FaultKind::kMalformed, "is not a JSON object; need the metadata of an Ouster");
    }
  }

  const Json* Find(const std::string& group, const std::string& key) const {
    const Json* at = &json_;
    if (json_.contains(group) && json_[group].is_object()) at = &json_[group];
    return at->contains(key) ? &(*at)[key] : nullptr;
  }
  /// A key of the group that describes packets. The group has two possible names.
  const Json* Format(const std::string& key) const {
    for (const char* group : {"lidar_data_format", "data_format"}) {
      if (json_.contains(group) && json_[group].is_object() && json_[group].contains(key)) {
        return &json_[group][key];
      }
    }
    return nullptr;
  }

  double Number(const Json* value, const std::string& key) const {
    if (value == nullptr) Fail(key, FaultKind::kMissing, "is missing");
    if (!value->is_number()) Fail(key, FaultKind::kMistyped, "is no number");
    return value->get<double>();
  }
  int Integer(const Json* value, const std::string& key, int least, int most) const {
    const double number = Number(value, key);
    if (number != std::floor(number) || number < least || number > most) {
      Fail(key, FaultKind::kOutOfRange,
           fmt::format("is {}, need a whole number from {} to {}", number, least, most));
    }
    return static_cast<int>(number);
  }
  std::vector<double> Numbers(const Json* value, const std::string& key, std::size_t count) const {
    if (value == nullptr) Fail(key, FaultKind::kMissing, "is missing");
    std::vector<double> numbers;
    if (value->is_array()) {
      for (const Json& item : *value) {
        if (item.is_number()) numbers.push_back(item.get<double>());
      }
    }
    if (!value->is_array() || numbers.size() != value->size() || numbers.size() != count) {
      Fail(key, FaultKind::kMistyped, fmt::format("need {} numbers", count));
    }
    return numbers;
  }
  std::string Text(const Json* value, const std::string& otherwise) const {
    return value != nullptr && value->is_string() ? value->get<std::string>() : otherwise;
  }

  [[noreturn]] void Fail(const std::string& key, FaultKind kind, const std::string& what) const {
    throw InputError(key.empty() ? file_ : file_ + ": " + key,
                     {kind, what + "; need the metadata JSON of the sensor"});
  }

 private:
  std::string file_;
  Json json_;
};

Pose PoseOf(const std::vector<double>& rows_mm) {
  Pose X = Pose::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      X.linear()(row, column) = rows_mm[static_cast<std::size_t>(4 * row + column)];
    }
    X.translation()[row] = rows_mm[static_cast<std::size_t>(4 * row + 3)] / kMetre_mm;
  }
  return X;
}

/// Parses a mode such as "1024x10": columns per turn and turns per second.
void ReadMode(const SheetReader& reader, OusterSheet* sheet) {
  const Json* value = reader.Find("config_params", "lidar_mode");
  const std::string mode = reader.Text(value, "");
  int columns = 0, rate_hz = 0;
  char more = 0;
  if (std::sscanf(mode.c_str(), "%dx%d%c", &columns, &rate_hz, &more) != 2 || columns < 1 ||
      rate_hz < 1) {
    reader.Fail("lidar_mode", value == nullptr ? FaultKind::kMissing : FaultKind::kMistyped,
                fmt::format("found '{}', need columns and rate as in 1024x10", mode));
  }
  sheet->columns_per_frame = columns;
  sheet->rate_hz = rate_hz;
}

void ReadFormat(const SheetReader& reader, OusterSheet* sheet) {
  constexpr int kMostColumns = 4096, kMostBeams = 256, kMostInPacket = 64;
  sheet->profile = reader.Text(reader.Format("udp_profile_lidar"), "LEGACY");
  const OusterPixel* const pixel = OusterPixelOf(sheet->profile);
  if (pixel == nullptr) {
    std::string known;
    for (const auto& [name, _] : Profiles()) known += (known.empty() ? "" : ", ") + name;
    reader.Fail("udp_profile_lidar", FaultKind::kUnsupported,
                fmt::format("'{}' is not known; known are {}", sheet->profile, known));
  }
  sheet->pixel = *pixel;
  sheet->is_legacy = sheet->profile == "LEGACY";
  sheet->is_fusa = sheet->profile.starts_with("FUSA");
  if (const Json* columns = reader.Format("columns_per_frame")) {
    const int count = reader.Integer(columns, "columns_per_frame", 1, kMostColumns);
    if (count != sheet->columns_per_frame) {
      reader.Fail("columns_per_frame", FaultKind::kInconsistent,
                  fmt::format("is {}, but {} in lidar_mode", count, sheet->columns_per_frame));
    }
  }
  if (const Json* columns = reader.Format("columns_per_packet")) {
    sheet->columns_per_packet = reader.Integer(columns, "columns_per_packet", 1, kMostInPacket);
  }
  sheet->beams =
      reader.Integer(reader.Format("pixels_per_column"), "pixels_per_column", 1, kMostBeams);
  sheet->first_column = 0;
  sheet->last_column = sheet->columns_per_frame - 1;
  if (const Json* window = reader.Format("column_window")) {
    const auto ends = reader.Numbers(window, "column_window", 2);
    sheet->first_column = static_cast<int>(ends[0]);
    sheet->last_column = static_cast<int>(ends[1]);
  }
}

void ReadBeams(const SheetReader& reader, OusterSheet* sheet) {
  const auto beams = static_cast<std::size_t>(sheet->beams);
  constexpr const char* kGroup = "beam_intrinsics";
  for (const double deg :
       reader.Numbers(reader.Find(kGroup, "beam_altitude_angles"), "beam_altitude_angles", beams)) {
    sheet->altitude_rad.push_back(deg * kDeg);
  }
  for (const double deg :
       reader.Numbers(reader.Find(kGroup, "beam_azimuth_angles"), "beam_azimuth_angles", beams)) {
    sheet->azimuth_rad.push_back(deg * kDeg);
  }
  if (const Json* beam = reader.Find(kGroup, "beam_to_lidar_transform")) {
    const auto rows = reader.Numbers(beam, "beam_to_lidar_transform", 16);
    sheet->beam_x_m = rows[3] / kMetre_mm;
    sheet->beam_z_m = rows[11] / kMetre_mm;
  } else {
    constexpr const char* kArm = "lidar_origin_to_beam_origin_mm";
    sheet->beam_x_m = reader.Number(reader.Find(kGroup, kArm), kArm) / kMetre_mm;
  }
  constexpr const char* kToSensor = "lidar_to_sensor_transform";
  sheet->X_SL = PoseOf(reader.Numbers(reader.Find("lidar_intrinsics", kToSensor), kToSensor, 16));
}

}  // namespace

const OusterPixel* OusterPixelOf(const std::string& profile) {
  const auto found = Profiles().find(profile);
  return found == Profiles().end() ? nullptr : &found->second;
}

std::size_t OusterSheet::column_bytes() const {
  const std::size_t around = is_legacy ? 20 : 12;
  return around + static_cast<std::size_t>(beams) * pixel.bytes;
}

std::size_t OusterSheet::packet_bytes() const {
  const std::size_t around = is_legacy ? 0 : 64;
  return around + static_cast<std::size_t>(columns_per_packet) * column_bytes();
}

OusterSheet ReadOusterSheet(const std::filesystem::path& file) {
  const SheetReader reader(file);
  OusterSheet sheet;
  ReadMode(reader, &sheet);
  ReadFormat(reader, &sheet);
  ReadBeams(reader, &sheet);
  sheet.product = reader.Text(reader.Find("sensor_info", "prod_line"), "Ouster");
  const std::string serial = reader.Text(reader.Find("sensor_info", "prod_sn"), "");
  std::from_chars(serial.data(), serial.data() + serial.size(), sheet.serial);
  if (const Json* port = reader.Find("config_params", "udp_port_lidar")) {
    sheet.port = reader.Integer(port, "udp_port_lidar", 1, 65535);
  }
  return sheet;
}

}  // namespace tera
