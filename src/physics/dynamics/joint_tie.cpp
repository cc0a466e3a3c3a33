#include "physics/dynamics/joint_tie.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <limits>

namespace tera {

class JointTie::Constraint : public btMultiBodyConstraint {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  Constraint(btMultiBody* body, int link, const Following& following)
      : btMultiBodyConstraint(body, nullptr, link, -1, 1, false, MULTIBODY_CONSTRAINT_GEAR),
        following_(following) {}

  void finalizeMultiDof() override {
    allocateJacobiansMultiDof();
    jacobianA(0)[DofOf(m_linkA)] = 1;
    jacobianA(0)[DofOf(following_.leader)] = -following_.ratio;
    m_numDofsFinalized = m_jacSizeBoth;
  }

  int getIslandIdA() const override { return m_bodyA->getBaseCollider()->getIslandTag(); }
  int getIslandIdB() const override { return getIslandIdA(); }

  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override {
    if (m_numDofsFinalized != m_jacSizeBoth) finalizeMultiDof();
    internalSetAppliedImpulse(0, 0);
    const double wanted = following_.At(m_bodyA->getJointPos(following_.leader));
    const double rate = (wanted - m_bodyA->getJointPos(m_linkA)) / info.m_timeStep;
    const double unlimited = std::numeric_limits<double>::max();
    const btVector3 zero(0, 0, 0);
    btMultiBodySolverConstraint& row = rows.expandNonInitializing();
    row.m_orgConstraint = this;
    row.m_orgDofIndex = 0;
    row.m_contactNormal1 = row.m_contactNormal2 = zero;
    row.m_relpos1CrossNormal = row.m_relpos2CrossNormal = zero;
    row.m_solverBodyIdA = row.m_solverBodyIdB = data.m_fixedBodyId;
    fillMultiBodyConstraint(row, data, jacobianA(0), nullptr, zero, zero, zero, zero, 0, info,
                            -unlimited, unlimited, false, 1, false, rate);
  }

  void debugDraw(btIDebugDraw*) override {}

 private:
  int DofOf(int link) const { return 6 + m_bodyA->getLink(link).m_dofOffset; }

  Following following_;
};

JointTie::JointTie(btMultiBody* body, int bullet_link, const Following& following,
                   btMultiBodyDynamicsWorld* world)
    : constraint_(std::make_unique<Constraint>(body, bullet_link, following)), world_(world) {
  world_->addMultiBodyConstraint(constraint_.get());
  constraint_->finalizeMultiDof();
}

JointTie::~JointTie() {
  if (constraint_) world_->removeMultiBodyConstraint(constraint_.get());
}

JointTie::JointTie(JointTie&&) noexcept = default;

}  // namespace tera
