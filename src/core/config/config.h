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
  /// A file whose mapping `key` overlays the mapping `key` of a configuration.
  struct Overlay {
    std::filesystem::path file;
    std::string key;
  };

  /// `overrides` are `key.path=value` texts as in --set; `a.b[2].c=1.5` addresses list items by
  /// index. The last override of a key wins. Overlays rank below the overrides; later overlays rank
  /// above earlier overlays. Throws InputError if a file is unreadable or no YAML, or if an
  /// override or overlay is malformed.
  static Config FromFile(const std::filesystem::path& file,
                         const std::vector<std::string>& overrides = {},
                         const std::vector<Overlay>& overlays = {});
  /// For tests and generated text. Messages show `name`; paths are relative to the working
  /// directory.
  static Config FromText(const std::string& text, const std::string& name,
                         const std::vector<std::string>& overrides = {});

  /// A value for one key from outside the file. Messages show `place`.
  struct GivenValue {
    std::string path, yaml, place;
  };
  /// Lays values over all layers except the overrides; the last value of a key wins. Call this
  /// function before any read of these keys. A path that does not have the form `a.b[2].c` is a
  /// fault.
  void LayOver(const std::vector<GivenValue>& values);
  /// Removes the values read at a root key from the resolved document.
  void LeaveOut(const std::string& key);

  /// Redirects files that File reads; the resolved document keeps their original names.
  void Move(std::vector<MovedFiles> moved);
  ConfigMap root() const;
  /// Throws InputError with every fault, including unknown and repeated keys.
  void Finish() const;
  /// All values read, with defaults and included files resolved.
  std::string ResolvedYaml() const;

 private:
  explicit Config(std::shared_ptr<internal::ConfigDocument> document)
      : document_(std::move(document)) {}
  std::shared_ptr<internal::ConfigDocument> document_;
};

/// Folder that holds assets/, config/ and shaders/. The order of search is: environment variable
/// TERA_DATA_DIR; share/tera next to the bin/ of the running program; source tree or installation
/// of the library's build.
std::filesystem::path DataRoot();

}  // namespace tera
