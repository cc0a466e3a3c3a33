#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "dataset/export/json_lists.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recording.h"

namespace tera {

/// Tables of nuScenes. A token contains the number of its table.
enum class NuTable : std::uint8_t {
  kCategory,
  kAttribute,
  kVisibility,
  kInstance,
  kSensor,
  kCalibratedSensor,
  kEgoPose,
  kLog,
  kScene,
  kSample,
  kSampleData,
  kSampleAnnotation,
  kMap,
  kLidarseg
};

/// Tokens (identifiers) of rows, with 32 hexadecimal digits. The first digits identify the
/// recording, so rows of several exports can be merged into one table. A token depends only on the
/// position of its row, so a row can refer to a row that is written later.
class NuTokens {
 public:
  explicit NuTokens(const Recording& recording);

  /// Token of row `entry` in list `list` of the table.
  std::string Of(NuTable table, std::size_t list, std::int64_t entry) const;
  /// As Of, but returns an empty text, which means none in nuScenes, unless 0 <= `entry` < `count`.
  std::string IfAny(NuTable table, std::size_t list, std::int64_t entry, std::int64_t count) const;

 private:
  std::string recording_;
};

/// Writes all tables to a folder as NAME.json. Each file is a list of objects and may exceed the
/// memory.
class NuTables {
 public:
  explicit NuTables(const std::filesystem::path& folder);

  void Add(NuTable table, const OrderedJson& row);
  void Commit();

 private:
  std::map<NuTable, CheckedFile> files_;
  std::set<NuTable> begun_;  ///< tables that have at least one row
};

/// In the format of nuScenes: x, y, z of a translation; w, x, y, z of a quaternion with w >= 0.
OrderedJson TranslationJson(const Pose& pose);
OrderedJson RotationJson(const Pose& pose);

}  // namespace tera
