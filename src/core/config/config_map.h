#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/config/input_file.h"
#include "core/error.h"
#include "core/motion.h"

/// Strict YAML. A reader requests each key by name, type and range. Unread, repeated, missing,
/// mistyped, non-finite and out-of-range keys are reported together, each with file:line:column and
/// key path. A resolved document records all values read, including defaults, and is itself
/// readable.

namespace tera {

/// Admissible values of a number, with the unit for messages.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_excluded = false;
  std::string unit;
};

Range Any(std::string unit);
Range Positive(std::string unit);
Range AtLeast(double min, std::string unit);
Range Between(double min, double max, std::string unit);

namespace internal {
struct ConfigDocument;
struct ConfigNode;
}  // namespace internal

/// One mapping of a configuration. The handle is cheap; copies refer to the same mapping.
///
/// Model   A mapping may have several layers: overlays such as `--set`, the mapping itself, and
///         preset files below it. The first layer that has a key supplies its value; nested
///         mappings merge by the same rule. A list replaces a lower list as a whole. A mapping
///         above a list patches items by index: {2: {rate_hz: 5}}. Reading never throws for bad
///         input: it collects faults and returns an in-range value. Config::Finish throws all
///         faults.
class ConfigMap {
 public:
  // Scalars: required without a default, otherwise optional.
  double Number(std::string_view key, const Range& range) const;
  double Number(std::string_view key, const Range& range, double otherwise) const;
  /// The number, if the key exists.
  std::optional<double> OptionalNumber(std::string_view key, const Range& range) const;
  std::int64_t Integer(std::string_view key, const Range& range) const;
  std::int64_t Integer(std::string_view key, const Range& range, std::int64_t otherwise) const;
  bool Boolean(std::string_view key, bool otherwise) const;
  std::string Text(std::string_view key) const;
  std::string Text(std::string_view key, std::string_view otherwise) const;
  /// One of `allowed`; required without a default.
  std::string Choice(std::string_view key, std::initializer_list<std::string_view> allowed) const;
  std::string Choice(std::string_view key, std::initializer_list<std::string_view> allowed,
                     std::string_view otherwise) const;

  /// Any value as YAML on one line; required.
  std::string Yaml(std::string_view key) const;
  /// Keys of the mapping: the keys of the lowest layer, followed by the additions of each layer
  /// above.
  std::vector<std::string> Keys() const;

  // Sequences.
  Vec3 Vector3(std::string_view key, const Range& each) const;
  Vec3 Vector3(std::string_view key, const Range& each, const Vec3& otherwise) const;
  Vec2 Vector2(std::string_view key, const Range& each) const;
  Vec2 Vector2(std::string_view key, const Range& each, const Vec2& otherwise) const;
  /// Between `min_count` and `max_count` numbers. An absent key is an empty list if min_count is 0.
  std::vector<double> Numbers(std::string_view key, const Range& each, std::size_t min_count,
                              std::size_t max_count) const;
  /// At least `min_rows` rows of `columns` numbers. An absent key is an empty list if min_rows is
  /// 0.
  std::vector<std::vector<double>> NumberRows(std::string_view key, const Range& each,
                                              std::size_t columns, std::size_t min_rows) const;
  std::vector<std::string> Texts(std::string_view key) const;
  /// Items of a required list, each as YAML on one line.
  std::vector<std::string> YamlItems(std::string_view key) const;
  /// A pose from `xyz_m` and `rpy_deg`, both defaulting to zero.
  Pose PoseXyzRpy() const;

  // Mappings.
  bool Has(std::string_view key) const;
  /// True if the key exists and holds a list; for keys with one value or several.
  bool IsList(std::string_view key) const;
  /// True if the key exists and holds a scalar; for keys with a mapping or a word.
  bool IsText(std::string_view key) const;
  /// A required mapping.
  ConfigMap Map(std::string_view key) const;
  /// The mapping, if it exists; nullopt means defaults.
  std::optional<ConfigMap> OptionalMap(std::string_view key) const;
  /// The mapping at `key`, overlaid by the mapping at `upper_key` of `upper`, if either exists.
  std::optional<ConfigMap> OptionalMapUnder(std::string_view key, const ConfigMap& upper,
                                            std::string_view upper_key) const;
  /// A required mapping, inline or in a YAML file that the key names. The resolved document holds
  /// the mapping itself.
  ConfigMap MapOrFile(std::string_view key) const;
  /// Mappings in a list; an absent key is an empty list.
  std::vector<ConfigMap> List(std::string_view key) const;
  /// Named mappings in the order of Keys(); an absent key is an empty list.
  std::vector<std::pair<std::string, ConfigMap>> NamedMaps(std::string_view key) const;
  /// Named numbers, `{boom: 0.1, arm: -0.3}`, in the same order.
  std::vector<std::pair<std::string, double>> NamedNumbers(std::string_view key,
                                                           const Range& each) const;
  /// Lays the preset file named by `key` below this mapping's layers, if the key exists. A preset
  /// that the file names lies below the file.
  void ApplyPreset(std::string_view key) const;

  // Files. A relative path is relative to the file that mentions it. `tera:` paths are relative to
  // DataRoot(). The file must exist.
  std::filesystem::path File(std::string_view key) const;
  std::optional<std::filesystem::path> OptionalFile(std::string_view key) const;
  /// Registers a file that a named file refers to, such as a mesh of a URDF.
  void AlsoReads(const std::filesystem::path& file) const;
  /// All files named so far in the whole configuration, without repetition, by name.
  std::vector<InputFile> Inputs() const;

  /// Reports a fault that only the caller detects, at the place of `key`. An empty or absent `key`
  /// reports at the mapping.
  void Fault(std::string_view key, const InputFault& fault) const;
  /// "file:line:column: key.path", for later messages.
  std::string Place(std::string_view key = {}) const;

 private:
  friend class Config;
  friend struct internal::ConfigDocument;
  explicit ConfigMap(std::shared_ptr<internal::ConfigNode> node) : node_(std::move(node)) {}

  std::shared_ptr<internal::ConfigNode> node_;
};

}  // namespace tera
