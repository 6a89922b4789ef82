#include "plugin/model/user_data.h"

#include <bit>
#include <cstdint>
#include <cstdio>

#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

// Checksum of the entries that change only in the plugin's passes: the id of the config and the
// entries of the contacts. It lies in [1, 2), so it is never 0, the value that a reset leaves.
double check_of(const mjData* d, int memory, int size) {
  const mjtNum* entry = d->userdata + memory;
  std::uint64_t sum = std::bit_cast<std::uint64_t>(entry[0]);
  for (int i = kFirstContact; i < size; ++i) {
    sum = std::rotl(sum, 7) * 0x9e3779b97f4a7c15u ^ std::bit_cast<std::uint64_t>(entry[i]);
  }
  sum *= 0x9e3779b97f4a7c15u;
  return std::bit_cast<double>(sum >> 12 | std::uint64_t{0x3ff} << 52);
}

bool is_reset(const mjData* d, int memory, int size) {
  for (int i = 0; i < size; ++i) {
    if (d->userdata[memory + i] != 0.0) return false;
  }
  return true;
}

}  // namespace

bool block_is_ours(const Config& config, const mjData* d) {
  if (!config.own) return true;
  const mjtNum check = model_entries(config, d).sample;
  return check == 0.0 ? is_reset(d, config.memory, config.memory_size)
                      : check == check_of(d, config.memory, config.memory_size);
}

void seal_block(const Config& config, mjData* d) {
  if (!config.own) return;
  model_entries(config, d).sample = check_of(d, config.memory, config.memory_size);
}

void refuse_clash(const Config& config, const mjModel* m) {
  // mju_error may leave by longjmp, so nothing here may have a destructor.
  static thread_local char words[500];
  std::snprintf(words, sizeof words,
                "rotorub: mjData.userdata[%d] to [%d] hold the contacts' state, but something else "
                "has written there (nuserdata is %d); give another place by <custom><numeric "
                "name=\"rotorub_userdata\" data=\"...\"/>, the index of the first",
                config.memory, config.memory + config.memory_size - 1, count(m->nuserdata));
  raise_error(words);
}

}  // namespace rotorub::plugin
