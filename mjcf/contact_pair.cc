#include "mjcf/contact_pair.h"

namespace rotorub {

ContactPair contact_pair(scene::ContactModel model, double clearance, const FrictionLaw& friction,
                         const SoftContact& soft, const MujocoVersion& target, bool kept_out) {
  const bool is_cone = scene::is_cone(model);
  const bool is_rigid = model == scene::ContactModel::kRigid;
  ContactPair pair;
  // `coulomb`: no friction in MuJoCo's contact, the plugin adds it. Without friction the cone's
  // tangential directions are of no use either.
  pair.condim = is_cone && !friction.none() ? 3 : 1;
  pair.friction = is_cone ? friction.constant("MuJoCo's friction cone") : friction.coefficient;
  pair.soft = soft;
  // In a lasting rub `coulomb` holds the gap at 0 to within the step's error: the contact must
  // not come and go with the sign of a nanometre; nor `cone-coulomb`. `cone` would keep the margin
  // as a gap. `rigid` shows the contact from a little further off, for viewers, and keeps it from
  // MuJoCo's solver by a gap that no depth makes up for.
  const bool is_soft = model == scene::ContactModel::kCoulomb;
  const double reach =
      model == scene::ContactModel::kCone ? 0.0 : (is_soft ? 1e-3 : 1e-2) * clearance;
  pair.gap = is_rigid || kept_out ? 1e3 : 0.0;
  // Before 3.9 a contact is seen below the margin and solved below margin - gap, since then seen
  // below margin + gap and solved below the margin.
  pair.margin = target < MujocoVersion{3, 9, 0} ? reach : reach - pair.gap;
  return pair;
}

}  // namespace rotorub
