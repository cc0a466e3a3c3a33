#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// Turns a configuration of the TERA paper's own project into YAML of TERA's schema: of one machine
/// into a rig, `sensors:`; of several into the keys `machines:` and `effects:` of a scenario, each
/// machine with its `start` and rig.
///
///     Excavator:
///       - {id, name, type, offset, rotation, sensors: [
///           {id, type, topic, location, noise: {mean, std_dev}, offset, rotation}]}
///
/// The machines may also be a mapping by their ids, and stand under `machines`. `offset` and
/// `rotation` are {x, y, z} or, as in the paper, [x, y, z]; `noise` may be [mean, std].
///
/// Frames  there: Unity's axes, x right, y up, z forward, left-handed; `rotation` in degrees about
///         z, then x, then y. Here: x forward, y left, z up. A vector (x, y, z) becomes
///         (z, -x, y), a rotation is conjugated with that map.
/// Model   CHASSIS (also spelt CHASIS) is the link `upper`, which carries the cab; BOOM, ARM and
///         BUCKET are the links of those names. The name of a sensor is the last part of its topic,
///         else its id. `noise` becomes a constant bias of `mean` and white noise of `std` on every
///         axis of every sample, in the unit of each output: rad/s and m/s^2 for an IMU, metres for
///         GPS, metres along the ray for a LIDAR (the mean as the effect range_bias), levels of 255
///         for an RGB camera (std only); the depth of an RGBD_CAMERA has the noise of its preset.
///         Beside the types of the paper, every other kind of sensor on a link whose samples are
///         rows is known by its name in capitals (INCLINOMETER), without noise: it is as the preset
///         of its name has it. Machines are the paper's, tb235.yaml, with levers at rest.
/// Omits   height, roll and pitch of a machine, which the ground gives it: a comment tells them;
///         rates and optics, which the form does not state: they come from the presets named in the
///         output. A rig's comments say what of its machine belongs to the scenario.
///
/// `machine` is the id of one machine, or empty for all. Throws InputError for anything else than
/// this form, and for a mean that a sensor's type cannot have.
std::string ImportRig(const std::filesystem::path& file, const std::string& machine = "");

}  // namespace tera
