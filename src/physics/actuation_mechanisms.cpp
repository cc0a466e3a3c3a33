#include "physics/actuation_mechanisms.h"

namespace tera {

std::span<const Mechanism> ActuationMechanisms() { return {}; }

}  // namespace tera
