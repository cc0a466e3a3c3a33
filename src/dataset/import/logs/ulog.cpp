#include "dataset/import/logs/ulog.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "core/config/spelling.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/bag/byte_cursor.h"
#include "dataset/import/logs/number_table.h"
#include "dataset/import/logs/ulog_format.h"

namespace tera {
namespace {

constexpr std::string_view kMagic("\x55\x4c\x6f\x67\x01\x12\x35", 7);
constexpr std::size_t kHeaderBytes = 16, kMessageHeadBytes = 3;

/// Reads the definitions and messages of a log in order.
class UlogReader {
 public:
  explicit UlogReader(const std::filesystem::path& file)
      : file_(file), bytes_(ReadWholeFile(file)) {
    if (bytes_.size() < kHeaderBytes || !bytes_.starts_with(kMagic)) {
      throw InputError(fmt::format("{}: is not a ULog; need a log of PX4 (.ulg)", file.string()));
    }
    constexpr int kNewest = 1;
    const int version = static_cast<unsigned char>(bytes_[kMagic.size()]);
    if (version > kNewest) {
      throw InputError(
          fmt::format("{}: is a ULog of version {}; need version 0 or 1", file.string(), version));
    }
  }

  /// Reads the next data message; returns false at the end. Throws BadBytes for a fault of the log.
  bool Next(std::string* topic, std::string_view* payload) {
    while (at_ < bytes_.size()) {
      const std::size_t end = at_ < appended_ ? appended_ : bytes_.size();
      if (end - at_ < kMessageHeadBytes) {
        if (end == appended_) {
          at_ = end;  // skips an incomplete message in front of appended data
          continue;
        }
        throw BadBytes{"ends within a message"};
      }
      const std::size_t size = UlogNumberAt<std::uint16_t>(bytes_, at_);
      const char type = bytes_[at_ + 2];
      const std::size_t begin = at_ + kMessageHeadBytes;
      if (size > end - begin) {
        if (end != appended_) throw BadBytes{"ends within a message"};
        at_ = end;
        continue;
      }
      const std::string_view body = std::string_view(bytes_).substr(begin, size);
      at_ = begin + size;
      if (TakeMessage(type, body, topic, payload)) return true;
    }
    return false;
  }

  /// Numeric fields of a subscribed topic. Throws BadBytes.
  std::vector<UlogNumber> NumbersOf(const std::string& topic) const {
    return formats_.NumbersOf(format_of_.at(topic));
  }

  std::string Location() const { return fmt::format("{}: at byte {}", file_.string(), at_); }
  int messages() const { return messages_; }

 private:
  bool TakeMessage(char type, std::string_view body, std::string* topic,
                   std::string_view* payload) {
    switch (type) {
      case 'B':
        TakeFlags(body);
        return false;
      case 'F':
        formats_.Define(body);
        return false;
      case 'A': {
        if (body.size() < 4) throw BadBytes{"offers a topic without a name"};
        const int instance = static_cast<unsigned char>(body[0]);
        const std::string format(body.substr(3));
        const std::string name = instance == 0 ? format : fmt::format("{}[{}]", format, instance);
        topic_of_[UlogNumberAt<std::uint16_t>(body, 1)] = name;
        format_of_[name] = format;
        return false;
      }
      case 'D': {
        if (body.size() < 2) throw BadBytes{"has a message of data without a topic"};
        ++messages_;
        const auto known = topic_of_.find(UlogNumberAt<std::uint16_t>(body, 0));
        if (known == topic_of_.end()) throw BadBytes{"has data of an undeclared topic"};
        *topic = known->second;
        *payload = body.substr(2);
        return true;
      }
      default:
        // Texts, parameters and marks are skipped. A message type is always a letter.
        if (type < 'A' || type > 'Z') throw BadBytes{"has bytes that are not a message"};
        return false;
    }
  }

  /// Reads the flags: incompatible features, and offsets of appended data.
  void TakeFlags(std::string_view body) {
    constexpr std::size_t kFlags = 8, kOffset = 16, kBytes = 40;
    if (body.size() < kBytes) throw BadBytes{"has too few flags"};
    const bool is_appended = (body[kFlags] & 1) != 0;
    for (std::size_t k = kFlags; k < kOffset; ++k) {
      const int known = k == kFlags ? 1 : 0;
      if ((static_cast<unsigned char>(body[k]) & ~known) != 0) {
        throw BadBytes{"needs a reader of a later version of ULog"};
      }
    }
    const auto offset = UlogNumberAt<std::uint64_t>(body, kOffset);
    if (is_appended && offset > at_ && offset < bytes_.size()) appended_ = offset;
  }

