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

/// Strict reading of YAML. The program asks for each key by name, type and range. A key is a fault
/// if it is unknown, repeated, missing, mistyped, not finite or out of range. All faults of a
/// configuration are reported together, each with file, line, column and key path. The resolved
/// document records every value read, defaults included. It is itself a valid configuration.

namespace tera {

/// Allowed values of a number, with the unit for error messages.
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

/// One mapping of a configuration. Copies refer to the same mapping and cost little.
///
/// Model   A mapping may consist of layers. Overrides such as `--set` are on top, the mapping
///         itself follows, and preset files are at the bottom. The topmost layer that has a key
///         supplies its value. Nested mappings merge by the same rule. A list replaces the whole
///         list of a lower layer. A mapping with integer keys changes single items of a lower list:
///         {2: {rate_hz: 5}}. Reading never throws on bad input. It collects faults and returns
///         some value in range. Config::Finish then throws all faults.
class ConfigMap {
 public:
  // Scalars. A key is required if the function has no parameter `otherwise`.
  double Number(std::string_view key, const Range& range) const;
  double Number(std::string_view key, const Range& range, double otherwise) const;
  /// The number; nullopt if the key is absent.
  std::optional<double> OptionalNumber(std::string_view key, const Range& range) const;
  std::int64_t Integer(std::string_view key, const Range& range) const;
  std::int64_t Integer(std::string_view key, const Range& range, std::int64_t otherwise) const;
  bool Boolean(std::string_view key, bool otherwise) const;
  std::string Text(std::string_view key) const;
  std::string Text(std::string_view key, std::string_view otherwise) const;
  /// A text that must be in `allowed`. Required without `otherwise`.
  std::string Choice(std::string_view key, std::initializer_list<std::string_view> allowed) const;
  std::string Choice(std::string_view key, std::initializer_list<std::string_view> allowed,
                     std::string_view otherwise) const;

  /// Any value as one line of YAML; required.
  std::string Yaml(std::string_view key) const;
  /// Keys of the lowest layer, then the additional keys of each higher layer.
  std::vector<std::string> Keys() const;

  // Lists.
  Vec3 Vector3(std::string_view key, const Range& each) const;
  Vec3 Vector3(std::string_view key, const Range& each, const Vec3& otherwise) const;
  Vec2 Vector2(std::string_view key, const Range& each) const;
  Vec2 Vector2(std::string_view key, const Range& each, const Vec2& otherwise) const;
  /// A list of `min_count` to `max_count` numbers. If min_count is 0, the key may be absent; the
  /// result is then empty.
  std::vector<double> Numbers(std::string_view key, const Range& each, std::size_t min_count,
                              std::size_t max_count) const;
  /// A list of at least `min_rows` rows with `columns` numbers each. If min_rows is 0, the key may
  /// be absent; the result is then empty.
  std::vector<std::vector<double>> NumberRows(std::string_view key, const Range& each,
                                              std::size_t columns, std::size_t min_rows) const;
  std::vector<std::string> Texts(std::string_view key) const;
  /// Items of a required list, each as one line of YAML.
  std::vector<std::string> YamlItems(std::string_view key) const;
  /// The pose that the keys `xyz_m` and `rpy_deg` define; both default to zero.
  Pose PoseXyzRpy() const;

  // Presence and nested mappings.
  bool Has(std::string_view key) const;
  /// True if the key holds a list. For keys that accept a single value or a list.
  bool IsList(std::string_view key) const;
  /// True if the key holds a scalar. For keys that accept a mapping or a word.
  bool IsText(std::string_view key) const;
  /// A required mapping.
  ConfigMap Map(std::string_view key) const;
  /// The mapping at `key`; nullopt if absent.
  std::optional<ConfigMap> OptionalMap(std::string_view key) const;
  /// The mapping at `key`, with the mapping at `upper_key` of `upper` as a layer above it. Either
  /// may be absent; nullopt if both are.
  std::optional<ConfigMap> OptionalMapUnder(std::string_view key, const ConfigMap& upper,
                                            std::string_view upper_key) const;
  /// A required mapping, given inline or as the name of a YAML file. The resolved document holds
  /// the mapping itself, not the file name.
  ConfigMap MapOrFile(std::string_view key) const;
  /// A list of mappings; empty if the key is absent.
  std::vector<ConfigMap> List(std::string_view key) const;
  /// Mappings by name, in the order of Keys(); empty if the key is absent.
  std::vector<std::pair<std::string, ConfigMap>> NamedMaps(std::string_view key) const;
  /// Numbers by name, such as `{boom: 0.1, arm: -0.3}`, in the order of Keys().
  std::vector<std::pair<std::string, double>> NamedNumbers(std::string_view key,
                                                           const Range& each) const;
  /// If `key` exists, adds the preset file that it names as the lowest layer of this mapping. A
  /// preset file may name another preset, which becomes the layer below it.
  void ApplyPreset(std::string_view key) const;

  // Files, which must exist. A relative path is relative to the file in which it is written. A path
  // `tera:...` is relative to DataRoot().
  std::filesystem::path File(std::string_view key) const;
  std::optional<std::filesystem::path> OptionalFile(std::string_view key) const;
  /// Adds a file to Inputs() that a named file refers to, such as a mesh of a URDF.
  void AlsoReads(const std::filesystem::path& file) const;
  /// All files that the configuration has named so far, sorted by name, without duplicates.
  std::vector<InputFile> Inputs() const;

  /// Reports a fault that the caller detects. It is placed at the value of `key`, or at the mapping
  /// if `key` is empty or absent.
  void Fault(std::string_view key, const InputFault& fault) const;
  /// Place of the key as "file:line:column: key.path", for messages after reading.
  std::string Place(std::string_view key = {}) const;

 private:
  friend class Config;
  friend struct internal::ConfigDocument;
  explicit ConfigMap(std::shared_ptr<internal::ConfigNode> node) : node_(std::move(node)) {}

  std::shared_ptr<internal::ConfigNode> node_;
};

}  // namespace tera
