#include "dataset/import/suggest/bag_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>

#include "core/config/plain_name.h"
#include "core/motion.h"
#include "core/units.h"
#include "dataset/import/angle_wrap.h"
#include "dataset/import/bag/standard_topics.h"
#include "dataset/import/suggest/doubted_numbers.h"
#include "dataset/import/suggest/rate_guess.h"

namespace tera {
namespace {

using Paths = std::vector<std::string>;

Paths StandardPaths(const BagTopic& topic, const std::vector<const char*>& keys,
                    const std::string& above = "") {
  Paths paths;
  for (const char* key : keys) paths.push_back(above + StandardColumnOf(topic.type, key)->path);
  return paths;
}

/// Largest turn rate of a cab, boom or arm.
constexpr double kFastBody_radps = 3;

constexpr std::array<const char*, 7> kPoseKeys = {"x", "y", "z", "qw", "qx", "qy", "qz"};

/// Number of messages with a unit quaternion, and with an all-zero quaternion.
struct Orientations {
  std::int64_t unit = 0, zero = 0;
};
Orientations OrientationsOf(const TopicLook& look) {
  constexpr double kSlack = 0.1;
  Orientations found;
  for (std::size_t row = 0; row < look.rows(); ++row) {
    double squares = 0;
    bool is_whole = true;
    for (std::size_t k = 3; k < kPoseKeys.size(); ++k) {
      const auto value = look.At(row, k);
      is_whole = is_whole && value;
      squares += std::pow(value.value_or(0), 2);
    }
    if (is_whole && squares == 0) ++found.zero;
    if (is_whole && std::abs(std::sqrt(squares) - 1) < kSlack) ++found.unit;
  }
  return found;
}

/// The most likely pair of frames for the machine's pose. Map frames are preferred over odometry
/// frames, and the base over other parts. Returns nullopt if no pair has a world frame.
std::optional<std::pair<std::string, std::string>> PairOfMachine(
    const std::map<std::vector<std::string>, std::int64_t>& pairs) {
  constexpr std::array<std::string_view, 6> kWorlds = {"map", "world", "utm",
                                                       "enu", "earth", "odom"};
  constexpr std::array<std::string_view, 7> kBases = {
      "base_link", "base_footprint", "base", "chassis", "undercarriage", "body", "track"};
  const auto rank = [](const auto& names, std::string_view frame) {
    const std::string_view last = frame.substr(frame.rfind('/') + 1);
    return std::find(names.begin(), names.end(), last) - names.begin();
  };
  std::optional<std::pair<std::string, std::string>> best;
  std::ptrdiff_t best_rank = 0;
  for (const auto& [pair, count] : pairs) {
    const std::size_t arrow = pair.front().find('>');
    const std::string parent = pair.front().substr(0, arrow);
    const std::string child = pair.front().substr(arrow + 1);
    const auto world = rank(kWorlds, parent), base = rank(kBases, child);
    if (world == std::ssize(kWorlds) || rank(kWorlds, child) < std::ssize(kWorlds)) continue;
    const std::ptrdiff_t pair_rank = 10 * base + world;
    if (best && pair_rank >= best_rank) continue;
    best = {parent, child};
    best_rank = pair_rank;
  }
  return best;
}

}  // namespace

std::string SeenTopic::Rate() const {
  if (messages < 2 || last_ns <= first_ns) return fmt::format("{} messages", messages);
  return fmt::format("{} messages, {:.3g} Hz", messages,
                     static_cast<double>(messages - 1) / ToSeconds(last_ns - first_ns));
}

TopicLook BagChannels::Look(const SeenTopic& seen, const Paths& paths) const {
  return {log_, seen.topic, HasHeader(seen.topic) ? kHeaderStamp : "", paths, unpacked_};
}

void BagChannels::Add(const std::string& key, const SeenTopic& seen, const TopicTimes& times,
                      const RuleGuesses& rules, const std::string& rest, TakenNames* names) {
  entries_.push_back(
      {key,
       fmt::format("  - name: {}\n    topic: {}   # {}\n", names->Take(seen.topic.name),
                   YamlWord(seen.topic.name), seen.Rate()),
       times, rules, rest});
}

std::string BagChannels::AddImu(const SeenTopic& seen, TakenNames* names) {
  const std::vector<const char*> keys = {"wx", "wy", "wz", "ax", "ay", "az"};
  const Paths paths = StandardPaths(seen.topic, keys);
  const TopicLook look = Look(seen, paths);
  std::vector<NumbersOfColumn> columns;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    columns.push_back(look.Numbers(k));
    if (columns[k].values.empty()) return paths[k] + " has no number in any message";
  }
  RuleGuesses rules;
  look.AddPresenceRules(paths, &rules);
  const std::vector<const NumbersOfColumn*> rates = {&columns[0], &columns[1], &columns[2]};
  const std::vector<const NumbersOfColumn*> forces = {&columns[3], &columns[4], &columns[5]};
  UnitGuess rate = GuessRateUnit(rates, {look.times().t_ns, forces});
  UnitGuess force = GuessAccelerationUnit(forces);
  std::string yaml;
  // The units of ROS are assumed (rad/s, m/s2) unless the numbers contradict them.
  if (rate.unit == "rad/s") rate.doubt.clear();
  if (!rate.is_known()) {
    if (std::max({rates[0]->LargestSize(), rates[1]->LargestSize(), rates[2]->LargestSize()}) >
        kFastBody_radps) {
      yaml += "    # guessed: rad/s, as in ROS; " + rate.doubt + "\n";
    }
    rate = {"rad/s", 1.0, ""};
  }
  if (!force.is_known()) force.unit = "m/s2";
  yaml += InertialRemarks(look.times().t_ns, rates, rate, forces, force);
  if (rate.unit != "rad/s" || force.unit != "m/s2") {
    if (force.unit != "m/s2") force.doubt = "gravity is not 9.8; ROS uses m/s2";
    yaml += "    columns:\n";
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const UnitGuess& unit = k < 3 ? rate : force;
      yaml += fmt::format("      {}: {}{}\n", keys[k], ColumnYaml(paths[k], unit),
                          k % 3 == 0 ? DoubtRemark(unit) : "");
    }
  } else if (!force.doubt.empty()) {
    yaml += "    # guessed: m/s2, as in ROS; " + force.doubt + "\n";
  }
  Add("imus", seen, look.times(), rules, yaml, names);
  return "";
}

