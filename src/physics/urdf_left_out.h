#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// What a URDF says and ReadMachine leaves out, in words, such as "1 texture, 3 joints' damping and
/// friction"; empty where it takes everything.
std::string LeftOutOf(const std::filesystem::path& urdf);

}  // namespace tera
