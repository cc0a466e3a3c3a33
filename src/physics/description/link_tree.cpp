#include "physics/description/link_tree.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/config/config_faults.h"
#include "core/config/spelling.h"
#include "core/units.h"
#include "physics/description/fixed_links.h"

namespace tera {
namespace {

bool IsLimited(const Joint& joint) {
  return joint.type == JointType::kRevolute || joint.type == JointType::kPrismatic;
}

const JointPart& PartNamed(const MachineParts& parts, const std::string& name) {
  return *std::find_if(parts.joints.begin(), parts.joints.end(),
                       [&](const JointPart& part) { return part.joint.name == name; });
}

/// The first leader of the chain that starts at `part`, with ratio and offset; empty after a fault.
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

/// Positions of the leader that keep the follower within its limits.
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

/// Narrows the leader's limits to those that keep the follower within its own.
void NarrowLimits(const Joint& follower, const Following& following, const PartPlace& place,
                  MachineModel* model) {
  Joint& leader = model->joints[following.leader];
  if (!IsLimited(follower)) return;
  if (following.ratio == 0) {
    if (following.offset >= follower.lower_rad && following.offset <= follower.upper_rad) return;
    place.Fault("mimic", {FaultKind::kOutOfRange,
                          fmt::format("a multiplier of 0 holds '{}' at its offset of {:.4g}, which "
                                      "is beyond its limits ({}); correct limits, multiplier or "
                                      "offset",
                                      follower.name, following.offset, LimitsOf(follower))});
    return;
  }
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

/// Narrows the leader's rates to those that keep the follower within its own.
void NarrowRates(const Joint& follower, const Following& following, Joint* leader) {
  const double ratio = std::abs(following.ratio), rate = follower.max_rate_positive_radps;
  if (ratio == 0 || rate == 0) return;
  for (double* of : {&leader->max_rate_positive_radps, &leader->max_rate_negative_radps}) {
    *of = std::min(*of, rate / ratio);
  }
}

/// Sets the follower's limits and position from its leader's.
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

/// Ties following joints to their leaders (`mimic` of a URDF). A chain of followers is tied to its
/// first leader. Reports a leader that is missing, fixed or the joint itself, directly or over a
/// chain. Reports limits that no position of the leader meets.
///
/// Model   q = ratio * q(leader) + offset. Limits and rates of the leader narrow to those that keep
///         its followers within theirs. Its initial position moves there. A remark reports narrowed
///         limits.
/// Omits   Support of the follower by anything except its leader: it has no effort of its own.
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

/// Relative tolerance of the triangle inequality, because files contain rounded inertias.
constexpr double kInertiaTolerance = 1e-6;

void CheckInertia(const LinkPart& part) {
  const Vec3 moments =
      Eigen::SelfAdjointEigenSolver<Mat3>(part.link.inertia_B_kgm2, Eigen::EigenvaluesOnly)
          .eigenvalues();  // in ascending order
  const std::string shown = fmt::format("principal moments {:.4g}, {:.4g}, {:.4g} kg m2",
                                        moments[0], moments[1], moments[2]);
  if (moments[0] <= 0) {
    part.place.Fault(
        "inertia_kgm2",
        {FaultKind::kOutOfRange, shown + " are not all positive; no body has such an inertia"});
  } else if (moments[2] > (moments[0] + moments[1]) * (1 + kInertiaTolerance)) {
    part.place.Fault("inertia_kgm2",
                     shown +
                         " break the triangle inequality (the largest may not exceed the sum "
                         "of the others); no body has such an inertia");
  }
}

/// Index of the joint that carries each link, -1 for roots; reports bad names.
std::vector<int> ParentJoints(const MachineParts& parts, const std::map<std::string, int>& index) {
  std::vector<int> parent_joint(parts.links.size(), -1);
  std::vector<std::string> known;
  for (const LinkPart& part : parts.links) known.push_back(part.link.name);
  const auto unknown = [&](const std::string& name) {
    return fmt::format("there is no link '{}'{}", name, DidYouMean(name, known));
  };
  const auto check = [&](const JointPart& part, std::string_view key, const std::string& name) {
    if (!index.contains(name) && !name.empty())
      part.place.Fault(key, {FaultKind::kNoSuchName, unknown(name)});
  };
  for (std::size_t k = 0; k < parts.joints.size(); ++k) {
    const JointPart& part = parts.joints[k];
    check(part, "parent", part.parent);
    check(part, "child", part.child);
    if (!index.contains(part.child)) continue;
    if (part.parent == part.child) {
      part.place.Fault(
          "child", {FaultKind::kOutOfRange,
                    fmt::format("link '{}' is the parent already; need two links", part.child)});
      continue;
    }
    int& joint = parent_joint[index.at(part.child)];
    if (joint >= 0) {
      part.place.Fault("child",
                       {FaultKind::kRepeated,
                        fmt::format("link '{}' hangs on joint '{}' already; need one joint "
                                    "for each link",
                                    part.child, parts.joints[joint].joint.name)});
      continue;
    }
    joint = static_cast<int>(k);
  }
  return parent_joint;
}

/// The single root, or -1 after a fault.
int FindRoot(const MachineParts& parts, const std::vector<int>& parent_joint,
             const ConfigMap& config) {
  std::vector<std::string> roots;
  int root = -1;
  for (std::size_t i = 0; i < parts.links.size(); ++i) {
    if (parent_joint[i] >= 0) continue;
    root = static_cast<int>(i);
    roots.push_back(parts.links[i].link.name);
  }
  if (roots.size() == 1) return root;
  config.Fault(
      "joints",
      {FaultKind::kMissing,
       roots.empty()
           ? std::string("every link hangs on a joint, so the joints form a loop; need one "
                         "link without a parent")
           : fmt::format("links {} have no parent; need joints that connect all links to "
                         "one root",
                         fmt::join(roots, ", "))});
  return -1;
}

/// Checks mass and inertia as given. A link without mass is valid here.
void CheckMass(const LinkPart& part) {
  if (part.link.mass_kg < 0) {
    part.place.Fault("mass_kg", {FaultKind::kOutOfRange,
                                 fmt::format("{} kg; need a positive mass", part.link.mass_kg)});
  } else if (part.link.mass_kg > 0) {
    CheckInertia(part);
  }
}

/// A root without mass of this name is the ground in some programs and a frame in others.
constexpr char kWorld[] = "world";

/// Gathers masses and reports moving links without mass. `parts[i]` is link i of the model.
void GiveMasses(const std::vector<const LinkPart*>& parts, const ConfigMap& config,
                MachineModel* model) {
  if (model->links[0].name == kWorld && model->links[0].mass_kg == 0 && !config.Has("fixed_base")) {
    parts[0]->place.Fault("name",
                          "a root without mass of that name may stand for the ground or for a "
                          "frame of the machine; say which with `fixed_base: true`, bolted to it, "
                          "or `fixed_base: false`, free");
  }
  GatherFixedMasses(model);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool moves = i == 0 ? !model->fixed_base : model->joints[i - 1].type != JointType::kFixed;
    if (!moves || parts[i]->link.mass_kg < 0 || model->links[i].mass_kg > 0) continue;
    parts[i]->place.Fault(
        "mass_kg",
        {FaultKind::kOutOfRange,
         fmt::format(
             "0 kg, and no link fixed to it has any; a link that moves needs a positive "
             "mass: give one of them an <inertial>{}",
             i == 0 ? ", or the machine `fixed_base: true` if it is bolted to the world" : "")});
  }
}

}  // namespace

void PartPlace::Fault(std::string_view key, const InputFault& fault) const {
  if (part.empty()) {
    config.Fault(key, fault);
  } else {
    config.Fault("urdf", {fault.kind, fault.finding, fmt::format("{}, {}", part, key)});
  }
}

bool OrderIntoTree(const MachineParts& parts, const ConfigMap& config, MachineModel* model) {
  std::map<std::string, int> index;
  for (std::size_t i = 0; i < parts.links.size(); ++i) {
    index.emplace(parts.links[i].link.name, static_cast<int>(i));
  }
  if (parts.links.empty()) {
    config.Fault("links", {FaultKind::kMissing, "there are no links; need at least one"});
    return false;
  }
  const std::size_t faults_before = FaultCount(config);
  const std::vector<int> parent_joint = ParentJoints(parts, index);
  if (FaultCount(config) > faults_before) return false;
  const auto unnamed = [](const JointPart& p) { return p.parent.empty() || p.child.empty(); };
  // already reported
  if (std::any_of(parts.joints.begin(), parts.joints.end(), unnamed)) return false;
  const int root = FindRoot(parts, parent_joint, config);
  if (root < 0) return false;

  std::vector<int> place_of(parts.links.size(), -1);  // index in model->links
  std::vector<const LinkPart*> in_order = {&parts.links[root]};
  place_of[root] = 0;
  model->links = {parts.links[root].link};
  // A joint is placed as soon as its parent is placed, in the written order. A description with
  // parents first keeps its order.
  std::vector<bool> taken(parts.joints.size(), false);
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t k = 0; k < parts.joints.size(); ++k) {
      const JointPart& part = parts.joints[k];
      if (taken[k] || !index.contains(part.parent) || !index.contains(part.child)) continue;
      const int parent = place_of[index.at(part.parent)], child = index.at(part.child);
      if (parent < 0 || parent_joint[child] != static_cast<int>(k)) continue;
      taken[k] = grown = true;
      place_of[child] = static_cast<int>(model->links.size());
      Joint joint = part.joint;
      joint.parent = parent;
      joint.child = place_of[child];
      model->joints.push_back(joint);
      model->links.push_back(parts.links[child].link);
      in_order.push_back(&parts.links[child]);
      break;
    }
  }
  TieFollowers(parts, model);
  for (const LinkPart* part : in_order) CheckMass(*part);
  GiveMasses(in_order, config, model);
  for (std::size_t i = 0; i < parts.links.size(); ++i) {
    if (place_of[i] >= 0) continue;
    parts.links[i].place.Fault("", fmt::format("link '{}' is not connected to the root '{}'",
                                               parts.links[i].link.name, model->links[0].name));
  }
  return model->links.size() == parts.links.size();
}

}  // namespace tera
