// The functions that stand in MuJoCo's places (places.h): kLinks of them a place, of one work.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <type_traits>
#include <utility>

#include "plugin/actuators.h"
#include "plugin/places.h"

namespace rotorub::plugin {

template <typename Function>
using LinkTable = std::array<Function, kLinks>;

// Of a class with a template function `link<K>`.
template <class Of, typename Function>
constexpr LinkTable<Function> make_links() {
  return []<int... K>(std::integer_sequence<int, K...>) {
    return LinkTable<Function>{&Of::template link<K>...};
  }
  (std::make_integer_sequence<int, kLinks>());
}

// What was there first, then kWork(m, d, ...), once a call of the place.
template <typename Function, auto& kPlace, auto kWork>
struct LinksOf;

template <typename... Rest, auto& kPlace, auto kWork>
struct LinksOf<void (*)(const mjModel*, mjData*, Rest...), kPlace, kWork> {
  using Function = void (*)(const mjModel*, mjData*, Rest...);
  static inline thread_local constinit LinkCall call;

  template <int K>
  static void link(const mjModel* m, mjData* d, Rest... rest) {
    const Function previous = kPlace.previous(K);
    if (!kPlace.layered()) {
      if (previous) previous(m, d, rest...);
      kWork(m, d, rest...);
      return;
    }
    LinkScope scope(call, d, K);
    if (previous && !scope.again() && scope.reaches([&] { previous(m, d, rest...); })) {
      kPlace.let_in_front(K);
    }
    if (scope.begin_work()) kWork(m, d, rest...);
  }
  static constexpr LinkTable<Function> kTable = make_links<LinksOf, Function>();
};

template <auto& kPlace, auto kWork>
using Links = LinksOf<typename std::remove_reference_t<decltype(kPlace)>::Type, kPlace, kWork>;

// kWork(m, d, id, value) says true where the value is ours; else what was there gives it, or it is
// kDefault.
// kKind: of actuators.h. Ours stays in front, so that what it calls is asked once a pass.
template <auto& kPlace, auto kWork, int kDefault, int kKind>
struct Givers {
  static inline thread_local constinit LinkCall call;

  template <int K>
  static mjtNum link(const mjModel* m, const mjData* d, int id) {
    mjtNum value = kDefault;
    if (kWork(m, d, id, value)) return value;
    const mjfAct previous = kPlace.previous(K);
    if (!previous || answer_given(kKind, m, d, id, value)) return value;
    if (!kPlace.layered()) {
      value = previous(m, d, id);
    } else {
      LinkScope scope(call, d, K);
      if (scope.again()) return value;
      scope.reaches([&] { value = previous(m, d, id); });
    }
    keep_answer(kKind, d, id, value);
    return value;
  }
  static constexpr LinkTable<mjfAct> kTable = make_links<Givers, mjfAct>();
};

}  // namespace rotorub::plugin
