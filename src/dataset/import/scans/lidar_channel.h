#pragma once

#include "dataset/import/import_run.h"

namespace tera {

/// Imports the scans of a real lidar, an entry of a mapping's `lidars`: packets of a capture or a
/// bag, points of a bag, or a folder of scans. Memory holds one scan, and the scans that are being
/// written.
ImportJob ReadLidar(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);

}  // namespace tera
