// Forces of a shaft bearing beyond uncoupled springs and dampers: cross-coupling, and coefficients
// that depend on the speed, as for an oil film or a seal (J. W. Lund, "Review of the concept of
// dynamic coefficients for fluid film journal bearings", J. Tribology 109, 1987),
//
//   F = -K(Omega) (r - o) - C(Omega) r',   K = (k_xx k_xy; k_yx k_yy), C likewise,      (45)
//
// with r the deflection at the station and o the offset of the bearing. The model's own springs and
// dampers have the diagonals at one speed, with negative values replaced by 0. This part adds the
// rest.
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

// k_xx, k_xy, k_yx, k_yy in N/m, then the same for c in N s/m.
using BearingCoefficients = std::array<double, 8>;

// Coefficients as functions of the rotational speed; the end values are held beyond the ends.
class CoefficientTable {
 public:
  // speed: rad/s, ascending, at least two. Each list of values is as long, or empty for 0.
  CoefficientTable(const std::vector<double>& speed,
                   const std::array<std::vector<double>, 8>& values);
  BearingCoefficients at(double speed) const;
  // Largest magnitude of each coefficient at any speed.
  BearingCoefficients largest() const { return largest_; }
  const std::vector<double>& speeds() const { return speeds_; }
  // True if K and C are isotropic at every speed: k_xx = k_yy, k_xy = -k_yx.
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
  // Without a table these are the coefficients. With a table they are the coefficients of the
  // model's own springs and dampers, which are subtracted.
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

// Upper bound of the magnitude of each coefficient at any speed.
BearingCoefficients largest(const BearingFilm& film);

// The forces beyond the model's springs and dampers, which have the bearing's `stiffness` and
// `damping` and are centred at its offset. Empty if the bearing has no further forces.
std::optional<BearingFilm> film_of(const scene::ShaftBearing& bearing);

}  // namespace rotorub
