#pragma once

#include <numbers>
#include <utility>

#include "blind/mujoco/cases/effect.h"

namespace tera::blind::mujoco {

inline constexpr double kDegree = std::numbers::pi / 180;

/// An effect of joint `axis`. Variables without a channel are the joint's, except time.
Effect OfJoint(const std::string& name, std::size_t axis, std::string form,
               std::vector<std::string> variables);
/// Applies `change` to the joint's drive.
Effect WithDrive(Effect effect, std::size_t axis, std::function<void(DriveForm*)> change);

Effect OfSensor(const std::string& sensor, const std::string& name, std::string form);
/// Joints whose motion a unit on this link senses, without the slew.
std::vector<std::size_t> JointsUnder(std::size_t link);
/// A unit on boom, arm or bucket, which joints move.
std::size_t MovingUnit(const Draw& draw);
/// An effect of an encoder on boom, arm or bucket, and its axis.
std::pair<std::size_t, Effect> OfEncoder(const Draw& draw, const std::string& name,
                                         std::string form);

/// Length of ground after which a bristle is new, for the given slip at a track thrust given as a
/// share of the machine's weight. As in Shoes, the stiffness of both tracks' bristles is the
/// machine's mass times their natural frequency squared.
double RelaxationFor_m(double slip, double thrust_of_weight);

/// The reserved forms, for tracks and outside the library as for joints and sensors.
Effect DrawReservedOfJoint(const std::string& name, std::size_t axis, const Draw& draw);
Effect DrawReservedOfTracks(const std::string& name, const Draw& draw);
Effect DrawReservedOfSensor(const std::string& name, const Draw& draw);
Effect DrawReservedOutside(const Draw& draw);

}  // namespace tera::blind::mujoco
