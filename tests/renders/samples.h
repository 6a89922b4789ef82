// Scenes and runs made by hand for the tests of the pictures, and what the tests see in a picture.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

#include "native_model/scene/reader.h"
#include "native_model/trajectory/trajectory.h"
#include "renders/sheet.h"
#include "tests/support/said.h"
#include "tests/support/temporary_folder.h"

namespace rotorub::renders {

inline constexpr double kClearance = 0.5e-3;  // m

// A rotor without geometry with a contact, and what further tables give it.
inline scene::Scene modal_scene(const std::string& tables) {
  return scene::parse_scene(R"(
[run]
end = 0.1
[rotor]
speed = "50 Hz"
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.15
restitution = 0.5
)" + tables,
                            "modal.toml");
}

inline const std::string kElasticRing = "[stator]\nmass = 1.0\ndamping = 200.0\nstiffness = 1e5\n";
inline scene::Scene ring_scene() { return modal_scene(kElasticRing); }

// A free mass without springs and contact.
inline scene::Scene free_scene() {
  return scene::parse_scene(R"(
[run]
end = 0.1
[rotor]
speed = 0.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
damping = [0.0]
)",
                            "free.toml");
}

inline scene::Scene shipped_scene(const std::string& name) {
  return scene::read_scene(std::filesystem::path(ROTORUB_MJCF_DIR) / (name + ".toml"));
}

// The reference rig, as runs of two modes go with it.
inline scene::Scene rig_of_two_modes() {
  scene::Scene rig = shipped_scene("paper_passive");
  rig.rotor.geometry->modes = 2;
  return rig;
}

struct Row {
  double rotor_x = 0.0, rotor_y = 0.0;              // m
  double stator_x = 0.0, stator_y = 0.0;            // m
  double spin_angle = 0.0;                          // rad
  double normal_force = 0.0, friction_force = 0.0;  // N
};

// A run of one bending mode with rows at equal times over [0, 0.1] s; velocities are not given.
inline Trajectory made_run(int rows, const std::function<Row(double)>& row_at) {
  Trajectory run;
  run.engine = "made";
  for (const char* name : {"t", "rotor_x", "rotor_y", "stator_x", "stator_y", "spin_angle", "gap",
                           "normal_force", "friction_force", "mode", "x_1", "y_1"}) {
    run.series.push_back({name, "", {}});
  }
  for (int i = 0; i < rows; ++i) {
    const double t = 0.1 * i / (rows - 1);
    const Row row = row_at(t);
    const double gap =
        kClearance - std::hypot(row.rotor_x - row.stator_x, row.rotor_y - row.stator_y);
    const double values[] = {t,
                             row.rotor_x,
                             row.rotor_y,
                             row.stator_x,
                             row.stator_y,
                             row.spin_angle,
                             gap,
                             row.normal_force,
                             row.friction_force,
                             row.normal_force > 0.0 ? 1.0 : 0.0,
                             row.rotor_x,
                             row.rotor_y};
    for (std::size_t k = 0; k < run.series.size(); ++k) run.series[k].values.push_back(values[k]);
  }
  run.end = 0.1;
  return run;
}

// A run that stays in one state.
inline Trajectory resting_run(const Row& row) {
  return made_run(11, [&row](double) { return row; });
}

// The same run with a second mode, m.
inline Trajectory with_second_mode(Trajectory run, double x, double y) {
  run.series.push_back({"x_2", "m", std::vector<double>(run.rows(), x)});
  run.series.push_back({"y_2", "m", std::vector<double>(run.rows(), y)});
  return run;
}

// In touch with the ring from the middle on.
inline Trajectory late_touch() {
  return made_run(101, [](double t) {
    return Row{.rotor_x = kClearance, .normal_force = t > 0.0495 ? 5.0 : 0.0};
  });
}

// A whirl in touch with the ring, forwards at 20 Hz.
inline Trajectory whirling_run() {
  return made_run(401, [](double t) {
    const double angle = 2.0 * 3.141592653589793 * 20.0 * t;
    Row row;
    row.rotor_x = kClearance * std::cos(angle);
    row.rotor_y = kClearance * std::sin(angle);
    row.spin_angle = 314.0 * t;
    row.normal_force = 100.0;
    row.friction_force = -15.0;
    return row;
  });
}

class Folder : public test::TemporaryFolder {
 public:
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path()), {}));
  }
};

inline bool same(const Picture& a, const Picture& b) {
  return std::ranges::equal(a.bytes(), b.bytes());
}

// Expects that `act` throws an Error whose message contains `word`.
template <class Error, class Act>
void expect_thrown(Act act, const std::string& word) {
  EXPECT_TRUE(test::contains(test::message_of<Error>(act), word));
}

using Test = std::function<bool(int red, int green, int blue)>;

// Pixels of a part of the picture, [left, right) x [top, bottom), that pass a test.
struct Found {
  int count = 0;
  double column = 0.0, row = 0.0;  // mean
};
inline Found find(const Picture& picture, int left, int top, int right, int bottom,
                  const Test& test) {
  Found found;
  for (int row = top; row < bottom; ++row) {
    for (int column = left; column < right; ++column) {
      const auto p = picture.pixel(column, row);
      if (!test(p[0], p[1], p[2])) continue;
      ++found.count;
      found.column += column;
      found.row += row;
    }
  }
  if (found.count > 0) {
    found.column /= found.count;
    found.row /= found.count;
  }
  return found;
}
inline Found find(const Picture& picture, const Test& test) {
  return find(picture, 0, 0, picture.width(), picture.height(), test);
}

// The colours of the parts, with generous limits.
inline bool is_rotor(int r, int g, int b) { return b > 150 && b > r + 60 && b > g + 30 && r > 60; }
inline bool is_ring(int r, int g, int b) { return r > 200 && g > 140 && g < 215 && b < 140; }
inline bool is_red(int r, int g, int b) { return r > 190 && g < 90 && b < 100; }
inline bool is_green(int r, int g, int b) { return g > 110 && r < 90 && b < 120; }
inline bool is_light(int r, int g, int b) { return r > 235 && g > 235 && b > 235; }

}  // namespace rotorub::renders
