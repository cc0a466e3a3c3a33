#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dataset/format/epoch.h"

namespace tera {

/// An input file of a recording, with its digest. scenario.yaml is not among the inputs.
struct RecordedInput {
  std::string name;  ///< PortableName
  std::int64_t bytes = 0;
  std::string sha256;  ///< 64 hexadecimal digits
  std::string place;   ///< location for messages, such as "run/dataset.yaml:9:5: inputs[0]"; empty
                       ///< for a new input
};

/// Entries of dataset.yaml other than channels.
struct DatasetInfo {
  std::string scenario_name;
  bool simulated = true;
  std::uint64_t seed = 0;
  double duration_s = 0;
  std::optional<RecordingEpoch> epoch;  ///< absent for a simulation
  double origin_lat_deg = 0, origin_lon_deg = 0, origin_height_m = 0;
  std::string resolved_scenario_yaml;  ///< written to scenario.yaml
  struct Instance {
    std::uint16_t id;
    std::string name;
    std::string label;
    std::uint16_t parent = 0;  ///< instance of the object that contains this part; 0 for none
  };
  std::vector<Instance> instances;
  std::vector<RecordedInput> inputs;
};

}  // namespace tera
