#include "dataset/import/bag/topic_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "core/check.h"
#include "dataset/import/bag/byte_cursor.h"
#include "dataset/import/bag/message_reader.h"

namespace tera {
namespace {

class TopicFinder : public BagVisitor {
 public:
  TopicFinder(const std::string& name, FoundTopic* found) : name_(name), found_(found) {}

  Wish Wants(const BagTopic& topic) override {
    if (topic.name == name_) {
      found_->topic = topic;
      return Wish::kEnough;
    }
    auto& names = found_->names;
    if (std::find(names.begin(), names.end(), topic.name) == names.end()) {
      names.push_back(topic.name);
    }
    return Wish::kSkip;
  }
  bool Take(std::size_t, const BagMessage&) override { return false; }

 private:
  const std::string& name_;
  FoundTopic* found_;
};

/// Place of a topic for messages: "log.mcap: topic /imu (sensor_msgs/Imu)".
std::string TopicPlace(const std::filesystem::path& bag, const BagTopic& topic) {
  return fmt::format("{}: topic {} ({})", bag.string(), topic.name, topic.type);
}

}  // namespace

FoundTopic FindTopic(const std::filesystem::path& bag, const std::string& name,
                     UnpackedFiles* unpacked) {
  FoundTopic found;
  TopicFinder finder(name, &found);
  try {
    ReadBag(bag, unpacked, &finder, /*to_the_damage=*/true);
  } catch (const BagDamage&) {
    // If the topic is known, reading its messages will report the damage. Without any topic,
    // nothing else would.
    if (!found.topic && found.names.empty()) throw;
  }
  return found;
}

bool HasHeader(const BagTopic& topic) {
  try {
    return SchemaOf(topic).HasHeader();
  } catch (const BadBytes&) {
    return false;
  }
}

std::string MessagePlace(const std::filesystem::path& bag, const BagTopic& topic, int number) {
  return fmt::format("{}: {} message {}", bag.string(), topic.name, number);
}

/// Fills the columns of the table from messages.
class TopicTable::Filler : public BagVisitor {
 public:
  Filler(TopicTable* table, LeftOutRows* left_out) : table_(table), left_out_(left_out) {
    for (const ColumnOfCells& column : table->columns_) {
      if (column.path != kLogTime) paths_.push_back(column.path);
    }
  }

  Wish Wants(const BagTopic& topic) override {
    const std::size_t number = asked_++;
    if (topic.name != table_->topic_.name) return Wish::kSkip;
    readers_[number] = ReaderOf(topic);
    return Wish::kTake;
  }

  bool Take(std::size_t number, const BagMessage& message) override {
    const int line = ++messages_;
    try {
      readers_.at(number)->Read(message.bytes, &cells_);
    } catch (const BadBytes& bad) {
      const std::string fault =
          MessagePlace(table_->bag_, table_->topic_, line) + ": " + bad.finding;
      if (left_out_ == nullptr) {
        throw InputError(fault + "; repair it, or skip such messages with --skip-bad-rows");
      }
      left_out_->Add(fault);
      return true;
    }
    AddRow(message, line);
    return true;
  }

 private:
  /// Publishers of a topic may use different definitions, so there is one reader per definition.
  std::shared_ptr<const MessageReader> ReaderOf(const BagTopic& topic) {
    try {
      auto reader = std::make_shared<const MessageReader>(SchemaOf(topic), paths_);
      std::size_t path = 0;
      for (ColumnOfCells& column : table_->columns_) {
        column.is_stamp = column.path == kLogTime || reader->IsStamp(path);
        if (column.path != kLogTime) ++path;
      }
      return reader;
    } catch (const BadBytes& bad) {
      throw InputError(TopicPlace(table_->bag_, topic) + ": " + bad.finding);
    }
  }

  void AddRow(const BagMessage& message, int line) {
    table_->lines_.push_back(line);
    std::size_t path = 0;
    for (ColumnOfCells& column : table_->columns_) {
      const MessageCell cell = column.path == kLogTime
                                   ? MessageCell{ToSeconds(message.log_ns), message.log_ns}
                                   : cells_[path++];
      column.numbers.push_back(cell.number);
      if (column.is_stamp) column.stamps_ns.push_back(cell.stamp_ns);
    }
  }

  TopicTable* table_;
  LeftOutRows* left_out_;
  std::vector<std::string> paths_;
  std::size_t asked_ = 0;
  std::map<std::size_t, std::shared_ptr<const MessageReader>> readers_;
  std::vector<MessageCell> cells_;
  int messages_ = 0;
};

TopicTable::TopicTable(const std::filesystem::path& bag, const BagTopic& topic,
                       const std::vector<std::string>& paths, UnpackedFiles* unpacked,
                       LeftOutRows* left_out)
    : bag_(bag), topic_(topic) {
  for (const std::string& path : paths) columns_.push_back({.path = path});
  Filler filler(this, left_out);
  try {
    ReadBag(bag, unpacked, &filler, /*to_the_damage=*/left_out != nullptr);
  } catch (const BagDamage& damage) {
    if (left_out == nullptr) throw;
    left_out->Add(damage.what());
  }
}

std::size_t TopicTable::Column(const std::string& name) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(),
                                  [&](const ColumnOfCells& column) { return column.path == name; });
  TERA_CHECK(found != columns_.end(), name);
  return static_cast<std::size_t>(found - columns_.begin());
}

bool TopicTable::IsPresent(std::size_t row, std::size_t column) const {
  const auto& number = columns_[column].numbers[row];
  return number && !std::isnan(*number);
}

std::optional<double> TopicTable::NumberIfAny(std::size_t row, std::size_t column) const {
  const auto& number = columns_[column].numbers[row];
  return number && std::isfinite(*number) ? number : std::nullopt;
}

double TopicTable::Number(std::size_t row, std::size_t column) const {
  const auto number = NumberIfAny(row, column);
  if (!number) Fail(row, column, {FaultKind::kMistyped, "need a finite number"});
  return *number;
}

std::optional<TimeNs> TopicTable::Stamp(std::size_t row, std::size_t column) const {
  if (!columns_[column].is_stamp || !columns_[column].numbers[row]) return std::nullopt;
  return columns_[column].stamps_ns[row];
}

bool TopicTable::Repeats(std::size_t row, std::size_t column) const {
  const ColumnOfCells& cells = columns_[column];
  if (cells.is_stamp) return cells.stamps_ns[row] == cells.stamps_ns[row - 1];
  const auto &now = cells.numbers[row], &before = cells.numbers[row - 1];
  return now == before || (now && before && std::isnan(*now) && std::isnan(*before));
}

void TopicTable::Fail(std::size_t row, std::size_t column, const InputFault& fault) const {
  const ColumnOfCells& cells = columns_[column];
  const std::string found = cells.is_stamp       ? fmt::format("{} ns", cells.stamps_ns[row])
                            : cells.numbers[row] ? fmt::format("'{}'", *cells.numbers[row])
                                                 : "no such element";
  throw InputError(
      fmt::format("{}: field '{}'", MessagePlace(bag_, topic_, lines_[row]), cells.path),
      {fault.kind, fmt::format("found {}, {}", found, fault.finding)});
}

}  // namespace tera
