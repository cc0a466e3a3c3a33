#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/config/config_map.h"

namespace tera {

/// A configuration file being read.
///
///     Config config = Config::FromFile(path);
///     const Scenario scenario = ReadScenario(config.root());
///     config.Finish();             // throws InputError with every fault
///     const std::string resolved = config.ResolvedYaml();
class Config {
 public:
  /// A file with a mapping `key` that becomes a layer above the mapping `key` of a configuration.
  struct Overlay {
    std::filesystem::path file;
    std::string key;
  };

  /// `overrides` are texts `key.path=value` as in --set; `a.b[2].c=1.5` addresses a list item. If a
  /// key is overridden twice, the last override wins. Overlays rank below overrides; a later
  /// overlay ranks above an earlier one. Throws InputError if a file is unreadable or not YAML, or
  /// if an override or overlay is malformed.
  static Config FromFile(const std::filesystem::path& file,
                         const std::vector<std::string>& overrides = {},
                         const std::vector<Overlay>& overlays = {});
  /// Reads text instead of a file. Messages show `name` as the file. Paths are relative to the
  /// working directory.
  static Config FromText(const std::string& text, const std::string& name,
                         const std::vector<std::string>& overrides = {});

  /// A value for one key that does not come from a file. Messages show `place`.
  struct GivenValue {
    std::string path, yaml, place;
  };
  /// Adds values as a layer above all others except the overrides. If a key occurs twice, the last
  /// value wins. Must be called before any of these keys is read. A path that is not of the form
  /// `a.b[2].c` is a fault.
  void LayOver(const std::vector<GivenValue>& values);
  /// Removes a root key and its values from the resolved document.
  void LeaveOut(const std::string& key);

  /// Redirects the files that ConfigMap::File reads. The resolved document keeps the original
  /// names.
  void Move(std::vector<MovedFiles> moved);
  ConfigMap root() const;
  /// Throws InputError with all faults, including unknown and repeated keys.
  void Finish() const;
  /// YAML with every value read, including defaults and the content of included files.
  std::string ResolvedYaml() const;

 private:
  explicit Config(std::shared_ptr<internal::ConfigDocument> document)
      : document_(std::move(document)) {}
  std::shared_ptr<internal::ConfigDocument> document_;
};

/// Folder that contains assets/, config/ and shaders/. The search order is: the environment
/// variable TERA_DATA_DIR; share/tera next to the bin/ of the running program; the source tree or
/// installation folder of the build.
std::filesystem::path DataRoot();

}  // namespace tera
