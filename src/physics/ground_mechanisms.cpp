#include "physics/ground_mechanisms.h"

namespace tera {

std::span<const Mechanism> GroundMechanisms() { return {}; }

}  // namespace tera
