#include "dataset/import/logs/foreign_log.h"

#include "core/check.h"

namespace tera {
namespace fs = std::filesystem;

std::string TypeOfLog(const fs::path& file) {
  const std::string ending = file.extension();
  if (ending == ".pos") return kPosType;
  if (ending == ".nmea") return kNmeaType;
  if (ending == ".ulg") return kUlogType;
  std::error_code ignored;
  const bool is_drive =
      file.filename() == "timestamps.txt" && fs::is_directory(file.parent_path() / "data", ignored);
  return is_drive ? kKittiType : "";
}

std::unique_ptr<const RowTable> ReadLog(const fs::path& file, const std::string& type,
                                        LeftOutRows* left_out) {
  if (type == kPosType) return ReadPosLog(file, left_out);
  if (type == kNmeaType) return ReadNmeaLog(file, left_out);
  TERA_CHECK(type == kKittiType);
  return ReadKittiLog(file, left_out);
}

}  // namespace tera
