// The orders of a run with changing spin: the rotor's 1x and 2x vectors, as from a tracking filter
// with a keyphasor. Over stretches of whole turns of the spin angle phi, under a Hann window w,
//
//   r_k = sum_n w_n z_n e^{-i k phi_n} / sum_n w_n,   z = x + i y,
//
// at even steps of phi, so that a steady whirl of another order does not contribute. r_1 is forward
// whirl, r_-1 backward. A probe along x measures Re(v_k e^{i k phi}), v_k = r_k + conj(r_-k). phi
// is 0 where the mark on the rotor points to +x.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

struct OrderTrack {
  static constexpr int kOrders = 2;                              // 1x, 2x
  static constexpr int kTurns = 4;                               // per stretch
  std::vector<double> t;                                         // s, of the middle of each stretch
  std::vector<double> speed;                                     // rad/s, at that time
  std::vector<std::array<std::complex<double>, kOrders>> probe;  // m, v_1 and v_2
};

// A stretch every quarter of a turn, or at larger intervals so that there are at most `most`, for
// the rotor at the contact. Empty if the spin changes its direction or the rows are too coarse for
// the orders.
OrderTrack order_track(const Trajectory& run, std::size_t most);

}  // namespace rotorub
