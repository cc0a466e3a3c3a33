#pragma once

#include <tinyxml2.h>

#include <filesystem>
#include <map>
#include <string>

#include "core/config/config.h"

namespace tera {

/// Lines of the parts of a URDF, for messages.
class UrdfLines {
 public:
  explicit UrdfLines(const std::string& file) : file_(file) {}
  void Add(const std::string& kind, const std::string& name, int line) {
    lines_.emplace(kind + " " + name, line);
  }
  /// "joint 'boom' of arm.urdf:12".
  std::string PlaceOf(const std::string& kind, const std::string& name) const;

 private:
  std::string file_;
  std::map<std::string, int> lines_;
};

/// Parses `xml`, the text of `file`, into `document`. Returns false and reports a fault of `urdf`
/// if it is not XML.
bool ParseXml(const ConfigMap& config, const std::filesystem::path& file, const std::string& xml,
              tinyxml2::XMLDocument* document);

/// Lines of the links and joints of a URDF `file`.
UrdfLines LinesOf(const tinyxml2::XMLElement& robot, const std::filesystem::path& file);

}  // namespace tera
