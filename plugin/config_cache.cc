#include "plugin/config_cache.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>

#include "plugin/fingerprint.h"
#include "plugin/in_turns.h"
#include "plugin/model_parameters.h"
#include "plugin/mujoco_versions.h"
#include "plugin/own/own_config.h"
#include "plugin/own/user_block.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

using ConfigPointer = std::shared_ptr<const Config>;

// Whether config is still m's.
bool fits(const Config& config, const mjModel* m) {
  return has_fingerprint(m, config.fingerprint) && has_parameters(config, m);
}

// The configs that a thread of the process holds, so that threads share one.
class Registry {
 public:
  ConfigPointer find_or_make(const mjModel* m) {
    const ModelHash hash = model_hash(m);
    ConfigPointer near;
    if (ConfigPointer known = find(m, hash, &near)) return known;
    // No lock while it is made.
    ConfigPointer made =
        std::make_shared<const Config>(near ? with_parameters(*near, m) : make_config(m));
    const std::lock_guard<std::mutex> lock(mutex_);
    if (ConfigPointer known = among(m, hash.numbers)) return known;  // by another thread meanwhile
    if (all_.size() >= room_) sweep();
    all_.emplace(hash.numbers, made);
    latest_[hash.kind] = made;
    return made;
  }

 private:
  // Null, and in `near` one of the same fingerprint, whose numbers are others, if there is one.
  ConfigPointer find(const mjModel* m, const ModelHash& hash, ConfigPointer* near) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (ConfigPointer known = among(m, hash.numbers)) return known;
    const auto at = latest_.find(hash.kind);
    if (at != latest_.end()) *near = at->second.lock();
    if (*near && !(has_fingerprint(m, (*near)->fingerprint) && same_motion(**near, m)))
      near->reset();
    return nullptr;
  }
  ConfigPointer among(const mjModel* m, std::uint64_t numbers) const {
    const auto [first, last] = all_.equal_range(numbers);
    for (auto at = first; at != last; ++at) {
      ConfigPointer config = at->second.lock();
      if (config && fits(*config, m) && same_motion(*config, m)) return config;
    }
    return nullptr;
  }
  // Those that no thread holds any more.
  void sweep() {
    const auto gone = [](const auto& entry) { return entry.second.expired(); };
    std::erase_if(all_, gone);
    std::erase_if(latest_, gone);
    room_ = std::max<std::size_t>(64, 2 * all_.size());
  }

  using Held = std::weak_ptr<const Config>;
  std::mutex mutex_;
  std::unordered_multimap<std::uint64_t, Held> all_;
  std::unordered_map<std::uint64_t, Held> latest_;  // of each fingerprint
  std::size_t room_ = 64;
};

// Never destroyed: other threads may still step when the process ends.
Registry& registry() {
  static Registry* const all = new Registry;
  return *all;
}

struct Known {
  ConfigPointer config;  // null: of somebody else, by the names in its <custom>:
  std::string names;
  const mjData* compared = nullptr;  // whose pass has compared them, and its time
  double time = 0.0;
};
thread_local InTurns<const mjModel*, Known> recent;

// The names in <custom>, which MuJoCo has one behind the other.
std::string_view custom_names(const mjModel* m) {
  const char* begin = m->names + count(m->nnames);
  const char* end = m->names;
  const auto include = [&](const int* addresses, int n) {
    if (n == 0) return;
    const char* last = m->names + addresses[n - 1];
    begin = std::min<const char*>(begin, m->names + addresses[0]);
    end = std::max(end, last + std::strlen(last));
  };
  include(m->name_numericadr, count(m->nnumeric));
  include(m->name_textadr, count(m->ntext));
  return {begin, static_cast<std::size_t>(end - begin)};
}

// Compared once in a pass, as an address may be another model's by now.
bool is_still_foreign(Known& known, const mjModel* m, const mjData* d, bool check) {
  if (!check) {
    known.compared = nullptr;
    return true;
  }
  if (known.compared == d && known.time == d->time) return true;
  known.compared = d;
  known.time = d->time;
  return known.names == custom_names(m);
}

// mju_error may leave by longjmp (it does while a model is compiled): nothing with a destructor
// lives in the frame that calls it.
thread_local char raised_text[1000];

const Config* look_up(const mjModel* m) {
  try {
    const Known* known = recent.find(m);
    if (known && known->config && fits(*known->config, m) && same_motion(*known->config, m))
      return known->config.get();
    return recent.add(m, {registry().find_or_make(m), {}}).config.get();
  } catch (const std::exception& error) {
    std::snprintf(raised_text, sizeof raised_text, "%s", error.what());
  }
  return nullptr;
}

// The mark that mjData carries.
bool is_marked(const mjModel* m, const mjData* d, const Config& config) {
  return m->nuserdata > config.memory + kConfigId &&
         config.id == d->userdata[config.memory + kConfigId];
}

const Config* find(const mjModel* m, const mjData* d, bool check) {
  if (m->ntext == 0 && m->nnumeric == 0) return nullptr;
  if (Known* known = recent.find(m)) {
    if (!known->config) {
      if (is_still_foreign(*known, m, d, check)) return nullptr;
    } else if (is_marked(m, d, *known->config) && (!check || fits(*known->config, m))) {
      return known->config.get();
    }
  }
  if (!is_ours(m)) {
    recent.add(m, {nullptr, std::string(custom_names(m)), check ? d : nullptr, d->time});
    return nullptr;
  }
  const Config* config = look_up(m);
  if (!config) {
    raise_error(raised_text);
    return nullptr;
  }
  if (!block_is_ours(*config, d)) {
    refuse_clash(*config, m);
    return nullptr;
  }
  d->userdata[config->memory + kConfigId] = config->id;
  seal_block(*config, d);
  return config;
}

}  // namespace

const Config* find_config(const mjModel* m, const mjData* d) { return find(m, d, false); }
const Config* find_config_checked(const mjModel* m, const mjData* d) { return find(m, d, true); }

}  // namespace rotorub::plugin
