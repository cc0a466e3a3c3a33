#pragma once

#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/optimise/search.h"
#include "physics/description/machine.h"

namespace tera {

/// A layout as the vector that the search varies.
///
/// Model   first come six numbers in [0, 1] per slot: position (x, y, z) and roll, pitch, yaw as
///         fractions of the mount's bounds. Then come two integers per slot: the sensor type (index
///         plus one; 0: absent) and the index of the mount. NSGA-II does not accept fixed genes, so
///         an integer without a choice gets an extra value with the same meaning.
using Genes = std::vector<double>;

/// Lower and upper bound of each gene.
struct GeneBounds {
  Genes low, high;
  std::size_t whole = 0;  ///< number of integer genes, at the end
};
GeneBounds BoundsOf(const LayoutSearch& search);

std::size_t FirstGene(std::size_t slot);
/// Index of a slot's type gene. The mount gene follows it.
std::size_t TypeGene(const LayoutSearch& search, std::size_t slot);

/// The sensors that the genes describe.
std::vector<SensorDescription> SensorsOf(const LayoutSearch& search, const Genes& genes);
/// The layout of the kept sensors and those that the genes describe.
Layout LayoutOf(const LayoutSearch& search, const Genes& genes,
                const std::vector<SensorDescription>& kept, const MachineModel& model);
/// Text of a rig file: `kept_yaml`, which ends with a list of sensors, followed by the sensors of
/// the genes.
std::string RigYaml(const LayoutSearch& search, const Genes& genes, const std::string& kept_yaml);

}  // namespace tera
