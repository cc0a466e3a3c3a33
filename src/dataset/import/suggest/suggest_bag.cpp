#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/config/plain_name.h"
#include "core/error.h"
#include "core/units.h"
#include "dataset/import/bag/bag_source.h"
#include "dataset/import/bag/byte_cursor.h"
#include "dataset/import/bag/message_schema.h"
#include "dataset/import/bag/standard_topics.h"
#include "dataset/import/pictures/camera_topic.h"
#include "dataset/import/scans/packet_topic.h"
#include "dataset/import/scans/point_topic.h"
#include "dataset/import/suggest/bag_channels.h"
#include "dataset/import/suggest/suggest.h"

// Suggests a mapping for a bag of ROS messages.

namespace tera {
namespace {

/// Counts the messages of each topic.
class Census : public BagVisitor {
 public:
  Wish Wants(const BagTopic& topic) override {
    auto seen = std::find_if(topics_.begin(), topics_.end(),
                             [&](const SeenTopic& t) { return t.topic.name == topic.name; });
    numbers_.push_back(static_cast<std::size_t>(seen - topics_.begin()));
    if (seen == topics_.end()) topics_.push_back({topic});
    return Wish::kTake;
  }
  bool Take(std::size_t number, const BagMessage& message) override {
    SeenTopic& seen = topics_[numbers_[number]];
    if (seen.messages++ == 0) seen.first_ns = message.log_ns;
    seen.last_ns = message.log_ns;
    return true;
  }
  const std::vector<SeenTopic>& topics() const { return topics_; }

 private:
  std::vector<SeenTopic> topics_;
  std::vector<std::size_t> numbers_;  ///< index in topics_ by the number passed to Take
};

std::string OneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Rank of a topic of poses as the pose of the machine. The lowest rank is the most likely. Returns
/// nullopt for parts, sensors and goals.
std::optional<int> RankOfPose(const SeenTopic& seen) {
  constexpr std::array<std::string_view, 5> kTypes = {
      "nav_msgs/Odometry", "geometry_msgs/PoseWithCovarianceStamped", "geometry_msgs/PoseStamped",
      "geometry_msgs/TransformStamped", "tf2_msgs/TFMessage"};
  constexpr std::array<std::string_view, 22> kParts = {
      "ee",     "boom",        "arm",     "stick",  "bucket", "tool",    "link",  "camera",
      "lidar",  "imu",         "goal",    "target", "marker", "joint",   "swing", "upper",
      "shovel", "initialpose", "gripper", "tip",    "teeth",  "setpoint"};
  for (const std::string& word : WordsOfName(seen.topic.name)) {
    if (std::find(kParts.begin(), kParts.end(), word) != kParts.end()) return std::nullopt;
  }
  const auto type = std::find(kTypes.begin(), kTypes.end(), seen.topic.type);
  return static_cast<int>(type - kTypes.begin());
}

class BagGuess {
 public:
  explicit BagGuess(const std::filesystem::path& log)
      : log_(std::filesystem::is_directory(log) ? log / "metadata.yaml" : log),
        channels_(log_, &unpacked_) {
    try {
      ReadBag(log, &unpacked_, &census_, /*to_the_damage=*/true);
    } catch (const BagDamage& damage) {
      if (census_.topics().empty()) throw;
      damage_ = damage.what();
    }
  }

  std::string Yaml() {
    FindPose();
    for (const SeenTopic& seen : census_.topics()) Sort(seen);
    std::string yaml = fmt::format(
        "# A first mapping by 'tera import --suggest': look at what is marked as guessed.\n"
        "name: {}\nmachine: {}   # guessed: name the machine's folder\nfile: {}\n",
        PlainNameOf(NameOfLog()), Machine(), YamlWord(log_.string()));
    if (!damage_.empty()) yaml += "# damaged, needs --skip-bad-rows: " + OneLine(damage_) + "\n";
    const std::string channels = channels_.Yaml();
    if (counts_from_epoch_ && !channels.starts_with("zero: start")) yaml += "zero: start\n";
    yaml += channels;
    if (!lidars_.empty()) yaml += "lidars:\n" + lidars_;
    if (!cameras_.empty()) yaml += "cameras:\n" + cameras_;
    if (!others_.empty()) yaml += "# Not mapped:\n" + others_;
    return yaml;
  }

 private:
  std::string NameOfLog() const {
    const bool is_folder = log_.filename() == "metadata.yaml";
    return is_folder ? std::filesystem::absolute(log_).parent_path().filename() : log_.stem();
  }

  /// The first word of the topic names, if they all share it.
  std::string Machine() const {
    std::set<std::string> words;
    for (const SeenTopic& seen : census_.topics()) {
      if (!StandardColumnOf(seen.topic.type, "wx") && !StandardColumnOf(seen.topic.type, "lat") &&
          seen.topic.type != kJointType) {
        continue;
      }
      const std::string name = seen.topic.name.substr(seen.topic.name.starts_with('/') ? 1 : 0);
      const std::size_t slash = name.find('/');
      words.insert(slash == std::string::npos ? "" : name.substr(0, slash));
    }
    return words.size() == 1 && !words.begin()->empty() ? PlainNameOf(*words.begin()) : "machine";
  }

