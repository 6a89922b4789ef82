// How many contacts of a rotor are solved together.
#pragma once

namespace rotorub {

inline constexpr int kMaxContacts = 8;

}  // namespace rotorub
