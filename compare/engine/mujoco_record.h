// Feeds the recorder that the native side uses with the steps of a MuJoCo run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/chunked_run.h"
#include "compare/engine/contact_episodes.h"
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
  void count_impact();
  void note_mode(double t, Mode mode, std::size_t contact = 0);
  void note_rigid(double next, const plugin::ContactForces& f, const Impact& impact,
                  std::size_t contact = 0);
  double impact_time(double t, const plugin::ContactForces& f, const ContactPoint& point) const;
  void step_further(std::int64_t k, std::size_t contact, const double* q, const double* v,
                    const StepResult& r);

  const Model& model_;
  bool rigid_;
  double step_;
  Mode mode_ = Mode::kFree;
  Recorder recorder_;
  ContactEpisodes episodes_;
  ContactPoint point_;
  // Of the contacts beyond the first.
  struct Further {
    Mode mode = Mode::kFree;
    ContactEpisodes episodes;
    ContactPoint point{};
  };
  std::vector<Further> further_;
  std::vector<ContactSnapshot> others_;
  // Of native steps, of the step before: its impact, and the impact's work on the coordinates.
  Impact impact_;
  double impact_work_ = 0.0;  // J
  // Of others: the state that the step began from, and what its forces did over the whole of it, J.
  std::vector<double> last_q_, last_v_, middle_, half_;
  StepBalance last_step_;
};

}  // namespace rotorub
