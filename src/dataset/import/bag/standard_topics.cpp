#include "dataset/import/bag/standard_topics.h"

#include <array>

#include "core/units.h"
#include "dataset/import/bag/byte_cursor.h"
#include "dataset/import/bag/message_reader.h"
#include "dataset/import/bag/topic_table.h"
#include "dataset/import/logs/foreign_log.h"

namespace tera {
namespace {

struct Row {
  std::string_view key, path;
  double factor = 1.0;
  bool may_lack = false;
};

constexpr std::array<Row, 6> kImu = {{{"wx", "angular_velocity.x"},
                                      {"wy", "angular_velocity.y"},
                                      {"wz", "angular_velocity.z"},
                                      {"ax", "linear_acceleration.x"},
                                      {"ay", "linear_acceleration.y"},
                                      {"az", "linear_acceleration.z"}}};

constexpr std::array<Row, 7> kFix = {{{"lat", "latitude", kDeg, true},
                                      {"lon", "longitude", kDeg, true},
                                      {"alt", "altitude", 1.0, true},
                                      {"fix", "status.status"},
                                      {"var_e", "position_covariance[0]", 1.0, true},
                                      {"var_n", "position_covariance[4]", 1.0, true},
                                      {"var_u", "position_covariance[8]", 1.0, true}}};

/// Fields of a pose, relative to the place of the pose in each type.
constexpr std::array<Row, 7> kPose = {{{"x", "position.x"},
                                       {"y", "position.y"},
                                       {"z", "position.z"},
                                       {"qw", "orientation.w"},
                                       {"qx", "orientation.x"},
                                       {"qy", "orientation.y"},
                                       {"qz", "orientation.z"}}};
constexpr std::array<Row, 7> kBarePose = {
    {{"x", "x"}, {"y", "y"}, {"z", "z"}, {"qw", "qw"}, {"qx", "qx"}, {"qy", "qy"}, {"qz", "qz"}}};
constexpr std::array<Row, 7> kTransform = {{{"x", "translation.x"},
                                            {"y", "translation.y"},
                                            {"z", "translation.z"},
                                            {"qw", "rotation.w"},
                                            {"qx", "rotation.x"},
                                            {"qy", "rotation.y"},
                                            {"qz", "rotation.z"}}};

constexpr std::array<Row, 7> kPos = {{{"lat", "latitude", kDeg},
                                      {"lon", "longitude", kDeg},
                                      {"alt", "height"},
                                      {"fix", "fix"},
                                      {"var_e", "var_e"},
                                      {"var_n", "var_n"},
                                      {"var_u", "var_u"}}};
/// An NMEA row has no position without a fix, and no variances without a GST sentence.
constexpr std::array<Row, 7> kNmea = {{{"lat", "latitude", kDeg, true},
                                       {"lon", "longitude", kDeg, true},
                                       {"alt", "altitude", 1.0, true},
                                       {"fix", "fix"},
                                       {"var_e", "var_e", 1.0, true},
                                       {"var_n", "var_n", 1.0, true},
                                       {"var_u", "var_u", 1.0, true}}};
constexpr std::array<Row, 16> kKitti = {{{"wx", "wx"},
                                         {"wy", "wy"},
                                         {"wz", "wz"},
                                         {"ax", "ax"},
                                         {"ay", "ay"},
                                         {"az", "az"},
                                         {"lat", "lat", kDeg},
                                         {"lon", "lon", kDeg},
                                         {"alt", "alt"},
                                         {"x", "x"},
                                         {"y", "y"},
                                         {"z", "z"},
                                         {"qw", "qw"},
                                         {"qx", "qx"},
                                         {"qy", "qy"},
                                         {"qz", "qz"}}};

template <typename Rows>
std::optional<StandardColumn> Find(const Rows& rows, std::string_view key,
                                   const std::string& above) {
  for (const Row& row : rows) {
    if (row.key == key)
      return StandardColumn{above + std::string(row.path), row.factor, row.may_lack};
  }
  return std::nullopt;
}

/// Counts messages by the names that they contain.
class NamesOfMessages : public BagVisitor {
 public:
  explicit NamesOfMessages(const BagTopic& topic) : topic_(topic), reader_(SchemaOf(topic), {}) {}

