#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/export/bag/bag_writer.h"
#include "dataset/export/counted_file.h"

namespace tera {

/// Writes a ROS 1 bag, format 2.0. Messages are in chunks; each chunk is followed by one index per
/// connection. Connections and chunk offsets are at the end of the file.
///
/// Omits   compression of chunks.
/// Source  "Bags/Format/2.0" of the ROS 1 wiki.
class Ros1BagWriter : public BagWriter {
 public:
  /// Throws InputError if the file cannot be written, like every other function of the class.
  explicit Ros1BagWriter(const std::filesystem::path& file) : file_(file) {}

  ros::WireForm form() const override { return ros::WireForm::kRos1; }
  std::size_t AddTopic(const Topic& topic) override;
  void Write(std::size_t topic, TimeNs t_ns, std::string_view message) override;
  void Finish() override;

 private:
  /// Offset of a chunk and its message count by connection.
  struct Chunk {
    std::uint64_t position = 0;
    TimeNs first_ns = 0, last_ns = 0;
    std::map<std::uint32_t, std::uint32_t> counts;
  };

  void Append(const std::string& bytes);
  void EndChunk();

  CountedFile file_;  ///< the file after its first record; that record holds the offset of the
                      ///< connections, which is known only at the end
  std::uint64_t bytes_ = 0;
  std::string connections_;  ///< connection records
  std::string chunk_;        ///< records of the current chunk
  std::map<std::uint32_t, std::string>
      index_;  ///< time and offset of each message in the current chunk, by connection
  Chunk current_;
  std::vector<Chunk> chunks_;
  std::uint32_t topics_ = 0;
};

}  // namespace tera
