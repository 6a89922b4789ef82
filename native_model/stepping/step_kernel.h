// What the fixed steps have in common: the velocity change that all loads give about one instant,
//
//   M(q) (v+ - v-) = h F(q, (v- + v+)/2, t) + J^T p,
//
// p the contact's impulse, for one run (M = Model) or for many (M = LaneModel). With A = M + h/2 D
// (velocity_matrix.h) the linear part is solved at once, v+ = v- + A^-1 (h F(q, v-) + J^T p); what
// depends on velocities beyond that (free spin with gyroscopics or unbalance, a motor's curve, coils)
// is iterated. What a model lacks costs nothing. All inline: whoever calls it chooses the
// instruction set.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "native_model/bearing/actuator_axes.h"
#include "native_model/contact/lasting_contact.h"
#include "native_model/dynamics/equations.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/lane_model.h"
#include "native_model/stepping/stepped_loads.h"
#include "native_model/stepping/velocity_matrix.h"
#include "native_model/system/actuation.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// The circle at which a step's path is stopped.
template <class T>
struct ContactNumbers {
  T clearance{}, radius{}, friction{}, restitution{};
};

template <class M>
class StepKernel {
 public:
  using T = typename M::Scalar;
  using Mask = lanes::Mask<T>;
  static constexpr int kLanes = lanes::kWidth<T>;
  using Centre = equations::Pair<T>;

  // `models`: those of the lanes, all of the same structure; they and `m` must outlive this.
  StepKernel(const M& m, const std::vector<const Model*>& models, double h)
      : m_(&m), h_(h), layout_(m.layout), matrix_(models, h), loads_(models, h) {
    const Model& first = *models.front();
    const auto nq = static_cast<std::size_t>(layout_.nq());
    for (auto* x : {&q_, &v_, &start_, &free_, &after_, &f_, &change_}) x->assign(nq, T{});
    contact_ = first.contact.has_value();
    coupled_ = first.coupled_mass();
    commanded = layout_.stator && first.controller;
    const bool turns = layout_.spin && (!first.gyroscopic.absent() || !first.internal_xx.absent() ||
                                        !first.internal_yy.absent() || coupled_);
    const bool curve = first.drive && first.drive->kind() != scene::DriveKind::kLinear &&
                       first.drive->kind() != scene::DriveKind::kFree;
    iterates_ = turns || curve || layout_.coils > 0;
    if (coupled_) {
      bx_.assign(static_cast<std::size_t>(layout_.modes), T{});
      by_ = bx_;
    }
    for (int lane = 0; lane < kLanes; ++lane) {
      const Model& model = *models[static_cast<std::size_t>(lane)];
      if (!contact_) break;
      lanes::set(contact.clearance, lane, model.contact->clearance);
      lanes::set(contact.radius, lane, model.contact->radius);
      lanes::set(contact.friction, lane, model.contact->friction);
      lanes::set(contact.restitution, lane, model.contact->restitution);
    }
    for (auto& column : response_) column.assign(nq, T{});
    if (contact_ && !coupled_) respond();
  }

  const T* q() const { return q_.data(); }
  const T* v() const { return v_.data(); }

  // What the actuator is told over the next step (system/actuation.h): the force on the ring, or the
  // currents of the two axes; `commanded`: there is a command.
  T command_x{}, command_y{};
  bool commanded = false;
  const T* applied = nullptr;  // nq further loads, or none
  double origin = 0.0;  // s, t at k = 0
  ContactNumbers<T> contact;

  // What the last step did.
  T normal_impulse{}, friction_impulse{};  // N s
  T slip_sign{};                           // sliding: +1, -1; 0: free or sticking
  T in_contact{};                          // 1 in lasting contact, else 0
  Status status[kLanes] = {};              // a lane with one stays where it was

  // All that outlives a step, as plain numbers, in one order: action(double or T&).
  template <class Action>
  void for_each_kept(Action action) {
    action(origin);
    action(in_contact);
    action(slip_sign);
    for (T& x : q_) action(x);
    for (T& x : v_) action(x);
    for (T& x : bx_) action(x);
    for (T& x : by_) action(x);
    loads_.for_each_kept(action);
  }
  // A state at t (s), nq values each: the memory of everything before it is gone.
  void begin(double t, const double* q, const double* v)
    requires(kLanes == 1)
  {
    for_each_kept([](double& x) { x = 0.0; });
    std::copy_n(q, layout_.nq(), q_.begin());
    std::copy_n(v, layout_.nq(), v_.begin());
    origin = t;
    revive();
  }
  // Another state at the same instant; everything else is kept.
  void adopt(const double* q, const double* v)
    requires(kLanes == 1)
  {
    std::copy_n(q, layout_.nq(), q_.begin());
    std::copy_n(v, layout_.nq(), v_.begin());
  }
  // Ends every status.
  void revive() {
    for (Status& s : status) s = Status::kOk;
    failed_ = false;
    loads_.forget();
  }
  // The lanes' initial states.
  void load_initial_states() {
    for (int lane = 0; lane < kLanes; ++lane) {
      put_lane(q_, lane_model(*m_, lane).q0, lane);
      put_lane(v_, lane_model(*m_, lane).v0, lane);
    }
  }