  Wish Wants(const BagTopic& topic) override {
    return topic.name == topic_.name ? Wish::kTake : Wish::kSkip;
  }
  bool Take(std::size_t, const BagMessage& message) override {
    try {
      if (!HoldsTransforms(topic_.type)) ++counts_[reader_.Labels(message.bytes)];
      if (!HoldsTransforms(topic_.type)) return true;
      for (const std::string& pair : reader_.FramePairs(message.bytes)) ++counts_[{pair}];
    } catch (const BadBytes&) {
      // The import of this topic will report the damage.
    }
    return true;
  }
  const std::map<std::vector<std::string>, std::int64_t>& counts() const { return counts_; }

 private:
  const BagTopic& topic_;
  MessageReader reader_;
  std::map<std::vector<std::string>, std::int64_t> counts_;
};

/// Reads only the first message of a topic.
class FirstMessage : public BagVisitor {
 public:
  explicit FirstMessage(const BagTopic& topic) : topic_(topic) {}

  Wish Wants(const BagTopic& topic) override {
    return topic.name == topic_.name ? Wish::kTake : Wish::kSkip;
  }
  bool Take(std::size_t, const BagMessage& message) override {
    bytes_ = message.bytes;
    return false;
  }
  const std::optional<std::string>& bytes() const { return bytes_; }

 private:
  const BagTopic& topic_;
  std::optional<std::string> bytes_;
};

}  // namespace

std::optional<StandardColumn> StandardColumnOf(std::string_view type, std::string_view key) {
  if (type == kImuType) return Find(kImu, key, "");
  if (type == kFixType) return Find(kFix, key, "");
  if (type == kPosType) return Find(kPos, key, "");
  if (type == kNmeaType) return Find(kNmea, key, "");
  if (type == kKittiType) return Find(kKitti, key, "");
  if (type.starts_with("poses/")) return Find(kBarePose, key, "");
  if (type == "geometry_msgs/PoseStamped") return Find(kPose, key, "pose.");
  if (type == "geometry_msgs/TransformStamped" || HoldsTransforms(type)) {
    return Find(kTransform, key, "transform.");
  }
  if (type == "nav_msgs/Odometry" || type == "geometry_msgs/PoseWithCovarianceStamped") {
    return Find(kPose, key, "pose.pose.");
  }
  return std::nullopt;
}

bool HoldsTransforms(std::string_view type) {
  return type == "tf2_msgs/TFMessage" || type == "tf/tfMessage";
}

std::string PathOfTransform(const std::string& parent, const std::string& child) {
  return "transforms[" + parent + ">" + child + "].";
}

std::map<std::vector<std::string>, std::int64_t> NamesInMessages(const std::filesystem::path& bag,
                                                                 const BagTopic& topic,
                                                                 UnpackedFiles* unpacked) {
  try {
    NamesOfMessages names(topic);
    try {
      ReadBag(bag, unpacked, &names, /*to_the_damage=*/true);
    } catch (const BagDamage&) {
      // Messages before the damage are counted.
    }
    return names.counts();
  } catch (const BadBytes&) {
    return {};  // the definition is unreadable
  }
}

std::vector<std::string> JointNames(const std::filesystem::path& bag, const BagTopic& topic,
                                    UnpackedFiles* unpacked) {
  FirstMessage first(topic);
  try {
    ReadBag(bag, unpacked, &first, /*to_the_damage=*/true);
  } catch (const BagDamage&) {
    if (!first.bytes()) throw;
  }
  if (!first.bytes()) return {};
  try {
    return MessageReader(SchemaOf(topic), {}).Labels(*first.bytes());
  } catch (const BadBytes& bad) {
    throw InputError(MessagePlace(bag, topic, 1) + ": " + bad.finding);
  }
}

}  // namespace tera