std::string BagChannels::AddReceiver(const SeenTopic& seen, TakenNames* names) {
  enum { kLat, kLon, kAlt, kStatus, kVarE, kVarN, kVarU, kType };
  Paths paths = StandardPaths(seen.topic, {"lat", "lon", "alt", "fix", "var_e", "var_n", "var_u"});
  paths.push_back(kCovarianceTypePath);
  const TopicLook look = Look(seen, paths);
  std::int64_t unplaced = 0, at_zero = 0, unknown = 0;
  std::optional<std::size_t> first;
  for (std::size_t row = 0; row < look.rows(); ++row) {
    const auto number = [&](std::size_t k) { return look.At(row, k); };
    if (number(kStatus).value_or(-1) < 0) continue;
    const bool is_zero = number(kLat) == 0.0 && number(kLon) == 0.0;
    if (!number(kLat) || !number(kLon) || !number(kAlt)) {
      ++unplaced;
    } else if (is_zero) {
      ++at_zero;
    } else if (!first) {
      first = row;
    }
    const auto is_known = [&](std::size_t k) { return number(k).value_or(-1) >= 0; };
    if (number(kType).value_or(0) == 0 || !is_known(kVarE) || !is_known(kVarN) ||
        !is_known(kVarU)) {
      ++unknown;
    }
  }
  if (!first) return "no message has a fix with a place";
  const double lat_deg = *look.At(*first, kLat);
  if (origin_.empty()) {
    origin_ = OriginYaml(lat_deg, *look.At(*first, kLon), *look.At(*first, kAlt),
                         "the first message with a fix");
  }
  RuleGuesses rules;
  if (unplaced > 0) {
    rules.Add("{column: latitude, present: true}, {column: altitude, present: true}",
              fmt::format("{} fixes have no place", unplaced));
  }
  if (at_zero > 0) {
    rules.Add(fmt::format("{{column: latitude, {}: 0}}", lat_deg > 0 ? "above" : "below"),
              fmt::format("{} fixes are at 0, 0", at_zero));
  }
  std::string yaml;
  if (unknown > 0) {
    yaml = "    columns:\n";
    for (const auto& [key, variance_m2] : {std::pair{"var_e", 4}, {"var_n", 4}, {"var_u", 9}}) {
      yaml += fmt::format(
          "      {}: {{constant: {}}}   # guessed: {} messages do not know it (covariance type 0); "
          "give that of the receiver's data sheet in m2\n",
          key, variance_m2, unknown);
    }
  }
  Add("gnss", seen, look.times(), rules, yaml, names);
  return "";
}

