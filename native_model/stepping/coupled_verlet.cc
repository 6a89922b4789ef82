#include "native_model/stepping/coupled_verlet.h"

#include <algorithm>

#include "native_model/contact/impact.h"

namespace rotorub {

CoupledVerlet::CoupledVerlet(const Model& model, double step)
    : CoupledStep(model, step, 1.0),
      late_(after_),
      velocity_(after_),
      acceleration_(after_),
      at_(after_),
      there_(after_),
      jump_(after_),
      before_(after_),
      missed_(after_),
      was_(contacts_),
      mean_(contacts_),
      part_(contacts_),
      mean_after_(after_),
      part_after_(after_) {}

bool CoupledVerlet::rebounds(const Contact& c, double approach, double pressed) const {
  return flight_outlives(h_, c.law.restitution * approach, pressed);
}

void CoupledVerlet::jump(std::size_t contact, const CommandJump& command) {
  commands_[contact] = command;
}

double CoupledVerlet::begin_of(std::int64_t k) const {
  const double t = origin + static_cast<double>(k) * h_;
  return first_ ? t : t - 0.5 * h_;
}

// start_ and free_ of step k.
void CoupledVerlet::kick(std::int64_t k) {
  for (std::size_t i = 0; i < start_.size(); ++i) start_[i] = v_[i] + late_[i];
  free_velocity(k, begin_of(k), origin + static_cast<double>(k) * h_, q_.data());
  if (!first_) return;
  for (std::size_t i = 0; i < free_.size(); ++i) free_[i] = 0.5 * (start_[i] + free_[i]);
}

FixedStep CoupledVerlet::step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) {
  hits_.clear();
  late_work_ = 0.0;
  apply_commands(u, q_.data());
  kick(k);
  std::copy(q_.begin(), q_.end(), seen_.begin());
  std::fill(late_.begin(), late_.end(), 0.0);
  was_first_ = first_;
  kick_ = was_first_ ? 0.5 : 1.0;
  was_ = contacts_;
  place();
  last();
  if (status[0] == Status::kOk) split(begin_of(k), origin + (static_cast<double>(k) + 0.5) * h_, u);
  std::copy(after_.begin(), after_.end(), free_end_.begin());
  bool hit = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& c = contacts_[i];
    c.free = rates(i, after_.data());
    hit = hit || (!c.lasts && leaves(c, c.free));
  }
  if (hit && status[0] == Status::kOk) collide(k);
  const FixedStep out = result(kick_, free_end_, works);
  kick_ = 1.0;
  first_ = false;
  commands_.fill({});
  move(h_);
  return out;
}

void CoupledVerlet::velocity_now(std::int64_t k, std::span<const Eigen::Vector2d> held,
                                 double* now) {
  if (first_) {
    std::copy(v_.begin(), v_.end(), now);
    return;
  }
  apply_commands(held, q_.data());
  kick(k);
  std::copy(free_.begin(), free_.end(), now);
  if (coupled_) respond();
  for (Contact& c : contacts_) {
    if (!c.lasts) c.normal = c.friction = 0.0;
  }
  push(now);
  for (std::size_t i = 0; i < start_.size(); ++i) now[i] = 0.5 * (start_[i] + now[i]);
}

void CoupledVerlet::last_velocity(double* now) const {
  for (std::size_t i = 0; i < start_.size(); ++i) {
    now[i] = was_first_ ? start_[i] : 0.5 * (start_[i] + free_end_[i]);
  }
}

}  // namespace rotorub
