// A user's law in Python: a file with the functions of rotorub/controller.h, run by a Python
// process (mjcf/docs/own_controller.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/control/law.h"
#include "native_model/control/python_process.h"

namespace rotorub {

template <class Kind>
class PythonLaw final : public Law<Kind> {
 public:
  // Starts Python and imports the file. Throws std::runtime_error if Python cannot be started, the
  // file fails or lacks a function.
  explicit PythonLaw(const std::filesystem::path& file);
  ~PythonLaw() override;
  PythonLaw(const PythonLaw&) = delete;
  PythonLaw& operator=(const PythonLaw&) = delete;

  std::string name() const override { return file_.filename().string(); }
  std::uint32_t command() const override { return command_; }
  std::string create(const typename Kind::Setup& setup) override;
  std::size_t state_size() const override { return start_.size(); }
  void start(double* state) const override;
  std::string step(const typename Kind::Measurement& now, double* state,
                   double* output) const override;

 private:
  // Asks the process. Returns why the law failed; an empty string if it succeeded, with the rest of
  // the answer.
  std::string failure_of(char kind, std::string_view request, std::string* answer) const;

  std::filesystem::path file_;
  std::uint32_t command_ = ROTORUB_FORCE;
  std::size_t commands_ = 2;
  std::vector<double> start_;

  std::shared_ptr<PythonProcess> process_;
  std::uint32_t number_;  // of this law in the process
};

}  // namespace rotorub
