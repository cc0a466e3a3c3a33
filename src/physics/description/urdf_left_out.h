#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// Textures and safety controllers of a URDF, which ReadMachine leaves out, in words such as
/// "1 texture, 3 safety controllers"; empty where it has none.
std::string LeftOutOf(const std::filesystem::path& urdf);

}  // namespace tera
