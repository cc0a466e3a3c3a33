#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// A file other than YAML that a configuration names as input.
struct InputFile {
  std::string name;            ///< PortableName, as in resolved documents and recordings
  std::filesystem::path path;  ///< location of the file
};

/// Redirects files named `from`, or below it, to `to`.
struct MovedFiles {
  std::string from;  ///< prefix of a portable name
  std::filesystem::path to;
};

}  // namespace tera
