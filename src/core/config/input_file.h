#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// An input file that a configuration names and that is not YAML itself.
struct InputFile {
  std::string name;  ///< portable name (PortableName), as resolved documents and recordings store
                     ///< it
  std::filesystem::path path;
};

/// A file named `from`, or a file below it, is read at `to` instead.
struct MovedFiles {
  std::string from;  ///< prefix of a portable name
  std::filesystem::path to;
};

}  // namespace tera
