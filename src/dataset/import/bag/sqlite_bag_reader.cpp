#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "dataset/import/bag/bag_file.h"
#include "dataset/import/bag/bag_source.h"
#include "dataset/import/bag/sqlite_whole_file.h"
#include "dataset/import/bag/unpack.h"

// Source  ros2/rosbag2, rosbag2_storage_default_plugins (Humble) and rosbag2_storage_sqlite3
//         (Jazzy), whose table message_definitions has schema version 4.

namespace tera {
namespace {

using Statement = std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)>;

class SqliteBagReader {
 public:
  SqliteBagReader(const std::filesystem::path& file, BagVisitor* visitor, bool to_the_damage)
      : file_(file), visitor_(visitor) {
    BagFile(file).Read(0, 0);  // throws if the file is unreadable
    sqlite3* handle = nullptr;
    const char* access = IsUnpackedFile(file) ? SqliteWholeFile() : nullptr;
    const int status = sqlite3_open_v2(file.c_str(), &handle, SQLITE_OPEN_READONLY, access);
    database_.reset(handle);
    Require(status);
    sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, static_cast<int>(kMostPieceBytes));
    // The file's views and triggers must not run. A truncated file can be read up to its end.
    Execute("PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON;");
    if (to_the_damage) Execute("PRAGMA writable_schema=ON;");
  }

  bool Read() {
    for (const char* table : {"topics", "messages"}) {
      if (!HasTable(table)) {
        throw InputError(fmt::format("{}: has no table '{}', so it is not a bag of rosbag2",
                                     file_.string(), table));
      }
    }
    if (!AskOfTopics() || !ShowMessages()) return false;
    RequireWhole();
    return true;
  }

 private:
  struct Topic {
    std::size_t number = 0;  ///< index of the topic for BagVisitor::Take
    std::string name;
    bool wanted = false;
  };

