#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

/// "tera:..." for a file that TERA ships, which has that name on every machine; else its absolute
/// path, without links to folders. A link that is the file itself keeps its name, since files that
/// it names are looked for beside the link.
std::string PortableName(const std::filesystem::path& path);

/// Where the file of that portable name is read. The first of `moved` that concerns it holds.
std::filesystem::path PlaceOfInput(const std::string& name, const std::vector<MovedFiles>& moved);

/// Whether the name is `moved.from` or below it.
bool Concerns(const MovedFiles& moved, const std::string& name);

}  // namespace tera
