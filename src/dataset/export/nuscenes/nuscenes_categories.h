#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/types/labels.h"

namespace tera {

/// Categories of nuScenes by index. A labelled point stores the index as a byte. The nuScenes tools
/// accept only these names, because they have a fixed colour for each.
///
/// Source  Fong et al. 2022, "Panoptic nuScenes", and the development kit's `color_map.py`.
inline constexpr std::array<std::string_view, 32> kNuScenesCategories = {
    "noise",
    "animal",
    "human.pedestrian.adult",
    "human.pedestrian.child",
    "human.pedestrian.construction_worker",
    "human.pedestrian.personal_mobility",
    "human.pedestrian.police_officer",
    "human.pedestrian.stroller",
    "human.pedestrian.wheelchair",
    "movable_object.barrier",
    "movable_object.debris",
    "movable_object.pushable_pullable",
    "movable_object.trafficcone",
    "static_object.bicycle_rack",
    "vehicle.bicycle",
    "vehicle.bus.bendy",
    "vehicle.bus.rigid",
    "vehicle.car",
    "vehicle.construction",
    "vehicle.emergency.ambulance",
    "vehicle.emergency.police",
    "vehicle.motorcycle",
    "vehicle.trailer",
    "vehicle.truck",
    "flat.driveable_surface",
    "flat.other",
    "flat.sidewalk",
    "flat.terrain",
    "static.manmade",
    "static.other",
    "static.vegetation",
    "vehicle.ego"};

/// Index of "vehicle.ego": the machine that carries the sensors, and its load.
inline constexpr std::uint8_t kNuScenesEgo = 31;

/// Index of the category for a class.
std::uint8_t NuScenesCategoryOf(SemanticClass label);

}  // namespace tera
