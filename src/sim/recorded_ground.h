#pragma once

#include "dataset/export/ros/ground_squares.h"
#include "dataset/format/dataset_info.h"

namespace tera {

/// Reads rasters of a recording's truth/terrain, in at most 1024 squares along a side: the layer
/// `elevation` as z of W, others as they are.
ReadGround ReaderOfGround(const DatasetInfo& info);

}  // namespace tera
