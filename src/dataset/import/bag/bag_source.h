#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/time.h"
#include "dataset/import/bag/unpacked_file.h"

/// Bags of ROS messages, read from their beginning to their end.

namespace tera {

/// A place from which on a bag cannot be read; what stands before it can.
class BagDamage : public InputError {
 public:
  using InputError::InputError;
};

/// A topic as a bag describes it.
struct BagTopic {
  std::string name;              ///< "/imu/data"
  std::string type;              ///< "sensor_msgs/Imu", without "/msg"
  std::string message_encoding;  ///< "cdr", "ros1"
  std::string schema_encoding;   ///< "ros2msg", "ros1msg"; empty where the bag has no definition
  std::string definition;
};

struct BagMessage {
  TimeNs log_ns = 0;  ///< when it was recorded
  std::string_view bytes;
};

/// Who reads a bag.
class BagVisitor {
 public:
  virtual ~BagVisitor() = default;
  enum class Wish { kSkip, kTake, kEnough };
  /// Asked of each topic before its messages; of a topic that was offered twice, or that stands in
  /// several files, more than once.
  virtual Wish Wants(const BagTopic& topic) = 0;
  /// A message of a topic that was wanted: the one that Wants was asked of as `number`, from 0.
  /// False: it is enough.
  virtual bool Take(std::size_t number, const BagMessage& message) = 0;
};

/// Shows a bag's topics and messages in the order of the file, no more than a chunk of them in
/// memory: an MCAP file, a SQLite 3 file of rosbag2, a ROS 1 bag, the metadata.yaml of a rosbag2
/// folder or that folder, whose files are read one after the other. A file that was compressed as a
/// whole by zstd, whatever its name is, is read from `unpacked`.
///
/// Throws InputError where there is no bag, and BagDamage where its bytes are not as its format
/// says; with `to_the_damage` what can be read behind some damage is read too.
void ReadBag(const std::filesystem::path& bag, UnpackedFiles* unpacked, BagVisitor* visitor,
             bool to_the_damage);

/// In the folder of a rosbag2, the list of its files.
inline constexpr const char* kBagMetadata = "metadata.yaml";

/// The files of a bag, in order.
std::vector<std::filesystem::path> FilesOfBag(const std::filesystem::path& bag);

/// Whether a file is to be read as a bag: by its name (.mcap, .db3, .bag, these with .zstd or .zst
/// behind them, metadata.yaml or a folder that has it), or by its first bytes, which are those of a
/// bag or of something that zstd compressed as a whole.
bool LooksLikeBag(const std::filesystem::path& file);

/// "sensor_msgs/Imu" of "sensor_msgs/msg/Imu".
std::string ShortTypeName(std::string_view type);

// The formats, of one file each. False where the visitor has had enough.
bool ReadMcapFile(const std::filesystem::path& file, BagVisitor* visitor);
bool ReadRos1BagFile(const std::filesystem::path& file, BagVisitor* visitor);
bool ReadSqliteBagFile(const std::filesystem::path& file, BagVisitor* visitor, bool to_the_damage);

}  // namespace tera
