#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/config/config.h"
#include "own_folder.h"
#include "sim/run/generate.h"

// Data of a moment do not depend on the run's remaining length.

namespace tera {
namespace {

namespace fs = std::filesystem;

/// An excavator that digs at once under hydraulic effects, with a sensor of each kind, some of them
/// filtered or delayed.
std::map<std::string, std::string> TablesOf(double duration_s) {
  const Config config = Config::FromText(
      R"(
name: prefix
seed: 3
duration_s: 60
settle_s: 0.2
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}
effects:
  excavator1:
    boom: {actuator_lag: {time_s: 0.1}}
    imu_boom: {filter_delay: {time_constant_s: 0.02}, clock_drift: {drift_ppm: 30}}
    gnss: {latency: {delay_s: 0.1}}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {yaw_deg: 30}
    operator: {type: dig_cycle, reach_m: 4.0}
    rig: {sensors: [
      {name: imu_boom, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.3]},
      {name: gnss, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.8, 0.5, 2.0]},
      {name: camera, preset: tera:config/sensors/rgb_640.yaml, link: upper, xyz_m: [0.8, 0.3, 1.8], width_px: 64, height_px: 48, rate_hz: 5},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0.8, 0.3, 2.0]},
      {name: encoders, preset: tera:config/sensors/encoder.yaml}]}
)",
      "prefix.yaml", {"duration_s=" + std::to_string(duration_s)});
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  const fs::path out = OwnFolder() / ("for_" + std::to_string(duration_s));
  Generate(scenario, config.ResolvedYaml(), {.out = out});
  std::map<std::string, std::string> tables;
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    if (entry.path().extension() != ".csv") continue;
    if (entry.path().filename() == "events.csv") continue;  // events that last end with the run
    std::ifstream stream(entry.path(), std::ios::binary);
    std::stringstream bytes;
    bytes << stream.rdbuf();
    tables[entry.path().lexically_relative(out).generic_string()] = bytes.str();
  }
  return tables;
}

TEST(Prefix, AShortRunIsTheBeginningOfALongOne) {
  const auto short_run = TablesOf(1.2), long_run = TablesOf(2);
  EXPECT_EQ(short_run.size(), 9u);  // commands, three of truth, five sensors
  for (const auto& [name, bytes] : short_run) {
    ASSERT_TRUE(long_run.contains(name)) << name;
    EXPECT_LT(bytes.size(), long_run.at(name).size()) << name;
    EXPECT_TRUE(long_run.at(name).starts_with(bytes)) << name;
  }
  // It includes the final state and the levers from there on: rows from 0 to 1.2 s at 500 Hz.
  for (const char* name : {"truth/excavator1/joints.csv", "excavator1/commands.csv"}) {
    const std::string& table = short_run.at(name);
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 601) << name;
  }
}

}  // namespace
}  // namespace tera
