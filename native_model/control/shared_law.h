// A user's law from a shared library, through the C functions of rotorub/controller.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "native_model/control/law.h"

namespace rotorub {

// "follow (law.so)", the shared library whose code runs in this thread; null if none does.
// Async-signal-safe.
const char* running_law();

template <class Kind>
class SharedLaw final : public Law<Kind> {
 public:
  // Loads the library and checks its ABI and functions. Throws std::runtime_error.
  explicit SharedLaw(const std::filesystem::path& file);
  ~SharedLaw() override;
  SharedLaw(const SharedLaw&) = delete;
  SharedLaw& operator=(const SharedLaw&) = delete;

  std::string name() const override { return name_; }
  std::uint32_t command() const override;
  std::string create(const typename Kind::Setup& setup) override;
  std::size_t state_size() const override { return state_size_; }
  void start(double* state) const override;
  std::string step(const typename Kind::Measurement& now, double* state,
                   double* output) const override;

 private:
  std::shared_ptr<void> library_;  // keeps `functions_` valid
  const typename Kind::Functions* functions_ = nullptr;
  void* self_ = nullptr;
  bool created_ = false;
  std::size_t state_size_ = 0;
  std::string name_;
  std::string shown_;  // for running_law()
};

}  // namespace rotorub