std::string BagChannels::AddJoints(const SeenTopic& seen, TakenNames* names) {
  const auto sets = NamesInMessages(log_, seen.topic, unpacked_);
  std::string why_not = "no message names a joint";
  bool is_added = false;
  for (const auto& [named, count] : sets) {
    std::vector<std::string> joints;
    for (const std::string& joint : named) {
      if (std::find(joints.begin(), joints.end(), joint) == joints.end()) joints.push_back(joint);
    }
    if (joints.empty()) continue;
    why_not = AddJointSet(seen, joints, names);
    is_added = is_added || why_not.empty();
  }
  return is_added ? "" : why_not;
}

std::string BagChannels::AddJointSet(const SeenTopic& seen, const std::vector<std::string>& joints,
                                     TakenNames* names) {
  Paths paths;
  for (const std::string& joint : joints) {
    if (joint.empty() || joint.find_first_of("[]") != std::string::npos) {
      return "the joint '" + joint + "' has a name that no path can hold";
    }
    paths.push_back("position[" + joint + "]");
    paths.push_back("velocity[" + joint + "]");
  }
  const TopicLook look = Look(seen, paths);
  // Rows of this set are those in which its first joint has a number.
  const std::int64_t positions = look.Count(0), rows = std::max(positions, look.Count(1));
  RuleGuesses rules;
  if (rows < static_cast<std::int64_t>(look.rows()) && rows > 0) {
    rules.Add(fmt::format("{{column: {}, present: true}}", YamlWord(paths[positions > 0 ? 0 : 1])),
              "other messages are of other joints");
  }
  bool is_plain = true, is_any = false;
  std::string explicit_joints;
  TakenNames joint_names;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    NumbersOfColumn angles = look.Numbers(2 * j), rates = look.Numbers(2 * j + 1);
    angles.name = rates.name = joints[j];
    const bool has_angle = std::ssize(angles.values) == rows && rows > 0;
    const bool has_rate = std::ssize(rates.values) == rows && rows > 0;
    if (!has_angle && !has_rate) {
      explicit_joints += "      # " + PlainNameOf(joints[j]) + ": not in all messages\n";
      is_plain = false;
      continue;
    }
    is_any = true;
    AngleGuess angle = GuessAngle(angles);
    if (angle.unit.unit != "deg" || angles.LargestSize() <= 8 * kPi) angle.unit = {"rad"};
    angle.begins_anew =
        has_angle && BeginsAnew(angles.values, angle.unit.unit == "deg" ? 360 : 2 * kPi);
    if (angle.unit.unit == "deg") {
      angle.unit.doubt = fmt::format("the largest is {:.4g}", angles.LargestSize());
    }
    is_plain = is_plain && IsPlainName(joints[j]) && angle.unit.unit == "rad" &&
               !angle.begins_anew && (has_rate || rates.values.empty()) &&
               (has_angle || angles.values.empty());
    const std::string name = YamlWord(joint_names.Take(joints[j]));
    explicit_joints += has_angle ? JointYaml(name, paths[2 * j], angle)
                                 : JointYaml(name, {paths[2 * j + 1], {"rad/s"}});
  }
  if (!is_any) return "its joints have neither positions nor velocities";
  const bool is_alone = rows == static_cast<std::int64_t>(look.rows());
  Add("encoders", seen, look.times(), rules,
      is_plain && is_alone ? "" : "    joints:\n" + explicit_joints, names);
  return "";
}

