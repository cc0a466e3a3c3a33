#include "dataset/export/bag/sqlite_bag_writer.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include "core/error.h"
#include "dataset/export/bag/bag_metadata.h"
#include "dataset/ros/message_definitions.h"

namespace tera {
namespace {

constexpr std::int64_t kMessagesPerTransaction = 1000;

constexpr const char* kTables =
    "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);"
    "CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL,"
    "  metadata TEXT NOT NULL);"
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
    "  serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
    "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
    "  timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
    "INSERT INTO schema VALUES (3, 'humble');";

}  // namespace

struct SqliteBagWriter::Database {
  std::filesystem::path file;
  sqlite3* handle = nullptr;
  sqlite3_stmt* insert = nullptr;
  std::int64_t topics = 0, messages = 0;

  ~Database() {
    sqlite3_finalize(insert);
    sqlite3_close(handle);
  }
  void Require(int status) const {
    if (status == SQLITE_OK || status == SQLITE_DONE || status == SQLITE_ROW) return;
    throw InputError(
        file.string(),
        {FaultKind::kUnwritable,
         fmt::format("cannot be written: {}; free space on that disk or choose another place",
                     sqlite3_errmsg(handle))});
  }
  void Execute(const char* sql) const {
    Require(sqlite3_exec(handle, sql, nullptr, nullptr, nullptr));
  }
  sqlite3_stmt* Prepare(const char* sql) const {
    sqlite3_stmt* statement = nullptr;
    Require(sqlite3_prepare_v2(handle, sql, -1, &statement, nullptr));
    return statement;
  }
};

SqliteBagWriter::SqliteBagWriter(const std::filesystem::path& file)
    : database_(std::make_unique<Database>()) {
  database_->file = file;
  database_->Require(sqlite3_open(file.c_str(), &database_->handle));
  // A journal is unnecessary, because the folder gets its final name only when the file is
  // complete.
  database_->Execute("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF;");
  database_->Execute(kTables);
  database_->insert =
      database_->Prepare("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)");
  database_->Execute("BEGIN");
}

SqliteBagWriter::~SqliteBagWriter() = default;

std::size_t SqliteBagWriter::AddTopic(const Topic& topic) {
  const std::string type = ros::FullTypeName(topic.type, form());
  const std::string qos = QosProfiles(topic.quality);
  sqlite3_stmt* const insert = database_->Prepare("INSERT INTO topics VALUES (?, ?, ?, 'cdr', ?)");
  sqlite3_bind_int64(insert, 1, database_->topics + 1);
  sqlite3_bind_text(insert, 2, topic.name.c_str(), -1, SQLITE_STATIC);
  sqlite3_bind_text(insert, 3, type.c_str(), -1, SQLITE_STATIC);
  sqlite3_bind_text(insert, 4, qos.c_str(), -1, SQLITE_STATIC);
  const int status = sqlite3_step(insert);
  sqlite3_finalize(insert);
  database_->Require(status);
  return static_cast<std::size_t>(database_->topics++);
}

void SqliteBagWriter::Write(std::size_t topic, TimeNs t_ns, std::string_view message) {
  sqlite3_stmt* const insert = database_->insert;
  sqlite3_bind_int64(insert, 1, static_cast<sqlite3_int64>(topic) + 1);
  sqlite3_bind_int64(insert, 2, t_ns);
  sqlite3_bind_blob64(insert, 3, message.data(), message.size(), SQLITE_STATIC);
  database_->Require(sqlite3_step(insert));
  database_->Require(sqlite3_reset(insert));
  if (++database_->messages % kMessagesPerTransaction == 0) database_->Execute("COMMIT; BEGIN");
}

void SqliteBagWriter::AddMetadata(const std::string& yaml) {
  constexpr int kMetadataVersion = 5;
  sqlite3_stmt* const insert = database_->Prepare("INSERT INTO metadata VALUES (1, ?, ?)");
  sqlite3_bind_int(insert, 1, kMetadataVersion);
  sqlite3_bind_text(insert, 2, yaml.c_str(), -1, SQLITE_STATIC);
  const int status = sqlite3_step(insert);
  sqlite3_finalize(insert);
  database_->Require(status);
}

void SqliteBagWriter::Finish() {
  database_->Execute("CREATE INDEX timestamp_idx ON messages (timestamp ASC); COMMIT");
  sqlite3_finalize(database_->insert);
  database_->insert = nullptr;
  database_->Require(sqlite3_close(database_->handle));
  database_->handle = nullptr;
}

}  // namespace tera
