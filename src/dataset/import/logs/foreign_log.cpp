#include "dataset/import/logs/foreign_log.h"

#include <fstream>

#include "core/check.h"
#include "dataset/import/logs/nmea_sentence.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

std::string BeginningOfLog(const fs::path& file) {
  constexpr std::size_t kBytes = 16384;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return "";
  std::string bytes(kBytes, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

}  // namespace

std::string TypeOfLog(const fs::path& file) {
  const std::string ending = file.extension();
  if (ending == ".pos") return kPosType;
  if (ending == ".nmea") return kNmeaType;
  if (ending == ".ulg") return kUlogType;
  std::error_code ignored;
  if (file.filename() == "timestamps.txt" &&
      fs::is_directory(file.parent_path() / "data", ignored)) {
    return kKittiType;
  }
  const std::string beginning = BeginningOfLog(file);
  if (beginning.starts_with("ULog\x01\x12\x35")) return kUlogType;
  return BeginsAsNmea(beginning) ? kNmeaType : "";
}

std::unique_ptr<const RowTable> ReadLog(const fs::path& file, const std::string& type,
                                        const std::string& talker, LeftOutRows* left_out) {
  if (type == kPosType) return ReadPosLog(file, left_out);
  if (type == kNmeaType) return ReadNmeaLog(file, talker, left_out);
  if (type == kKittiType) return ReadKittiLog(file, left_out);
  TERA_CHECK(type.starts_with("poses/"), type);
  return ReadTrajectoryLog(file, type, left_out);
}

}  // namespace tera