 protected:
  struct Admittance {
    T a[3][3];
  };

  // F(q, v), all loads but the contact's; the loads of [[force]] as advanced last.
  ROTORUB_INLINE void force(const T* q, const T* v, T* f) {
    const M& m = *m_;
    const T omega = equations::spin_speed(m, v);
    equations::diagonal_force(m, q, v, f);
    equations::add_rotating_damping(m, q, v, omega, f);
    equations::add_dampers(m, v, f);
    equations::add_springs(m, q, f);
    equations::add_gyroscopic(m, omega, v, f);
    loads_.add(layout_.modes, f);
    if (!m.unbalances.empty()) equations::add_unbalance(m, angles_, omega, f);
    equations::add_drive(m, v, f);
    if (applied) {
      for (int i = 0; i < layout_.nq(); ++i) f[i] += applied[i];
    }
    if (magnetic()) {
      magnet_force(q, v, f);
    } else if (commanded && layout_.stator) {
      f[layout_.ring()] += command_x;
      f[layout_.ring() + 1] += command_y;
    }
  }

  // start_ -> free_: the velocities that the loads of step k give, about the instant t and at q;
  // begin (s): of the loads, they end at t + h/2.
  ROTORUB_INLINE void free_velocity(std::int64_t k, double begin, double t, const T* q) {
    const int nq = layout_.nq();
    const T h = lanes::all<T>(h_);
    loads_.advance(k, t, begin, t + 0.5 * h_);
    if (!m_->unbalances.empty()) {
      angles_.fill(*m_, t, q);
      if (coupled_) equations::spin_coupling(*m_, angles_, bx_.data(), by_.data());
    }
    const T* start = start_.data();
    T *f = f_.data(), *free = free_.data();
    force(q, start, f);
    for (int i = 0; i < nq; ++i) f[i] = h * f[i];
    solve(f);
    for (int i = 0; i < nq; ++i) free[i] = start[i] + f[i];
    if (!iterates_) return;
    begin_iteration(lanes::all<T>(1.0));
    while (improve(q, free)) {
    }
  }

