#pragma once

#include <string>

#include "dataset/format/writer.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Writes what a recording keeps of the ground (TerrainRecord) to truth/terrain/.
class TerrainLog {
 public:
  /// Keeps references. Changes count from the start of the simulation whose `ground` it is.
  TerrainLog(const Scenario& scenario, const Soil& ground, DatasetWriter* writer);

  /// After each step, which led to `t_ns`.
  void Write(TimeNs t_ns);
  void Finish();

 private:
  /// All files, their names ending in `when`.
  void WriteAll(const std::string& when);

  const Scenario& scenario_;
  const Soil& ground_;
  DatasetWriter* writer_;
  std::int64_t next_ = 1;  ///< of the multiples of the period
};

}  // namespace tera
