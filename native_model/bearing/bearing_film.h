// What a shaft bearing does beyond a spring and a dashpot in each plane: coefficients across the
// planes, and such that follow the speed, as an oil film's or a seal's do (J. W. Lund, "Review of
// the concept of dynamic coefficients for fluid film journal bearings", J. Tribology 109, 1987),
//
//   F = -K(Omega) (r - o) - C(Omega) r',   K = (k_xx k_xy; k_yx k_yy), C alike,      (45)
//
// r the deflection at its station, o where the bearing stands. The model's own springs and dashpots
// have the diagonals of one speed, 0 where those are negative; here is the rest.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "native_model/numerics/monotone_cubic.h"
#include "native_model/scene/rotor.h"

namespace rotorub {

// k_xx, k_xy, k_yx, k_yy in N/m, then c alike in N s/m.
using BearingCoefficients = std::array<double, 8>;

// The coefficients over the speed of rotation, held beyond the ends.
class CoefficientTable {
 public:
  // speed: rad/s, ascending, two or more; of each coefficient as many values, or none: 0.
  CoefficientTable(const std::vector<double>& speed,
                   const std::array<std::vector<double>, 8>& values);
  BearingCoefficients at(double speed) const;
  // For each the largest size that it has at any speed.
  BearingCoefficients largest() const { return largest_; }
  const std::vector<double>& speeds() const { return speeds_; }
  // At every speed the same in every direction: k_xx = k_yy, k_xy = -k_yx.
  bool isotropic() const { return isotropic_; }

 private:
  std::vector<double> speeds_;
  std::array<MonotoneCubic, 8> curves_;
  std::array<bool, 8> given_{};
  BearingCoefficients largest_{};
  bool isotropic_ = false;
};

bool isotropic(const BearingCoefficients& coefficients);

struct BearingFilm {
  // Beside a table what the model's springs and dashpots have, to be taken off; else the
  // coefficients.
  BearingCoefficients constant{};
  std::shared_ptr<const CoefficientTable> table;  // null: constant coefficients
  double offset_x = 0.0, offset_y = 0.0;          // m, o

  bool follows() const { return table != nullptr; }
  BearingCoefficients at(double speed) const {
    if (!table) return constant;
    BearingCoefficients all = table->at(speed);
    for (std::size_t k = 0; k < all.size(); ++k) all[k] -= constant[k];
    return all;
  }
};

// For each coefficient the largest size at any speed.
BearingCoefficients largest(const BearingFilm& film);

// What the bearing does beyond the springs and dashpots that `stiffness` and `damping` are, off
// whose middle it stands by its offset; none where that is nothing.
std::optional<BearingFilm> film_of(const scene::ShaftBearing& bearing);

}  // namespace rotorub
