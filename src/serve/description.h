#pragma once

#include "sim/scenario/scenario.h"
#include "tera/v1/simulation.pb.h"

namespace tera {

/// Description of a scenario for a client.
v1::Description Describe(const Scenario& scenario);

}  // namespace tera
