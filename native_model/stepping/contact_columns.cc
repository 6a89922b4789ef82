#include "native_model/stepping/contact_columns.h"

namespace rotorub {

ContactColumns::ContactColumns(const StepState& x, LoadKick& loads)
    : done(x.m.auxiliary.size()),
      m_(x.m),
      h_(x.h),
      response_(3 * done.size(), Columns(static_cast<std::size_t>(x.nq()))) {
  for (std::size_t k = 0; k < response_.size(); ++k) {
    const auto axis = static_cast<Eigen::Index>(k % 3);
    add_contact_load(m_, Eigen::Vector3d::Unit(axis), response_[k].data(), k / 3);
    loads.solve_uncoupled(response_[k].data());
  }
  if (loads.coupled()) uncoupled_ = response_;
}

void ContactColumns::look(const StepState& x) {
  for (std::size_t i = 0; i < count(); ++i) {
    places[i].d = separation(m_, x.seen.data(), i);
    places[i].start = rates(i, x.start.data());
    places[i].free = rates(i, x.free.data());
  }
}

void ContactColumns::respond(LoadKick& loads) {
  for (std::size_t k = 0; k < uncoupled_.size(); ++k) {
    std::ranges::copy(uncoupled_[k], response_[k].begin());
    loads.couple(response_[k].data());
  }
}

Eigen::Matrix3d ContactColumns::admittance(std::size_t i, std::size_t j) const {
  Eigen::Matrix3d a;
  for (int axis = 0; axis < 3; ++axis) {
    const Columns& column = response_[3 * j + static_cast<std::size_t>(axis)];
    a.col(axis) = contact_acceleration(m_, column.data(), i);
  }
  return a;
}

void ContactColumns::push(std::size_t i, double normal, double friction,
                          std::span<double> to) const {
  const Eigen::Vector3d p = contact_load(places[i].e_r, law(i).radius, normal, friction);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Columns& column = response_[3 * i + axis];
    for (std::size_t k = 0; k < column.size(); ++k)
      to[k] += column[k] * p[static_cast<Eigen::Index>(axis)];
  }
}

double ContactColumns::work_of_lasting(const double* end) const {
  double work = 0.0;
  for (std::size_t i = 0; i < count(); ++i) {
    work += lasting_work(m_, i, places[i].e_r, done[i].lasting, places[i].start, rates(i, end));
  }
  return work;
}

}  // namespace rotorub