  std::filesystem::path file_;
  std::string bytes_;
  std::size_t at_ = kHeaderBytes, appended_ = 0;
  int messages_ = 0;
  UlogFormats formats_;
  std::map<std::uint16_t, std::string> topic_of_;
  std::map<std::string, std::string> format_of_;
};

/// The requested numbers, with the time first.
std::vector<UlogNumber> Wanted(const std::vector<UlogNumber>& all,
                               const std::vector<std::string>& paths, const std::string& where) {
  std::vector<UlogNumber> wanted;
  std::vector<std::string> names;
  for (const UlogNumber& number : all) names.push_back(number.path);
  std::vector<std::string> asked = {"timestamp"};
  asked.insert(asked.end(), paths.begin(), paths.end());
  for (const std::string& path : asked) {
    const auto found = std::find(names.begin(), names.end(), path);
    if (found == names.end()) {
      throw InputError(fmt::format("{} has no '{}'{}; it has {}", where, path,
                                   DidYouMean(path, names), fmt::join(names, ", ")));
    }
    wanted.push_back(all[static_cast<std::size_t>(found - names.begin())]);
  }
  return wanted;
}

}  // namespace

std::vector<UlogTopic> UlogTopics(const std::filesystem::path& file) {
  UlogReader reader(file);
  std::map<std::string, UlogTopic> topics;
  try {
    std::string name;
    std::string_view payload;
    while (reader.Next(&name, &payload)) {
      UlogTopic& topic = topics[name];
      if (topic.messages++ > 0) continue;
      topic.name = name;
      for (const UlogNumber& number : reader.NumbersOf(name)) {
        topic.fields.push_back(number.path);
      }
    }
  } catch (const BadBytes&) {
    // Topics before the damage are returned.
  }
  std::vector<UlogTopic> list;
  for (auto& [name, topic] : topics) list.push_back(std::move(topic));
  return list;
}

std::unique_ptr<const RowTable> ReadUlog(const std::filesystem::path& file,
                                         const std::string& topic,
                                         const std::vector<std::string>& paths,
                                         LeftOutRows* left_out) {
  const std::string where = fmt::format("{}: {}", file.string(), topic);
  auto table = std::make_unique<NumberTable>(file, paths);
  UlogReader reader(file);
  std::vector<UlogNumber> wanted;
  const auto fault = [&](const std::string& finding) {
    if (left_out == nullptr) {
      throw InputError(finding + "; repair it, or skip it with --skip-bad-rows");
    }
    left_out->Add(finding);
  };
  int number = 0;
  try {
    std::string name;
    std::string_view payload;
    while (reader.Next(&name, &payload)) {
      if (name != topic) continue;
      if (number++ == 0) wanted = Wanted(reader.NumbersOf(topic), paths, where);
      const bool is_whole = std::all_of(wanted.begin(), wanted.end(), [&](const UlogNumber& n) {
        return n.offset + n.bytes <= payload.size();
      });
      if (!is_whole) {
        fault(fmt::format("{} message {}: is shorter than its fields", where, number));
        continue;
      }
      constexpr std::uint64_t kNsPerMicrosecond = 1000, kLast_us = 9'000'000'000'000'000;
      const auto t_us = UlogNumberAt<std::uint64_t>(payload, wanted.front().offset);
      if (wanted.front().bytes != sizeof t_us || t_us > kLast_us) {
        fault(fmt::format("{} message {}: its timestamp is no time", where, number));
        continue;
      }
      std::vector<NumberTable::Cell> cells;
      for (std::size_t k = 1; k < wanted.size(); ++k) {
        cells.push_back({paths[k - 1], wanted[k].read(payload, wanted[k].offset)});
      }
      table->AddRow(number, static_cast<TimeNs>(t_us * kNsPerMicrosecond), cells);
    }
  } catch (const BadBytes& damage) {
    fault(fmt::format("{}: the log {}", reader.Location(), damage.finding));
  }
  if (number == 0 && left_out == nullptr) {
    std::vector<std::string> names;
    for (const UlogTopic& other : UlogTopics(file)) names.push_back(other.name);
    throw InputError(fmt::format(
        "{}: has no topic '{}'{}; it has {}", file.string(), topic, DidYouMean(topic, names),
        names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }
  return table;
}

}  // namespace tera
