#include "native_model/control/tracking_pd.h"

#include "native_model/control/radial_tracking.h"

namespace rotorub {

Eigen::Vector2d TrackingPd::command(const Measurement& now, const SwitchOn& on, double*) const {
  const auto r = radial_error(now, on, plant_.clearance, settings_.gap_time);
  if (!r) return {0.0, 0.0};
  const double preload = settings_.preload * preload_share(plant_, r->e_r) * r->wanted.share;
  return turned_ahead(
      -(settings_.stiffness * r->error + settings_.damping * r->rate + preload) * r->e_r, *r,
      lead_);
}

}  // namespace rotorub
