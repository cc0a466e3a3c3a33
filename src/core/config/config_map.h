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

/// Strict YAML. A reader asks for each key by name, type and range; whatever is then left over,
/// repeated, missing, mistyped, non-finite or out of range is reported, all at once, with
/// file:line:column and key path. Everything that was read, defaults included, is recorded in a
/// resolved document that can be read again.

namespace tera {

/// Admissible values of a number, with the unit that messages print.
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

/// One mapping of a configuration being read. A cheap handle; copies are the same mapping.
///
/// Model   A mapping may have several layers (overlays such as `--set`, the mapping itself, preset
///         files below it). A key is taken from the first layer that has it; nested mappings merge
///         by the same rule. A list is replaced as a whole, but for a mapping above it, whose keys
///         are indices of items: {2: {rate_hz: 5}}. Reading never throws for bad input: faults are
///         collected, a harmless value is returned, and Config::Finish throws them all.
class ConfigMap {
 public:
  // Scalars: required without a default, else optional.
  double Number(std::string_view key, const Range& range) const;
  double Number(std::string_view key, const Range& range, double otherwise) const;
  /// The number if the key is there.
  std::optional<double> OptionalNumber(std::string_view key, const Range& range) const;
  std::int64_t Integer(std::string_view key, const Range& range) const;
  std::int64_t Integer(std::string_view key, const Range& range, std::int64_t otherwise) const;
  bool Boolean(std::string_view key, bool otherwise) const;
  std::string Text(std::string_view key) const;
  std::string Text(std::string_view key, std::string_view otherwise) const;
  /// One of `allowed`; without a default, required.
  std::string Choice(std::string_view key, std::initializer_list<std::string_view> allowed) const;
  std::string Choice(std::string_view key, std::initializer_list<std::string_view> allowed,
                     std::string_view otherwise) const;

  /// The value as YAML on one line, whatever it is; required.
  std::string Yaml(std::string_view key) const;
  /// Keys of the mapping: those of the lowest layer, then what each layer above it adds.
  std::vector<std::string> Keys() const;

  // Sequences.
  Vec3 Vector3(std::string_view key, const Range& each) const;
  Vec3 Vector3(std::string_view key, const Range& each, const Vec3& otherwise) const;
  Vec2 Vector2(std::string_view key, const Range& each) const;
  Vec2 Vector2(std::string_view key, const Range& each, const Vec2& otherwise) const;
  /// Numbers, at least `min_count` and at most `max_count`; an absent key is an empty list when
  /// min_count is 0.
  std::vector<double> Numbers(std::string_view key, const Range& each, std::size_t min_count,
                              std::size_t max_count) const;
  /// Rows of `columns` numbers each, at least `min_rows`; an absent key is an empty list when
  /// min_rows is 0.
  std::vector<std::vector<double>> NumberRows(std::string_view key, const Range& each,
                                              std::size_t columns, std::size_t min_rows) const;
  std::vector<std::string> Texts(std::string_view key) const;
  /// Items of a required list, each as YAML on one line.
  std::vector<std::string> YamlItems(std::string_view key) const;
  /// A pose from `xyz_m` and `rpy_deg`, both defaulting to zero.
  Pose PoseXyzRpy() const;

  // Mappings.
  bool Has(std::string_view key) const;
  /// The key is there and holds a list, for keys that take one value or several.
  bool IsList(std::string_view key) const;
  /// The key is there and holds a scalar, for keys that take a mapping or a word.
  bool IsText(std::string_view key) const;
  /// A required mapping.
  ConfigMap Map(std::string_view key) const;
  /// A mapping if it is there. With `std::nullopt` the caller uses its defaults.
  std::optional<ConfigMap> OptionalMap(std::string_view key) const;
  /// The mapping at `key` with that at `upper_key` of `upper` laid over it, if either is there.
  std::optional<ConfigMap> OptionalMapUnder(std::string_view key, const ConfigMap& upper,
                                            std::string_view upper_key) const;
  /// A required mapping that is either written in place or names a YAML file holding it. The
  /// resolved document holds the mapping itself.
  ConfigMap MapOrFile(std::string_view key) const;
  /// Mappings in a list; an absent key is an empty list.
  std::vector<ConfigMap> List(std::string_view key) const;
  /// Named mappings in the order of the lowest layer, then what each layer above it adds; an absent
  /// key is an empty list.
  std::vector<std::pair<std::string, ConfigMap>> NamedMaps(std::string_view key) const;
  /// Named numbers, `{boom: 0.1, arm: -0.3}`, in the same order.
  std::vector<std::pair<std::string, double>> NamedNumbers(std::string_view key,
                                                           const Range& each) const;
  /// Puts the mapping in the file named by `key`, if the key is there, below this mapping's layers,
  /// and below that the preset which that file names in its turn.
  void ApplyPreset(std::string_view key) const;

  // Files. A relative path is relative to the file that mentions it; `tera:` paths are relative to
  // DataRoot(). The file must exist.
  std::filesystem::path File(std::string_view key) const;
  std::optional<std::filesystem::path> OptionalFile(std::string_view key) const;
  /// Tells of a file that one of those names in its turn, as a URDF its meshes.
  void AlsoReads(const std::filesystem::path& file) const;
  /// The files named so far in the whole configuration, each once, by their names.
  std::vector<InputFile> Inputs() const;

  /// Reports a fault that only the caller can see, at the place of `key` (or of the mapping itself
  /// where `key` is empty or absent).
  void Fault(std::string_view key, const InputFault& fault) const;
  /// "file:line:column: key.path", for messages made later.
  std::string Place(std::string_view key = {}) const;

 private:
  friend class Config;
  friend struct internal::ConfigDocument;
  explicit ConfigMap(std::shared_ptr<internal::ConfigNode> node) : node_(std::move(node)) {}

  std::shared_ptr<internal::ConfigNode> node_;
};

}  // namespace tera
