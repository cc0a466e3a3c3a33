#pragma once

#include <cstdint>

/// A body image: each pixel holds the index into SceneState::X_WB plus 1 of the visible body.

namespace tera {

inline constexpr std::uint16_t kNoBody = 0;            ///< ground, surrounding land, sky
inline constexpr std::uint16_t kSoilInFlight = 65535;  ///< a clod, which belongs to no body

}  // namespace tera
