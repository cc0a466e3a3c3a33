#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dataset/import/bag/bag_source.h"
#include "dataset/import/left_out_rows.h"
#include "dataset/import/row_table.h"

namespace tera {

inline constexpr const char* kHeaderStamp = "header.stamp";
/// Column of the messages' recording times.
inline constexpr const char* kLogTime = "log_time";

struct FoundTopic {
  std::optional<BagTopic> topic;
  std::vector<std::string> names;  ///< all topics, where the name was not found
};

/// Looks up a topic, reading as little of the bag as possible. Damage counts as the bag's end.
FoundTopic FindTopic(const std::filesystem::path& bag, const std::string& name,
                     UnpackedFiles* unpacked);

/// Whether a topic's messages begin with a header; false where its definition is unreadable.
bool HasHeader(const BagTopic& topic);

/// "log.mcap: /imu message 12"
std::string MessagePlace(const std::filesystem::path& bag, const BagTopic& topic, int number);

/// Fields of a topic's messages in memory, one row for each message. Nothing else of the messages
/// is kept.
class TopicTable final : public RowTable {
 public:
  /// `paths` as in MessageReader, or kLogTime. Throws the faults of ReadBag and MessageReader. With
  /// `left_out`, unreadable messages and damage are added to it instead, and all content before the
  /// damage is read.
  TopicTable(const std::filesystem::path& bag, const BagTopic& topic,
             const std::vector<std::string>& paths, UnpackedFiles* unpacked, LeftOutRows* left_out);

  std::size_t row_count() const override { return lines_.size(); }
  std::size_t Column(const std::string& name) const override;
  int Line(std::size_t row) const override { return lines_[row]; }
  std::optional<double> NumberIfAny(std::size_t row, std::size_t column) const override;
  double Number(std::size_t row, std::size_t column) const override;
  std::optional<TimeNs> Stamp(std::size_t row, std::size_t column) const override;
  bool IsPresent(std::size_t row, std::size_t column) const override;
  bool Repeats(std::size_t row, std::size_t column) const override;
  [[noreturn]] void Fail(std::size_t row, std::size_t column,
                         const InputFault& fault) const override;

 private:
  class Filler;
  struct ColumnOfCells {
    std::string path;
    std::vector<std::optional<double>> numbers;
    bool is_stamp = false;
    std::vector<TimeNs> stamps_ns;  ///< for columns of times
  };

  std::filesystem::path bag_;
  BagTopic topic_;
  std::vector<ColumnOfCells> columns_;
  std::vector<int> lines_;
};

}  // namespace tera
