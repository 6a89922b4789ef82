#include "native_model/contact/coulomb.h"

#include <cassert>
#include <cmath>

namespace rotorub {
namespace {

struct Slide {
  double normal;   // L_N, valid where defined
  double slip;     // y_T
  bool defined;    // the normal row can carry the load
};

// L_T = -mu sigma L_N and y_N = 0.
Slide slide(const Delassus& a, double b_n, double b_t, double mu, double sigma) {
  const double denominator = a.nn - mu * sigma * a.nt;
  if (denominator == 0.0) return {0.0, 0.0, false};
  const double normal = -b_n / denominator;
  return {normal, b_t + (a.tn - mu * sigma * a.tt) * normal, true};
}

// y_N = 0, y_T = 0.
void stick(const Delassus& a, double b_n, double b_t, double& normal, double& friction) {
  const double determinant = a.nn * a.tt - a.nt * a.tn;
  normal = (-b_n * a.tt + b_t * a.nt) / determinant;
  friction = (-b_t * a.nn + b_n * a.tn) / determinant;
}

// Every case on its own, for matrices where the solution need not be unique.
CoulombSolution enumerate(const Delassus& a, double b_n, double b_t, double mu) {
  CoulombSolution found;
  found.solutions = 0;
  const auto take = [&found](ContactCase c, double normal, double friction) {
    if (found.solutions++ == 0) {
      found.contact_case = c;
      found.normal = normal;
      found.friction = friction;
    }
  };
  if (b_n >= 0.0) take(ContactCase::kOpen, 0.0, 0.0);
  double normal = 0.0, friction = 0.0;
  stick(a, b_n, b_t, normal, friction);
  if (normal > 0.0 && std::abs(friction) <= mu * normal) {
    take(ContactCase::kStick, normal, friction);
  }
  const Slide positive = slide(a, b_n, b_t, mu, 1.0);
  if (positive.defined && positive.normal > 0.0 && positive.slip > 0.0) {
    take(ContactCase::kSlidePositive, positive.normal, -mu * positive.normal);
  }
  const Slide negative = slide(a, b_n, b_t, mu, -1.0);
  if (negative.defined && negative.normal > 0.0 && negative.slip < 0.0) {
    take(ContactCase::kSlideNegative, negative.normal, mu * negative.normal);
  }
  return found;
}

}  // namespace

CoulombSolution solve_coulomb(const Delassus& a, double b_n, double b_t, double mu) {
  assert(a.nn > 0.0 && a.tt > 0.0 && mu >= 0.0);
  // With a_nn > mu |a_nt| and a symmetric matrix the cases exclude each other and leave no gap
  // between them: sliding one way, the other way, and sticking for what remains.
  if (a.nt != a.tn || mu * std::abs(a.nt) >= a.nn) return enumerate(a, b_n, b_t, mu);
  CoulombSolution s;
  if (b_n >= 0.0) return s;
  const Slide positive = slide(a, b_n, b_t, mu, 1.0);
  if (positive.slip > 0.0) {
    s.contact_case = ContactCase::kSlidePositive;
    s.normal = positive.normal;
    s.friction = -mu * s.normal;
    return s;
  }
  const Slide negative = slide(a, b_n, b_t, mu, -1.0);
  if (negative.slip < 0.0) {
    s.contact_case = ContactCase::kSlideNegative;
    s.normal = negative.normal;
    s.friction = mu * s.normal;
    return s;
  }
  s.contact_case = ContactCase::kStick;
  stick(a, b_n, b_t, s.normal, s.friction);
  return s;
}

}  // namespace rotorub
