#pragma once

#include "dataset/import/import_run.h"

namespace tera {

/// Scans of a real lidar, one of a mapping's `lidars`: packets of a capture or a bag, points of a
/// bag, or a folder of scans. One scan is in memory at a time, and those that are being written.
ImportJob ReadLidar(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);

}  // namespace tera
