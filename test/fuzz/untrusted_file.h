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

/// What all fuzz targets do: they put bytes into a file and let a reader read it.

namespace tera {

/// A folder of this process alone: the one that scripts/fuzz.sh has made in memory, or another.
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

/// An InputError is what a reader answers to input that cannot be read; all else that it throws,
/// and a failed check, ends the process, which is a finding.
inline void Read(const std::function<void()>& reader) {
  try {
    reader();
  } catch (const InputError&) {
  }
}

/// The same, in a file of that name.
inline int ReadAsFile(const std::string& name, const std::uint8_t* data, std::size_t size,
                      const std::function<void(const std::filesystem::path& file)>& reader) {
  Put(name, data, size);
  Read([&] { reader(FuzzFolder() / name); });
  return 0;
}

}  // namespace tera
