// The contact part of a PaperKernel's step, all inline but for the scalar impact.
#pragma once

#include "native_model/integrate/paper_kernel_step.h"

namespace rotorub {

// x += M^-1 J^T p of the contact load (N, F), in the lanes of `on`.
template <class T>
void PaperKernel<T>::add_contact(const T* inverse, T* x, T ex, T ey, T normal, T friction,
                                 Mask on) {
  const T zero{};
  const T N = lanes::select(on, normal, zero), F = lanes::select(on, friction, zero);
  const T px = -ex * N - ey * F, py = -ey * N + ex * F, pz = radius_ * F;
  const int n = layout_.modes, nq = layout_.nq();
  T* f = f_.data();
  for (int k = 0; k < n; ++k) {
    f[k] = contact_x_[static_cast<std::size_t>(k)] * px;
    f[n + k] = contact_y_[static_cast<std::size_t>(k)] * py;
  }
  if (layout_.spin) f[layout_.phi()] = pz;
  for (int k = 0; k < layout_.torsion; ++k) {
    f[layout_.theta() + k] = torsion_contact_[static_cast<std::size_t>(k)] * pz;
  }
  if (layout_.stator) {
    f[layout_.ring()] = -px;
    f[layout_.ring() + 1] = -py;
  }
  for (int k = 0; k < layout_.coils; ++k) f[layout_.coil() + k] = T{};
  solve(inverse, f);
  for (int i = 0; i < nq; ++i) x[i] += f[i];
}

// A midpoint outside the ring (a flight of more than the clearance within half a step, round-off
// otherwise) goes back to the circle: q_m += M^-1 W_N (-g_N / G_NN). Left to (12), the depth over
// the step would come back as speed.
template <class T>
void PaperKernel<T>::project() {
  const Centre d = relative(q_mid_.data());
  const T square = d.x * d.x + d.y * d.y;
  const Mask outside = square > clearance_ * clearance_;
  if (!lanes::any(outside)) return;
  const T delta = lanes::select(outside, lanes::square_root(square), lanes::all<T>(1.0));
  const T ex = d.x / delta, ey = d.y / delta;
  const Admittance a = coupled_ ? admittance(inverse_mass_.data()) : constant_;
  const T nn = ex * (a.xx * ex + a.xy * ey) + ey * (a.xy * ex + a.yy * ey);
  add_contact(inverse_mass_.data(), q_mid_.data(), ex, ey, (delta - clearance_) / nn, T{}, outside);
}

// (12), (13) over the step: y_N = gap / h at the next midpoint, y_T = slip at the end. A symmetric
// matrix with one solution is solved in all lanes at once, anything else by solve_coulomb.
template <class T>
void PaperKernel<T>::persist(Mask on, T ex, T ey, T gap, Centre free, T spin) {
  const Admittance a = coupled_ ? admittance(implicit_inverse_.data()) : constant_implicit_;
  const T r = radius_, mu = friction_;
  const T ax = a.xx * ex + a.xy * ey, ay = a.xy * ex + a.yy * ey;
  const T tx = -a.xx * ey + a.xy * ex + a.xz * r, ty = -a.xy * ey + a.yy * ex + a.yz * r;
  const T tz = -a.xz * ey + a.yz * ex + a.zz * r;
  const T nn = ex * ax + ey * ay, nt = -(ex * tx + ey * ty), tt = -ey * tx + ex * ty + r * tz;
  const T b_n = gap / lanes::all<T>(step_);
  const T b_t = -ey * free.x + ex * free.y + r * spin;

  const T one = lanes::all<T>(1.0), zero{};
  const T n_plus = -b_n / (nn - mu * nt), slip_plus = b_t + (nt - mu * tt) * n_plus;
  T normal = n_plus, friction = -mu * n_plus, sign = one;
  const Mask not_plus = slip_plus <= zero;
  if (lanes::any(not_plus)) {
    const T n_minus = -b_n / (nn + mu * nt), slip_minus = b_t + (nt + mu * tt) * n_minus;
    const Mask minus = slip_minus < zero;
    const T determinant = nn * tt - nt * nt;
    const T n_stick = (-b_n * tt + b_t * nt) / determinant;
    const T f_stick = (-b_t * nn + b_n * nt) / determinant;
    normal = lanes::select(not_plus, lanes::select(minus, n_minus, n_stick), normal);
    friction = lanes::select(not_plus, lanes::select(minus, mu * n_minus, f_stick), friction);
    sign = lanes::select(not_plus, lanes::select(minus, -one, zero), sign);
  }
  if (const Mask jams = mu * lanes::magnitude(nt) >= nn; lanes::any(jams)) {
    for (int lane = 0; lane < kLanes; ++lane) {
      if (!lanes::get(on, lane) || !lanes::get(jams, lane)) continue;
      const double off = lanes::get(nt, lane);
      const CoulombSolution s =
          solve_coulomb({lanes::get(nn, lane), off, off, lanes::get(tt, lane)},
                        lanes::get(b_n, lane), lanes::get(b_t, lane), lanes::get(mu, lane));
      if (s.solutions != 1) {
        status[lane] = s.solutions == 0 ? Status::kNoSolution : Status::kAmbiguous;
        failed_ = true;
      }
      lanes::set(normal, lane, s.normal);
      lanes::set(friction, lane, s.friction);
      lanes::set(sign, lane, s.contact_case == ContactCase::kSlidePositive   ? 1.0
                             : s.contact_case == ContactCase::kSlideNegative ? -1.0
                                                                             : 0.0);
    }
  }
  normal_impulse = lanes::select(on, normal, normal_impulse);
  friction_impulse = lanes::select(on, friction, friction_impulse);
  slip_sign = lanes::select(on, sign, slip_sign);
  in_contact_ = lanes::select(on, lanes::select(normal > zero, one, zero), in_contact_);
  add_contact(implicit_inverse_.data(), v_new_.data(), ex, ey, normal, friction, on);
}

template <class T>
void PaperKernel<T>::touch(std::int64_t k) {
  const T zero{}, h = lanes::all<T>(step_), one = lanes::all<T>(1.0);
  const Centre d = relative(q_mid_.data()), free = relative(v_new_.data());
  const T px = d.x + h * free.x, py = d.y + h * free.y;
  const T square = px * px + py * py;
  const Mask outside = square > clearance_ * clearance_;
  in_contact_ = lanes::select(outside, in_contact_, zero);
  if (!lanes::any(outside)) return;

  // The normal at the midpoint. Where the step is so long that it does not close along that one,
  // the normal where the path meets the circle.
  const T delta = lanes::square_root(d.x * d.x + d.y * d.y);
  const T safe = lanes::select(delta > lanes::all<T>(kNoNormal), delta, one);
  T ex = d.x / safe, ey = d.y / safe;
  T closing = ex * free.x + ey * free.y;
  if (const Mask away = closing <= zero; lanes::any(away)) {
    for (int lane = 0; lane < kLanes; ++lane) {
      if (!lanes::get(away, lane) || !lanes::get(outside, lane) ||
          lanes::get(delta, lane) >= lanes::get(clearance_, lane)) {
        continue;
      }
      const double fx = lanes::get(free.x, lane), fy = lanes::get(free.y, lane);
      const double dx = lanes::get(d.x, lane), dy = lanes::get(d.y, lane);
      const double s = circle_crossing(dx, dy, fx, fy, lanes::get(clearance_, lane), step_);
      const double mx = dx + s * fx, my = dy + s * fy, m = std::hypot(mx, my);
      lanes::set(ex, lane, mx / m);
      lanes::set(ey, lane, my / m);
      lanes::set(closing, lane, (mx * fx + my * fy) / m);
    }
  }
  // A rebound that the loads and the ring's curvature would undo within the step is no impact but
  // lasting contact: -gddot_N h = e_r . (ddot+ - ddot) + h v_t^2 / delta.
  const Centre start = relative(v_.data());
  const T whirl = ex * free.y - ey * free.x;
  const T gained =
      ex * (free.x - start.x) + ey * (free.y - start.y) + h * whirl * whirl / clearance_;
  const Mask hits = outside & (in_contact_ == zero) & (closing > zero) &
                    (restitution_ * closing > gained);
  const T spin = spin_at_contact(v_new_.data());
  T hit{};  // 1 in the lanes of an impact
  if (lanes::any(hits)) {
    for (int lane = 0; lane < kLanes; ++lane) {
      if (!lanes::get(hits, lane)) continue;
      lanes::set(hit, lane, 1.0);
      const double fx = lanes::get(free.x, lane), fy = lanes::get(free.y, lane);
      const double crossing = circle_crossing(lanes::get(d.x, lane), lanes::get(d.y, lane), fx, fy,
                                              lanes::get(clearance_, lane), step_);
      impact_lane(lane, k, {lanes::get(ex, lane), lanes::get(ey, lane)},
                  {fx, fy, lanes::get(spin, lane)},
                  {lanes::get(start.x, lane), lanes::get(start.y, lane)}, crossing);
    }
    add_contact(inverse_mass_.data(), v_new_.data(), ex, ey, normal_impulse, friction_impulse,
                hit > zero);
  }
  const Mask rests = outside & (hit == zero);
  if (lanes::any(rests)) persist(rests, ex, ey, clearance_ - lanes::square_root(square), free, spin);
}

template <class T>
void PaperKernel<T>::step(std::int64_t k) {
  const int nq = layout_.nq();
  const T half = lanes::all<T>(0.5 * step_), zero{};
  T *q = q_.data(), *v = v_.data(), *mid = q_mid_.data();
  const T* v_new = v_new_.data();
  for (int i = 0; i < nq; ++i) mid[i] = q[i] + half * v[i];
  normal_impulse = friction_impulse = slip_sign = zero;
  if (impacts_) {
    for (int lane = 0; lane < kLanes; ++lane) impacted[lane] = false;
    impacts_ = false;
  }
  if (contact_present_) project();
  free_velocity(k);
  if (contact_present_) touch(k);
  T sum{};
  for (int i = 0; i < nq; ++i) sum += v_new[i];
  const T rest = sum - sum;  // 0 where finite
  if (lanes::any(rest != zero)) {
    failed_ = true;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (status[lane] == Status::kOk && lanes::get(rest, lane) != 0.0) {
        status[lane] = Status::kDiverged;
      }
    }
  }
  if (failed_) {
    T ok{};
    for (int lane = 0; lane < kLanes; ++lane) {
      lanes::set(ok, lane, status[lane] == Status::kOk ? 1.0 : 0.0);
    }
    const Mask moves = ok > zero;
    for (int i = 0; i < nq; ++i) {
      q[i] = lanes::select(moves, mid[i] + half * v_new[i], q[i]);
      v[i] = lanes::select(moves, v_new[i], v[i]);
    }
    return;
  }
  for (int i = 0; i < nq; ++i) {
    v[i] = v_new[i];
    q[i] = mid[i] + half * v_new[i];
  }
}

