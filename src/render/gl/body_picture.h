#pragma once

#include <cstdint>

/// A body image. Each pixel holds 1 plus the index into SceneState::X_WB of the visible body.

namespace tera {

inline constexpr std::uint16_t kNoBody = 0;  ///< ground, surrounding land, sky
/// A clod in the air, which belongs to no body.
inline constexpr std::uint16_t kSoilInFlight = 65535;

}  // namespace tera
