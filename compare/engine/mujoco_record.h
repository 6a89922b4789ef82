// Who is handed the steps of a MuJoCo run: the recorder that the native side uses, and an onlooker.
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
  // The model must outlive it. `rigid`: the contact model; `times`: the rows wanted, ascending.
  MujocoRecord(const Model& model, bool rigid, double step, std::vector<double> times,
               double window);

  // The state of t = 0.
  void begin(const double* q, const double* v);
  // Step k (from 0), time counted as k step; the state is that of its end.
  void step(std::int64_t k, const double* q, const double* v, const StepResult& r);
  // Step k of native steps: the state is that of t_k, and so are forces and works; what impacts do
  // comes after it. Of the last one, which begins at the end, half counts, and no impact.
  void native_step(std::int64_t k, const double* q, const double* v, const StepResult& r,
                   bool last);

  // Why the state is where nothing holds it, if it is.
  std::optional<std::string> lost(const double* q) const;
  Trajectory finish(double end);

 private:
  StepBalance balance_of_step(std::int64_t k, const double* q, const double* v,
                              const StepResult& r);
  double held(std::size_t contact) const;
  void count_impacts();
  void add_contact(StepFigures& figures, std::size_t contact, double t, double normal,
                   double friction, double work);
  void note_mode(double t, Mode mode, std::size_t contact);
  Impact step_contact(std::int64_t k, std::size_t contact, const double* q, const double* v,
                      const StepResult& r);
  double time(std::int64_t k) const { return static_cast<double>(k) * step_; }  // s

  const Model& model_;
  bool rigid_;
  double step_;
  Recorder recorder_;
  struct AtContact {
    Mode mode = Mode::kFree;
    ContactEpisodes episodes;
    ContactPoint point{};
  };
  std::vector<AtContact> contacts_;      // of each
  std::vector<ContactSnapshot> others_;  // of those beyond the first
  // With native steps: the impacts of the step before, and their work on the coordinates.
  std::vector<Impact> impacts_;
  double impact_work_ = 0.0;  // J
  // Of others: the state that the step began from, and what its forces did over the whole of it, J.
  std::vector<double> last_q_, last_v_, middle_, half_;
  StepBalance last_step_;
};

// What a watch is given (engine.h), of what the engine has.
class WatchFeed {
 public:
  // No watch: nothing is done. The model must outlive it.
  WatchFeed(const Model& model, double step, StepWatch watch);

  void begin(const double* q, const double* v);  // the state of t = 0
  // As MujocoRecord: the state at the step's end; of native steps that of its begin.
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
  Eigen::Vector2d current_{0.0, 0.0};
};

}  // namespace rotorub