// Poisson's law in one lane; the impulses go to normal_impulse and friction_impulse.
template <class T>
void PaperKernel<T>::impact_lane(int lane, std::int64_t k, const Eigen::Vector2d& e_r,
                                 const Eigen::Vector3d& free, const Eigen::Vector2d& start,
                                 double closing_time) {
  const ContactParameters& c = *models_[static_cast<std::size_t>(lane)]->contact;
  const Admittance a = coupled_ ? admittance(inverse_mass_.data()) : constant_;
  const auto of = [lane](const T& x) { return lanes::get(x, lane); };
  ImpactInput in;
  in.admittance << of(a.xx), of(a.xy), of(a.xz), of(a.xy), of(a.yy), of(a.yz), of(a.xz), of(a.yz),
      of(a.zz);
  in.e_r = e_r;
  in.radius = c.radius;
  in.delta = c.clearance;
  const double start_spin = of(spin_at_contact(v_.data()));
  in.acceleration = (free - Eigen::Vector3d(start.x(), start.y(), start_spin)) / step_;
  // An impact lasts a step at most. The loads of the whole step are in `free` already: what acts
  // during the impact is taken back.
  const double duration = c.compression_time + c.expansion_time;
  const double within = duration > step_ ? step_ / duration : 1.0;
  in.compression_time = within * c.compression_time;
  in.expansion_time = within * c.expansion_time;
  in.velocity = free - in.acceleration * (in.compression_time + in.expansion_time);
  const ImpactResult r = solve_impact(in, {c.friction, c.restitution, c.tangential_restitution});
  if (r.status != ImpactStatus::kOk) {
    status[lane] =
        r.status == ImpactStatus::kNoSolution ? Status::kNoSolution : Status::kAmbiguous;
    failed_ = true;
    return;
  }
  lanes::set(normal_impulse, lane, r.normal());
  lanes::set(friction_impulse, lane, r.friction());
  impacted[lane] = impacts_ = true;
  const Eigen::Vector3d after =
      free + in.admittance * contact_load(e_r, c.radius, r.normal(), r.friction());
  const Eigen::Vector2d e_t{-e_r.y(), e_r.x()};
  const auto slip = [&](const Eigen::Vector3d& w) {
    return e_t.dot(w.head<2>()) + c.radius * w.z();
  };
  Impact& detail = impact[lane];
  detail.t = origin + static_cast<double>(k) * step_ + std::min(step_, 0.5 * step_ + closing_time);
  detail.normal_impulse = r.normal();
  detail.friction_impulse = r.friction();
  detail.gap_rate_before = -e_r.dot(free.head<2>());
  detail.gap_rate_after = -e_r.dot(after.head<2>());
  detail.slip_before = slip(free);
  detail.slip_after = slip(after);
  detail.energy_change = 0.5 * (r.normal() * (detail.gap_rate_before + detail.gap_rate_after) +
                                r.friction() * (detail.slip_before + detail.slip_after));
}

}  // namespace rotorub
