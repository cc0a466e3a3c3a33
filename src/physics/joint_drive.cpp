#include "physics/joint_drive.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <algorithm>
#include <limits>

namespace tera {
namespace {

/// A stop takes part in a step when the joint could reach it within this many steps at its present
/// rate, or is this near; elsewhere it would only cost time.
constexpr double kStopReach_steps = 4;
constexpr double kStopReachMargin_rad = 2e-3;

enum Row { kMotor, kLowerStop, kUpperStop, kRowCount };

}  // namespace

class JointDrive::Constraint : public btMultiBodyConstraint {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  Constraint(btMultiBody* body, int link)
      : btMultiBodyConstraint(body, nullptr, link, -1, kRowCount, true,
                              MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR) {}

  void finalizeMultiDof() override {
    allocateJacobiansMultiDof();
    const int dof = 6 + m_bodyA->getLink(m_linkA).m_dofOffset;
    jacobianA(kMotor)[dof] = 1;
    jacobianA(kLowerStop)[dof] = 1;
    jacobianA(kUpperStop)[dof] = -1;
    m_numDofsFinalized = m_jacSizeBoth;
  }

  int getIslandIdA() const override { return m_bodyA->getBaseCollider()->getIslandTag(); }
  int getIslandIdB() const override { return getIslandIdA(); }

  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override {
    if (m_numDofsFinalized != m_jacSizeBoth) finalizeMultiDof();
    for (int row = 0; row < kRowCount; ++row) internalSetAppliedImpulse(row, 0);
    const double dt_s = info.m_timeStep;
    const double q = m_bodyA->getJointPos(m_linkA), qd = m_bodyA->getJointVel(m_linkA);
    double target = target_rate;
    if (has_stops) target = std::clamp(target, (lower - q) / dt_s, (upper - q) / dt_s);
    if (max_effort > 0) {
      const double impulse = max_effort * dt_s;
      AddRow(kMotor, target, -impulse, impulse, rows, data, info);
    }
    if (!has_stops) return;
    const double reach = kStopReach_steps * std::abs(qd) * dt_s + kStopReachMargin_rad;
    const double unlimited = std::numeric_limits<double>::max();
    if (q - lower < reach) {
      AddRow(kLowerStop, (lower - q) / dt_s, 0, unlimited, rows, data, info);
    }
    if (upper - q < reach) {
      AddRow(kUpperStop, (q - upper) / dt_s, 0, unlimited, rows, data, info);
    }
  }

  void debugDraw(btIDebugDraw*) override {}

  double target_rate = 0, max_effort = 0;
  bool has_stops = false;
  double lower = 0, upper = 0;

 private:
  void AddRow(Row row, double rate, double min_impulse, double max_impulse,
              btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
              const btContactSolverInfo& info) {
    const btVector3 zero(0, 0, 0);
    btMultiBodySolverConstraint& constraint = rows.expandNonInitializing();
    constraint.m_orgConstraint = this;
    constraint.m_orgDofIndex = row;
    constraint.m_contactNormal1 = constraint.m_contactNormal2 = zero;
    constraint.m_relpos1CrossNormal = constraint.m_relpos2CrossNormal = zero;
    constraint.m_solverBodyIdA = constraint.m_solverBodyIdB = data.m_fixedBodyId;
    fillMultiBodyConstraint(constraint, data, jacobianA(row), nullptr, zero, zero, zero, zero, 0,
                            info, min_impulse, max_impulse, false, 1, false, rate);
  }
};

JointDrive::JointDrive(btMultiBody* body, int bullet_link, btMultiBodyDynamicsWorld* world)
    : constraint_(std::make_unique<Constraint>(body, bullet_link)), world_(world) {
  world_->addMultiBodyConstraint(constraint_.get());
  constraint_->finalizeMultiDof();
}

JointDrive::~JointDrive() {
  if (constraint_) world_->removeMultiBodyConstraint(constraint_.get());
}

JointDrive::JointDrive(JointDrive&&) noexcept = default;

void JointDrive::SetStops(double lower, double upper) {
  constraint_->has_stops = true;
  constraint_->lower = lower;
  constraint_->upper = upper;
}

void JointDrive::SetTarget(double rate, double max_effort) {
  constraint_->target_rate = rate;
  constraint_->max_effort = max_effort;
}

double JointDrive::Effort(double dt_s) const {
  Constraint& c = *constraint_;
  return (c.getAppliedImpulse(kMotor) + c.getAppliedImpulse(kLowerStop) -
          c.getAppliedImpulse(kUpperStop)) /
         dt_s;
}

}  // namespace tera
