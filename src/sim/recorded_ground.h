#pragma once

#include "dataset/export/ros/ground_squares.h"
#include "dataset/format/dataset_info.h"

namespace tera {

/// Returns a reader for the rasters of a recording's truth/terrain. It reduces them to at most 1024
/// squares along a side. The layer `elevation` is z in W; other layers are unchanged.
ReadGround ReaderOfGround(const DatasetInfo& info);

}  // namespace tera
