#pragma once

#include <filesystem>
#include <vector>

#include "soil/soil.h"
#include "soil/soil_view.h"

namespace tera {

/// Writes cubes of ground as VTK image data (.vti), for ParaView and VTK. Cell data: density_kgpm3
/// (of the soil in a cube), mass_kg, fill, compaction, moisture, loose, soil. Field data:
/// soil_names. Positions are in metres of W. The file appears under its name when complete. Throws
/// InputError if it cannot be written.
///
/// Source  "VTK File Formats", XML ImageData with appended raw data.
void WriteVoxels(const std::filesystem::path& file, const SoilVoxels& voxels,
                 const std::vector<SoilType>& soils);

}  // namespace tera
