#pragma once

#include <numbers>
#include <utility>

#include "blind/mujoco/cases/effect.h"

namespace tera::blind::mujoco {

inline constexpr double kDegree = std::numbers::pi / 180;

/// Of the joint `axis`. Variables without a channel, but time, are those of the joint.
Effect OfJoint(const std::string& name, std::size_t axis, std::string form,
               std::vector<std::string> variables);
/// Lets `change` act on the joint's drive.
Effect WithDrive(Effect effect, std::size_t axis, std::function<void(DriveForm*)> change);

Effect OfSensor(const std::string& sensor, const std::string& name, std::string form);
/// The joints whose turning a unit on this link feels, the slew besides.
std::vector<std::size_t> JointsUnder(std::size_t link);
/// One of those on boom, arm and bucket, which the joints move.
std::size_t MovingUnit(const Draw& draw);
/// Of an encoder of boom, arm or bucket, and its axis.
std::pair<std::size_t, Effect> OfEncoder(const Draw& draw, const std::string& name,
                                         std::string form);

/// Ground under a track until its bristles are new, for a slip under a share of the machine's
/// weight that the track's thrust is: bristles of the machine's mass times the square of their
/// natural frequency with it, as Shoes has that, hold both tracks.
double RelaxationFor_m(double slip, double thrust_of_weight);

/// The forms that are kept in reserve. Of tracks and outside the library as of joints and sensors.
Effect DrawReservedOfJoint(const std::string& name, std::size_t axis, const Draw& draw);
Effect DrawReservedOfTracks(const std::string& name, const Draw& draw);
Effect DrawReservedOfSensor(const std::string& name, const Draw& draw);
Effect DrawReservedOutside(const Draw& draw);

}  // namespace tera::blind::mujoco
