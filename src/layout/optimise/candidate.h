#pragma once

#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/optimise/search.h"
#include "physics/description/machine.h"

namespace tera {

/// A layout as the vector that a search changes.
///
/// Model   each slot has six numbers from 0 to 1: its position and its roll, pitch and yaw within
///         the bounds of its mount. After all slots come two integers per slot: its type (index
///         plus one; 0: absent) and its mount. A gene without a choice has an extra value with the
///         same meaning, since NSGA-II accepts no fixed genes.
using Genes = std::vector<double>;

/// Lowest and highest value of each gene.
struct GeneBounds {
  Genes low, high;
  std::size_t whole = 0;  ///< number of integers at the end
};
GeneBounds BoundsOf(const LayoutSearch& search);

std::size_t FirstGene(std::size_t slot);
/// Index of a slot's type gene; that of its mount follows.
std::size_t TypeGene(const LayoutSearch& search, std::size_t slot);

/// The sensors that the genes describe.
std::vector<SensorDescription> SensorsOf(const LayoutSearch& search, const Genes& genes);
/// The layout of these sensors and the kept ones.
Layout LayoutOf(const LayoutSearch& search, const Genes& genes,
                const std::vector<SensorDescription>& kept, const MachineModel& model);
/// A rig file: `kept_yaml`, which ends in a list of sensors, followed by the sensors of the genes.
std::string RigYaml(const LayoutSearch& search, const Genes& genes, const std::string& kept_yaml);

}  // namespace tera
