#include "native_model/scene/file_name.h"

#include <functional>
#include <mutex>
#include <set>

namespace rotorub::scene {

const std::string& FileName::kept(std::string_view name) {
  static const std::string none;
  if (name.empty()) return none;
  static std::mutex mutex;
  static auto* const names = new std::set<std::string, std::less<>>;  // outlives every user
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = names->find(name);
  return found != names->end() ? *found : *names->emplace(name).first;
}

}  // namespace rotorub::scene
