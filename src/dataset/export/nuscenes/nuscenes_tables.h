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

/// The tables of nuScenes. The tokens of their rows contain the number.
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

/// Tokens of rows: 32 hexadecimal digits. The first digits identify the recording, so that rows of
/// two exports may share a table. A token depends only on a row's position, so that a row can name
/// the next one in advance.
class NuTokens {
 public:
  explicit NuTokens(const Recording& recording);

  /// Token of row `entry` of list `list` of a table.
  std::string Of(NuTable table, std::size_t list, std::int64_t entry) const;
  /// As Of, but empty (nuScenes' value for none) unless `entry` is from 0 to `count` - 1.
  std::string IfAny(NuTable table, std::size_t list, std::int64_t entry, std::int64_t count) const;

 private:
  std::string recording_;
};

/// Writes all tables as files of a folder, NAME.json, each a list of objects that may be larger
/// than memory.
class NuTables {
 public:
  explicit NuTables(const std::filesystem::path& folder);

  void Add(NuTable table, const OrderedJson& row);
  void Commit();

 private:
  std::map<NuTable, CheckedFile> files_;
  std::set<NuTable> begun_;  ///< tables with rows
};

/// Three numbers, and w, x, y, z with w >= 0, in nuScenes' format.
OrderedJson TranslationJson(const Pose& pose);
OrderedJson RotationJson(const Pose& pose);

}  // namespace tera
