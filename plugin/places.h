// Places in MuJoCo's global callback tables, kept against programs that write over them.
//
// MuJoCo's callbacks are plain global pointers: `mjcb_control = mine`, `mjcb_control = nullptr` and
// mj_resetCallbacks() take ours away without a word. A Place notices (held), takes itself back
// (take) and calls what was put there before its own work. It has several functions of the same
// work, links, each with its own `previous`, so that of a user who chains to us, whichever of our
// links was saved, we know what to call below:
//
//   mjcb_control = mine                       link 1 in the place, previous: mine: mine, then ours
//   old = mjcb_control, mine calls old        mine stands in front again, once seen to call us
//   mjcb_control = nullptr                    link 2, previous: none: our work alone
//
// The work is done once a call of the place, whatever the chain. No lock is held while a function
// of others runs; the one that orders who takes is never touched while the place is as left.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <type_traits>
#include <utility>

#include "plugin/model/actuators.h"

namespace rotorub::plugin {

inline constexpr int kLinks = 8;

template <typename Function>
class Place {
 public:
  using Type = Function;

  // `global` may be null until stand_at; link_with comes before all else.
  constexpr explicit Place(Function* global = nullptr) : global_(global) {}
  void stand_at(Function* global) { global_ = global; }
  void link_with(const Function* links) { links_ = links; }

  // True where MuJoCo will call us: one of our links is in the place, or one who calls us.
  bool held() const {
    return std::atomic_ref(*global_).load(std::memory_order_acquire) ==
           expected_.load(std::memory_order_acquire);
  }
  Function previous(int link) const { return previous_[link].load(std::memory_order_acquire); }

  // Puts a link in front of who stands there, if that is neither ours nor calls us. True where it
  // did.
  bool take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::atomic_ref place(*global_);
    for (;;) {
      Function there = place.load();
      if (index_of(there) >= 0 || (there && there == chains_)) {
        expected_ = there;
        return false;
      }
      const int link = link_for(there);
      previous_[link] = there;
      if (place.compare_exchange_strong(there, links_[link])) {
        expected_ = links_[link];
        return true;
      }
    }
  }

  // What `link` calls first has called another of ours: it stays in front, as it put itself.
  void let_in_front(int link) {
    std::atomic_ref place(*global_);
    if (place.load() != links_[link]) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    Function ours = links_[link], theirs = previous_[link];
    if (!theirs || theirs == deceives_) return;
    chains_ = theirs;
    if (place.compare_exchange_strong(ours, theirs)) expected_ = theirs;
  }

  // Who stands in front has called us before, and now has not: it is never let in front again. True
  // where it was so.
  bool distrust() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const Function there = std::atomic_ref(*global_).load();
      if (!there || there != chains_) return false;
      deceives_ = std::exchange(chains_, nullptr);
    }
    return take();
  }

  // Where a link of ours is in the place, what it calls first goes back there. Others stay.
  void give_back() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::atomic_ref place(*global_);
    for (;;) {
      Function there = place.load();
      const int link = index_of(there);
      if (link < 0 || place.compare_exchange_strong(there, previous_[link].load())) return;
    }
  }

 private:
  int index_of(Function f) const {
    for (int i = 0; i < kLinks; ++i) {
      if (links_[i] == f) return i;
    }
    return -1;
  }
  // One that calls this already, a new one, or the one that was used longest ago.
  int link_for(Function there) {
    for (int i = 0; i < used_; ++i) {
      if (previous_[i].load() == there) return i;
    }
    if (used_ < kLinks) return used_++;
    oldest_ = (oldest_ + 1) % kLinks;
    return oldest_;
  }

  Function* global_;
  const Function* links_ = nullptr;
  std::atomic<Function> expected_{nullptr};
  std::atomic<Function> previous_[kLinks] = {};

  std::mutex mutex_;  // of who changes the place
  int used_ = 0, oldest_ = 0;
  Function chains_ = nullptr;    // seen to call us
  Function deceives_ = nullptr;  // and not to
};

// What a thread is in: the links of one place that wait for what they called. Kept on the stack of
// the first of them. A frame that was left by longjmp (mju_error of a model that is compiled) is
// recognised by its address: it is not above ours.
struct LinkCall {
  const void* data = nullptr;  // mjData
  std::uintptr_t frame = 0;
  unsigned inside = 0;   // bits of the links
  bool reached = false;  // one link was reached from another
  bool done = false;     // the work
};

class LinkScope {
 public:
  LinkScope(LinkCall& call, const void* data, int link)
      : call_(call), outer_(call), bit_(1u << link) {
    const auto frame = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
    nested_ = call.inside != 0 && call.data == data && call.frame > frame;
    if (!nested_) call = {data, frame, 0, false, false};
    again_ = (call.inside & bit_) != 0;
    if (nested_ && !again_) call.reached = true;
  }
  ~LinkScope() {
    if (!nested_) call_ = outer_;
  }
  LinkScope(const LinkScope&) = delete;
  LinkScope& operator=(const LinkScope&) = delete;

  // True in a link that was called by what it called itself.
  bool again() const { return again_; }
  // Runs what the link calls first, unless it is under way; true where that reached another link.
  template <typename Call>
  bool reaches(Call call) {
    if (again_) return false;
    const bool reached = call_.reached;
    call_.reached = false;
    call_.inside |= bit_;
    call();
    call_.inside &= ~bit_;
    const bool now = call_.reached;
    call_.reached = reached || now;
    return now;
  }
  // True once.
  bool begin_work() {
    const bool first = !call_.done;
    call_.done = true;
    return first;
  }

 private:
  LinkCall& call_;
  LinkCall outer_;
  unsigned bit_;
  bool nested_, again_;
};

// The functions that stand in MuJoCo's places: kLinks of them a place, of one work.
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
    LinkScope scope(call, d, K);
    if (previous && scope.reaches([&] { previous(m, d, rest...); })) kPlace.let_in_front(K);
    if (scope.begin_work()) kWork(m, d, rest...);
  }
  static constexpr LinkTable<Function> kTable = make_links<LinksOf, Function>();
};

template <auto& kPlace, auto kWork>
using Links = LinksOf<typename std::remove_reference_t<decltype(kPlace)>::Type, kPlace, kWork>;

// kWork(m, d, id, value) says true where the value is ours; else what was there gives it, or it is
// MuJoCo's: a gain of 1, and 0. Ours stays in front, so that what it calls is asked once a pass.
template <auto& kPlace, auto kWork, ActuatorQuestion kAsked>
struct Givers {
  static inline thread_local constinit LinkCall call;

  template <int K>
  static mjtNum link(const mjModel* m, const mjData* d, int id) {
    mjtNum value = kAsked == ActuatorQuestion::kGain ? 1.0 : 0.0;
    if (kWork(m, d, id, value)) return value;
    const mjfAct previous = kPlace.previous(K);
    if (!previous || answer_given(kAsked, m, d, id, value)) return value;
    LinkScope scope(call, d, K);
    if (scope.again()) return value;
    scope.reaches([&] { value = previous(m, d, id); });
    keep_answer(kAsked, d, id, value);
    return value;
  }
  static constexpr LinkTable<mjfAct> kTable = make_links<Givers, mjfAct>();
};

}  // namespace rotorub::plugin
