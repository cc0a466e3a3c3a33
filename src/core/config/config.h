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
  /// A file whose one mapping `key` lies over that of a configuration.
  struct Overlay {
    std::filesystem::path file;
    std::string key;
  };

  /// `overrides` are `key.path=value` texts, as given to --set; `a.b[2].c=1.5` addresses items of
  /// lists by index. Of two for one key the later one holds. Overlays lie below the overrides, the
  /// later above the earlier. Throws InputError if a file cannot be read or is not YAML, or an
  /// override or overlay has no such form.
  static Config FromFile(const std::filesystem::path& file,
                         const std::vector<std::string>& overrides = {},
                         const std::vector<Overlay>& overlays = {});
  /// For tests and generated text; `name` stands in messages, paths are relative to the working
  /// directory.
  static Config FromText(const std::string& text, const std::string& name,
                         const std::vector<std::string>& overrides = {});

  /// A value for one key that someone else than the file gives; `place` stands in messages.
  struct GivenValue {
    std::string path, yaml, place;
  };
  /// Lays values over all but the overrides, of two for one key the later one above. Before any
  /// of these keys is read. A path of another form than `a.b[2].c` is a fault.
  void LayOver(const std::vector<GivenValue>& values);
  /// Leaves out of the resolved document what was read at a key of the root.
  void LeaveOut(const std::string& key);

  /// Files that File then reads elsewhere; the resolved document names them as they were.
  void Move(std::vector<MovedFiles> moved);
  ConfigMap root() const;
  /// Throws InputError listing every fault, unknown and repeated keys included.
  void Finish() const;
  /// Everything that was read, with defaults and included files in place.
  std::string ResolvedYaml() const;

 private:
  explicit Config(std::shared_ptr<internal::ConfigDocument> document)
      : document_(std::move(document)) {}
  std::shared_ptr<internal::ConfigDocument> document_;
};

/// Where assets/, config/ and shaders/ are: the environment variable TERA_DATA_DIR, else share/tera
/// beside the bin/ that this program runs from, else the source tree or the installation that this
/// library was built for.
std::filesystem::path DataRoot();

}  // namespace tera
