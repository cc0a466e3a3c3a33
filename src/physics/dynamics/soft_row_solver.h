#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyMLCPConstraintSolver.h>

namespace tera {

/// Bullet's solver for machines, which also knows rows that yield.
///
/// Model   a row of softness s lets its velocity err by s times its impulse: J v = target - s p.
///         With s = 1 / (c dt) and the target 0 that is a damper of the coefficient c, taken at the
///         end of the step, which is stable however stiff. Bullet's own MLCP solver leaves out the
///         softness of single rows.
class SoftRowSolver : public btMultiBodyMLCPConstraintSolver {
 public:
  using btMultiBodyMLCPConstraintSolver::btMultiBodyMLCPConstraintSolver;

  /// Makes a row soft that fillMultiBodyConstraint has filled.
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
      // Rows of contacts have softness of their own, which the other solver uses.
      if (row.m_orgConstraint == nullptr || row.m_cfm == 0) continue;
      m_multiBodyA.setElem(i, i, m_multiBodyA(i, i) + row.m_cfm / row.m_jacDiagABInv);
    }
  }
};

}  // namespace tera
