// The derivative R_y of an instantaneous impact, (15)-(19), by central differences of fourth order
// along a direction. For Coulomb's friction the impulses are linear in the rates while the cases of
// the contacts (open, sticking, sliding) stay the same; the differences stay within the case.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "native_model/contact/coupled_law.h"
#include "native_model/model/constraint.h"
#include "native_model/periodic/motion_record.h"

namespace rotorub::periodic {

class ImpactDerivative {
 public:
  // An impact at t (s), with the states of the contacts before it. no_rebound: all restitutions are
  // 0, as at the end of an accumulation. sizes: see FlowDerivative. All must outlive this object.
  ImpactDerivative(const Model& model, double t, const Jump& jump, const ContactStates& before,
                   const Eigen::VectorXd& sizes, bool no_rebound);

  // R_y u for a direction u of 2 nq values, tangent to the surface of the impact and to the
  // constraints of lasting contacts.
  Eigen::VectorXd along(const Eigen::VectorXd& u);

 private:
  Eigen::VectorXd after(const Eigen::VectorXd& y);
  double share_of(const Eigen::VectorXd& u) const;

  const Model* model_;
  double t_;
  const Jump* jump_;
  const Eigen::VectorXd* sizes_;
  Constraint constraint_;
  ContactList<Constraint::Closed> closed_, lasting_;
  ContactList<ImpactLaw> laws_;
};

}  // namespace rotorub::periodic
