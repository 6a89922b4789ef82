#include "native_model/stepping/stepped_loads.h"

namespace rotorub {

double next_switch(const Model& model, double from, double end) {
  double next = end;
  const auto look_at = [&](double instant) {
    if (instant > from && instant < next) next = instant;
  };
  for (const AppliedForce& force : model.forces) {
    look_at(force.on);
    look_at(force.off);
  }
  for (const DiscUnbalance& unbalance : model.unbalances) look_at(unbalance.on);
  if (model.base) std::ranges::for_each(model.base->jumps(), look_at);
  for (const StationFeedback& f : model.feedbacks) std::ranges::for_each(f.works.all(), look_at);
  return next;
}

template <class T>
SteppedLoads<T>::SteppedLoads(const std::vector<const Model*>& models, double h)
    : based_(models.front()->base != nullptr), models_(models) {
  using lanes::set;
  const std::vector<AppliedForce>& first = models.front()->forces;
  loads_.resize(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    Load& to = loads_[i];
    to.kind = first[i].kind;
    synchronous_ = synchronous_ || to.kind == scene::ForceKind::kSynchronous;
    to.shape.x.assign(static_cast<std::size_t>(first[i].shape.x.size()), T{});
    to.shape.y = to.shape.x;
    for (int lane = 0; lane < lanes::kWidth<T>; ++lane) {
      const AppliedForce& from = models[static_cast<std::size_t>(lane)]->forces[i];
      to.of.push_back(&from);
      to.switched = to.switched || from.on > 0.0 || from.off < scene::kNever || from.ramp > 0.0;
      set(to.amplitude, lane, from.amplitude);
      set(to.frequency, lane, from.frequency);
      set(to.phase, lane, from.phase);
      set(to.vector_x, lane, from.vector.x());
      set(to.vector_y, lane, from.vector.y());
      set(to.on, lane, from.on);
      set(to.off, lane, std::max(from.on, from.off));
      set(to.ramp, lane, from.ramp);
      set(to.turn_cosine, lane, std::cos(from.frequency * h));
      set(to.turn_sine, lane, std::sin(from.frequency * h));
      put_lane(to.shape.x, from.shape.x, lane);
      put_lane(to.shape.y, from.shape.y, lane);
    }
  }
}

template class SteppedLoads<double>;
template class SteppedLoads<lanes::Lane<2>>;
template class SteppedLoads<lanes::Lane<4>>;
template class SteppedLoads<lanes::Lane<8>>;

}  // namespace rotorub