std::string BagChannels::AddPose(const SeenTopic& seen) {
  std::string frames, element;
  if (HoldsTransforms(seen.topic.type)) {
    const auto pair = PairOfMachine(NamesInMessages(log_, seen.topic, unpacked_));
    if (!pair) return "no transform begins at a map, a world or odometry";
    frames = fmt::format("  parent: {}   # guessed: seen are {}\n  child: {}\n",
                         YamlWord(pair->first), PairsText(seen), YamlWord(pair->second));
    element = PathOfTransform(pair->first, pair->second);
  }
  const Paths paths = StandardPaths(seen.topic, {kPoseKeys.begin(), kPoseKeys.end()}, element);
  const std::string stamp = HasHeader(seen.topic) || !element.empty() ? element + kHeaderStamp : "";
  const TopicLook look(log_, seen.topic, stamp, paths, unpacked_);
  const Orientations turns = OrientationsOf(look);
  std::string columns;
  if (look.Count(0) == 0) return "no message has a place";
  if (turns.unit == 0 && turns.zero > 0) {
    columns =
        "  columns: {qw: {constant: 1}, qx: {constant: 0}, qy: {constant: 0}, qz: {constant: 0}}   "
        "# guessed: the orientation is empty\n";
  } else if (2 * turns.unit < look.Count(0)) {
    return "its quaternions are not of length 1";
  } else if (turns.unit < look.Count(0)) {
    columns = fmt::format("  # {} orientations are not of length 1: needs --skip-bad-rows\n",
                          look.Count(0) - turns.unit);
  }
  RuleGuesses rules;
  if (element.empty()) look.AddPresenceRules(paths, &rules);
  entries_.push_back({"pose",
                      fmt::format("  topic: {}   # {}, {}\n", YamlWord(seen.topic.name),
                                  seen.topic.type, seen.Rate()) +
                          frames,
                      look.times(), rules, columns});
  return "";
}

std::string BagChannels::PairsText(const SeenTopic& seen) const {
  std::string text;
  for (const auto& [pair, count] : NamesInMessages(log_, seen.topic, unpacked_)) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", pair.front(), count);
  }
  return text;
}

std::string BagChannels::Yaml() const {
  // Stamps from a different clock are used only if all channels have such stamps.
  const bool trusts_far =
      std::all_of(entries_.begin(), entries_.end(),
                  [](const Entry& e) { return e.times.HasStamps() && e.times.IsFar(); }) &&
      levers_.empty();
  bool begins_at_epoch = false;
  const auto text_of = [&](const Entry& entry) {
    const std::string indent = entry.key == "pose" ? "  " : "    ";
    RuleGuesses rules = entry.rules;
    const TimeChoice time = ChooseTime(entry.times, trusts_far, &rules);
    if (time.first_ns > FromSeconds(kLeastEpoch_s)) begins_at_epoch = true;
    return entry.head + (time.yaml.empty() ? "" : indent + time.yaml) + rules.Yaml(indent) +
           entry.rest;
  };
  std::string yaml;
  for (const char* key : {"imus", "gnss", "encoders", "tables", "pose"}) {
    std::string items;
    for (const Entry& entry : entries_) {
      if (entry.key == key) items += text_of(entry);
    }
    if (key == std::string_view("tables")) {
      TimeNs first_ns = 0;
      items += CommandsYaml(trusts_far, &first_ns);
      if (first_ns > FromSeconds(kLeastEpoch_s)) begins_at_epoch = true;
    }
    if (!items.empty()) yaml += std::string(key) + ":\n" + items;
  }
  return (begins_at_epoch ? "zero: start\n" : "") + origin_ + yaml;
}

}  // namespace tera
