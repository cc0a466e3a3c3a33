#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "dataset/export/bag/bag_writer.h"

namespace tera {

/// Writes a SQLite 3 file for rosbag2's storage plugin `sqlite3`, schema version 3. It has the
/// tables topics, messages, schema and metadata, and an index on message time.
///
/// Source  ros2/rosbag2, branch humble, rosbag2_storage_default_plugins.
class SqliteBagWriter : public BagWriter {
 public:
  /// Throws InputError if the file cannot be written, like every other function of the class.
  explicit SqliteBagWriter(const std::filesystem::path& file);
  ~SqliteBagWriter() override;

  ros::WireForm form() const override { return ros::WireForm::kCdr; }
  std::size_t AddTopic(const Topic& topic) override;
  void Write(std::size_t topic, TimeNs t_ns, std::string_view message) override;
  void Finish() override;
  /// Adds the text of metadata.yaml as a row of the table metadata. Must be called before Finish.
  void AddMetadata(const std::string& yaml);

 private:
  struct Database;
  std::unique_ptr<Database> database_;
};

}  // namespace tera
