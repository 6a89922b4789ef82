// Slots of MuJoCo's global callback tables, kept against programs that overwrite them.
//
// MuJoCo's callbacks are plain global pointers: `mjcb_control = mine`, `mjcb_control = nullptr` and
// mj_resetCallbacks() silently remove the plugin's. A CallbackSlot notices this (reaches_plugin),
// takes itself back (take), and calls the function that was put there before doing its own work. It
// has several functions for the same work, called links, each with its own `previous`. If a user's
// function calls the plugin's, it may have saved any of the links, and each link knows what to call
// next:
//
//   mjcb_control = mine                       link 1 in the slot, previous: mine. mine runs first,
//                                             then the plugin
//   old = mjcb_control, mine calls old        mine may stand in front again once it has been seen
//                                             to call the plugin
//   mjcb_control = nullptr                    link 2, previous: none. Only the plugin works
//
// The work is done once in each call of the slot, whatever the chain. No lock is held while a
// foreign function runs; the lock that orders changes is not touched while the slot is unchanged.
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
class CallbackSlot {
 public:
  using Type = Function;

  // `global` may be null until set_global(). Call link_with() before everything else.
  constexpr explicit CallbackSlot(Function* global = nullptr) : global_(global) {}
  void set_global(Function* global) { global_ = global; }
  void link_with(const Function* links) { links_ = links; }

  // True if MuJoCo will call the plugin: one of its links is in the slot, or a function that calls
  // it.
  bool reaches_plugin() const {
    return std::atomic_ref(*global_).load(std::memory_order_acquire) ==
           expected_.load(std::memory_order_acquire);
  }
  Function previous(int link) const { return previous_[link].load(std::memory_order_acquire); }

  // Puts a link in front of the present function, unless that is a link or calls one. True if it
  // did so.
  bool take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::atomic_ref slot(*global_);
    for (;;) {
      Function there = slot.load();
      if (index_of(there) >= 0 || (there && there == chains_)) {
        expected_ = there;
        return false;
      }
      const int link = link_for(there);
      previous_[link] = there;
      if (slot.compare_exchange_strong(there, links_[link])) {
        expected_ = links_[link];
        return true;
      }
    }
  }

  // Call it if the function that `link` calls first has called another link: that function may
  // stand in front, as it was installed.
  void let_in_front(int link) {
    std::atomic_ref slot(*global_);
    if (slot.load() != links_[link]) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    Function ours = links_[link], theirs = previous_[link];
    if (!theirs || theirs == untrusted_) return;
    chains_ = theirs;
    if (slot.compare_exchange_strong(ours, theirs)) expected_ = theirs;
  }

  // Call it if the function in front called the plugin before and did not call it now. It is then
  // never let in front again. True if this was the case.
  bool distrust() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const Function there = std::atomic_ref(*global_).load();
      if (!there || there != chains_) return false;
      untrusted_ = std::exchange(chains_, nullptr);
    }
    return take();
  }

  // If a link is in the slot, restores the function that the link calls first. A foreign function
  // stays.
  void give_back() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::atomic_ref slot(*global_);
    for (;;) {
      Function there = slot.load();
      const int link = index_of(there);
      if (link < 0 || slot.compare_exchange_strong(there, previous_[link].load())) return;
    }
  }

 private:
  int index_of(Function f) const {
    for (int i = 0; i < kLinks; ++i) {
      if (links_[i] == f) return i;
    }
    return -1;
  }
  // A link that calls this function already, or a new one, or the one that was used longest ago.
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

  std::mutex mutex_;  // held while the slot is changed
  int used_ = 0, oldest_ = 0;
  Function chains_ = nullptr;     // foreign function that was seen to call the plugin
  Function untrusted_ = nullptr;  // foreign function that once called it and then did not
};

// The links of one slot that are running in a thread, while they wait for the functions that they
// called. The first of them keeps this on its stack. A frame that was left by longjmp (mju_error of
// a model that is compiled) is recognised by its address, which is not above the present one.
struct LinkCall {
  const void* data = nullptr;  // mjData
  std::uintptr_t frame = 0;
  unsigned inside = 0;   // one bit for each running link
  bool reached = false;  // true if one link was reached from another
  bool done = false;     // true if the work is done
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

  // True in a link that was called by the function that it called itself.
  bool again() const { return again_; }
  // Runs the function that the link calls first, unless it is running. True if that reached another
  // link.
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
  // True once in each call of the slot.
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

// The functions for MuJoCo's slots: kLinks for each slot, all with the same work.
template <typename Function>
using LinkTable = std::array<Function, kLinks>;

// Makes the table of a class with a template function `link<K>`.
template <class Of, typename Function>
constexpr LinkTable<Function> make_links() {
  return []<int... K>(std::integer_sequence<int, K...>) {
    return LinkTable<Function>{&Of::template link<K>...};
  }
  (std::make_integer_sequence<int, kLinks>());
}

// Calls the previous function, then kWork(m, d, ...), once in each call of the slot.
template <typename Function, auto& kSlot, auto kWork>
struct LinksOf;

template <typename... Rest, auto& kSlot, auto kWork>
struct LinksOf<void (*)(const mjModel*, mjData*, Rest...), kSlot, kWork> {
  using Function = void (*)(const mjModel*, mjData*, Rest...);
  static inline thread_local constinit LinkCall call;

  template <int K>
  static void link(const mjModel* m, mjData* d, Rest... rest) {
    const Function previous = kSlot.previous(K);
    LinkScope scope(call, d, K);
    if (previous && scope.reaches([&] { previous(m, d, rest...); })) kSlot.let_in_front(K);
    if (scope.begin_work()) kWork(m, d, rest...);
  }
  static constexpr LinkTable<Function> kTable = make_links<LinksOf, Function>();
};

template <auto& kSlot, auto kWork>
using Links = LinksOf<typename std::remove_reference_t<decltype(kSlot)>::Type, kSlot, kWork>;

// kWork(m, d, id, value) returns true if the value is the plugin's. Otherwise the value comes from
// the previous function, or it is MuJoCo's default: 1 for a gain, else 0. The plugin stays in
// front, so that the previous function is called once in a pass.
template <auto& kSlot, auto kWork, ActuatorQuestion kAsked>
struct ActuatorLinks {
  static inline thread_local constinit LinkCall call;

  template <int K>
  static mjtNum link(const mjModel* m, const mjData* d, int id) {
    mjtNum value = kAsked == ActuatorQuestion::kGain ? 1.0 : 0.0;
    if (kWork(m, d, id, value)) return value;
    const mjfAct previous = kSlot.previous(K);
    if (!previous || answer_given(kAsked, m, d, id, value)) return value;
    LinkScope scope(call, d, K);
    if (scope.again()) return value;
    scope.reaches([&] { value = previous(m, d, id); });
    keep_answer(kAsked, d, id, value);
    return value;
  }
  static constexpr LinkTable<mjfAct> kTable = make_links<ActuatorLinks, mjfAct>();
};

}  // namespace rotorub::plugin
