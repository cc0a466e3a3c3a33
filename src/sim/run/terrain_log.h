#pragma once

#include <string>

#include "dataset/format/writer.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Writes the ground records of a recording (TerrainRecord) to truth/terrain/.
class TerrainLog {
 public:
  /// Keeps references. Changes are relative to the ground at the start of its simulation.
  TerrainLog(const Scenario& scenario, const Soil& ground, DatasetWriter* writer);

  /// Must be called after each step; `t_ns` is its end.
  void Write(TimeNs t_ns);
  void Finish();

 private:
  /// Writes all files; their names end in `when`.
  void WriteAll(const std::string& when);

  const Scenario& scenario_;
  const Soil& ground_;
  DatasetWriter* writer_;
  std::int64_t next_ = 1;  ///< index of the next record, in periods
};

}  // namespace tera
