#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// Converts a machine configuration of the TERA paper's software to YAML for this simulator. One
/// machine becomes a rig, `sensors:`. Several machines become the keys `machines:` and `effects:`
/// of a scenario, each with its `start` and rig. The input has this form:
///
///     Excavator:
///       - {id, name, type, offset, rotation, sensors: [
///           {id, type, topic, location, noise: {mean, std_dev}, offset, rotation}]}
///
/// The machines may also be a mapping by id, and may stand under `machines`. `offset` and
/// `rotation` are {x, y, z} or, as in the paper, [x, y, z]. `noise` may be [mean, std].
///
/// Frames  Input: Unity's axes, x right, y up, z forward, left-handed; `rotation` in degrees about
///         z, then x, then y. Output: x forward, y left, z up. A vector (x, y, z) becomes (z, -x,
///         y); a rotation is conjugated with this map.
/// Model   Locations: CHASSIS (also spelt CHASIS) is the link `upper`, which carries the cab. BOOM,
///         ARM and BUCKET are the links of those names. A sensor's name is the last part of its
///         topic, or its id without a topic.
///         Noise: `noise` becomes a constant bias `mean` and white noise `std` on every axis of
///         every sample. Units are those of the output: rad/s and m/s^2 (IMU), metres (GPS), metres
///         along the ray (LIDAR, whose mean becomes the effect range_bias), levels of 255 (RGB
///         camera, std only). The depth of an RGBD_CAMERA keeps the noise of its preset.
///         Other types: every other link-mounted kind with row samples has its name in capitals
///         (INCLINOMETER) and the noise of its preset. All machines become tb235.yaml, the machine
///         of the paper, with levers at rest.
/// Omits   Height, roll and pitch of a machine, which the ground determines; a comment in the
///         output states them. Rates and optics, which the input lacks, come from presets named in
///         the output. Comments of a rig list the settings that belong to the scenario.
///
/// `machine` is the id of one machine, or empty for all. Throws InputError for any other format,
/// and for a mean that the sensor's type does not support.
std::string ImportRig(const std::filesystem::path& file, const std::string& machine = "");

}  // namespace tera
