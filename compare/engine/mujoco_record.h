// Passes the steps of a MuJoCo run to the recorder that the native engines use, and to a watch.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/chunked_run.h"
#include "compare/engine/engine.h"
#include "native_model/model/model.h"
#include "native_model/trajectory/contact_episodes.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

class MujocoRecord {
 public:
  // The model must outlive this. rigid: whether the contact model is `rigid`. times: of the rows,
  // s, ascending. window: s, of the window impulse.
  MujocoRecord(const Model& model, bool rigid, double step, std::vector<double> times,
               double window);

  // The state at t = 0.
  void begin(const double* q, const double* v);
  // Step k (from 0) begins at time k step; q and v are the state at its end.
  void step(std::int64_t k, const double* q, const double* v, const StepResult& r);
  // Step k of native steps: state, forces and works are those at t_k; the step's impacts come after
  // it. The last call has last = true and the state at the end of the run; half of its forces
  // count, and its impacts do not.
  void native_step(std::int64_t k, const double* q, const double* v, const StepResult& r,
                   bool last);

  // The reason if the rotor is out of range of the contact, otherwise empty.
  std::optional<std::string> lost(const double* q, const double* v) const;
  Trajectory finish(const RunEnd& end);

 private:
  StepBalance balance_of_step(std::int64_t k, const double* q, const double* v,
                              const StepResult& r);
  double held(std::size_t contact) const;
  void count_impacts();
  void add_contact(StepFigures& figures, std::size_t contact, double t, double normal,
                   double friction, double work);
  void note_mode(double t, ContactMode mode, std::size_t contact);
  void show(std::size_t contact, const StepResult& r);  // writes shown_
  Impact step_contact(std::int64_t k, std::size_t contact, const double* q, const double* v,
                      const StepResult& r);
  double time(std::int64_t k) const { return static_cast<double>(k) * step_; }  // s

  const Model& model_;
  bool rigid_;
  double step_;
  Recorder recorder_;
  struct AtContact {
    ContactMode mode = ContactMode::kFree;
    ContactEpisodes episodes;
    ContactPoint point{};
  };
  std::vector<AtContact> contacts_;     // one per contact
  std::vector<ContactSnapshot> shown_;  // of the last snapshot
  std::vector<ContactPoint> points_;    // with native steps: at the last state
  // With native steps: the impacts of the previous step and their work on the coordinates.
  std::vector<Impact> impacts_;
  double impact_work_ = 0.0;  // J
  // Otherwise: the state at the start of the step, and the balance of the previous step, J.
  std::vector<double> last_q_, last_v_, middle_, half_;
  StepBalance last_step_;
};

// Calls a watch (engine.h) with the data of each step.
class WatchFeed {
 public:
  // Does nothing if the watch is empty. The model must outlive this.
  WatchFeed(const Model& model, double step, StepWatch watch);

  void begin(const double* q, const double* v);  // the state at t = 0
  // The state is the one at the step's end; with native steps, at its start (as in MujocoRecord).
  void step(std::int64_t k, const double* q, const double* v, const StepResult& result);
  void native_step(std::int64_t k, const double* q, const double* v, const StepResult& result);

 private:
  void tell(std::int64_t k, const double* q, const double* v, double kick,
            const StepResult& result);

  const Model& model_;
  double h_;  // s
  StepWatch watch_;
  bool lags_;
  std::vector<double> q_, v_, mean_;
  std::vector<WatchedContact> contacts_;
  Eigen::Vector2d current_{0.0, 0.0};
};

}  // namespace rotorub