  // In the lanes where `open` is 1.
  ROTORUB_INLINE void begin_iteration(const T& open) {
    rounds_ = 0;
    open_ = open;
  }
  // One round of the iteration: free_ from the forces at the middle of start_ and `end`, the step's
  // end with its contact. False once every lane has come to rest; one that has keeps its bits.
  ROTORUB_INLINE bool improve(const T* q, const T* end) {
    const int nq = layout_.nq(), n = layout_.modes, phi = layout_.phi();
    const T h = lanes::all<T>(h_), half = lanes::all<T>(0.5), zero{};
    const T *start = start_.data(), *mass = m_->mass.data();
    T *f = f_.data(), *change = change_.data(), *free = free_.data();
    for (int i = 0; i < nq; ++i) change[i] = half * (start[i] + end[i]);
    force(q, change, f);
    for (int i = 0; i < nq; ++i) {
      change[i] = end[i] - start[i];
      f[i] = h * f[i] - mass[i] * change[i];
    }
    if (coupled_) {
      const T *bx = bx_.data(), *by = by_.data();
      T sum{};
      for (int k = 0; k < n; ++k) {
        f[k] -= bx[k] * change[phi];
        f[n + k] -= by[k] * change[phi];
        sum += bx[k] * change[k] + by[k] * change[n + k];
      }
      f[phi] -= sum;
    }
    solve(f);
    T moved{}, size{}, whole{};
    for (int i = 0; i < nq; ++i) {
      const T better = start[i] + change[i] + f[i], by = better - free[i];
      moved += mass[i] * by * by;
      size += mass[i] * change[i] * change[i];
      whole += mass[i] * end[i] * end[i];
      free[i] = lanes::select(open_ > zero, better, free[i]);
    }
    // To 1e-10 of the change, as the next round would gain as much again; or to round-off.
    const T enough = lanes::all<T>(1e-20) * size + lanes::all<T>(1e-30) * whole;
    open_ = lanes::select(moved > enough, open_, zero);
    if (++rounds_ < kMostRounds) return lanes::any(open_ > zero);
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(open_, lane) > 0.0) fail(lane, Status::kStepTooLarge);
    }
    return false;
  }

  ROTORUB_INLINE void solve(T* f) {
    matrix_.solve(coupled_ ? bx_.data() : nullptr, by_.data(), f);
  }

  // The columns A^-1 J^T of the contact space and A's admittance J A^-1 J^T.
  ROTORUB_INLINE void respond() {
    const T zero{}, one = lanes::all<T>(1.0);
    for (int j = 0; j < 3; ++j) {
      T* column = response_[j].data();
      for (int i = 0; i < layout_.nq(); ++i) column[i] = zero;
      equations::add_contact_load(*m_, j == 0 ? one : zero, j == 1 ? one : zero,
                                  j == 2 ? one : zero, column);
      solve(column);
      const Centre d = equations::relative(*m_, column);
      admittance_.a[0][j] = d.x;
      admittance_.a[1][j] = d.y;
      // A prescribed spin speed does not change.
      admittance_.a[2][j] = layout_.torsion ? equations::torsion_at_contact(*m_, column) : zero;
      if (layout_.spin) admittance_.a[2][j] += column[layout_.phi()];
    }
  }

  // x += A^-1 J^T of the load (N, F) with the normal e, in the lanes of `on`.
  ROTORUB_INLINE void push(T* x, const T& ex, const T& ey, const T& normal, const T& friction,
                           const Mask& on) {
    const T zero{};
    const T N = lanes::select(on, normal, zero), F = lanes::select(on, friction, zero);
    const T px = -ex * N - ey * F, py = -ey * N + ex * F, pz = contact.radius * F;
    const T *cx = response_[0].data(), *cy = response_[1].data(), *cz = response_[2].data();
    const int nq = layout_.nq();
    for (int i = 0; i < nq; ++i) x[i] += cx[i] * px + cy[i] * py + cz[i] * pz;
  }

  // Lasting contact in the lanes of `on`, from d at the step's begin: after_ from free_, whatever
  // the iteration needs. Slides on as in the step before where it can, in all lanes at once.
  ROTORUB_INLINE void lasting_contact(const Mask& on, const T* q, const Centre& d) {
    if (coupled_) respond();
    last_sign_ = slip_sign;
    const T zero{}, one = lanes::all<T>(1.0);
    const T square = d.x * d.x + d.y * d.y;
    const T inverse =
        one / lanes::square_root(lanes::select(square > zero, square, one));
    T ex = d.x * inverse, ey = d.y * inverse;
    turn_normals(on, d, ex, ey);
    normal_x_ = ex;
    normal_y_ = ey;
    if (iterates_) begin_iteration(lanes::select(on, one, zero));
    for (bool settled = false;;) {
      press(on, d, ex, ey);
      const int nq = layout_.nq();
      for (int i = 0; i < nq; ++i) after_[static_cast<std::size_t>(i)] = free_[static_cast<std::size_t>(i)];
      push(after_.data(), ex, ey, normal_impulse, friction_impulse, on);
      // Once more after the last round: a lane's end must not depend on how long the others went on.
      if (!iterates_ || settled) break;
      settled = !improve(q, after_.data());
    }
    in_contact = lanes::select(on, lanes::select(normal_impulse > zero, one, zero), in_contact);
  }

  // J: of the forces of F at the middle of the step, but those that energy holds (springs, and with a
  // free spin unbalance, which is inertial), over h.
  double external_work(const double* q, const double* start, const double* end)
    requires(kLanes == 1)
  {
    const int nq = layout_.mechanical();
    double *f = f_.data(), *v = change_.data();
    for (int i = 0; i < layout_.nq(); ++i) v[i] = 0.5 * (start[i] + end[i]);
    force(q, v, f);
    double work = 0.0;
    const double* stiffness = m_->stiffness.data();
    for (int i = 0; i < nq; ++i) work += (f[i] + stiffness[i] * q[i]) * v[i];
    if (m_->springs.empty() && !coupled_) return h_ * work;
    for (int i = 0; i < layout_.nq(); ++i) f[i] = 0.0;
    equations::add_springs(*m_, q, f);
    if (coupled_) equations::add_unbalance(*m_, angles_, equations::spin_speed(*m_, v), f);
    for (int i = 0; i < nq; ++i) work -= f[i] * v[i];
    return h_ * work;
  }

  // J: of lasting contact's last impulses on the coordinates, from the velocities at both ends.
  double contact_work(const double* start, const double* end) const
    requires(kLanes == 1)
  {
    if (!(normal_impulse > 0.0)) return 0.0;
    const Eigen::Vector3d load =
        contact_load({normal_x_, normal_y_}, contact.radius, normal_impulse, friction_impulse);
    const double held = layout_.spin ? 0.0 : m_->speed;  // the machine that holds the speed works too
    const Eigen::Vector3d rates = 0.5 * (lane_rates(start, 0) + lane_rates(end, 0));
    return load.dot(rates - Eigen::Vector3d(0.0, 0.0, held));
  }
  // The same of impacts, which know their energy.
  double impact_work(const ImpactList& list) const {
    const Model& m = lane_model(*m_, 0);
    const double held = layout_.spin ? 0.0 : m.contact->radius * m.speed;
    double work = 0.0;
    for (int i = 0; i < list.count; ++i) {
      const Impact& hit = list.impact[static_cast<std::size_t>(i)];
      work += hit.energy_change - hit.friction_impulse * held;
    }
    return work;
  }

  // x's component sum is finite in every lane, or the lane gets a status.
  ROTORUB_INLINE void check_finite(const T* x) {
    T sum{};
    const int nq = layout_.nq();
    for (int i = 0; i < nq; ++i) sum += x[i];
    const T rest = sum - sum, zero{};  // 0 where finite
    if (!lanes::any(rest != zero)) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(rest, lane) != 0.0) fail(lane, Status::kDiverged);
    }
  }
  ROTORUB_SLOW void fail(int lane, Status why) {
    if (status[lane] == Status::kOk) status[lane] = why;
    failed_ = true;
  }
  // 1 in the lanes that go on.
  ROTORUB_INLINE T running() const {
    T ok{};
    for (int lane = 0; lane < kLanes; ++lane) {
      lanes::set(ok, lane, status[lane] == Status::kOk ? 1.0 : 0.0);
    }
    return ok;
  }

  // A lane's numbers as the scalar model's.
  void read_lane(const T* from, int lane, double* to) const {
    for (int i = 0; i < layout_.nq(); ++i) to[i] = lanes::get(from[i], lane);
  }
  Eigen::Vector3d lane_rates(const T* v, int lane) const {
    const Centre w = equations::relative(*m_, v);
    return {lanes::get(w.x, lane), lanes::get(w.y, lane),
            lanes::get(equations::contact_spin(*m_, v), lane)};
  }

  const M* m_;
  double h_;
  Layout layout_;
  bool contact_ = false, coupled_ = false, iterates_ = false, failed_ = false;
  VelocityMatrix<T> matrix_;
  SteppedLoads<T> loads_;
  equations::DiscAngles<T> angles_;
  lanes::Array<T> bx_, by_;
  // Coordinates; velocities before the step, at its start, without contact, at its end.
  lanes::Array<T> q_, v_, start_, free_, after_;
  Admittance admittance_{};

 private:
  static constexpr int kMostRounds = 20;

  ROTORUB_INLINE bool magnetic() const { return lane_model(*m_, 0).magnets.has_value(); }

  // F(s, i) on the ring, lane by lane, and what drives the coils.
  ROTORUB_SLOW void magnet_force(const T* q, const T* v, T* f) const {
    const int ring = layout_.ring(), coil = layout_.coil();
    for (int lane = 0; lane < kLanes; ++lane) {
      const MagneticActuator& magnets = *lane_model(*m_, lane).magnets;
      const auto of = [lane](const T& x) { return lanes::get(x, lane); };
      const Eigen::Vector2d asked{of(command_x), of(command_y)};
      Eigen::Vector2d current = asked;
      for (int k = 0; k < layout_.coils; ++k) {
        current[k] = of(v[coil + k]);
        lanes::set(f[coil + k], lane, of(f[coil + k]) + coil_load(magnets, asked[k], current[k]));
      }
      const Eigen::Vector2d s = to_axes({of(q[ring]), of(q[ring + 1])});
      const Eigen::Vector2d force = from_axes(
          {magnets.law->force(s.x(), current.x()), magnets.law->force(s.y(), current.y())});
      lanes::set(f[ring], lane, of(f[ring]) + force.x());
      lanes::set(f[ring + 1], lane, of(f[ring + 1]) + force.y());
    }
  }

  // Where the path ends far from where it begins (it passes the middle), the normal is that of the
  // place where it leaves the circle.
  ROTORUB_INLINE void turn_normals(const Mask& on, const Centre& d, T& ex, T& ey) const {
    const Centre w = equations::relative(*m_, free_.data());
    const T zero{}, one = lanes::all<T>(1.0), h = lanes::all<T>(h_), c = contact.clearance;
    const T turned = d.x * (d.x + h * w.x) + d.y * (d.y + h * w.y);
    const Mask far = turned < lanes::all<T>(0.5) * c * c;
    const T back = lanes::select(on, lanes::select(far, one, zero), zero);
    if (!lanes::any(back > zero)) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (!(lanes::get(back, lane) > 0.0)) continue;
      const Eigen::Vector2d from{lanes::get(d.x, lane), lanes::get(d.y, lane)};
      const Eigen::Vector2d path = h_ * Eigen::Vector2d(lanes::get(w.x, lane), lanes::get(w.y, lane));
      const double share = circle_exit(from, path, lanes::get(contact.clearance, lane));
      const Eigen::Vector2d e_r = (from + std::min(1.0, share) * path).normalized();
      lanes::set(ex, lane, e_r.x());
      lanes::set(ey, lane, e_r.y());
    }
  }

  // The impulses of lasting_contact for the present free_; see contact/lasting_contact.h.
  ROTORUB_INLINE void press(const Mask& on, const Centre& d, const T& ex, const T& ey) {
    const T zero{}, one = lanes::all<T>(1.0), h = lanes::all<T>(h_);
    const Centre w = equations::relative(*m_, free_.data());
    const T spin = equations::contact_spin(*m_, free_.data());
    const T r = contact.radius, ratio = -contact.friction * last_sign_;
    // Response to N with T = ratio N.
    const T lx = -ex - ey * ratio, ly = -ey + ex * ratio, lz = r * ratio;
    const auto& a = admittance_.a;
    const T gx = a[0][0] * lx + a[0][1] * ly + a[0][2] * lz;
    const T gy = a[1][0] * lx + a[1][1] * ly + a[1][2] * lz;
    const T gz = a[2][0] * lx + a[2][1] * ly + a[2][2] * lz;
    const T px = d.x + h * w.x, py = d.y + h * w.y, hx = h * gx, hy = h * gy;
    const T square = hx * hx + hy * hy, along = px * hx + py * hy;
    const T depth = px * px + py * py - contact.clearance * contact.clearance;
    const T root = along * along - square * depth;
    const T normal = depth / (lanes::square_root(lanes::select(root > zero, root, one)) - along);
    const T slip = ex * (w.y + normal * gy) - ey * (w.x + normal * gx) + r * (spin + normal * gz);
    const Mask slides = (root > zero) & (along < zero) & (slip * last_sign_ > zero);
    normal_impulse = lanes::select(on, normal, normal_impulse);
    friction_impulse = lanes::select(on, ratio * normal, friction_impulse);
    slip_sign = lanes::select(on, last_sign_, slip_sign);
    const T other = lanes::select(on, lanes::select(slides, zero, one), zero);
    if (!lanes::any(other > zero)) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(other, lane) > 0.0) press_lane(lane, d, {lanes::get(ex, lane), lanes::get(ey, lane)});
    }
  }

  ROTORUB_SLOW void press_lane(int lane, const Centre& d, const Eigen::Vector2d& e_r) {
    LastingStep s;
    s.h = h_;
    s.d = {lanes::get(d.x, lane), lanes::get(d.y, lane)};
    s.e_r = e_r;
    s.start = lane_rates(start_.data(), lane);
    s.free = lane_rates(free_.data(), lane);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) s.admittance(i, j) = lanes::get(admittance_.a[i][j], lane);
    }
    const ContactParameters& c = *lane_model(*m_, lane).contact;
    s.clearance = c.clearance;
    s.radius = c.radius;
    s.friction = c.friction;
    const LastingResult r = solve_lasting_contact(s);
    if (r.solutions != 1) fail(lane, r.solutions == 0 ? Status::kNoSolution : Status::kAmbiguous);
    lanes::set(normal_impulse, lane, r.normal);
    lanes::set(friction_impulse, lane, r.friction);
    lanes::set(slip_sign, lane, r.contact_case == ContactCase::kSlidePositive   ? 1.0
                                : r.contact_case == ContactCase::kSlideNegative ? -1.0
                                                                                : 0.0);
  }

  lanes::Array<T> f_, change_, response_[3];
  T last_sign_{}, open_{}, normal_x_{}, normal_y_{};
  int rounds_ = 0;
};

}  // namespace rotorub
