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
/// Name of the column with the recording times of the messages.
inline constexpr const char* kLogTime = "log_time";

struct FoundTopic {
  std::optional<BagTopic> topic;
  std::vector<std::string> names;  ///< names of all topics, only if the topic was not found
};

/// Finds a topic by name. Reads as little of the bag as possible; the search ends at damage.
FoundTopic FindTopic(const std::filesystem::path& bag, const std::string& name,
                     UnpackedFiles* unpacked);

/// True if messages of the topic begin with a header. False if the definition is unreadable.
bool HasHeader(const BagTopic& topic);

/// Place of a message for error texts: "log.mcap: /imu message 12".
std::string MessagePlace(const std::filesystem::path& bag, const BagTopic& topic, int number);

/// Selected fields of all messages of a topic, in memory, with one row per message.
class TopicTable final : public RowTable {
 public:
  /// Each path is a path of MessageReader or kLogTime. Throws as ReadBag and MessageReader do. With
  /// `left_out`, unreadable messages and damage are recorded there instead, and the bag is read up
  /// to the damage.
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
    std::vector<TimeNs> stamps_ns;  ///< only for a column of times
  };

  std::filesystem::path bag_;
  BagTopic topic_;
  std::vector<ColumnOfCells> columns_;
  std::vector<int> lines_;
};

}  // namespace tera