  void Require(int status) const {
    if (status == SQLITE_OK || status == SQLITE_DONE || status == SQLITE_ROW) return;
    throw BagDamage(fmt::format(
        "{}: SQLite says '{}'; need a complete SQLite 3 file of rosbag2: copy it again, or read "
        "the intact part with --skip-bad-rows",
        file_.string(),
        status == SQLITE_CORRUPT ? sqlite3_errstr(status) : sqlite3_errmsg(database_.get())));
  }
  void Execute(const char* sql) const {
    Require(sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr));
  }
  Statement Prepare(const char* sql) const {
    sqlite3_stmt* statement = nullptr;
    Require(sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr));
    return {statement, &sqlite3_finalize};
  }
  /// Advances to the next row; returns false after the last.
  bool Step(const Statement& statement) const {
    const int status = sqlite3_step(statement.get());
    Require(status);
    return status == SQLITE_ROW;
  }
  static std::string Text(const Statement& statement, int column) {
    const void* text = sqlite3_column_blob(statement.get(), column);
    const int bytes = sqlite3_column_bytes(statement.get(), column);
    return text == nullptr
               ? ""
               : std::string(static_cast<const char*>(text), static_cast<std::size_t>(bytes));
  }

  /// Throws for a truncated file. SQLite itself does not report missing pages that a query does not
  /// reach, nor an incomplete last page.
  ///
  /// Source  "Database File Format", sqlite.org: page size at byte 16, page count at byte 28.
  void RequireWhole() const {
    constexpr std::uint64_t kHeadBytes = 100, kLargestPage = 65536;
    BagFile file(file_);
    const std::string head = file.Read(0, std::min(file.size(), kHeadBytes));
    if (std::filesystem::exists(file_.string() + "-wal"))
      return;  // the rest may be in the -wal file
    const auto number = [&](std::size_t at, std::size_t bytes) {
      std::uint64_t value = 0;
      for (std::size_t k = at; k < at + bytes; ++k) {
        value = value << 8 | static_cast<unsigned char>(head.at(k));
      }
      return value;
    };
    const std::uint64_t page = number(16, 2) == 1 ? kLargestPage : number(16, 2);
    const std::uint64_t whole = page * number(28, 4);
    if (file.size() >= whole) return;
    throw BagDamage(
        fmt::format("{}: ends after {} bytes, but its header declares {}; copy the file again, or "
                    "read the available part with --skip-bad-rows",
                    file_.string(), file.size(), whole));
  }

  bool HasTable(const char* name) const {
    const Statement query =
        Prepare("SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?");
    sqlite3_bind_text(query.get(), 1, name, -1, SQLITE_STATIC);
    return Step(query);
  }

  /// Message definitions by type; empty for schema versions before 4.
  std::map<std::string, std::pair<std::string, std::string>> Definitions() const {
    std::map<std::string, std::pair<std::string, std::string>> definitions;
    if (!HasTable("message_definitions")) return definitions;
    const Statement query =
        Prepare("SELECT topic_type, encoding, encoded_message_definition FROM message_definitions");
    while (Step(query)) {
      definitions[ShortTypeName(Text(query, 0))] = {Text(query, 1), Text(query, 2)};
    }
    return definitions;
  }

  bool AskOfTopics() {
    const auto definitions = Definitions();
    const Statement query = Prepare("SELECT id, name, type, serialization_format FROM topics");
    while (Step(query)) {
      BagTopic topic{.name = Text(query, 1),
                     .type = ShortTypeName(Text(query, 2)),
                     .message_encoding = Text(query, 3)};
      if (const auto found = definitions.find(topic.type); found != definitions.end()) {
        topic.schema_encoding = found->second.first;
        topic.definition = found->second.second;
      }
      const BagVisitor::Wish wish = visitor_->Wants(topic);
      topics_[sqlite3_column_int64(query.get(), 0)] = {asked_++, topic.name,
                                                       wish == BagVisitor::Wish::kTake};
      if (wish == BagVisitor::Wish::kEnough) return false;
    }
    return true;
  }

  /// Reads topic by topic, so that SQLite skips the data of unwanted topics.
  bool ShowMessages() const {
    const Statement query =
        Prepare("SELECT timestamp, data, id FROM messages WHERE topic_id = ? ORDER BY id");
    for (const auto& [id, topic] : topics_) {
      if (!topic.wanted) continue;
      Require(sqlite3_reset(query.get()));
      sqlite3_bind_int64(query.get(), 1, id);
      std::optional<std::int64_t> before;
      for (std::int64_t row = 1; Step(query); ++row) {
        // A damaged file may link to a page twice, which would repeat its rows forever.
        const std::int64_t id_of_row = sqlite3_column_int64(query.get(), 2);
        if (before && id_of_row <= *before) Require(SQLITE_CORRUPT);
        before = id_of_row;
        if (!Show(query, topic, row)) return false;
      }
    }
    return true;
  }

  bool Show(const Statement& query, const Topic& topic, std::int64_t row) const {
    const void* data = sqlite3_column_blob(query.get(), 1);
    const int bytes = sqlite3_column_bytes(query.get(), 1);
    if (data == nullptr) Require(sqlite3_errcode(database_.get()));
    std::string_view message(static_cast<const char*>(data), static_cast<std::size_t>(bytes));
    std::string unpacked;
    try {
      if (IsZstdFrame(message)) message = unpacked = UnpackedZstd(message);
    } catch (const BadBytes& bad) {
      throw BagDamage(
          fmt::format("{}: {} message {}: {}; copy the file again, or read the part before with "
                      "--skip-bad-rows",
                      file_.string(), topic.name, row, bad.finding));
    }
    return visitor_->Take(topic.number, {sqlite3_column_int64(query.get(), 0), message});
  }

  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close(handle); }
  };
  std::filesystem::path file_;
  BagVisitor* visitor_;
  std::unique_ptr<sqlite3, Close> database_;
  std::map<std::int64_t, Topic> topics_;
  std::size_t asked_ = 0;
};

}  // namespace

bool ReadSqliteBagFile(const std::filesystem::path& file, BagVisitor* visitor, bool to_the_damage) {
  return SqliteBagReader(file, visitor, to_the_damage).Read();
}

}  // namespace tera
