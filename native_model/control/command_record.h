// The commands of another run, to be given again: what the actuator was commanded, piece by piece,
// in the place of a controller. The one that is driven by them does not close the loop.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace rotorub {

// Piecewise constant: a command holds from its piece's begin until the next one's, the last for
// ever; 0 before the first. In the units of control_command (model/actuation.h): the force on the
// ring, N, fixed frame, or with magnets the currents of the two axes, A.
class CommandRecord {
 public:
  // A piece that begins at t (s), after all before it; one that repeats the command before it is
  // none.
  void add(double t, const Eigen::Vector2d& command);

  bool empty() const { return begins_.empty(); }
  const Eigen::Vector2d& at(double t) const;
  // Over begin..end, begin < end, s.
  Eigen::Vector2d mean(double begin, double end) const;
  // Instants at which the command jumps, s, ascending.
  const std::vector<double>& jumps() const { return begins_; }

 private:
  // Of the piece that holds at t; -1: none yet.
  std::ptrdiff_t piece(double t) const;
  const Eigen::Vector2d& command(std::ptrdiff_t piece) const;

  std::vector<double> begins_;
  std::vector<Eigen::Vector2d> commands_;
};

}  // namespace rotorub
