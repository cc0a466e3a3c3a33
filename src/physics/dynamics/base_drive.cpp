#include "physics/dynamics/base_drive.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <algorithm>

#include "physics/dynamics/bullet_types.h"

namespace tera {
namespace {

enum BaseRow { kForward, kLeft, kYaw, kBaseRowCount };
/// Index of the root's linear velocity in Bullet's velocity vector.
constexpr int kLinear = 3;

}  // namespace

class BaseDrive::Constraint : public btMultiBodyConstraint {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  Constraint(btMultiBody* body, const Vec3& contact_P_m, const Mat3& R_PB)
      : btMultiBodyConstraint(body, nullptr, -1, -1, kBaseRowCount, true,
                              MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR),
        contact_P_m_(contact_P_m),
        R_PB_(R_PB) {}

  void finalizeMultiDof() override {
    allocateJacobiansMultiDof();
    for (int row = 0; row < kBaseRowCount; ++row) {
      std::fill_n(jacobianA(row), 6 + m_bodyA->getNumDofs(), 0.0);
    }
    m_numDofsFinalized = m_jacSizeBoth;
  }

  int getIslandIdA() const override { return m_bodyA->getBaseCollider()->getIslandTag(); }
  int getIslandIdB() const override { return getIslandIdA(); }

  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override {
    if (m_numDofsFinalized != m_jacSizeBoth) finalizeMultiDof();
    const Mat3 R_WP = FromBullet(m_bodyA->getWorldToBaseRot()).transpose();
    const Mat3 R_WB = R_WP * R_PB_;
    const Vec3 arm_W = R_WP * contact_P_m_;
    AimAt(kForward, arm_W.cross(R_WB.col(0)), R_WB.col(0));
    AimAt(kLeft, arm_W.cross(R_WB.col(1)), R_WB.col(1));
    AimAt(kYaw, R_WB.col(2), Vec3::Zero());
    const double dt_s = info.m_timeStep;
    // The target is the velocity at the end of the step, after the rotation of the base.
    const Eigen::Rotation2Dd turn(twist.yaw_radps * dt_s);
    const Vec2 v_mps = turn * Vec2(twist.forward_mps, twist.left_mps);
    AddRow(kForward, v_mps.x(), most.forward_n * dt_s, rows, data, info);
    AddRow(kLeft, v_mps.y(), most.left_n * dt_s, rows, data, info);
    AddRow(kYaw, twist.yaw_radps, most.yaw_nm * dt_s, rows, data, info);
  }

  void debugDraw(btIDebugDraw*) override {}

  PlanarTwist twist;
  BaseEffort most;

 private:
  void AimAt(BaseRow row, const Vec3& angular_W, const Vec3& linear_W) {
    std::copy_n(angular_W.data(), 3, jacobianA(row));
    std::copy_n(linear_W.data(), 3, jacobianA(row) + kLinear);
  }

  void AddRow(BaseRow row, double rate, double impulse, btMultiBodyConstraintArray& rows,
              btMultiBodyJacobianData& data, const btContactSolverInfo& info) {
    internalSetAppliedImpulse(row, 0);
    if (impulse <= 0) return;
    const btVector3 zero(0, 0, 0);
    btMultiBodySolverConstraint& constraint = rows.expandNonInitializing();
    constraint.m_orgConstraint = this;
    constraint.m_orgDofIndex = row;
    constraint.m_contactNormal1 = constraint.m_contactNormal2 = zero;
    constraint.m_relpos1CrossNormal = constraint.m_relpos2CrossNormal = zero;
    constraint.m_solverBodyIdA = constraint.m_solverBodyIdB = data.m_fixedBodyId;
    fillMultiBodyConstraint(constraint, data, jacobianA(row), nullptr, zero, zero, zero, zero, 0,
                            info, -impulse, impulse, false, 1, false, rate);
  }

  Vec3 contact_P_m_;
  Mat3 R_PB_;
};

BaseDrive::BaseDrive(btMultiBody* body, const Vec3& contact_P_m, const Mat3& R_PB,
                     btMultiBodyDynamicsWorld* world)
    : constraint_(std::make_unique<Constraint>(body, contact_P_m, R_PB)), world_(world) {
  world_->addMultiBodyConstraint(constraint_.get());
  constraint_->finalizeMultiDof();
}

BaseDrive::~BaseDrive() {
  if (constraint_) world_->removeMultiBodyConstraint(constraint_.get());
}

BaseDrive::BaseDrive(BaseDrive&&) noexcept = default;

void BaseDrive::SetTarget(const PlanarTwist& twist, const BaseEffort& most) {
  constraint_->twist = twist;
  constraint_->most = most;
}

BaseEffort BaseDrive::Effort(double dt_s) const {
  Constraint& c = *constraint_;
  return {c.getAppliedImpulse(kForward) / dt_s, c.getAppliedImpulse(kLeft) / dt_s,
          c.getAppliedImpulse(kYaw) / dt_s};
}

}  // namespace tera
