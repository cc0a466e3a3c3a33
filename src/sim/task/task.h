#pragma once

#include <optional>
#include <vector>

#include "core/config/config.h"
#include "core/types/terrain_surface.h"
#include "sim/task/design_surface.h"

namespace tera {

/// The line of a trench, along the middle of its floor. It is dug from its first end towards the
/// other one.
///
/// Frames  W.
struct TrenchLine {
  Vec2 from_W_m = Vec2::Zero(), to_W_m = Vec2::Zero();
  double width_m = 0;  ///< of its floor
  double depth_m = 0;  ///< below the ground at both ends

  double length_m() const { return (to_W_m - from_W_m).norm(); }
  Vec2 Along() const { return (to_W_m - from_W_m).normalized(); }
};

/// Work to be done on the ground.
struct Task {
  DesignSurface design;
  std::optional<TrenchLine> trench;  ///< nothing for a pit
  double tolerance_m = 0.05;         ///< of the floor's height
  double side_m = 0;                 ///< width of the sides at most, beyond the floor
};

/// Reads a scenario's `task:` on the ground as it is before the work. Its floor has columns. Faults
/// go to `config`; nothing if the design has any.
std::optional<Task> ReadTask(const ConfigMap& config, const TerrainSurface& ground);

/// A ground compared with a task's design.
struct TaskDeviation {
  double to_cut_m3 = 0;      ///< above the design
  double cut_beyond_m3 = 0;  ///< missing below the design
  double within = 0;         ///< share of the floor's columns within the tolerance
  double lowest_m = 0, highest_m = 0, rms_m = 0;  ///< ground minus design on the floor
};

/// The columns of a ground that a design concerns.
///
/// Model   a column belongs to the design where that is below the ground as it was. It belongs to
///         the floor if it is also half a cell or more within the floor's edge. Volumes are over
///         all columns of the design, heights over those of the floor.
class TaskColumns {
 public:
  TaskColumns(const Task& task, const TerrainSurface& before);
  /// Whether any column belongs to the floor, as ReadTask requires.
  bool HasFloor() const;
  TaskDeviation Compare(const TerrainSurface& ground) const;
  /// Calls visit(i, j, design_m) for all columns of the design.
  template <typename Visit>
  void ForEach(Visit visit) const {
    for (const Column& column : columns_) visit(column.i, column.j, column.design_m);
  }

 private:
  struct Column {
    int i, j;
    double design_m;
    bool floor;
  };
  std::vector<Column> columns_;
  double tolerance_m_, cell_m_;
};

}  // namespace tera
