#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/units.h"
#include "dataset/import/bag/byte_cursor.h"
#include "dataset/import/bag/message_schema.h"
#include "dataset/import/suggest/bag_channels.h"
#include "dataset/import/suggest/doubted_numbers.h"
#include "dataset/import/suggest/rate_guess.h"
#include "dataset/ros/delta_can.h"

// Suggests channels for topics of single numbers and for TERA's own messages.

namespace tera {
namespace {

template <std::size_t n>
bool HasOneOf(const std::vector<std::string>& words, const std::array<std::string_view, n>& known) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(known.begin(), known.end(), word) != known.end();
  });
}

/// The joint or lever that the words denote, such as "left_track" for "left" and "travel"; empty if
/// none.
std::string JointOf(const std::vector<std::string>& words) {
  const auto has = [&](std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  for (const char* side : {"left", "right"}) {
    if (has(side) && HasOneOf<4>(words, {"track", "travel", "tracks", "drive"})) {
      return std::string(side) + "_track";
    }
  }
  for (const std::string& word : words) {
    if (word == "blade") return word;
    if (std::string joint = JointOfWord(word); !joint.empty()) return joint;
  }
  return "";
}

enum class Role { kLever, kAngle, kRate, kOther, kUnknown };

Role RoleOf(const std::vector<std::string>& words) {
  constexpr std::array<std::string_view, 16> kOthers = {
      "pressure", "force",  "effort", "torque", "current", "voltage",  "temperature", "temp",
      "flow",     "stroke", "length", "mass",   "load",    "setpoint", "target",      "desired"};
  constexpr std::array<std::string_view, 12> kLevers = {"cmd",     "command",  "commands", "lever",
                                                        "levers",  "joystick", "joy",      "valve",
                                                        "control", "input",    "pwm",      "spool"};
  constexpr std::array<std::string_view, 6> kRates = {"rate",  "velocity", "vel",
                                                      "speed", "radps",    "dps"};
  constexpr std::array<std::string_view, 9> kAngles = {
      "angle", "angles", "position", "pos", "joint", "encoder", "inclination", "deg", "rad"};
  if (HasOneOf(words, kOthers)) return Role::kOther;
  if (HasOneOf(words, kLevers)) return Role::kLever;
  if (HasOneOf(words, kRates)) return Role::kRate;
  return HasOneOf(words, kAngles) ? Role::kAngle : Role::kUnknown;
}

}  // namespace

bool IsNumber(const BagTopic& topic) {
  try {
    const MessageSchema schema = SchemaOf(topic);
    const std::vector<MessageField>& fields = schema.root().fields;
    const std::size_t header = schema.HasHeader() ? 1 : 0;
    if (fields.size() != header + 1) return false;
    const MessageField& field = fields.back();
    return field.name == "data" && field.arity == MessageField::Arity::kOne &&
           field.kind >= FieldKind::kInt8 && field.kind <= FieldKind::kFloat64;
  } catch (const BadBytes&) {
    return false;
  }
}

std::string BagChannels::AddNumber(const SeenTopic& seen, TakenNames* names) {
  const TopicLook look = Look(seen, {"data"});
  NumbersOfColumn numbers = look.Numbers(0);
  numbers.name = seen.topic.name;
  if (numbers.values.empty()) return "no message has a number";
  RuleGuesses rules;
  look.AddPresenceRules({"data"}, &rules);
  const std::vector<std::string> words = WordsOfName(seen.topic.name);
  const std::string joint = JointOf(words);
  const Role role = joint.empty() ? Role::kOther : RoleOf(words);
  const auto is_known = [&](const Lever& lever) { return lever.name == joint; };
  if (role == Role::kLever && std::none_of(levers_.begin(), levers_.end(), is_known)) {
    levers_.push_back(
        {joint, seen.topic.name, look.times(), numbers.LargestSize(), seen.Rate(), rules});
    return "";
  }
  if (role == Role::kOther || role == Role::kLever) {
    const bool is_mass = std::find(words.begin(), words.end(), "mass") != words.end();
    entries_.push_back(
        {"tables",
         fmt::format("  - name: {}\n    topic: {}   # {}\n", names->Take(seen.topic.name),
                     YamlWord(seen.topic.name), seen.Rate()),
         look.times(), rules,
         fmt::format("    columns:\n      {}: {{column: data, unit: '1'}}   # guessed: {}, up to "
                     "{:.4g}\n",
                     is_mass ? "mass_kg" : "value", is_mass ? "kg" : "unit unknown",
                     numbers.LargestSize())});
    return "";
  }
  AngleGuess angle = role == Role::kRate ? AngleGuess{} : GuessAngle(numbers);
  // ROS messages use rad.
  if (!angle.unit.is_known()) angle.unit.unit = "rad";
  if (role == Role::kUnknown) {
    angle.unit.doubt +=
        (angle.unit.doubt.empty() ? "" : "; ") +
        std::string("an angle by its joint's name; a lever is a column of commands");
  }
  Add("encoders", seen, look.times(), rules,
      "    joints:\n" + (role == Role::kRate ? JointYaml(joint, {"data", GuessRateUnit({&numbers})})
                                             : JointYaml(joint, "data", angle)),
      names);
  return "";
}

