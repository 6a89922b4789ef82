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
#include <memory>
#include <optional>
#include <vector>

#include "native_model/numerics/lanes.h"
#include "native_model/numerics/monotone_cubic.h"
#include "native_model/scene/rotor.h"

namespace rotorub {

// k_xx, k_xy, k_yx, k_yy in N/m, then c alike in N s/m.
template <class T>
using BearingCoefficients = std::array<T, 8>;

// The coefficients over the speed of rotation, held beyond the ends.
class CoefficientTable {
 public:
  // speed: rad/s, ascending, two or more; of each coefficient as many values, or none: 0.
  CoefficientTable(const std::vector<double>& speed,
                   const std::array<std::vector<double>, 8>& values);
  BearingCoefficients<double> at(double speed) const;
  // For each the largest size that it has at any speed.
  BearingCoefficients<double> largest() const { return largest_; }
  const std::vector<double>& speeds() const { return speeds_; }
  // At every speed the same in every direction: k_xx = k_yy, k_xy = -k_yx.
  bool isotropic() const { return isotropic_; }

 private:
  std::vector<double> speeds_;
  std::array<MonotoneCubic, 8> curves_;
  std::array<bool, 8> given_{};
  BearingCoefficients<double> largest_{};
  bool isotropic_ = false;
};

bool isotropic(const BearingCoefficients<double>& coefficients);

template <class T>
struct BearingFilm {
  // Beside a table what the model's springs and dashpots have, to be taken off; else the
  // coefficients.
  BearingCoefficients<T> constant{};
  // One a lane, or none: constant coefficients.
  std::vector<std::shared_ptr<const CoefficientTable>> tables;
  T offset_x{}, offset_y{};  // m, o

  bool follows() const { return !tables.empty(); }
  ROTORUB_INLINE BearingCoefficients<T> at(const T& speed) const {
    return follows() ? of_tables(speed) : constant;
  }

 private:
  ROTORUB_SLOW BearingCoefficients<T> of_tables(const T& speed) const {
    BearingCoefficients<T> all{};
    for (int lane = 0; lane < lanes::kWidth<T>; ++lane) {
      const BearingCoefficients<double> of =
          tables[static_cast<std::size_t>(lane)]->at(lanes::get(speed, lane));
      for (std::size_t k = 0; k < all.size(); ++k) lanes::set(all[k], lane, of[k]);
    }
    for (std::size_t k = 0; k < all.size(); ++k) all[k] -= constant[k];
    return all;
  }
};

// For each coefficient the largest size at any speed.
BearingCoefficients<double> largest(const BearingFilm<double>& film);

// What the bearing does beyond the springs and dashpots that `stiffness` and `damping` are, off
// whose middle it stands by its offset; none where that is nothing.
std::optional<BearingFilm<double>> film_of(const scene::ShaftBearing& bearing);

}  // namespace rotorub
