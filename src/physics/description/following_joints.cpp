#include "physics/description/following_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/config/spelling.h"
#include "core/units.h"

namespace tera {
namespace {

bool IsLimited(const Joint& joint) {
  return joint.type == JointType::kRevolute || joint.type == JointType::kPrismatic;
}

const JointPart& PartNamed(const MachineParts& parts, const std::string& name) {
  return *std::find_if(parts.joints.begin(), parts.joints.end(),
                       [&](const JointPart& part) { return part.joint.name == name; });
}

/// What `part` follows in the end, or nothing after a fault.
std::optional<Following> FollowingOf(const JointPart& part, const MachineParts& parts,
                                     const MachineModel& model) {
  Following total;
  const JointPart* at = &part;
  for (std::size_t steps = 0; !at->leader.empty(); ++steps) {
    const Following& following = *at->joint.following;
    total.offset += total.ratio * following.offset;
    total.ratio *= following.ratio;
    total.leader = model.JointIndex(at->leader);
    if (total.leader < 0) {
      std::vector<std::string> names;
      for (const Joint& joint : model.joints) names.push_back(joint.name);
      at->place.Fault("mimic",
                      {FaultKind::kNoSuchName, fmt::format("there is no joint '{}'{}", at->leader,
                                                           DidYouMean(at->leader, names))});
      return std::nullopt;
    }
    if (steps == parts.joints.size()) {
      part.place.Fault("mimic", "joints follow each other in a circle; need one that leads");
      return std::nullopt;
    }
    at = &PartNamed(parts, at->leader);
  }
  if (model.joints[total.leader].type == JointType::kFixed) {
    part.place.Fault("mimic", fmt::format("joint '{}' is fixed; need one that moves",
                                          model.joints[total.leader].name));
    return std::nullopt;
  }
  return total;
}

/// The places of the leader at which the follower is within its limits.
struct Span {
  double lower, upper;
};

Span SpanOfLeader(const Joint& follower, const Following& following) {
  const double a = (follower.lower_rad - following.offset) / following.ratio;
  const double b = (follower.upper_rad - following.offset) / following.ratio;
  return {std::min(a, b), std::max(a, b)};
}

std::string LimitsOf(const Joint& joint) {
  const bool slides = joint.type == JointType::kPrismatic;
  const double unit = slides ? 1 : kDeg;
  return fmt::format("{:.4g} to {:.4g} {}", joint.lower_rad / unit, joint.upper_rad / unit,
                     slides ? "m" : "deg");
}

/// Narrows the leader to where the follower is within its limits.
void NarrowLimits(const Joint& follower, const Following& following, const PartPlace& place,
                  MachineModel* model) {
  Joint& leader = model->joints[following.leader];
  if (!IsLimited(follower) || following.ratio == 0) return;
  const Span span = SpanOfLeader(follower, following);
  const bool is_free = !IsLimited(leader);
  const double lower = is_free ? span.lower : std::max(leader.lower_rad, span.lower);
  const double upper = is_free ? span.upper : std::min(leader.upper_rad, span.upper);
  if (lower > upper) {
    place.Fault("mimic", fmt::format("no position of joint '{}' keeps both within their limits; "
                                     "correct limits, multiplier or offset",
                                     leader.name));
    return;
  }
  if (!is_free && lower == leader.lower_rad && upper == leader.upper_rad) return;
  if (is_free) leader.type = JointType::kRevolute;
  leader.lower_rad = lower;
  leader.upper_rad = upper;
  leader.initial_rad = std::clamp(leader.initial_rad, lower, upper);
  model->remarks.push_back(
      fmt::format("joint '{}' moves from {}, which keeps '{}', that follows "
                  "it, within its limits",
                  leader.name, LimitsOf(leader), follower.name));
}

/// Narrows the leader's rates to those at which the follower keeps its own.
void NarrowRates(const Joint& follower, const Following& following, Joint* leader) {
  const double ratio = std::abs(following.ratio), rate = follower.max_rate_positive_radps;
  if (ratio == 0 || rate == 0) return;
  for (double* of : {&leader->max_rate_positive_radps, &leader->max_rate_negative_radps}) {
    *of = std::min(*of, rate / ratio);
  }
}

/// Gives the follower the limits and the place that follow from its leader's.
void SetFollower(const Joint& leader, Joint* follower) {
  const Following& following = *follower->following;
  if (IsLimited(*follower)) {
    const double a = following.At(leader.lower_rad), b = following.At(leader.upper_rad);
    follower->lower_rad = std::min(a, b);
    follower->upper_rad = std::max(a, b);
  }
  follower->initial_rad = following.At(leader.initial_rad);
  follower->max_rate_positive_radps = follower->max_rate_negative_radps = 0;
  follower->max_effort_nm = 0;
}

}  // namespace

void TieFollowers(const MachineParts& parts, MachineModel* model) {
  std::vector<int> followers;
  for (std::size_t j = 0; j < model->joints.size(); ++j) {
    Joint& joint = model->joints[j];
    if (!joint.following) continue;
    joint.following = FollowingOf(PartNamed(parts, joint.name), parts, *model);
    if (joint.following) followers.push_back(static_cast<int>(j));
  }
  for (const int j : followers) {
    const Joint& follower = model->joints[j];
    const Following& following = *follower.following;
    NarrowLimits(follower, following, PartNamed(parts, follower.name).place, model);
    NarrowRates(follower, following, &model->joints[following.leader]);
  }
  for (const int j : followers) {
    Joint& follower = model->joints[j];
    SetFollower(model->joints[follower.following->leader], &follower);
  }
}

}  // namespace tera
