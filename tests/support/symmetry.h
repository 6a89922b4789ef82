// The same machine mirrored or turned: every vector, sense of rotation and pair (x, y) of a scene
// becomes an override of its text, so that every engine reads the transformed machine from the
// file.
//
// R in the plane: kMirrored (x, y) -> (x, -y), which reverses all rotation; kTurned (x, y) -> (-y,
// x). Both are exact in floating point and map the actuator's axes at 45 degrees onto each other.
// kAskew turns by an angle unrelated to a right angle; a machine with axes that no key can turn is
// then not_expressible().
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub::test {

enum class Symmetry { kMirrored, kTurned, kAskew };

class Transformed {
 public:
  // scene: as it was read.
  Transformed(const scene::Scene& scene, Symmetry symmetry)
      : mirrored_(symmetry == Symmetry::kMirrored), askew_(symmetry == Symmetry::kAskew) {
    rotor(scene.rotor);
    if (scene.drive) drive(*scene.drive);
    for (std::size_t k = 0; k < scene.forces.size(); ++k)
      force(scene.forces[k], "force[" + std::to_string(k) + "].");
    if (scene.first().contact) vector("contact.offset", scene.first().contact->offset);
    // With several contacts, whose rings are all equal.
    const std::string at = scene.auxiliary.size() > 1 ? "contact.stator." : "stator.";
    if (scene.first().stator) stator(*scene.first().stator, at);
    if (scene.gravity) vector("gravity.acceleration", scene.gravity->acceleration);
    if (scene.base) base(*scene.base);
    initial(scene);
    for (const scene::AuxiliaryBearing& at_ring : scene.auxiliary) {
      if (at_ring.actuator) no_key("an actuator's axes are at 45 degrees");
      const auto& ring = at_ring.stator;
      if (ring && ring->dry_friction) no_key("a ring's dry friction is along its axes");
    }
    if (!scene.magnetic_bearings.empty()) no_key("magnetic bearings act along the axes");
  }

  const std::vector<std::string>& overrides() const { return overrides_; }
  // Why keys cannot express the machine turned by kAskew; empty if they can.
  const std::string& not_expressible() const { return not_expressible_; }
  Eigen::Vector2d of(const Eigen::Vector2d& v) const {
    if (askew_) {
      const double c = std::cos(kAngle), s = std::sin(kAngle);
      return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
    }
    return mirrored_ ? Eigen::Vector2d(v.x(), -v.y()) : Eigen::Vector2d(-v.y(), v.x());
  }
  double sense() const { return mirrored_ ? -1.0 : 1.0; }

 private:
  static std::string text(double value) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g", value);
    const std::string number = digits;
    return number.find_first_of(".e") == std::string::npos ? number + ".0" : number;
  }
  static std::string text(const std::vector<double>& values) {
    std::string list = "[";
    for (const double v : values) list += (list.size() > 1 ? "," : "") + text(v);
    return list + "]";
  }
  void set(const std::string& key, const std::string& value) {
    overrides_.push_back(key + "=" + value);
  }
  // A value of 0 is left out, because it may belong to a part that the scene lacks.
  void number(const std::string& key, double value) {
    if (value != 0.0) set(key, text(value));
  }
  void vector(const std::string& key, const Eigen::Vector2d& v) {
    if (!v.isZero(0.0)) set(key, text({of(v).x(), of(v).y()}));
  }
  void no_key(const std::string& why) {
    if (askew_ && not_expressible_.empty()) not_expressible_ = why;
  }
  // Values of the two planes, which are exchanged if the machine is turned.
  void planes(const std::string& key, const Eigen::Vector2d& v) {
    if (askew_) {
      if (v.x() != v.y()) no_key(key + " is along the axes");
      return;
    }
    if (!mirrored_ && v.x() != v.y()) set(key, text({v.y(), v.x()}));
  }
  // The transformed direction of an angle in the plane.
  double direction(double angle) const {
    if (askew_) return angle + kAngle;
    return mirrored_ ? -angle : angle + 0.5 * std::numbers::pi;
  }

  void rotor(const scene::Rotor& rotor) {
    number("rotor.speed", sense() * rotor.speed);
    if (const auto& modal = rotor.modal;
        modal && (modal->mass != modal->mass_y || modal->stiffness != modal->stiffness_y ||
                  modal->damping != modal->damping_y)) {
      no_key("its modes differ in x and y");
    }
    if (const auto& modal = rotor.modal; modal && !mirrored_ && !askew_ && !modal->mass_y.empty()) {
      for (const auto& [name, x, y] :
           {std::tuple{"mass", &modal->mass, &modal->mass_y},
            std::tuple{"stiffness", &modal->stiffness, &modal->stiffness_y},
            std::tuple{"damping", &modal->damping, &modal->damping_y}}) {
        set(std::string("rotor.modal.") + name, text(*y));
        set(std::string("rotor.modal.") + name + "_y", text(*x));
      }
    }
    if (!rotor.geometry) return;
    // Marks on the rotor: mirrored, they are on the other side; turned, the spin angle turns with
    // them.
    for (std::size_t k = 0; mirrored_ && k < rotor.geometry->discs.size(); ++k) {
      number("rotor.disc[" + std::to_string(k) + "].phase", -rotor.geometry->discs[k].phase);
    }
    for (std::size_t k = 0; k < rotor.geometry->bearings.size(); ++k) {
      bearing(rotor.geometry->bearings[k], "rotor.bearing[" + std::to_string(k) + "].");
    }
  }
  void bearing(const scene::ShaftBearing& b, const std::string& at) {
    vector(at + "offset", b.offset);
    if (b.pedestal) {
      planes(at + "pedestal.stiffness", b.pedestal->stiffness);
      planes(at + "pedestal.damping", b.pedestal->damping);
    }
    if (b.journal) {
      set(at + "journal.load_angle", text(direction(b.journal->load_angle)));
      return;
    }
    if (b.follows_speed()) {
      turned_table(at + "table_k", b.table_kxx, b.table_kxy, b.table_kyx, b.table_kyy);
      turned_table(at + "table_c", b.table_cxx, b.table_cxy, b.table_cyx, b.table_cyy);
      if (mirrored_) set(at + "table_speed", text(in_order(b.table_speed, -1.0)));
      return;
    }
    if (askew_) {
      turned(at, "stiffness", b.stiffness, b.cross_stiffness);
      turned(at, "damping", b.damping, b.cross_damping);
      return;
    }
    planes(at + "stiffness", b.stiffness);
    planes(at + "damping", b.damping);
    // R K R': the cross terms change their signs, and are exchanged if the machine is turned.
    const auto cross = [&](const std::string& key, const Eigen::Vector2d& c) {
      if (!c.isZero(0.0))
        set(at + key, mirrored_ ? text({-c.x(), -c.y()}) : text({-c.y(), -c.x()}));
    };
    cross("cross_stiffness", b.cross_stiffness);
    cross("cross_damping", b.cross_damping);
  }
  // R K R' for [xx, yy] and [xy, yx].
  void turned(const std::string& at, const std::string& key, const Eigen::Vector2d& own,
              const Eigen::Vector2d& cross) {
    if (own.x() == own.y() && cross.x() == -cross.y()) return;
    const Eigen::Matrix2d turned = turned_matrix(own.x(), cross.x(), cross.y(), own.y());
    set(at + key, text({turned(0, 0), turned(1, 1)}));
    set(at + "cross_" + key, text({turned(0, 1), turned(1, 0)}));
  }
  Eigen::Matrix2d turned_matrix(double xx, double xy, double yx, double yy) const {
    Eigen::Matrix2d R, K;
    R << of({1.0, 0.0}), of({0.0, 1.0});
    K << xx, xy, yx, yy;
    return R * K * R.transpose();
  }
  void turned_table(const std::string& at, const std::vector<double>& xx,
                    const std::vector<double>& xy, const std::vector<double>& yx,
                    const std::vector<double>& yy) {
    if (xx.empty()) return;
    std::vector<double> turned[4];
    for (std::size_t k = 0; k < xx.size(); ++k) {
      const auto or_none = [k](const std::vector<double>& list) {
        return list.empty() ? 0.0 : list[k];
      };
      const Eigen::Matrix2d m =
          turned_matrix(xx[k], or_none(xy), or_none(yx), yy.empty() ? xx[k] : yy[k]);
      for (int entry = 0; entry < 4; ++entry) turned[entry].push_back(m(entry / 2, entry % 2));
    }
    const char* names[4] = {"xx", "xy", "yx", "yy"};
    for (int entry = 0; entry < 4; ++entry) set(at + names[entry], text(in_order(turned[entry])));
  }
  // Values over the speed, in the order of the speeds of the image.
  std::vector<double> in_order(std::vector<double> values, double factor = 1.0) const {
    if (mirrored_) std::reverse(values.begin(), values.end());
    for (double& value : values) value *= factor;
    return values;
  }
  void drive(const scene::Drive& drive) {
    number("drive.speed", sense() * drive.speed);
    if (!mirrored_) return;
    number("drive.synchronous_speed", -drive.synchronous_speed);
  }
  void force(const scene::Force& force, const std::string& at) {
    using scene::ForceKind;
    const bool fixed = force.kind == ForceKind::kRotating || force.kind == ForceKind::kChirp;
    if (fixed) {
      number(at + "phase", direction(force.phase));
      number(at + "frequency", sense() * force.frequency);
      number(at + "frequency_end", sense() * force.frequency_end);
    } else if (force.kind == ForceKind::kSynchronous || force.kind == ForceKind::kUnbalance) {
      number(at + "phase", sense() * force.phase);
    } else {
      vector(at + "vector", force.vector);
    }
  }
  void stator(const scene::Stator& stator, const std::string& at) {
    planes(at + "mass", stator.mass);
    planes(at + "damping", stator.damping);
    planes(at + "stiffness", stator.stiffness);
    if (stator.spin) number(at + "spin.speed", sense() * stator.spin->speed);
    if (stator.mount) {
      planes(at + "mount.mass", stator.mount->mass);
      planes(at + "mount.damping", stator.mount->damping);
      planes(at + "mount.stiffness", stator.mount->stiffness);
    }
    if (stator.ball_bearing) {
      number(at + "ball_bearing.phase", direction(stator.ball_bearing->phase));
    }
  }
  // Pairs (x, y) in two lists; the shorter list is padded with 0.
  void lists(const std::string& x_key, const std::string& y_key, const std::vector<double>& x,
             const std::vector<double>& y) {
    std::vector<double> new_x, new_y;
    const auto at = [](const std::vector<double>& list, std::size_t k) {
      return k < list.size() ? list[k] : 0.0;
    };
    for (std::size_t k = 0; k < std::max(x.size(), y.size()); ++k) {
      const Eigen::Vector2d v = of({at(x, k), at(y, k)});
      new_x.push_back(v.x());
      new_y.push_back(v.y());
    }
    if (new_x.empty()) return;
    set(x_key, text(new_x));
    set(y_key, text(new_y));
  }
  void base(const scene::Base& base) {
    lists("base.acceleration_x", "base.acceleration_y", base.acceleration_x, base.acceleration_y);
    if (!base.frequency.empty()) number("base.direction", direction(base.direction));
  }
  void initial(const scene::Scene& scene) {
    const scene::Initial& initial = scene.initial;
    lists("initial.x", "initial.y", initial.x, initial.y);
    lists("initial.vx", "initial.vy", initial.vx, initial.vy);
    if (const auto& ring = scene.first().stator) {
      vector("initial.stator", ring->position);
      vector("initial.stator_velocity", ring->velocity);
    }
    number("initial.spin_angle", direction(initial.spin_angle));
    if (!mirrored_) return;
    const auto turned_round = [&](const char* key, std::vector<double> values) {
      for (double& v : values) v = -v;
      if (!values.empty()) set(std::string("initial.") + key, text(values));
    };
    turned_round("torsion", initial.torsion);
    turned_round("torsion_speed", initial.torsion_speed);
  }

  static constexpr double kAngle = 0.65;  // rad
  bool mirrored_, askew_;
  std::string not_expressible_;
  std::vector<std::string> overrides_;
};

}  // namespace rotorub::test
