// Contacts that are closed at the same time: the matrix through which they act on each other.
#pragma once

#include <Eigen/Core>
#include <span>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/kinematics.h"
#include "native_model/system/model.h"

namespace rotorub {

struct ClosedContact {
  std::size_t index = 0;  // of the auxiliary bearing
  ContactPoint point{};   // at the configuration in question
};

// Delassus's matrix G = W^T M^-1 W of all of them, rows and columns (normal, friction) of each in
// turn; 1/kg.
ContactMatrix delassus(const Model& model, double t, const double* q,
                       std::span<const ClosedContact> closed);

}  // namespace rotorub
