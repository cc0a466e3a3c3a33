#include "physics/link_tree.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <map>

#include "core/config_faults.h"
#include "core/spelling.h"

namespace tera {
namespace {

/// Rounding of inertias written with a few digits may break the triangle inequality this much.
constexpr double kInertiaTolerance = 1e-6;

void CheckInertia(const LinkPart& part) {
  const Vec3 moments =
      Eigen::SelfAdjointEigenSolver<Mat3>(part.link.inertia_B_kgm2, Eigen::EigenvaluesOnly)
          .eigenvalues();  // ascending
  const std::string shown = fmt::format("principal moments {:.4g}, {:.4g}, {:.4g} kg m2",
                                        moments[0], moments[1], moments[2]);
  if (moments[0] <= 0) {
    part.place.Fault("inertia_kgm2", shown + " are not all positive; no body has such an inertia");
  } else if (moments[2] > (moments[0] + moments[1]) * (1 + kInertiaTolerance)) {
    part.place.Fault("inertia_kgm2",
                     shown +
                         " break the triangle inequality (the largest may not exceed the sum "
                         "of the others); no body has such an inertia");
  }
}

/// Index of the joint that carries each link, -1 for roots; faults for bad names.
std::vector<int> ParentJoints(const MachineParts& parts, const std::map<std::string, int>& index) {
  std::vector<int> parent_joint(parts.links.size(), -1);
  std::vector<std::string> known;
  for (const LinkPart& part : parts.links) known.push_back(part.link.name);
  const auto unknown = [&](const std::string& name) {
    return fmt::format("there is no link '{}'{}", name, DidYouMean(name, known));
  };
  for (std::size_t k = 0; k < parts.joints.size(); ++k) {
    const JointPart& part = parts.joints[k];
    if (!index.contains(part.parent)) {
      part.place.Fault("parent", unknown(part.parent));
    }
    if (!index.contains(part.child)) {
      part.place.Fault("child", unknown(part.child));
      continue;
    }
    if (part.parent == part.child) {
      part.place.Fault("child",
                       fmt::format("link '{}' is the parent already; need two links", part.child));
      continue;
    }
    int& joint = parent_joint[index.at(part.child)];
    if (joint >= 0) {
      part.place.Fault("child", fmt::format("link '{}' hangs on joint '{}' already; need one joint "
                                            "for each link",
                                            part.child, parts.joints[joint].joint.name));
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
  config.Fault("joints",
               roots.empty()
                   ? std::string("every link hangs on a joint, so the joints form a loop; need one "
                                 "link without a parent")
                   : fmt::format("links {} have no parent; need joints that connect all links to "
                                 "one root",
                                 fmt::join(roots, ", ")));
  return -1;
}

}  // namespace

void PartPlace::Fault(std::string_view key, const std::string& finding) const {
  if (part.empty()) {
    config.Fault(key, finding);
  } else {
    config.Fault("urdf", fmt::format("{}, {}: {}", part, key, finding));
  }
}

void CheckLink(const LinkPart& part, bool may_be_massless) {
  if (part.link.mass_kg == 0 && may_be_massless) return;
  if (part.link.mass_kg <= 0) {
    part.place.Fault("mass_kg", fmt::format("{} kg; need a positive mass for a link that moves",
                                            part.link.mass_kg));
    return;
  }
  CheckInertia(part);
}

bool OrderIntoTree(const MachineParts& parts, const ConfigMap& config, MachineModel* model) {
  std::map<std::string, int> index;
  for (std::size_t i = 0; i < parts.links.size(); ++i) {
    index.emplace(parts.links[i].link.name, static_cast<int>(i));
  }
  if (parts.links.empty()) {
    config.Fault("links", "there are no links; need at least one");
    return false;
  }
  const std::size_t faults_before = FaultCount(config);
  const std::vector<int> parent_joint = ParentJoints(parts, index);
  if (FaultCount(config) > faults_before) return false;
  const int root = FindRoot(parts, parent_joint, config);
  if (root < 0) return false;

  std::vector<int> place_of(parts.links.size(), -1);  // in model->links
  place_of[root] = 0;
  model->links = {parts.links[root].link};
  CheckLink(parts.links[root], model->fixed_base);
  // Joints in their written order as soon as their parent is there, so that a description with
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
      CheckLink(parts.links[child], joint.type == JointType::kFixed);
      break;
    }
  }
  for (std::size_t i = 0; i < parts.links.size(); ++i) {
    if (place_of[i] >= 0) continue;
    parts.links[i].place.Fault("", fmt::format("link '{}' is not connected to the root '{}'",
                                               parts.links[i].link.name, model->links[0].name));
  }
  return model->links.size() == parts.links.size();
}

}  // namespace tera
