// The recorded commands of another run. A model that replays them uses them in place of a
// controller and does not close the loop.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace rotorub {

// A piecewise constant command: each piece holds until the next one begins, the last one forever;
// the command is 0 before the first piece. The units are those of control_command
// (model/actuation.h): the force on the ring in the fixed frame, N, or with magnets the currents of
// the two axes, A.
class CommandRecord {
 public:
  // Adds a piece that begins at t (s), after all earlier pieces. A piece that repeats the previous
  // command is ignored.
  void add(double t, const Eigen::Vector2d& command);

  bool empty() const { return begins_.empty(); }
  const Eigen::Vector2d& at(double t) const;
  // Mean over [begin, end], s, begin < end.
  Eigen::Vector2d mean(double begin, double end) const;
  // s, ascending, the times at which the command jumps.
  const std::vector<double>& jumps() const { return begins_; }

 private:
  // Index of the piece that holds at t; -1 before the first.
  std::ptrdiff_t piece(double t) const;
  const Eigen::Vector2d& command(std::ptrdiff_t piece) const;

  std::vector<double> begins_;
  std::vector<Eigen::Vector2d> commands_;
};

}  // namespace rotorub
