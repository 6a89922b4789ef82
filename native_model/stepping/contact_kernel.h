// The contact in a fixed step, for one run or for many: where the straight path of a step leaves
// the circle, lasting contact goes on or an impact begins. Lasting contact ends the step on the
// circle (contact/step_contact.h): sliding on as in the step before in all lanes at once,
// anything else lane by lane. Impacts are the schemes' own (midpoint_step.h, verlet_step.h).
#pragma once

#include "native_model/contact/kinematics.h"
#include "native_model/contact/step_contact.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/load_kernel.h"

namespace rotorub {

// The circle at which a step's path is stopped.
template <class T>
struct ContactNumbers {
  T clearance{}, radius{}, restitution{};
  FrictionOf<T> friction{};
};

template <class M>
class ContactKernel : public LoadKernel<M> {
  using Base = LoadKernel<M>;

 public:
  using Base::fail;
  using typename Base::Centre;
  using typename Base::Mask;
  using typename Base::T;
  static constexpr int kLanes = Base::kLanes;

  ContactKernel(const M& m, const std::vector<const Model*>& models, double h)
      : Base(m, models, h) {
    contact_ = models.front()->first().contact.has_value();
    if (!contact_) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      const ContactParameters& c = *models[static_cast<std::size_t>(lane)]->first().contact;
      lanes::set(contact.clearance, lane, c.clearance);
      lanes::set(contact.radius, lane, c.radius);
      contact.friction.set(lane, c.friction);
      lanes::set(contact.restitution, lane, c.restitution);
    }
    if (!coupled_) respond();
  }

  ContactNumbers<T> contact;
  // What the last step did.
  T normal_impulse{}, friction_impulse{};  // N s
  T slip_sign{};                           // sliding: +1, -1; 0: free or sticking
  T in_contact{};                          // 1 in lasting contact, else 0
  // Of each lane. Large, and rarely touched: apart from what every step reads.
  std::vector<ImpactList> impacts = std::vector<ImpactList>(kLanes);
  bool any_impact() const { return impacted_; }
  // m^2, |d|^2 as the step ended.
  ROTORUB_INLINE T square_of_relative() const {
    const Centre d = equations::separation(*m_, this->q_.data());
    return d.x * d.x + d.y * d.y;
  }

  // As the base's.
  template <class Action>
  void for_each_kept(Action action) {
    action(in_contact);
    action(slip_sign);
    Base::for_each_kept(action);
  }
  void begin(double t, const double* q, const double* v) requires(kLanes == 1) {
    in_contact = slip_sign = 0.0;
    Base::begin(t, q, v);
  }

 protected:
  using Base::change_, Base::coupled_, Base::free_, Base::h_, Base::iterates_, Base::layout,
      Base::m_, Base::make, Base::solve, Base::start_;
  using typename Base::Coordinates;

  // The step's beginning.
  ROTORUB_INLINE void forget_last() {
    normal_impulse = friction_impulse = T{};
    if (impacted_) forget_impacts();
  }
  ROTORUB_SLOW void forget_impacts() {
    for (ImpactList& list : impacts) list.count = 0;
    impacted_ = false;
  }

