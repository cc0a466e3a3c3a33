#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/time.h"
#include "dataset/import/bag/unpacked_file.h"

/// Bags of ROS messages, read in the order of the file.

namespace tera {

/// Damage in a bag. The content before it is readable.
class BagDamage : public InputError {
 public:
  using InputError::InputError;
};

/// A topic as described in a bag.
struct BagTopic {
  std::string name;              ///< such as "/imu/data"
  std::string type;              ///< such as "sensor_msgs/Imu", without "/msg"
  std::string message_encoding;  ///< "cdr" or "ros1"
  std::string schema_encoding;  ///< "ros2msg" or "ros1msg"; empty if the bag contains no definition
  std::string definition;
};

struct BagMessage {
  TimeNs log_ns = 0;  ///< time at which the message was recorded
  std::string_view bytes;
};

/// Receives the topics and messages of a bag.
class BagVisitor {
 public:
  virtual ~BagVisitor() = default;
  enum class Wish { kSkip, kTake, kEnough };
  /// Called for each topic before its messages. It may be called again for a topic that is
  /// announced twice or occurs in several files.
  virtual Wish Wants(const BagTopic& topic) = 0;
  /// Receives a message of a wanted topic. `number` is the index of the call of Wants for the
  /// topic, from 0. Return false to stop reading.
  virtual bool Take(std::size_t number, const BagMessage& message) = 0;
};

/// Passes topics and messages of a bag to `visitor` in file order. Memory holds at most one chunk.
/// A bag is an MCAP file, a SQLite 3 file of rosbag2, a ROS 1 bag, or a rosbag2 folder or its
/// metadata.yaml. The files of a folder are read one after another. A file that is compressed as a
/// whole by zstd is read through `unpacked`, whatever its name.
///
/// Throws InputError if `bag` is not a bag, and BagDamage if its bytes violate the format. With
/// `to_the_damage`, all readable content is passed on before BagDamage is thrown, including that of
/// later files.
void ReadBag(const std::filesystem::path& bag, UnpackedFiles* unpacked, BagVisitor* visitor,
             bool to_the_damage);

/// File in a rosbag2 folder that lists its bag files.
inline constexpr const char* kBagMetadata = "metadata.yaml";

std::vector<std::filesystem::path> FilesOfBag(const std::filesystem::path& bag);

/// True if the file is a bag, judged by its name or its first bytes. Names are .mcap, .db3 and
/// .bag, also followed by .zstd or .zst, and metadata.yaml or its folder. The first bytes are those
/// of a bag or a zstd frame.
bool LooksLikeBag(const std::filesystem::path& file);

/// Removes "/msg/": "sensor_msgs/msg/Imu" becomes "sensor_msgs/Imu".
std::string ShortTypeName(std::string_view type);

// Read one file each. Return false if the visitor stopped the reading.
bool ReadMcapFile(const std::filesystem::path& file, BagVisitor* visitor);
bool ReadRos1BagFile(const std::filesystem::path& file, BagVisitor* visitor);
bool ReadSqliteBagFile(const std::filesystem::path& file, BagVisitor* visitor, bool to_the_damage);

}  // namespace tera
