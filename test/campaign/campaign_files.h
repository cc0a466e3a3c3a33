#pragma once

#include <filesystem>
#include <string>

#include "dataset/files/checked_file.h"
#include "own_folder.h"

/// A small campaign of a rover at rest, for tests.

namespace tera {

inline const char* const kRestingRover = R"(name: resting
seed: 5
duration_s: 0.2
settle_s: 0.1
terrain: {size_m: [14, 14], cell_m: 0.1, soils: [dirt, sand], soil: dirt}
machines:
  - name: rover1
    machine: tera:config/machines/warthog.yaml
    operator: {type: idle}
    rig: {sensors: [
      {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: chassis, rate_hz: 100}]}
randomise:
  - {key: environment.sun_elevation_deg, uniform: [10, 60]}
)";

inline const char* const kSoils = R"(name: soils
scenario: resting.yaml
episodes: 4
factors:
  - {key: terrain.soil, levels: [dirt, sand]}
)";

/// Writes the scenario and a campaign to the test's folder. Returns the campaign's file.
inline std::filesystem::path WriteCampaign(const std::string& campaign,
                                           const std::string& scenario = kRestingRover) {
  WriteWholeFile(OwnFolder() / "resting.yaml", scenario);
  WriteWholeFile(OwnFolder() / "campaign.yaml", campaign);
  return OwnFolder() / "campaign.yaml";
}

}  // namespace tera
