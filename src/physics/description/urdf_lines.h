#pragma once

#include <tinyxml2.h>

#include <filesystem>
#include <map>
#include <string>

#include "core/config/config.h"

namespace tera {

/// Line numbers of the parts of a URDF, for messages.
class UrdfLines {
 public:
  explicit UrdfLines(const std::string& file) : file_(file) {}
  void Add(const std::string& kind, const std::string& name, int line) {
    lines_.emplace(kind + " " + name, line);
  }
  /// For example "joint 'boom' of arm.urdf:12".
  std::string PlaceOf(const std::string& kind, const std::string& name) const;

 private:
  std::string file_;
  std::map<std::string, int> lines_;
};

/// Parses `xml`, the text of `file`, into `document`. If it is not XML, reports a fault of `urdf`
/// and returns false.
bool ParseXml(const ConfigMap& config, const std::filesystem::path& file, const std::string& xml,
              tinyxml2::XMLDocument* document);

/// Line numbers of the links and joints of a URDF `file`.
UrdfLines LinesOf(const tinyxml2::XMLElement& robot, const std::filesystem::path& file);

}  // namespace tera
