#pragma once

#include <optional>
#include <vector>

#include "core/config/config.h"
#include "core/types/terrain_surface.h"
#include "sim/task/design_surface.h"

namespace tera {

/// Centre line of a trench's floor. Digging proceeds from its first end to the other one.
///
/// Frames  W.
struct TrenchLine {
  Vec2 from_W_m = Vec2::Zero(), to_W_m = Vec2::Zero();
  double width_m = 0;  ///< of the floor
  double depth_m = 0;  ///< of the floor below the ground, at both ends

  double length_m() const { return (to_W_m - from_W_m).norm(); }
  Vec2 Along() const { return (to_W_m - from_W_m).normalized(); }
};

/// Work to be done on the ground.
struct Task {
  DesignSurface design;
  std::optional<TrenchLine> trench;  ///< empty for a pit
  double tolerance_m = 0.05;         ///< tolerance of the floor's height
  double side_m = 0;                 ///< maximum horizontal width of the sides
};

/// Reads a scenario's `task:`, given the ground before the work. The floor contains at least one
/// column. Faults go to `config`; the result is empty if the design has any.
std::optional<Task> ReadTask(const ConfigMap& config, const TerrainSurface& ground);

/// Difference between the ground and a task's design.
struct TaskDeviation {
  double to_cut_m3 = 0;      ///< volume of soil above the design
  double cut_beyond_m3 = 0;  ///< volume of soil missing below the design
  double within = 0;         ///< share of the floor's columns whose height is within the tolerance
  double lowest_m = 0, highest_m = 0, rms_m = 0;  ///< ground minus design, on the floor
};

/// The columns of the ground that belong to a design.
///
/// Model   a column belongs to the design if the design is below the original ground there. It
///         belongs to the floor if it is also at least half a cell inside the floor's edge. Volumes
///         cover all columns of the design, heights only those of the floor.
class TaskColumns {
 public:
  TaskColumns(const Task& task, const TerrainSurface& before);
  /// Whether at least one column belongs to the floor. ReadTask requires it.
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
