#pragma once

#include <string>

#include "dataset/format/writer.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Writes a recording's ground records (TerrainRecord) to truth/terrain/.
class TerrainLog {
 public:
  /// Keeps references. Changes are relative to the start of the simulation of `ground`.
  TerrainLog(const Scenario& scenario, const Soil& ground, DatasetWriter* writer);

  /// Call after each step; `t_ns` is its end.
  void Write(TimeNs t_ns);
  void Finish();

 private:
  /// Writes all files, with names that end in `when`.
  void WriteAll(const std::string& when);

  const Scenario& scenario_;
  const Soil& ground_;
  DatasetWriter* writer_;
  std::int64_t next_ = 1;  ///< next multiple of the period
};

}  // namespace tera
