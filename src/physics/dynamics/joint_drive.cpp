#include "physics/dynamics/joint_drive.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/dynamics/soft_row_solver.h"

namespace tera {
namespace {

/// A stop enters the equations if the joint could reach it within this many steps at its present
/// rate, or is within the margin. Distant stops would only cost time.
constexpr double kStopReach_steps = 4;
constexpr double kStopReachMargin_rad = 2e-3;

/// Below this rate a motor holds the joint, and one row represents motor and friction. With two
/// equal rows, rounding in the solver would decide which row takes the load.
constexpr double kHeld_radps = 1e-7;

enum JointRow { kMotor, kFriction, kViscous, kLowerStop, kUpperStop, kJointRowCount };

}  // namespace

class JointDrive::Constraint : public btMultiBodyConstraint {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  Constraint(btMultiBody* body, int link)
      : btMultiBodyConstraint(body, nullptr, link, -1, kJointRowCount, true,
                              MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR) {}

  void finalizeMultiDof() override {
    allocateJacobiansMultiDof();
    const int dof = 6 + m_bodyA->getLink(m_linkA).m_dofOffset;
    jacobianA(kMotor)[dof] = 1;
    jacobianA(kFriction)[dof] = 1;
    jacobianA(kViscous)[dof] = 1;
    jacobianA(kLowerStop)[dof] = 1;
    jacobianA(kUpperStop)[dof] = -1;
    m_numDofsFinalized = m_jacSizeBoth;
  }

  int getIslandIdA() const override { return m_bodyA->getBaseCollider()->getIslandTag(); }
  int getIslandIdB() const override { return getIslandIdA(); }

  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override {
    if (m_numDofsFinalized != m_jacSizeBoth) finalizeMultiDof();
    for (int row = 0; row < kJointRowCount; ++row) internalSetAppliedImpulse(row, 0);
    const double dt_s = info.m_timeStep;
    const double q = m_bodyA->getJointPos(m_linkA), qd = m_bodyA->getJointVel(m_linkA);
    double rate = target.rate_radps;
    if (has_stops) rate = std::clamp(rate, (lower - q) / dt_s, (upper - q) / dt_s);
    double up = target.max_positive_nm * dt_s, down = target.max_negative_nm * dt_s;
    const double friction_up = target.friction.against_negative_nm * dt_s;
    const double friction_down = target.friction.against_positive_nm * dt_s;
    const bool motor = up > 0 || down > 0;
    if (motor && std::abs(rate) < kHeld_radps) {
      up += friction_up;
      down += friction_down;
    } else if (target.friction.dry()) {
      AddRow(kFriction, 0, -friction_down, friction_up, rows, data, info);
    }
    const double unlimited = std::numeric_limits<double>::max();
    const double softness = 1 / (target.friction.viscous_nmsprad * dt_s);
    if (std::isfinite(softness)) {
      auto& row = AddRow(kViscous, 0, -unlimited, unlimited, rows, data, info);
      SoftRowSolver::Soften(softness, &row);
    }
    if (motor) AddRow(kMotor, rate, -down, up, rows, data, info);
    if (!has_stops) return;
    const double reach = kStopReach_steps * std::abs(qd) * dt_s + kStopReachMargin_rad;
    if (q - lower < reach) {
      AddRow(kLowerStop, (lower - q) / dt_s, 0, unlimited, rows, data, info);
    }
    if (upper - q < reach) {
      AddRow(kUpperStop, (q - upper) / dt_s, 0, unlimited, rows, data, info);
    }
  }

  void debugDraw(btIDebugDraw*) override {}

  /// The motor's share of the impulse of its row.
  double MotorImpulse(double dt_s) {
    return std::clamp(double{getAppliedImpulse(kMotor)}, -target.max_negative_nm * dt_s,
                      target.max_positive_nm * dt_s);
  }
  double FrictionImpulse(double dt_s) {
    return getAppliedImpulse(kFriction) + getAppliedImpulse(kViscous) + getAppliedImpulse(kMotor) -
           MotorImpulse(dt_s);
  }

  JointTarget target;
  bool has_stops = false;
  double lower = 0, upper = 0;

 private:
  btMultiBodySolverConstraint& AddRow(JointRow row, double rate, double min_impulse,
                                      double max_impulse, btMultiBodyConstraintArray& rows,
                                      btMultiBodyJacobianData& data,
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
    return constraint;
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

void JointDrive::SetTarget(const JointTarget& target) { constraint_->target = target; }

double JointDrive::Effort(double dt_s) const {
  Constraint& c = *constraint_;
  return (c.MotorImpulse(dt_s) + c.getAppliedImpulse(kLowerStop) -
          c.getAppliedImpulse(kUpperStop)) /
         dt_s;
}

double JointDrive::Friction(double dt_s) const { return constraint_->FrictionImpulse(dt_s) / dt_s; }

}  // namespace tera
