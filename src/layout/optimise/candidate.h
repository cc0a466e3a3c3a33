#pragma once

#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/optimise/search.h"
#include "physics/description/machine.h"

namespace tera {

/// A layout as the numbers that a search changes.
///
/// Model   of each slot six numbers from 0 to 1, its place and its roll, pitch and yaw within the
///         bounds of its mount; then, behind those of all slots, of each slot two whole numbers,
///         its type (one more than its number; 0: it is not there) and its mount. One without a
///         choice goes one higher, which stands for the same, since NSGA-II takes none that is
///         fixed.
using Genes = std::vector<double>;

/// Lowest and highest of each gene.
struct GeneBounds {
  Genes low, high;
  std::size_t whole = 0;  ///< how many at the end are whole numbers
};
GeneBounds BoundsOf(const LayoutSearch& search);

/// Where a slot's genes begin.
std::size_t FirstGene(std::size_t slot);
/// Of its type; that of its mount follows.
std::size_t TypeGene(const LayoutSearch& search, std::size_t slot);

/// The sensors that the genes stand for.
std::vector<SensorDescription> SensorsOf(const LayoutSearch& search, const Genes& genes);
/// The layout of these, with those kept.
Layout LayoutOf(const LayoutSearch& search, const Genes& genes,
                const std::vector<SensorDescription>& kept, const MachineModel& model);
/// A rig file: `kept_yaml`, which ends in a list of sensors, and those of the genes.
std::string RigYaml(const LayoutSearch& search, const Genes& genes, const std::string& kept_yaml);

}  // namespace tera