std::string BagChannels::CommandsYaml(bool trusts_far, TimeNs* first_ns) const {
  constexpr double kMostOfFull = 1.5;  // a larger value is not on the scale -1 to 1
  std::string yaml;
  for (const Lever& lever : levers_) {
    RuleGuesses rules = lever.rules;
    const TimeChoice time = ChooseTime(lever.times, trusts_far, &rules);
    *first_ns = std::max(*first_ns, time.first_ns);
    yaml += fmt::format(
        "      {}:   # {}\n        topic: {}\n        column: data\n        unit: "
        "'{}'   # guessed: up to {:.4g}\n",
        lever.name, lever.rate, YamlWord(lever.topic), lever.largest > kMostOfFull ? "%" : "1",
        lever.largest);
    if (!time.yaml.empty()) yaml += "        " + time.yaml;
    yaml += rules.Yaml("        ");
  }
  return yaml.empty() ? ""
                      : fmt::format("  - name: {}\n    columns:\n{}",
                                    has_commands_ ? "commands_by_topic" : "commands", yaml);
}

std::string BagChannels::AddDeltaCan(const SeenTopic& seen, TakenNames* names) {
  std::vector<std::string> paths;
  for (const ros::DeltaCanField& field : ros::kDeltaCanFields) paths.emplace_back(field.name);
  paths.emplace_back("enable");
  const TopicLook look = Look(seen, paths);
  std::string moved, still;
  for (std::size_t k = 0; k + 1 < paths.size(); ++k) {
    const std::string lever = paths[k] == "left_travel"    ? "left_track"
                              : paths[k] == "right_travel" ? "right_track"
                                                           : paths[k];
    const std::string line =
        fmt::format("      {}{}: {}\n", look.Numbers(k).LargestSize() > 0 ? "" : "# always 0, ",
                    lever, ColumnYaml(paths[k], {"1"}));
    (look.Numbers(k).LargestSize() > 0 ? moved : still) += line;
  }
  if (moved.empty()) return "all levers are always 0";
  std::int64_t disabled = 0;
  for (const double enable : look.Numbers(paths.size() - 1).values) disabled += enable == 0 ? 1 : 0;
  std::string remark;
  if (disabled > 0) {
    remark =
        fmt::format("    # {} messages have enable false: no lever reached a valve\n", disabled);
  }
  const std::string name = has_commands_ ? names->Take(seen.topic.name) : "commands";
  has_commands_ = true;
  entries_.push_back({"tables",
                      fmt::format("  - name: {}\n    topic: {}   # {}\n", name,
                                  YamlWord(seen.topic.name), seen.Rate()),
                      look.times(),
                      {},
                      remark + "    columns:\n" + moved + still});
  return "";
}

std::string BagChannels::AddToolPose(const SeenTopic& seen, TakenNames* names) {
  constexpr std::array<const char*, 7> kNames = {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
  const std::vector<std::string> paths = {
      "pose.position.x",    "pose.position.y",    "pose.position.z",   "pose.orientation.w",
      "pose.orientation.x", "pose.orientation.y", "pose.orientation.z"};
  const TopicLook look = Look(seen, paths);
  RuleGuesses rules;
  look.AddPresenceRules(paths, &rules);
  std::string columns = "    columns:   # of the tool in the machine's root link\n";
  for (std::size_t k = 0; k < paths.size(); ++k) {
    columns += fmt::format("      {}: {}\n", kNames[k], ColumnYaml(paths[k], {k < 3 ? "m" : "1"}));
  }
  Add("tables", seen, look.times(), rules, columns, names);
  return "";
}

}  // namespace tera
