// The colours of the pictures. Each has the same meaning in every view.
#pragma once

#include <cstddef>
#include <iterator>

namespace rotorub::renders {

struct Color {
  float red, green, blue;
  float alpha = 1.0F;

  Color with_alpha(double value) const { return {red, green, blue, static_cast<float>(value)}; }
};

namespace palette {

// Multiples of 1/255, so that MuJoCo's picture and the flat parts beside it have the same shade.
inline constexpr Color kBackground{244 / 255.0F, 246 / 255.0F, 250 / 255.0F};
inline constexpr Color kPaper{1.0F, 1.0F, 1.0F};
inline constexpr Color kGrid{0.80F, 0.83F, 0.87F};
inline constexpr Color kFuture{0.70F, 0.75F, 0.83F};  // part of a curve that is not yet reached
inline constexpr Color kInk{0.13F, 0.16F, 0.21F};
inline constexpr Color kFaintInk{0.55F, 0.59F, 0.65F};
inline constexpr Color kShaft{0.66F, 0.69F, 0.74F};
inline constexpr Color kDisc{0.53F, 0.58F, 0.65F};
inline constexpr Color kRotor{0.36F, 0.52F, 0.74F};  // the body that can touch the ring
inline constexpr Color kRotorEdge{0.13F, 0.27F, 0.47F};
inline constexpr Color kMark{0.74F, 0.86F, 1.0F};  // turns with the rotor
inline constexpr Color kRing{0.86F, 0.67F, 0.33F};
inline constexpr Color kRingEdge{0.50F, 0.34F, 0.08F};
inline constexpr Color kHousing{0.42F, 0.46F, 0.52F};
inline constexpr Color kPlate{0.80F, 0.83F, 0.87F};
inline constexpr Color kPenumbra{0.73F, 0.76F, 0.80F};  // shadows on the plate
inline constexpr Color kUmbra{0.66F, 0.69F, 0.74F};
inline constexpr Color kMotor{0.25F, 0.42F, 0.40F};
inline constexpr Color kCopper{0.76F, 0.45F, 0.27F};
inline constexpr Color kNormal{0.84F, 0.10F, 0.13F};    // normal force, point of contact
inline constexpr Color kFriction{0.05F, 0.52F, 0.28F};  // friction force
inline constexpr Color kControl{0.80F, 0.36F, 0.0F};    // force of the actuator on the ring
inline constexpr Color kCurrent{0.76F, 0.10F, 0.55F};   // current of a coil
inline constexpr Color kLoad{0.32F, 0.22F, 0.62F};      // external force on the shaft
inline constexpr Color kStrike{1.0F, 0.74F, 0.10F};     // a recent impact
inline constexpr Color kTrail{0.09F, 0.24F, 0.60F};     // path of the rotor's centre
inline constexpr Color kGhost{0.56F, 0.20F, 0.70F};     // the second trajectory

// The colour of a contact's name and curves where there are several.
inline Color contact(std::size_t k) {
  constexpr Color kContacts[] = {
      kTrail, {0.0F, 0.56F, 0.60F}, {0.55F, 0.34F, 0.12F}, {0.35F, 0.60F, 0.10F}};
  return kContacts[k % std::size(kContacts)];
}

}  // namespace palette
}  // namespace rotorub::renders
