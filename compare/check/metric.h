// What a rule of [[check]] measures on a run: a number, as a pure function of the run, its scene
// and a reference.
//
//   <key>            a number of the run's summary: max_penetration, contact_fraction, impacts, ...
//   error.<column>   largest difference from the reference over the rows that both have
//   end.<column>     the last row's value
//   largest.<column> the largest size of it in any row
//   residual.<name>  how far the rows are from the laws of contact (compare/metrics/residuals.h)
//   count.<event>    how many events of a kind: impact, slide, stick, lift_off, reverse
#pragma once

#include <stdexcept>
#include <string>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::check {

// The metric does not exist; the message says which do.
class NoSuchMetric : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr const char* kErrorPrefix = "error.";
bool needs_reference(const std::string& metric);

// Throws NoSuchMetric for a name that no run can have; of a column only its prefix is known here.
void check_name(const std::string& metric);

// `reference`: for error.<column> alone, else null. Throws NoSuchMetric for a column that the run
// does not have.
double measure(const std::string& metric, const scene::Scene& scene, const Trajectory& trajectory,
               const Trajectory* reference);

}  // namespace rotorub::check
