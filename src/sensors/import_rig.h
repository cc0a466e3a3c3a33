#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// Turns the rig of a machine written in the TERA paper's own YAML form into a `sensors:` list of
/// TERA's schema, as text.
///
///     Excavator:
///       - {id, type, offset, rotation, sensors: [
///           {id, type, topic, location, noise: [mean, std], offset, rotation}]}
///
/// Frames  there: Unity's axes, x right, y up, z forward, left-handed; `rotation` in degrees about
///         z, then x, then y. Here: x forward, y left, z up. A vector (x, y, z) becomes
///         (z, -x, y), a rotation is conjugated with that map.
/// Model   CHASSIS (also spelt CHASIS) is the link `upper`, which carries the cab; BOOM, ARM and
///         BUCKET are the links of those names. The name of a sensor is the last part of its topic,
///         else its id. `noise` becomes a constant bias of `mean` and white noise of `std` on every
///         axis of every sample, in the unit of each output: rad/s and m/s^2 for an IMU, metres for
///         GPS, metres along the ray for a LIDAR (std only), levels of 255 for an RGB camera (std
///         only); the depth of an RGBD_CAMERA has the noise of its preset.
///         Beside the types of the paper, every other kind of sensor on a link whose samples are
///         rows is known by its name in capitals (INCLINOMETER), without noise: it is as the preset
///         of its name has it.
/// Omits   the machine's own offset and rotation, which belong to the scenario; rates and optics,
///         which the form does not state: they come from the presets named in the output.
///
/// `machine` is the id of one machine and may be empty where the file holds just one. Throws
/// InputError for anything else than this form, and for a mean that a sensor's type cannot have.
std::string ImportRig(const std::filesystem::path& file, const std::string& machine = "");

}  // namespace tera
