// Memory of a thread, by key. Several keys may be used in turns. When the number of entries has
// doubled, those that were not used in the last kAsked look-ups are deleted, so that models which
// no longer exist are not kept for ever.
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
  // Null if there is none. An entry stays valid as long as it is used.
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
  static constexpr std::uint64_t kAsked = 1 << 18;  // there are about ten look-ups in a step
  std::map<Key, Kept> all_;
  typename std::map<Key, Kept>::iterator last_ = all_.end();
  std::size_t room_ = kLeast;
  std::uint64_t asked_ = 0;
};

// This thread's Worker for the model and the step h (s). It is made if it is new or was not used
// for long. The Worker only holds working memory, and nothing that outlives a call, so that several
// threads can step several mjData of one model. It has its own copy of the model, because the
// Config may be destroyed before the thread ends. Constructor: Worker(const Config&, double h).
template <class Worker>
Worker& thread_worker(const Config& config, double h) {
  thread_local InTurns<std::pair<double, double>, std::unique_ptr<Worker>> known;
  const std::pair key{config.id, h};
  if (const auto* worker = known.find(key)) return **worker;
  return *known.add(key, std::make_unique<Worker>(config, h));
}

}  // namespace rotorub::plugin
