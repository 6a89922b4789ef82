// Two electromagnets that pull against each other with a bias current,
//
//   F(s, i) = k_m [ ((i_0 + i)/(s_0 - s))^2 - ((i_0 - i)/(s_0 + s))^2 ] - c s
//
// (2) of the paper. F rises with i for |i| <= i_0. At s = i = 0 it has the slopes 4 k_m i_0 / s_0^2
// (N/A) and 4 k_m i_0^2 / s_0^3 - c (N/m: it pulls away from the middle).
#pragma once

#include "native_model/bearing/force_law.h"

namespace rotorub {

class Electromagnet final : public ForceLaw {
 public:
  struct Parameters {
    double force_constant = 0.0;  // N m^2/A^2, k_m > 0
    double bias_current = 0.0;    // A, i_0 > 0
    double air_gap = 0.0;         // m, s_0 > 0
    double stiffness = 0.0;       // N/m, c >= 0
  };
  explicit Electromagnet(const Parameters& parameters) : p_(parameters) {}

  // The ring's stop at the cores is not modelled: beyond kReach of the air gap the magnets pull as
  // they do there.
  static constexpr double kReach = 0.99;

  double force(double s, double i) const override;
  double gain(double s, double i) const override;
  double current(double s, double force, double limit) const override;
  double reach() const override { return p_.air_gap; }

 private:
  // 1/(s_0 - s)^2 and 1/(s_0 + s)^2.
  struct Gaps {
    double pulling, opposing;
  };
  Gaps gaps(double s) const;

  Parameters p_;
};

}  // namespace rotorub
