#include "sim/joint_trees.h"

#include "dataset/format/recording.h"
#include "sim/end_effector.h"
#include "sim/run/recorded_run.h"

namespace tera {
namespace {

JointTree::Motion MotionOf(JointType type) {
  switch (type) {
    case JointType::kFixed:
      return JointTree::Motion::kNone;
    case JointType::kRevolute:
    case JointType::kContinuous:
      return JointTree::Motion::kTurns;
    case JointType::kPrismatic:
      return JointTree::Motion::kSlides;
  }
  return JointTree::Motion::kNone;
}

}  // namespace

std::vector<JointTree> JointTreesOf(const Scenario& scenario) {
  std::vector<JointTree> trees;
  for (const ScenarioMachine& machine : scenario.machines) {
    const MachineModel& model = machine.placement.model;
    JointTree tree;
    tree.machine = machine.placement.name;
    tree.root = model.links.front().name;
    tree.fixed_base = model.fixed_base;
    for (const Joint& joint : model.joints) {
      tree.joints.push_back({joint.name, model.links[joint.parent].name,
                             model.links[joint.child].name, MotionOf(joint.type), joint.X_PJ,
                             joint.axis_J});
    }
    if (const auto tool = EndEffectorOf(model)) {
      tree.tool = JointTree::Tool{model.links[tool->link].name, tool->X_BT};
    }
    for (const Lever& lever : model.levers) tree.levers.push_back({lever.name, lever.gear >= 0});
    trees.push_back(std::move(tree));
  }
  return trees;
}

std::vector<JointTree> RecordedJointTrees(const std::filesystem::path& recording,
                                          const std::vector<std::string>& moved) {
  if (!Recording(recording).info().simulated) return {};
  return JointTreesOf(LoadRecordedScenario(recording, {}, moved).scenario);
}

}  // namespace tera