  // The contact over the step, where the straight path from `from` with free_ would leave the
  // circle: after_, from free_. collide(lane): the impacts of one lane; lasted(): lasting contact
  // is done.
  template <class Collide, class Lasted>
  ROTORUB_INLINE void touch(const T* from, Collide collide, Lasted done) {
    const T zero{}, lasted = in_contact, outside = go_on(from, done);
    const Mask fresh = (outside > zero) & (lasted == zero);
    if (!lanes::any(fresh)) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(fresh, lane)) collide(lane);
    }
  }

  // Of that what goes on of lasting contact; 1 where the path leaves the circle.
  template <class Lasted>
  ROTORUB_INLINE T go_on(const T* from, Lasted done) {
    const T zero{}, one = lanes::all<T>(1.0), h = lanes::all<T>(h_), c = contact.clearance;
    const Centre d = equations::separation(*m_, from);
    const Centre w = equations::relative(*m_, free_.data());
    const T px = d.x + h * w.x, py = d.y + h * w.y;
    T outside = lanes::select(px * px + py * py > c * c, one, zero);
    if (impact_lasts_) outside = outside * flying_;
    const T lasted = in_contact;
    in_contact = outside * lasted;
    slip_sign = in_contact * slip_sign;
    const Mask rests = (outside > zero) & (lasted > zero);
    if (lanes::any(rests)) {
      lasting_contact(rests, from, d, w);
      done();
    }
    return outside;
  }

  // The step's end: v = after_, q = from + dt after_. A lane with a status stays where it was.
  ROTORUB_INLINE void move(const T* from, const T& dt) {
    const int nq = layout().nq();
    const T* after = after_.data();
    T *q = this->q_.data(), *v = this->v_.data();
    this->check_finite(after);
    if (this->failed_) return move_running(from, dt);
    for (int i = 0; i < nq; ++i) {
      v[i] = after[i];
      q[i] = from[i] + dt * after[i];
    }
  }

  // The columns A^-1 J^T of the contact space and A's admittance J A^-1 J^T.
  ROTORUB_INLINE void respond() {
    const T zero{}, one = lanes::all<T>(1.0);
    for (int j = 0; j < 3; ++j) {
      T* column = response_[j].data();
      for (int i = 0; i < layout().nq(); ++i) column[i] = zero;
      equations::add_contact_load(*m_, j == 0 ? one : zero, j == 1 ? one : zero,
                                  j == 2 ? one : zero, column);
      solve(column);
      const Centre d = equations::relative(*m_, column);
      admittance_.a[0][j] = d.x;
      admittance_.a[1][j] = d.y;
      // A prescribed spin speed does not change.
      admittance_.a[2][j] = equations::turns_at_contact(*m_)
                                ? equations::turning_at_contact(*m_, m_->first(), column)
                                : zero;
      if (layout().spin) admittance_.a[2][j] += column[layout().phi()];
    }
  }

  // to = x + A^-1 J^T of the load (N, F) with the normal e, in the lanes of `on`.
  ROTORUB_INLINE void push(const T* x, T* to, const T& ex, const T& ey, const T& normal,
                           const T& friction, const Mask& on) {
    const T zero{};
    const T N = lanes::select(on, normal, zero), F = lanes::select(on, friction, zero);
    const T px = -ex * N - ey * F, py = -ey * N + ex * F, pz = contact.radius * F;
    const T *cx = response_[0].data(), *cy = response_[1].data(), *cz = response_[2].data();
    const int nq = layout().nq();
    for (int i = 0; i < nq; ++i) to[i] = x[i] + (cx[i] * px + cy[i] * py + cz[i] * pz);
  }

  // Lasting contact in the lanes of `on`, from d at the step's begin: after_ from free_, whatever
  // the iteration needs. Slides on as in the step before where it can, in all lanes at once.
  ROTORUB_INLINE void lasting_contact(const Mask& on, const T* q, const Centre& d, Centre w) {
    if (coupled_) respond();
    last_sign_ = slip_sign;
    const T zero{}, one = lanes::all<T>(1.0);
    const T square = d.x * d.x + d.y * d.y;
    const T inverse = one / lanes::square_root(lanes::select(square > zero, square, one));
    normal_x_ = d.x * inverse;
    normal_y_ = d.y * inverse;
    if (iterates_) this->begin_iteration(lanes::select(on, one, zero));
    for (bool settled = false;;) {
      press(on, d, w);
      push(free_.data(), after_.data(), normal_x_, normal_y_, normal_impulse, friction_impulse, on);
      // Once more after the last round: a lane's end must not depend on how long the others went
      // on.
      if (!iterates_ || settled) break;
      settled = !this->improve(q, after_.data());
      w = equations::relative(*m_, free_.data());
    }
    in_contact = lanes::select(on, lanes::select(normal_impulse > zero, one, zero), in_contact);
  }

  // m/s, of the relative velocity w and the spin, by the normal of the last lasting contact.
  ROTORUB_INLINE T slip_of(const Centre& w, const T& spin) const {
    return normal_x_ * w.y - normal_y_ * w.x + contact.radius * spin;
  }

  // J: of lasting contact's last impulses on the coordinates, from the velocities at both ends.
  double contact_work(const double* start, const double* end) const requires(kLanes == 1) {
    if (!(normal_impulse > 0.0)) return 0.0;
    const Eigen::Vector3d load =
        contact_load({normal_x_, normal_y_}, contact.radius, normal_impulse, friction_impulse);
    const double held =
        layout().spin ? 0.0 : m_->speed;  // the machine that holds the speed works too
    const Eigen::Vector3d rates = 0.5 * (this->lane_rates(start, 0) + this->lane_rates(end, 0));
    return load.dot(rates - Eigen::Vector3d(0.0, 0.0, held));
  }
  // The same of impacts, which know their energy.
  double impact_work(const ImpactList& list) const {
    const Model& m = lane_model(*m_, 0);
    const double held = layout().spin ? 0.0 : m.first().contact->radius * m.speed;
    double work = 0.0;
    for (int i = 0; i < list.count; ++i) {
      const Impact& hit = list.impact[static_cast<std::size_t>(i)];
      work += hit.energy_change - hit.friction_impulse * held;
    }
    return work;
  }

  struct Admittance {
    T a[3][3];
  };
  bool contact_ = false, impacted_ = false;
  bool impact_lasts_ = false;  // in a lane at least
  T flying_{};                 // 0 in those lanes, else 1
  Admittance admittance_{};
  Coordinates after_ = make(*m_);  // velocities at the step's end

 private:
  ROTORUB_INLINE void move_running(const T* from, const T& dt) {
    T *q = this->q_.data(), *v = this->v_.data();
    const Mask moves = this->running() > T{};
    for (int i = 0; i < layout().nq(); ++i) {
      const T& after = after_[static_cast<std::size_t>(i)];
      q[i] = lanes::select(moves, from[i] + dt * after, q[i]);
      v[i] = lanes::select(moves, after, v[i]);
    }
  }

  // Where the path ends far from where it begins (it passes the middle), the normal is that of the
  // place where it leaves the circle.
  void turn_normal(int lane, const Eigen::Vector2d& d, const Eigen::Vector2d& path,
                   double clearance) {
    if (!(d.dot(d + path) < 0.5 * clearance * clearance)) return;
    const double share = circle_exit(d, path, clearance);
    const Eigen::Vector2d e_r = (d + std::min(1.0, share) * path).normalized();
    lanes::set(normal_x_, lane, e_r.x());
    lanes::set(normal_y_, lane, e_r.y());
  }

  // The impulses of lasting_contact for the present free_; see contact/step_contact.h.
  ROTORUB_INLINE void press(const Mask& on, const Centre& d, const Centre& w) {
    const T zero{}, one = lanes::all<T>(1.0), h = lanes::all<T>(h_);
    const T ex = normal_x_, ey = normal_y_;
    const T spin = equations::contact_spin(*m_, free_.data());
    const T r = contact.radius;
    // mu of the slip before the step, as in press_lane.
    const Centre before = equations::relative(*m_, start_.data());
    const T slip_before =
        ex * before.y - ey * before.x + r * equations::contact_spin(*m_, start_.data());
    const T ratio = -contact.friction.at(slip_before) * last_sign_;
    // Response to N with T = ratio N.
    const T lx = -ex - ey * ratio, ly = -ey + ex * ratio, lz = r * ratio;
    const auto& a = admittance_.a;
    const T gx = a[0][0] * lx + a[0][1] * ly + a[0][2] * lz;
    const T gy = a[1][0] * lx + a[1][1] * ly + a[1][2] * lz;
    const T gz = a[2][0] * lx + a[2][1] * ly + a[2][2] * lz;
    const T px = d.x + h * w.x, py = d.y + h * w.y, hx = h * gx, hy = h * gy;
    const T square = hx * hx + hy * hy, along = px * hx + py * hy;
    const T circle = contact.clearance * contact.clearance;
    const T depth = px * px + py * py - circle;
    const T root = along * along - square * depth;
    const T normal = depth / (lanes::square_root(lanes::select(root > zero, root, one)) - along);
    const T slip = ex * (w.y + normal * gy) - ey * (w.x + normal * gx) + r * (spin + normal * gz);
    const T turned = d.x * px + d.y * py;
    const Mask slides = (root > zero) & (along < zero) & (slip * last_sign_ > zero) &
                        (turned >= lanes::all<T>(0.5) * circle);
    normal_impulse = lanes::select(on, normal, normal_impulse);
    friction_impulse = lanes::select(on, ratio * normal, friction_impulse);
    slip_sign = lanes::select(on, last_sign_, slip_sign);
    const T other = lanes::select(on, lanes::select(slides, zero, one), zero);
    if (!lanes::any(other > zero)) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(other, lane) > 0.0) press_lane(lane, d, w);
    }
  }

  ROTORUB_SLOW void press_lane(int lane, const Centre& d, const Centre& w) {
    LastingStep s;
    s.h = h_;
    s.d = {lanes::get(d.x, lane), lanes::get(d.y, lane)};
    const ContactParameters& c = *lane_model(*m_, lane).first().contact;
    turn_normal(lane, s.d, h_ * Eigen::Vector2d(lanes::get(w.x, lane), lanes::get(w.y, lane)),
                c.clearance);
    s.e_r = {lanes::get(normal_x_, lane), lanes::get(normal_y_, lane)};
    s.start = this->lane_rates(start_.data(), lane);
    s.free = this->lane_rates(free_.data(), lane);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) s.admittance(i, j) = lanes::get(admittance_.a[i][j], lane);
    }
    s.clearance = c.clearance;
    s.radius = c.radius;
    s.friction = c.friction;
    const LastingResult r = solve_lasting_contact(s);
    if (r.solutions != 1) fail(lane, status_of(r.solutions));
    lanes::set(normal_impulse, lane, r.normal);
    lanes::set(friction_impulse, lane, r.friction);
    lanes::set(slip_sign, lane,
               r.contact_case == ContactCase::kSlidePositive   ? 1.0
               : r.contact_case == ContactCase::kSlideNegative ? -1.0
                                                               : 0.0);
  }

  Coordinates response_[3] = {make(*m_), make(*m_), make(*m_)};
  T last_sign_{}, normal_x_{}, normal_y_{};
};

}  // namespace rotorub
