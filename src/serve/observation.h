#pragma once

#include <string>
#include <vector>

#include "core/time.h"
#include "sim/scenario/scenario.h"
#include "sim/simulation.h"
#include "tera/v1/simulation.pb.h"

/// A client's requested observations, checked against the scenario, and the observed state.

namespace tera {

/// A grid of ground heights around a machine's root link or its shovel's cutting edge.
struct PatchPlan {
  std::size_t machine = 0;
  int shovel = -1;  ///< -1: around the root link
  int n = 0;        ///< vertices per side
  double resolution_m = 0;
};

/// A sensor with collected samples.
struct SensorPlan {
  std::string machine, sensor;
  bool latest_only = false;
};

struct ObservationPlan {
  std::vector<PatchPlan> patches;
  std::vector<SensorPlan> sensors;
  double bytes = 0;  ///< upper bound of samples and patches in a message
};

/// Throws InputError for absent or repeated machines, shovels and sensors, and for a patch of
/// invalid size. Also throws for samples of more than kLargestSamples_bytes over `duration_s`.
ObservationPlan PlanObservation(const v1::Observe& observe, const Scenario& scenario,
                                double duration_s);

/// Writes time, machines and terrain patches.
void PutState(const WorldState& state, const Scenario& scenario,
              const std::vector<PatchPlan>& patches, v1::Observation* observation);

/// Index of the machine of that name. Throws InputError if it is absent.
std::size_t MachineIndex(const Scenario& scenario, const std::string& name);

}  // namespace tera
