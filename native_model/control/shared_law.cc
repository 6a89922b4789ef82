#include "native_model/control/shared_law.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <exception>
#include <stdexcept>
#include <type_traits>

#include "native_model/scene/text.h"

namespace rotorub {
namespace {

constexpr std::size_t kReasonRoom = 512;  // bytes
constexpr std::size_t kNameRoom = 80;     // bytes

thread_local constinit const char* running = nullptr;

// Names the law while its code runs. The library's own threads are not known.
class Running {
 public:
  explicit Running(const std::string& law) : before_(running) { running = law.c_str(); }
  ~Running() { running = before_; }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  const char* before_;
};

std::shared_ptr<void> opened(const std::filesystem::path& file) {
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* why = dlerror();
    std::string text = scene::printable(why != nullptr ? why : "cannot be loaded", kReasonRoom);
    if (text.ends_with("invalid ELF header") || text.ends_with("file too short"))
      text += ". Give a shared library (.so) or a Python file (.py).";
    throw std::runtime_error(text);
  }
  return {handle, [](void* h) { dlclose(h); }};
}

// Calls `action` of the library. Returns an empty string if it succeeds (returns 0), otherwise its
// reason, which need not end with 0; an exception counts as a failure.
template <typename Action>
std::string failure_of(Action action) {
  std::array<char, kReasonRoom> reason{};
  try {
    if (action(reason.data()) == 0) return "";
  } catch (const std::exception& error) {
    return scene::printable(error.what(), kReasonRoom);
  } catch (...) {
    return "it threw something that is not a std::exception";
  }
  const std::string text(reason.begin(), std::find(reason.begin(), reason.end(), '\0'));
  return text.empty() ? "no reason given" : scene::printable(text, kReasonRoom);
}

// The message about a library without the function of this kind of law. It may have the function of
// the other kind.
template <class Kind>
std::string absent(void* library, const std::filesystem::path& file) {
  constexpr bool is_ring = std::is_same_v<Kind, RingLaw>;
  using Other = std::conditional_t<is_ring, MagneticLaw, RingLaw>;
  const std::string name = scene::printable(file.filename().string(), kNameRoom);
  if (dlsym(library, Other::kSymbol) == nullptr) {
    return name + " does not export " + Kind::kSymbol + ", so it is not a controller for " +
           (is_ring ? "rotorub" : "magnetic bearings") + " (see rotorub/controller.h).";
  }
  const std::string commands = name + " commands " + (is_ring ? "magnetic bearings" : "a ring") +
                               " (" + Other::kSymbol + "), but this key sets " +
                               (is_ring ? "a ring's controller" : "the law of magnetic bearings");
  return commands + ". Set [" + (is_ring ? "magnetic_control" : "controller") +
         "] kind = \"library\" and library = \"" + name + "\".";
}

}  // namespace

const char* running_law() { return running; }

template <class Kind>
SharedLaw<Kind>::SharedLaw(const std::filesystem::path& file) : library_(opened(file)) {
  const auto refuse = [&file](const std::string& why) {
    throw std::runtime_error(file.string() + ": " + why);
  };
  const auto get =
      reinterpret_cast<const typename Kind::Functions* (*)()>(dlsym(library_.get(), Kind::kSymbol));
  if (get == nullptr) throw std::runtime_error(absent<Kind>(library_.get(), file));
  functions_ = get();
  if (functions_ == nullptr) refuse("returns no controller");
  if (functions_->abi != Kind::kAbi) {
    refuse("has controller ABI " + std::to_string(functions_->abi) +
           ", but this program needs ABI " + std::to_string(Kind::kAbi) +
           ". Rebuild it with this program's rotorub/controller.h.");
  }
  if (functions_->create == nullptr || functions_->step == nullptr)
    refuse("has no create() or no step()");
  name_ = functions_->name != nullptr ? scene::printable(functions_->name, kNameRoom)
                                      : file.filename().string();
  shown_ = name_ + " (" + scene::printable(file.filename().string(), kNameRoom) + ")";
}

template <class Kind>
SharedLaw<Kind>::~SharedLaw() {
  const Running here(shown_);
  if (created_ && functions_->destroy != nullptr) functions_->destroy(self_);
}

template <class Kind>
std::uint32_t SharedLaw<Kind>::command() const {
  if constexpr (std::is_same_v<Kind, RingLaw>)
    return functions_->command;
  else
    return ROTORUB_CURRENT;
}

template <class Kind>
std::string SharedLaw<Kind>::create(const typename Kind::Setup& setup) {
  const Running here(shown_);
  const std::string failed = failure_of(
      [&](char* reason) { return functions_->create(&setup, &self_, reason, kReasonRoom); });
  if (!failed.empty()) return failed;
  created_ = true;
  if (functions_->state_size != nullptr) state_size_ = functions_->state_size(self_);
  return "";
}

template <class Kind>
void SharedLaw<Kind>::start(double* state) const {
  const Running here(shown_);
  if (functions_->start != nullptr) functions_->start(self_, state);
}

template <class Kind>
std::string SharedLaw<Kind>::step(const typename Kind::Measurement& now, double* state,
                                  double* output) const {
  const Running here(shown_);
  return failure_of([&](char* reason) {
    return functions_->step(self_, &now, state, output, reason, kReasonRoom);
  });
}

template class SharedLaw<RingLaw>;
template class SharedLaw<MagneticLaw>;

}  // namespace rotorub