  /// Finds the most likely readable topic with the machine's pose.
  void FindPose() {
    std::vector<std::pair<int, const SeenTopic*>> candidates;
    for (const SeenTopic& seen : census_.topics()) {
      if (seen.messages == 0 || !StandardColumnOf(seen.topic.type, "qw")) continue;
      const auto rank = RankOfPose(seen);
      if (rank) candidates.emplace_back(*rank, &seen);
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [rank, seen] : candidates) {
      if (channels_.AddPose(*seen).empty()) {
        pose_ = seen;
        return;
      }
    }
  }

  void Sort(const SeenTopic& seen) {
    if (&seen == pose_) return;
    std::string why_not = "no message";
    if (seen.messages > 0) why_not = Add(seen);
    if (why_not.empty()) return;
    others_ +=
        fmt::format("#   {} ({}): {}{}\n", OneLine(seen.topic.name), OneLine(seen.topic.type),
                    seen.Rate(), why_not == "-" ? "" : "; " + OneLine(why_not));
  }

  /// Adds a channel for a topic. Returns the reason if none is possible, and "-" if no remark is
  /// needed.
  std::string Add(const SeenTopic& seen) {
    const std::string& type = seen.topic.type;
    if (HoldsPoints(type) || HoldsPackets(type)) return AddLidar(seen);
    if (type == kImageType || type == kCompressedImageType) return AddCamera(seen);
    try {
      SchemaOf(seen.topic);
    } catch (const BadBytes& bad) {
      return bad.finding;
    }
    if (type == kImuType) return channels_.AddImu(seen, &names_);
    if (type == kFixType) return channels_.AddReceiver(seen, &names_);
    if (type == kJointType) return channels_.AddJoints(seen, &names_);
    if (type == "tera_msgs/DeltaCAN") return channels_.AddDeltaCan(seen, &names_);
    if (seen.topic.name.ends_with("/ee_pose")) return channels_.AddToolPose(seen, &names_);
    if (IsNumber(seen.topic)) return channels_.AddNumber(seen, &names_);
    if (HoldsTransforms(type)) return "transforms " + channels_.PairsText(seen);
    if (StandardColumnOf(type, "qw")) {
      return pose_ != nullptr ? "the pose is that of " + pose_->topic.name
                              : "a pose of a part, or an unreadable pose";
    }
    if (type.ends_with("Scan") || type.ends_with("Packets")) {
      return "a mapping cannot import scans of this type: docs/reference/import.md, Scans of "
             "lidars";
    }
    if (type == "sensor_msgs/Joy") return "levers may be columns \"axes[0]\" of a table commands";
    return "-";
  }

  /// Adds an entry of `lidars`, with placeholders for facts that the topic's type does not
  /// determine.
  std::string AddLidar(const SeenTopic& seen) {
    const std::string& type = seen.topic.type;
    std::string rest;
    if (type == kVelodyneType) rest = ", unit: unknown}   # need vlp16 or vlp32c";
    if (type == kPandarType) rest = ", unit: qt64}   # guessed: the only one that is read";
    if (HoldsPoints(type)) rest = "}";
    if (rest.empty()) rest = ", metadata: unknown}   # need the metadata JSON of the sensor";
    counts_from_epoch_ = counts_from_epoch_ || seen.first_ns > kEpoch_ns;
    lidars_ +=
        fmt::format("  - {{name: {}, topic: {}{}\n", names_.Take(PlainNameOf(seen.topic.name)),
                    YamlWord(seen.topic.name), rest);
    return "";
  }

  /// Adds an entry of `cameras`, with the CameraInfo topic of the same namespace.
  std::string AddCamera(const SeenTopic& seen) {
    std::string why_not = FaultOfFirstPicture(log_, seen.topic, &unpacked_);
    if (!why_not.empty()) return why_not;
    std::string name = seen.topic.name;
    for (const std::string_view transport : {"/compressed", "/theora"}) {
      if (name.ends_with(transport)) name.resize(name.size() - transport.size());
    }
    const std::string info = name.substr(0, name.rfind('/') + 1) + "camera_info";
    const bool has_info =
        std::any_of(census_.topics().begin(), census_.topics().end(), [&](const SeenTopic& other) {
          return other.topic.name == info && other.topic.type == kCameraInfoType;
        });
    const std::string lens =
        !has_info ? "uncalibrated: true}   # guessed: no CameraInfo is beside it"
        : name.find("rect") != name.npos
            ? fmt::format("info: {}, rectified: true}}   # guessed, by the name", YamlWord(info))
            : fmt::format("info: {}}}", YamlWord(info));
    counts_from_epoch_ = counts_from_epoch_ || seen.first_ns > kEpoch_ns;
    cameras_ += fmt::format("  - {{name: {}, topic: {}, {}\n", names_.Take(PlainNameOf(name)),
                            YamlWord(seen.topic.name), lens);
    return "";
  }

  static constexpr TimeNs kEpoch_ns = 100'000'000 * kNsPerSecond;
  std::filesystem::path log_;
  UnpackedFiles unpacked_;
  Census census_;
  BagChannels channels_;
  std::string damage_;
  const SeenTopic* pose_ = nullptr;
  TakenNames names_;
  std::string others_, lidars_, cameras_;
  bool counts_from_epoch_ = false;  ///< the times of lidars or cameras count from 1970
};

}  // namespace

std::string SuggestForBag(const std::filesystem::path& log) { return BagGuess(log).Yaml(); }

}  // namespace tera
