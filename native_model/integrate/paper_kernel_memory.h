// What a scalar PaperKernel carries from one step to the next, as plain numbers: the time origin,
// the state, whether contact lasts, the angles of rotating forces (turned step by step between
// exact sines), and the directions of unbalance that project() has from the step before.
#pragma once

#include <algorithm>
#include <cassert>

#include "native_model/integrate/paper_kernel.h"

namespace rotorub {

template <class T>
template <class Kernel, class Action>
void PaperKernel<T>::for_each_kept(Kernel& kernel, Action action) {
  action(kernel.origin);
  action(kernel.in_contact_);
  for (auto& q : kernel.q_) action(q);
  for (auto& v : kernel.v_) action(v);
  for (auto& force : kernel.forces_) {
    if (!force.rotating) continue;
    action(force.cosine);
    action(force.sine);
  }
  for (auto& arm : kernel.arm_x_) action(arm);
  for (auto& arm : kernel.arm_y_) action(arm);
}

template <class T>
const double* PaperKernel<T>::saved_q(const double* memory) {
  return memory + 2;  // behind origin and contact
}

template <class T>
void PaperKernel<T>::begin(double t, const double* q, const double* v) {
  static_assert(kLanes == 1);
  for_each_kept(*this, [](double& value) { value = 0.0; });
  origin = t;
  std::copy_n(q, layout_.nq(), q_.begin());
  std::copy_n(v, layout_.nq(), v_.begin());
  status[0] = Status::kOk;
  failed_ = false;
}

template <class T>
std::size_t PaperKernel<T>::memory_size(const Model& model) {
  std::size_t size = 2 + 2 * static_cast<std::size_t>(model.nq());
  for (const AppliedForce& force : model.forces) {
    if (force.kind == scene::ForceKind::kRotating) size += 2;
  }
  if (model.coupled_mass()) size += 2 * static_cast<std::size_t>(model.layout.modes);
  return size;
}

template <class T>
void PaperKernel<T>::save(double* to) const {
  static_assert(kLanes == 1);
  [[maybe_unused]] const double* const begin = to;
  for_each_kept(*this, [&to](const double& value) { *to++ = value; });
  assert(static_cast<std::size_t>(to - begin) == memory_size(*models_.front()));
}

template <class T>
void PaperKernel<T>::restore(const double* from) {
  static_assert(kLanes == 1);
  for_each_kept(*this, [&from](double& value) { value = *from++; });
  status[0] = Status::kOk;
  failed_ = false;
}

}  // namespace rotorub
