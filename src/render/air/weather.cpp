#include "render/air/weather.h"

#include <cmath>

namespace tera {

Vec2 Wind::towards_W() const { return {-std::sin(from_rad), -std::cos(from_rad)}; }

}  // namespace tera
