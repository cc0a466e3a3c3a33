#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"
#include "core/motion.h"

namespace tera {

/// Reads a model from a mapping or writes it as YAML. A model type M provides one function for both
/// directions: `void Serialize(ModelArchive*, M*)` visits each key of M in YAML order.
///
/// Model   The member's value is the YAML value times `unit`. For example, kDeg converts a key in
///         degrees to a member in radians. An absent key leaves its member unchanged. Faults are
///         reported at the mapping.
/// Source  Drake, common/yaml: one Serialize function for reading and writing.
class ModelArchive {
 public:
  explicit ModelArchive(const ConfigMap& source) : sources_{source} {}
  /// Creates an archive that writes YAML indented by `blanks` spaces.
  explicit ModelArchive(int blanks) : blanks_(blanks) {}
  const std::string& yaml() const { return yaml_; }

  void Visit(std::string_view key, double* value, const Range& range, double unit = 1);
  void Visit(std::string_view key, int* value, const Range& range);
  void Visit(std::string_view key, bool* value);
  void Visit(std::string_view key, Vec3* value, const Range& each, double unit = 1);
  /// A list of any length.
  void Visit(std::string_view key, std::vector<double>* values, const Range& each, double unit = 1);
  void Visit(std::string_view key, std::vector<std::string>* names);
  /// One of `allowed`.
  void Visit(std::string_view key, std::string* choice,
             std::initializer_list<std::string_view> allowed);
  /// An optional file, present if its key exists. A missing file is a fault, and an empty path.
  void Visit(std::string_view key, std::optional<std::filesystem::path>* file);
  /// An optional number, present if its key exists.
  void Visit(std::string_view key, std::optional<double>* value, const Range& range);

  // Required keys.
  void Need(std::string_view key, double* value, const Range& range);
  void Need(std::string_view key, int* value, const Range& range);
  /// One to `most` numbers.
  void Need(std::string_view key, std::vector<double>* values, const Range& each, std::size_t most,
            double unit = 1);

  /// An optional part; it has a value if the key exists.
  template <typename Part>
  void Visit(std::string_view key, std::optional<Part>* part) {
    if (!Enter(key, part->has_value())) return;
    if (!*part) part->emplace();
    Serialize(this, &**part);
    Leave();
  }

  /// Reports `fault` at `key` unless `holds` is true. With an empty `key`, the fault is at the
  /// whole mapping.
  void Check(bool holds, std::string_view key, const InputFault& fault) const;

 private:
  bool reads() const { return !sources_.empty(); }
  const ConfigMap& source() const { return sources_.back(); }
  void Write(std::string_view key, std::string_view value);
  bool Enter(std::string_view key, bool is_written);
  void Leave();

  std::vector<ConfigMap> sources_;  ///< nested mappings being read, innermost last; empty when
                                    ///< writing
  int blanks_ = 0;
  std::string yaml_;
};

template <typename Model>
Model ReadModel(const ConfigMap& config) {
  Model model;
  ModelArchive archive(config);
  Serialize(&archive, &model);
  return model;
}

template <typename Model>
std::string ModelYaml(Model model, int blanks) {
  ModelArchive archive(blanks);
  Serialize(&archive, &model);
  return archive.yaml();
}

}  // namespace tera
