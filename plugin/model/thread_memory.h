// What a thread remembers, by key, however many it takes in turns. What nobody asked for in the
// last kAsked questions goes when their number has doubled: a model that is gone is not kept for
// ever.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "plugin/model/config.h"

namespace rotorub::plugin {

template <typename Key, typename Value>
class InTurns {
 public:
  // Null: none. What is found stays while it is asked for.
  Value* find(const Key& key) {
    if (last_ == all_.end() || last_->first != key) last_ = all_.find(key);
    if (last_ == all_.end()) return nullptr;
    last_->second.asked = ++asked_;
    return &last_->second.value;
  }
  Value& add(const Key& key, Value value) {
    if (all_.size() >= room_) sweep();
    last_ = all_.insert_or_assign(key, Kept{std::move(value), ++asked_}).first;
    return last_->second.value;
  }

 private:
  struct Kept {
    Value value;
    std::uint64_t asked;
  };

  void sweep() {
    last_ = all_.end();
    std::erase_if(all_, [this](const auto& kept) { return kept.second.asked + kAsked < asked_; });
    room_ = std::max(kLeast, 2 * all_.size());
  }

  static constexpr std::size_t kLeast = 64;
  static constexpr std::uint64_t kAsked = 1 << 18;  // some ten a step
  std::map<Key, Kept> all_;
  typename std::map<Key, Kept>::iterator last_ = all_.end();
  std::size_t room_ = kLeast;
  std::uint64_t asked_ = 0;
};

// What a thread steps models with: room, and nothing that outlives a call, so that several threads
// may step several mjData of one model. A worker has a model of its own, as the Config may be gone
// before the thread is.
//
// This thread's Worker for the model and the step h (s), made where it is new or was long not used.
// Worker(const Config&, double h).
template <class Worker>
Worker& thread_worker(const Config& config, double h) {
  thread_local InTurns<std::pair<double, double>, std::unique_ptr<Worker>> known;
  const std::pair key{config.id, h};
  if (const auto* worker = known.find(key)) return **worker;
  return *known.add(key, std::make_unique<Worker>(config, h));
}

}  // namespace rotorub::plugin
