#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// A file besides the YAML ones that something is read from, as what a configuration names.
struct InputFile {
  std::string name;            ///< as resolved documents and recordings name it: PortableName
  std::filesystem::path path;  ///< where it is read
};

/// Files named `from`, or below it, that are read at `to` instead, or below that.
struct MovedFiles {
  std::string from;  ///< as in a portable name
  std::filesystem::path to;
};

}  // namespace tera
