#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "core/units.h"
#include "dataset/import/bag/bag_source.h"
#include "dataset/import/bag/byte_cursor.h"
#include "dataset/import/bag/message_schema.h"
#include "dataset/import/bag/standard_topics.h"
#include "dataset/import/bag/topic_table.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/suggest.h"

// Guesses about a bag of ROS messages.

namespace tera {
namespace {

struct SeenTopic {
  BagTopic topic;
  std::int64_t messages = 0;
  TimeNs first_ns = 0, last_ns = 0;

  std::string Rate() const {
    if (messages < 2 || last_ns <= first_ns) return fmt::format("{} messages", messages);
    return fmt::format("{} messages, {:.3g} Hz", messages,
                       static_cast<double>(messages - 1) / ToSeconds(last_ns - first_ns));
  }
};

/// Counts messages.
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
  std::vector<std::size_t> numbers_;  ///< of topics_, by the number that Take has
};

class BagGuess {
 public:
  explicit BagGuess(const std::filesystem::path& log)
      : log_(std::filesystem::is_directory(log) ? log / "metadata.yaml" : log) {
    try {
      ReadBag(log, &unpacked_, &census_, /*to_the_damage=*/true);
    } catch (const BagDamage& damage) {
      if (census_.topics().empty()) throw;
      damage_ = damage.what();
    }
  }

  std::string Yaml() {
    for (const SeenTopic& seen : census_.topics()) Sort(seen);
    std::string yaml = fmt::format(
        "# A first mapping by 'tera import --suggest': look at what is marked as guessed.\n"
        "name: {}\nmachine: {}   # guessed: name the machine's folder\nfile: {}\n",
        PlainNameOf(NameOfLog()), Machine(), YamlWord(log_.string()));
    if (!damage_.empty()) yaml += "# damaged, needs --skip-bad-rows: " + OneLine(damage_) + "\n";
    if (begins_at_epoch_) yaml += "zero: start\n";
    const auto add = [&](const char* key, const std::string& items) {
      if (!items.empty()) yaml += std::string(key) + ":\n" + items;
    };
    yaml += origin_;
    add("imus", imus_);
    add("gnss", gnss_);
    add("encoders", encoders_);
    yaml += pose_;
    if (!others_.empty()) yaml += "# Not mapped:\n" + others_;
    return yaml;
  }

 private:
  std::string NameOfLog() const {
    const bool is_folder = log_.filename() == "metadata.yaml";
    return is_folder ? std::filesystem::absolute(log_).parent_path().filename() : log_.stem();
  }

  static std::string OneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  }

  /// The first word of the topics' names where they share one.
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

  void Sort(const SeenTopic& seen) {
    const std::string& type = seen.topic.type;
    const std::string entry =
        fmt::format("  - name: {}\n    topic: {}   # {}\n", UniqueName(seen.topic.name),
                    YamlWord(seen.topic.name), seen.Rate());
    const bool has_messages = seen.messages > 0;
    if (has_messages && seen.first_ns > FromSeconds(kLeastEpoch_s)) begins_at_epoch_ = true;
    if (has_messages && type == kImuType) {
      imus_ += entry + ImuColumns(seen.topic);
    } else if (has_messages && type == kFixType) {
      gnss_ += entry;
      if (origin_.empty()) origin_ = Origin(seen.topic);
    } else if (has_messages && type == kJointType && NamesJoints(seen.topic)) {
      encoders_ += entry;
    } else if (has_messages && StandardColumnOf(type, "qw") && pose_.empty()) {
      pose_ = fmt::format("pose:   # guessed: the first topic of poses\n  topic: {}   # {}, {}\n",
                          YamlWord(seen.topic.name), type, seen.Rate());
    } else {
      others_ += fmt::format("#   {} ({}): {}{}\n", OneLine(seen.topic.name), OneLine(type),
                             seen.Rate(), WhyNot(seen.topic));
    }
  }

  bool NamesJoints(const BagTopic& topic) {
    try {
      return !JointNames(log_, topic, &unpacked_).empty();
    } catch (const InputError&) {
      return false;
    } catch (const BadBytes&) {
      return false;
    }
  }

  static std::string WhyNot(const BagTopic& topic) {
    try {
      SchemaOf(topic);
      return "";
    } catch (const BadBytes& bad) {
      return "; " + OneLine(bad.finding);
    }
  }

  std::string UniqueName(const std::string& topic) {
    std::string name = PlainNameOf(topic);
    while (!names_.insert(name).second) name += "_2";
    return name;
  }

  std::vector<NumbersOfColumn> Numbers(const BagTopic& topic,
                                       const std::vector<std::string>& paths) {
    LeftOutRows left_out;
    const TopicTable table(log_, topic, paths, &unpacked_, &left_out);
    std::vector<NumbersOfColumn> columns;
    for (const std::string& path : paths) {
      NumbersOfColumn column{.name = path};
      for (std::size_t row = 0; row < table.row_count(); ++row) {
        if (table.IsPresent(row, table.Column(path))) {
          column.values.push_back(table.Number(row, table.Column(path)));
        }
      }
      columns.push_back(std::move(column));
    }
    return columns;
  }

  /// Nothing where the numbers are in the units of the message's definition.
  std::string ImuColumns(const BagTopic& topic) {
    std::vector<std::string> paths;
    const std::vector<const char*> keys = {"wx", "wy", "wz", "ax", "ay", "az"};
    for (const char* key : keys) paths.push_back(StandardColumnOf(topic.type, key)->path);
    const auto columns = Numbers(topic, paths);
    UnitGuess rate = GuessRateUnit({&columns[0], &columns[1], &columns[2]});
    UnitGuess force = GuessAccelerationUnit({&columns[3], &columns[4], &columns[5]});
    if (rate.unit == "rad/s") rate.doubt.clear();
    if (rate.unit == "rad/s" && force.unit == "m/s2") {
      return force.doubt.empty() ? "" : "    # guessed: m/s2; " + force.doubt + "\n";
    }
    if (force.unit != "m/s2") force.doubt = "gravity is not 9.8 long; ROS means m/s2";
    std::string yaml = "    columns:\n";
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const UnitGuess& unit = k < 3 ? rate : force;
      yaml += fmt::format("      {}: {}{}\n", keys[k], ColumnYaml(paths[k], unit),
                          k % 3 == 0 ? DoubtRemark(unit) : "");
    }
    return yaml;
  }

  std::string Origin(const BagTopic& topic) {
    const auto columns = Numbers(topic, {"latitude", "longitude", "altitude"});
    for (const NumbersOfColumn& column : columns) {
      if (column.values.empty()) {
        return "origin: {lat_deg: 0, lon_deg: 0, height_m: 0}   # guessed: no fix has a position\n";
      }
    }
    return fmt::format(
        "origin: {{lat_deg: {:.7f}, lon_deg: {:.7f}, height_m: {:.3f}}}   # guessed: the first "
        "position\n",
        columns[0].values.front(), columns[1].values.front(), columns[2].values.front());
  }

  std::filesystem::path log_;
  UnpackedFiles unpacked_;
  Census census_;
  std::string damage_;
  std::set<std::string> names_;
  bool begins_at_epoch_ = false;
  std::string origin_, imus_, gnss_, encoders_, pose_, others_;
};

}  // namespace

std::string SuggestForBag(const std::filesystem::path& log) { return BagGuess(log).Yaml(); }

}  // namespace tera
