// What moves: time, and y = (q, qdot, integrals) as the integrator carries it.
#pragma once

#include <algorithm>
#include <vector>

#include "native_model/system/model.h"

namespace rotorub {

// Carried along with the state, for statistics and the energy balance; the first kOfContact for
// each contact.
enum Integral {
  kNormalImpulse,
  kFrictionImpulse,
  kFrictionWork,
  kContactWork,
  kExternalWork,
  kGapRateSquare,
  kIntegrals
};
inline constexpr int kOfContact = 3;
inline int integral_count(const Model& model) {
  return kIntegrals + kOfContact * static_cast<int>(model.auxiliary.size() - 1);
}

// Among the integrals.
inline int integral_index(Integral k, std::size_t contact) {
  return contact == 0 ? k : kIntegrals + kOfContact * static_cast<int>(contact - 1) + k;
}

struct Motion {
  explicit Motion(const Model& model)
      : nq(model.nq()), y(static_cast<std::size_t>(2 * nq + integral_count(model))) {}
  // From `start` on, with all integrals 0.
  void begin(const State& start) {
    t = start.t;
    std::fill(y.begin(), y.end(), 0.0);
    std::copy_n(start.q.data(), nq, q());
    std::copy_n(start.v.data(), nq, v());
  }
  double* q() { return y.data(); }
  double* v() { return y.data() + nq; }
  const double* q() const { return y.data(); }
  const double* v() const { return y.data() + nq; }
  int index(Integral k, std::size_t contact = 0) const {
    return 2 * nq + integral_index(k, contact);
  }
  double& integral(Integral k) { return y[static_cast<std::size_t>(index(k))]; }
  double integral(Integral k, std::size_t contact = 0) const {
    return y[static_cast<std::size_t>(index(k, contact))];
  }

  double t = 0.0;  // s
  int nq;
  std::vector<double> y;
};

}  // namespace rotorub
