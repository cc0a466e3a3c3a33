#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// Converts a configuration of the TERA paper's own project to YAML of TERA's schema. One machine
/// becomes a rig, `sensors:`. Several machines become the keys `machines:` and `effects:` of a
/// scenario, each with its `start` and rig.
///
///     Excavator:
///       - {id, name, type, offset, rotation, sensors: [
///           {id, type, topic, location, noise: {mean, std_dev}, offset, rotation}]}
///
/// The machines may also be a mapping by id, and may stand under `machines`. `offset` and
/// `rotation` are {x, y, z} or, as in the paper, [x, y, z]; `noise` may be [mean, std].
///
/// Frames  input: Unity's axes, x right, y up, z forward, left-handed; `rotation` in degrees about
///         z, then x, then y. Output: x forward, y left, z up. A vector (x, y, z) becomes
///         (z, -x, y); a rotation is conjugated with this map.
/// Model   CHASSIS (also spelt CHASIS) is the link `upper`, which carries the cab; BOOM, ARM and
///         BUCKET are the links of those names. A sensor's name is the last part of its topic, or
///         its id without a topic. `noise` becomes a constant bias `mean` and white noise `std` on
///         every axis of every sample. Units are the output's: rad/s and m/s^2 (IMU), metres (GPS),
///         metres along the ray (LIDAR, mean as the effect range_bias), levels of 255 (RGB camera,
///         std only). The depth of an RGBD_CAMERA has its preset's noise. Every other link-mounted
///         kind with row samples has its name in capitals (INCLINOMETER) and its preset's noise.
///         Machines are the paper's, tb235.yaml, with levers at rest.
/// Omits   height, roll and pitch of a machine, which the ground determines; a comment states them.
///         Rates and optics, which the format lacks, come from presets named in the output. A rig's
///         comments list the settings that belong to the scenario.
///
/// `machine` is the id of one machine, or empty for all. Throws InputError for any other format,
/// and for a mean that the sensor's type does not support.
std::string ImportRig(const std::filesystem::path& file, const std::string& machine = "");

}  // namespace tera
