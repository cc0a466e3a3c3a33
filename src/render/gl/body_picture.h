#pragma once

#include <cstdint>

/// A picture of bodies: of each pixel the index into SceneState::X_WB plus 1 of what it shows.

namespace tera {

inline constexpr std::uint16_t kNoBody = 0;            ///< ground, land around it, sky
inline constexpr std::uint16_t kSoilInFlight = 65535;  ///< a clod, whose motion no body has

}  // namespace tera
