// Work without Python's lock, so that other threads of Python run meanwhile, and Ctrl-C ends it.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>

namespace rotorub::python {

// work(interrupt) on a thread of its own; its exception is thrown on. KeyboardInterrupt where a
// signal came.
template <class Result>
Result in_background(const std::function<Result(const std::atomic<bool>&)>& work) {
  namespace py = pybind11;
  constexpr std::chrono::milliseconds kLook{50};  // a signal is Python's to handle, on this thread
  std::atomic<bool> interrupt{false};
  bool raised = false;
  auto result = std::async(std::launch::async, [&] { return work(interrupt); });
  {
    const py::gil_scoped_release free;
    while (result.wait_for(kLook) != std::future_status::ready) {
      const py::gil_scoped_acquire lock;
      if (interrupt || PyErr_CheckSignals() == 0) continue;
      raised = interrupt = true;
    }
  }
  if (raised) throw py::error_already_set();
  return result.get();
}

}  // namespace rotorub::python
