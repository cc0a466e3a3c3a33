#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "core/error.h"

/// Common part of all fuzz targets: writes bytes to a file and lets a reader read it.

namespace tera {

/// A folder of this process alone: in memory by scripts/fuzz.sh, or another.
inline const std::filesystem::path& FuzzFolder() {
  static const std::filesystem::path folder = [] {
    const char* const given = std::getenv("TERA_FUZZ_FOLDER");
    const std::filesystem::path made =
        given != nullptr
            ? given
            : std::filesystem::temp_directory_path() / ("tera_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(made);
    return made;
  }();
  return folder;
}

inline void Put(const std::string& name, const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = FuzzFolder() / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
}

/// A reader answers unreadable input with an InputError. Any other exception, and a failed check,
/// ends the process and is a finding.
inline void Read(const std::function<void()>& reader) {
  try {
    reader();
  } catch (const InputError&) {
  }
}

/// The same with a file of that name.
inline int ReadAsFile(const std::string& name, const std::uint8_t* data, std::size_t size,
                      const std::function<void(const std::filesystem::path& file)>& reader) {
  Put(name, data, size);
  Read([&] { reader(FuzzFolder() / name); });
  return 0;
}

}  // namespace tera
