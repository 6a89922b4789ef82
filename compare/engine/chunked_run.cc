#include "compare/engine/chunked_run.h"

#include <algorithm>

#include "compare/engine/mujoco_model.h"
#include "plugin/model/control.h"
#include "plugin/model/user_data.h"

namespace rotorub {
namespace {

struct RecordWorks {
  explicit RecordWorks(plugin::StepWorks* to) { plugin::record_works(to); }
  ~RecordWorks() { plugin::record_works(nullptr); }
};

}  // namespace

ChunkedRun::ChunkedRun(const MujocoSetup& setup, bool commands)
    : m_(setup.m.get()),
      config_(*setup.config),
      model_(*setup.model),
      read_(setup.read),
      control_(setup.control),
      commands_(commands),
      data_(make_start(m_)),
      results_(kChunk) {
  states_.resize(2 * kChunk * size());
  start_.resize(2 * size());
  read_state(start_.data());
}

std::size_t ChunkedRun::advance(std::size_t wanted) {
  const std::size_t count = std::min(wanted, kChunk);
  const auto start = std::chrono::steady_clock::now();
  std::size_t done = 0;
  for (; done < count && !failed_; ++done) {
    // With native steps, the velocities at the start of the step are known only after the step.
    const bool native = config_.takes_native_steps();
    double* state = states_.data() + 2 * done * size();
    if (native) read_state(state);
    failed_ = !step() || bad();
    if (failed_) break;
    StepResult& r = results_[done];
    r.works = works_;
    read_forces(r.forces);
    r.actuator = plugin::actuator_state(config_, m_, data_.get());
    if (commands_) r.command = plugin::command_of_pass(config_, m_, data_.get());
    if (control_) r.command = r.actuator.force = commanded_;
    const auto failing = std::find_if(r.forces.begin(), r.forces.end(),
                                      [](const auto& f) { return f.status != Status::kOk; });
    if (failing != r.forces.end()) {
      contact_status_ = failing->status;
      failed_ = true;
      break;
    }
    if (native) {
      std::copy_n(plugin::velocities_of_pass(config_, data_.get()), size(), state + size());
    } else {
      read_state(state);
    }
  }
  wall_ += std::chrono::steady_clock::now() - start;
  return done;
}

bool ChunkedRun::step() {
  const RecordWorks recording(&works_);
  try {
    if (control_) commanded_ = control_(data_.get());
    mj_step(m_, data_.get());
    return true;
  } catch (const ControllerError& error) {
    error_ = error.what();
    contact_status_ = Status::kControllerFailed;
    return false;
  } catch (const MujocoError& error) {
    error_ = error.what();
    const auto controller = static_cast<double>(Status::kControllerFailed);
    const bool sampled = config_.model.first().loop || !config_.model.samplers.empty();
    if (sampled && plugin::model_entries(config_, data_.get()).contact.status == controller) {
      contact_status_ = Status::kControllerFailed;
    }
    return false;
  }
}

StepResult ChunkedRun::last_half() {
  const RecordWorks recording(&works_);
  mj_forward(m_, data_.get());
  read_state(states_.data());
  std::copy_n(plugin::velocities_of_pass(config_, data_.get()), size(), states_.data() + size());
  StepResult r;
  read_forces(r.forces);
  r.actuator = plugin::actuator_state(config_, m_, data_.get());
  r.works = works_;
  return r;
}

// The forces of every contact. A model without contacts gets one entry without force.
void ChunkedRun::read_forces(std::vector<plugin::ContactForces>& forces) const {
  forces.assign(1, plugin::contact_forces(config_, m_, data_.get()));
  for (std::size_t k = 1; k < config_.pairs.size(); ++k) {
    forces.push_back(plugin::contact_forces(config_.pairs[k], m_, data_.get()));
  }
}

// MuJoCo resets a state that is not finite (or beyond 1e10) and warns.
bool ChunkedRun::bad() const {
  const mjWarningStat* w = data_->warning;
  return (w[mjWARN_BADQPOS].number | w[mjWARN_BADQVEL].number | w[mjWARN_BADQACC].number) != 0;
}

}  // namespace rotorub
