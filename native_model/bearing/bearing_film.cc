#include "native_model/bearing/bearing_film.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "native_model/scene/shaft_bearing.h"

namespace rotorub {

CoefficientTable::CoefficientTable(const std::vector<double>& speed,
                                   const std::array<std::vector<double>, 8>& values)
    : speeds_(speed) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    given_[k] = !values[k].empty();
    if (!given_[k]) continue;
    curves_[k] = MonotoneCubic(speed, values[k]);
    for (const double value : values[k]) largest_[k] = std::max(largest_[k], std::abs(value));
  }
  // Testing the points is enough, because curves through equal points are equal.
  isotropic_ = std::all_of(speed.begin(), speed.end(),
                           [this](double at_speed) { return rotorub::isotropic(at(at_speed)); });
}

BearingCoefficients CoefficientTable::at(double speed) const {
  BearingCoefficients all{};
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (given_[k]) all[k] = curves_[k].value(speed);
  }
  return all;
}

bool isotropic(const BearingCoefficients& c) {
  return c[0] == c[3] && c[1] == -c[2] && c[4] == c[7] && c[5] == -c[6];
}

BearingCoefficients largest(const BearingFilm& film) {
  BearingCoefficients most{};
  if (film.follows()) most = film.table->largest();
  for (std::size_t k = 0; k < most.size(); ++k) most[k] += std::abs(film.constant[k]);
  return most;
}

std::optional<BearingFilm> film_of(const scene::ShaftBearing& b) {
  if (!b.follows_speed() && !b.crosses()) return {};
  BearingFilm film;
  film.offset_x = b.offset.x();
  film.offset_y = b.offset.y();
  if (b.follows_speed()) {
    film.table = std::make_shared<CoefficientTable>(b.table_speed, scene::coefficient_lists(b));
    film.constant = {b.stiffness.x(), 0.0, 0.0, b.stiffness.y(),
                     b.damping.x(),   0.0, 0.0, b.damping.y()};
  } else {
    film.constant = {0.0, b.cross_stiffness.x(), b.cross_stiffness.y(), 0.0,
                     0.0, b.cross_damping.x(),   b.cross_damping.y(),   0.0};
  }
  return film;
}

}  // namespace rotorub
