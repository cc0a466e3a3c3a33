#pragma once

#include <filesystem>
#include <vector>

#include "soil/soil.h"
#include "soil/soil_view.h"

namespace tera {

/// Writes the ground in cubes as VTK image data (.vti), which ParaView and VTK read: cell data
/// density_kgpm3 (of the soil in a cube), mass_kg, fill, compaction, moisture, loose and soil;
/// field data soil_names; places in metres of W. The file appears under its name when it is
/// complete. Throws InputError where it cannot be written.
///
/// Source  "VTK File Formats", XML ImageData with appended raw data.
void WriteVoxels(const std::filesystem::path& file, const SoilVoxels& voxels,
                 const std::vector<SoilType>& soils);

}  // namespace tera
