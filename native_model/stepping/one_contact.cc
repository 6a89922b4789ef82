// What is done run by run, for the least processor.
#include "native_model/stepping/one_contact.h"

#include "native_model/contact/kinematics.h"
#include "native_model/contact/step_contact.h"

namespace rotorub {

template <class M>
void OneContact<M>::begin(const State& x) {
  now = {};
  if (!exists_) return;
  for (int lane = 0; lane < kLanes; ++lane) {
    double q[kMaxCoordinates], v[kMaxCoordinates];
    read_lane(x, x.q, lane, q);
    read_lane(x, x.v, lane, v);
    set_lasting(lane, rests_on_circle(lane_model(x.m, lane), q, v, 0));
  }
}

// Where the path ends far from where it begins (it passes the middle), the normal is that of the
// place where it leaves the circle.
template <class M>
void OneContact<M>::press_lane(int lane, State& x, const Centre& d, const Centre& w) {
  const ContactParameters& c = *lane_model(x.m, lane).first().contact;
  LastingStep s;
  s.h = x.h;
  s.d = {lanes::get(d.x, lane), lanes::get(d.y, lane)};
  const Eigen::Vector2d path = x.h * Eigen::Vector2d(lanes::get(w.x, lane), lanes::get(w.y, lane));
  if (s.d.dot(s.d + path) < 0.5 * c.clearance * c.clearance) {
    const double share = circle_exit(s.d, path, c.clearance);
    const Eigen::Vector2d e_r = (s.d + std::min(1.0, share) * path).normalized();
    lanes::set(normal_.x, lane, e_r.x());
    lanes::set(normal_.y, lane, e_r.y());
  }
  s.e_r = {lanes::get(normal_.x, lane), lanes::get(normal_.y, lane)};
  s.start = rates_of_lane(x, x.start, lane);
  s.free = rates_of_lane(x, x.free, lane);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) s.admittance(i, j) = lanes::get(response_.admittance[i][j], lane);
  }
  s.clearance = c.clearance;
  s.radius = c.radius;
  s.friction = c.friction;
  const LastingResult r = solve_lasting_contact(s);
  if (r.solutions != 1) x.fail(lane, status_of(r.solutions));
  lanes::set(now.normal, lane, r.normal);
  lanes::set(now.friction, lane, r.friction);
  lanes::set(now.slip_sign, lane,
             r.contact_case == ContactCase::kSlidePositive   ? 1.0
             : r.contact_case == ContactCase::kSlideNegative ? -1.0
                                                             : 0.0);
}

template <class M>
double OneContact<M>::lasting_work(const State& x) const {
  const Eigen::Vector2d impulses{lanes::get(now.normal, 0), lanes::get(now.friction, 0)};
  const Eigen::Vector2d e_r{lanes::get(normal_.x, 0), lanes::get(normal_.y, 0)};
  return rotorub::lasting_work(lane_model(x.m, 0), 0, e_r, impulses, rates_of_lane(x, x.start, 0),
                               rates_of_lane(x, x.after, 0));
}

#define ROTORUB_DEFINE(...)                                                                     \
  template void OneContact<__VA_ARGS__>::begin(const State&);                                   \
  template void OneContact<__VA_ARGS__>::press_lane(int, State&, const Centre&, const Centre&); \
  template double OneContact<__VA_ARGS__>::lasting_work(const State&) const;
ROTORUB_ALL_MODELS(ROTORUB_DEFINE)
#undef ROTORUB_DEFINE

}  // namespace rotorub
