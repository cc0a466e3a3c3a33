#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "app/program.h"

namespace tera {

/// A lidar on a mast, tilted, above a slope with a pile, a pit to come, a rock and a truck.
inline const char* const kSite = R"(
name: watch
duration_s: 14
terrain: {size_m: [24, 24], cell_m: 0.2, soil: clay, relief: {amplitude_m: 0.1, wavelength_m: 8},
          piles: [{xy_m: [5, -3], height_m: 0.8, soil: clay}]}
machines:
  - name: mast1
    machine: tera:config/machines/mast.yaml
    start: {xy_m: [-1, 0.5], yaw_deg: 20}
    operator: {type: idle}
    rig:
      sensors:
        - {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: mast, xyz_m: [0, 0, 3],
           rpy_deg: [4, 20, 0], columns: 360, rate_hz: 2, firing_offset_us: [0, 0, 0, 0, 0, 0, 0, 0,
           0, 0, 0, 0, 0, 0, 0, 0]}
obstacles:
  - {name: rock1, preset: tera:config/obstacles/rock.yaml, xy_m: [4, 2], yaw_deg: 30}
  - {name: truck1, preset: tera:config/obstacles/truck.yaml, xy_m: [1, 8], yaw_deg: 8}
)";

class PerceivedSite : public testing::Test {
 protected:
  PerceivedSite() { Write("site.yaml", kSite); }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(scratch_.path() / name) << text;
  }
  std::string Read(const std::string& name) const {
    std::ifstream file(scratch_.path() / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  Outcome Run(const Arguments& arguments) const { return RunTera(arguments, {scratch_.path()}); }
  void Record(const Arguments& more = {}) const {
    Arguments arguments = {"generate", "site.yaml", "--out", "real"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = Run(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  nlohmann::json Diagnosed(const Arguments& more = {}) const {
    Arguments arguments = {"diagnose", "site.yaml", "real", "--out", "why"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.status == 0 ? nlohmann::json::parse(Read("why/diagnosis.json"))
                               : nlohmann::json();
  }

  const ScratchDirectory scratch_;
};

}  // namespace tera
