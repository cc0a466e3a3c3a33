#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyMLCPConstraintSolver.h>

namespace tera {

/// Bullet's solver for machines, extended by soft rows.
///
/// Model   In a row of softness s, the velocity deviates by s times the impulse p: J v = target - s
///         p. With s = 1 / (c dt) and target 0, the row is a damper of coefficient c, evaluated at
///         the end of the step and stable for any c. Bullet's own MLCP solver ignores the softness
///         of single rows.
class SoftRowSolver : public btMultiBodyMLCPConstraintSolver {
 public:
  using btMultiBodyMLCPConstraintSolver::btMultiBodyMLCPConstraintSolver;

  /// Makes a row soft. Call it after fillMultiBodyConstraint.
  static void Soften(btScalar softness, btMultiBodySolverConstraint* row) {
    const btScalar hard = row->m_jacDiagABInv;
    row->m_jacDiagABInv = hard / (1 + softness * hard);
    row->m_rhs *= row->m_jacDiagABInv / hard;
    row->m_cfm = softness * row->m_jacDiagABInv;
  }

 protected:
  void createMLCPFast(const btContactSolverInfo& info) override {
    btMultiBodyMLCPConstraintSolver::createMLCPFast(info);
    for (int i = 0; i < m_multiBodyAllConstraintPtrArray.size(); ++i) {
      const btMultiBodySolverConstraint& row = *m_multiBodyAllConstraintPtrArray[i];
      // Contact rows also have a softness, but only Bullet's other solver uses it.
      if (row.m_orgConstraint == nullptr || row.m_cfm == 0) continue;
      m_multiBodyA.setElem(i, i, m_multiBodyA(i, i) + row.m_cfm / row.m_jacDiagABInv);
    }
  }
};

}  // namespace tera
