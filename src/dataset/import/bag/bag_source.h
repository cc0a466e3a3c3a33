#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/time.h"
#include "dataset/import/bag/unpacked_file.h"

/// Bags of ROS messages, read in file order.

namespace tera {

/// Damage of a bag from some place on; the content before it is readable.
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
  TimeNs log_ns = 0;  ///< time of recording
  std::string_view bytes;
};

/// Receiver of a bag's topics and messages.
class BagVisitor {
 public:
  virtual ~BagVisitor() = default;
  enum class Wish { kSkip, kTake, kEnough };
  /// Called for each topic before its messages. Repeats are possible, for a topic that is announced
  /// twice or stands in several files.
  virtual Wish Wants(const BagTopic& topic) = 0;
  /// A message of a wanted topic. `number` counts the calls of Wants from 0. False stops the
  /// reading.
  virtual bool Take(std::size_t number, const BagMessage& message) = 0;
};

/// Passes a bag's topics and messages to `visitor` in file order, with at most one chunk in memory.
/// Reads an MCAP file, a SQLite 3 file of rosbag2, a ROS 1 bag, a rosbag2 folder or its
/// metadata.yaml. A folder's files follow one another. A file compressed as a whole by zstd,
/// whatever its name, is read from `unpacked`.
///
/// Throws InputError where there is no bag, and BagDamage where its bytes violate its format. With
/// `to_the_damage`, the readable content after some damage is read too.
void ReadBag(const std::filesystem::path& bag, UnpackedFiles* unpacked, BagVisitor* visitor,
             bool to_the_damage);

/// File name of the list of files in a rosbag2 folder.
inline constexpr const char* kBagMetadata = "metadata.yaml";

/// The files of a bag, in order.
std::vector<std::filesystem::path> FilesOfBag(const std::filesystem::path& bag);

/// Whether a file is a bag: by its name (.mcap, .db3, .bag, each also with .zstd or .zst;
/// metadata.yaml or its folder), or by its first bytes, those of a bag or of a zstd frame.
bool LooksLikeBag(const std::filesystem::path& file);

/// "sensor_msgs/Imu" of "sensor_msgs/msg/Imu".
std::string ShortTypeName(std::string_view type);

// Readers of one file each. They return false when the visitor stops.
bool ReadMcapFile(const std::filesystem::path& file, BagVisitor* visitor);
bool ReadRos1BagFile(const std::filesystem::path& file, BagVisitor* visitor);
bool ReadSqliteBagFile(const std::filesystem::path& file, BagVisitor* visitor, bool to_the_damage);

}  // namespace tera
