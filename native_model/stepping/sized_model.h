// A model whose sizes the compiler knows. In a rotor of one mode the loops over coordinates cost
// more than the arithmetic: the fixed steps are compiled for the layouts of a Jeffcott rotor too.
#pragma once

#include <array>
#include <type_traits>

#include "native_model/numerics/lanes.h"
#include "native_model/system/model.h"

namespace rotorub {

// As Layout, without torsion, a ring that turns and coils.
template <int kModes, int kSpin, int kStator>
struct SmallLayout {
  static constexpr int modes = kModes, spin = kSpin, torsion = 0, stator = kStator;
  static constexpr int ring_spin = 0, integrals = 0, coils = 0;
  static constexpr int phi() { return 2 * modes; }
  static constexpr int theta() { return phi() + spin; }
  static constexpr int ring() { return theta(); }
  static constexpr int ring_angle() { return ring() + stator; }
  static constexpr int integral() { return ring_angle(); }
  static constexpr int coil() { return integral(); }
  static constexpr int mechanical() { return coil(); }
  static constexpr int nq() { return coil(); }
  static bool fits(const Layout& l) {
    return l.modes == modes && l.spin == spin && l.torsion == 0 && l.stator == stator &&
           l.ring_spin == 0 && l.integrals == 0 && l.coils == 0;
  }
};

// One mode in each plane: with the spin held and the ring fixed; in a moving ring; driven, in one.
using Jeffcott = SmallLayout<1, 0, 0>;
using JeffcottInRing = SmallLayout<1, 0, 2>;
using DrivenJeffcottInRing = SmallLayout<1, 1, 2>;

// X(L, ...) for each layout L that is compiled.
#define ROTORUB_SMALL_LAYOUTS(X, ...) \
  X(Jeffcott, __VA_ARGS__) X(JeffcottInRing, __VA_ARGS__) X(DrivenJeffcottInRing, __VA_ARGS__)

// M (a Model or a LaneModel) with the layout L.
template <class M, class L>
struct Sized : M {
  explicit Sized(const M& m) : M(m) {}
  static constexpr L layout{};
};

template <class M>
using LayoutOf = std::remove_cvref_t<decltype(M::layout)>;

// A number for each coordinate of M.
template <class M>
struct CoordinateArray {
  using Type = lanes::Array<typename M::Scalar>;
  using Scratch = Type&;
  static Type make(const M& m) { return Type(static_cast<std::size_t>(m.layout.nq()), {}); }
};
template <class M, class L>
struct CoordinateArray<Sized<M, L>> {
  using Type = std::array<typename M::Scalar, static_cast<std::size_t>(L::nq())>;
  using Scratch = Type;
  static Type make(const Sized<M, L>&) { return {}; }
};

}  // namespace rotorub
