#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// What a URDF shows or collides with and ReadMachine leaves out, in words, such as "3 visuals that
/// are no meshes and 1 collision mesh"; empty where it takes everything.
std::string LeftOutOf(const std::filesystem::path& urdf);

}  // namespace tera
