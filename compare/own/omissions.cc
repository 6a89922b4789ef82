#include "compare/own/omissions.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "compare/engine/mujoco_model.h"
#include "native_model/model/dynamics.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/contact_space.h"
#include "plugin/contact_force.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_actuators.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::VectorXd;

std::string share_text(double share) { return fmt::format("{:.2g} %", 100.0 * share); }

std::string element(const mjModel* m, const char* kind, mjtObj type, int id) {
  const char* name = mj_id2name(m, type, id);
  return name ? fmt::format("{} \"{}\"", kind, name) : fmt::format("{} number {}", kind, id + 1);
}

// The part that moves, and the contact force that would move it as much.
struct Effect {
  const char* part = "";
  double force = 0.0;  // N
};

// a: accelerations of the twin's coordinates. Returns the largest effect.
Effect effect_of(const Model& model, const VectorXd& a) {
  Effect largest;
  const auto take = [&largest](const char* part, double force) {
    if (force > largest.force) largest = {part, force};
  };
  const Layout& l = model.layout;
  const auto in_plane = [&](const VectorXd& shape, int first) {
    const VectorXd moved = shape.cwiseProduct(a.segment(first, l.modes)),
                   admittance = shape.cwiseAbs2().cwiseQuotient(model.mass.segment(first, l.modes));
    const double whole = admittance.sum();
    return whole > 0.0 ? moved.cwiseAbs().sum() / whole : 0.0;
  };
  const auto inertial = [&](int at) { return std::abs(model.mass[at] * a[at]); };
  for (const AuxiliaryBearing& at : model.auxiliary) {
    const double radius = at.contact->radius;
    take("the rotor", std::hypot(in_plane(at.shape.x, l.x()), in_plane(at.shape.y, l.y())));
    if (l.spin) take("the rotor's spin", inertial(l.phi()) / radius);
    if (at.moves()) take("the ring", std::hypot(inertial(at.ring), inertial(at.ring + 1)));
    if (at.turns()) take("the ring's spin", inertial(at.ring_angle) / radius);
  }
  return largest;
}

// The origin of a constraint row.
struct Source {
  int type, id, second = -1;  // of a contact: its two geoms
  auto operator<=>(const Source&) const = default;
};

Source source_of(const mjData* d, int row) {
  const int type = d->efc_type[row], id = d->efc_id[row];
  if (type < mjCNSTR_CONTACT_FRICTIONLESS) return {type, id};
  const mjContact& c = d->contact[id];
  return {mjCNSTR_CONTACT_FRICTIONLESS, c.geom1, c.geom2};
}

std::string name_of(const mjModel* m, const Source& source) {
  const auto [type, id, second] = source;
  switch (type) {
    case mjCNSTR_EQUALITY:
      return element(m, "equality", mjOBJ_EQUALITY, id);
    case mjCNSTR_FRICTION_DOF:
      return "the friction loss of " + plugin::joint_of_dof(m, id);
    case mjCNSTR_FRICTION_TENDON:
      return "the friction loss of " + element(m, "tendon", mjOBJ_TENDON, id);
    case mjCNSTR_LIMIT_JOINT:
      return "the limit of " + plugin::joint_element(m, id);
    case mjCNSTR_LIMIT_TENDON:
      return "the limit of " + element(m, "tendon", mjOBJ_TENDON, id);
    default:
      return fmt::format("the contact of {} with {}", element(m, "geom", mjOBJ_GEOM, id),
                         element(m, "geom", mjOBJ_GEOM, second));
  }
}

class OmissionMeter {
 public:
  explicit OmissionMeter(const MujocoSetup& setup)
      : setup_(setup),
        m_(setup.m.get()),
        model_(*setup.model),
        nv_(plugin::count(m_->nv)),
        run_(make_start(m_)),
        begin_(make_start(m_)),
        peak_(make_start(m_)),
        rates_(make_start(m_)) {
    std::copy_n(m_->qpos0, m_->nq, rates_->qpos);
    mj_kinematics(m_, rates_.get());
    std::copy_n(rates_->geom_xmat + 9 * setup.config->pairs.front().ring_geom, 9, axes_.begin());
  }

  void step() {
    const Vector2d commanded = setup_.control ? setup_.control(run_.get()) : Vector2d(0.0, 0.0);
    mj_copyData(begin_.get(), m_, run_.get());
    mj_step(m_, run_.get());
    look_at_smooth_forces(commanded);
    look_at_constraints();
    for (std::size_t k = 0; k < setup_.config->pairs.size(); ++k) look_at_contact(k);
  }

  std::vector<Omission> found() {
    std::vector<Omission> all;
    for (const auto& [source, force] : constraints_) {
      all.push_back(
          {fmt::format("the native model leaves out {}, whose force reaches", name_of(m_, source)),
           force});
    }
    all.push_back(
        {fmt::format("the forces on {}{} differ from the native model's, which are linear about "
                     "qpos0, by up to",
                     smooth_.part, cause_of_peak()),
         smooth_.force});
    all.push_back({"the rotor's place in its ring differs from the native model's by up to", place_,
                   " of the clearance"});
    all.push_back(
        {"the mass that the contact moves differs from the native model's by up to", mass_, ""});
    all.push_back(
        {"the native model leaves out the friction along the ring's axis, which takes from the "
         "friction round it up to",
         axial_, " of the normal force"});
    std::erase_if(all, [](const Omission& o) { return o.peak == 0.0; });
    return all;
  }

 private:
  // All forces except constraints and contacts, for a state with qpos, qvel, act and ctrl set.
  VectorXd smooth_force(mjModel* m, mjData* d) const {
    mj_fwdPosition(m, d);
    // With the actuation disabled, the plugin's contact would count as a passive force.
    const int flags = m->opt.disableflags;
    m->opt.disableflags &= ~mjDSBL_ACTUATION;
    mj_fwdVelocity(m, d);
    m->opt.disableflags = flags;
    mj_fwdActuation(m, d);
    VectorXd force(nv_);
    for (int i = 0; i < nv_; ++i)
      force[i] = d->qfrc_passive[i] + d->qfrc_actuator[i] - d->qfrc_bias[i];
    return force;
  }

  // C v
  VectorXd native_rates(const VectorXd& v) {
    VectorXd q(model_.nq()), rates(model_.nq());
    std::copy_n(v.data(), nv_, rates_->qvel);
    setup_.read(rates_.get(), q.data(), rates.data());
    return rates;
  }
  // C M^-1 force, with M at the start of the step.
  VectorXd accelerations(const VectorXd& force) {
    VectorXd a(nv_);
    mj_solveM(m_, begin_.get(), a.data(), force.data(), 1);
    return native_rates(a);
  }

  void look_at_smooth_forces(const Vector2d& commanded) {
    const VectorXd force = smooth_force(m_, begin_.get());
    q_.resize(model_.nq());
    VectorXd v(model_.nq()), f(model_.nq()), a(model_.nq());
    setup_.read(begin_.get(), q_.data(), v.data());
    unactuated_force(model_, begin_->time, q_.data(), v.data(), f.data());
    if (setup_.control) f.segment<2>(model_.first().ring) += commanded;
    solve_mass(model_, begin_->time, q_.data(), f.data(), a.data());
    const Effect effect = effect_of(model_, accelerations(force) - a);
    if (effect.force <= smooth_.force) return;
    smooth_ = effect;
    mj_copyData(peak_.get(), m_, begin_.get());
  }

  bool is_ours(const Source& source) const {
    return source.type == mjCNSTR_CONTACT_FRICTIONLESS &&
           std::any_of(setup_.config->pairs.begin(), setup_.config->pairs.end(),
                       [&](const plugin::ContactPair& pair) {
                         return plugin::are_geoms(source.id, source.second, pair.rotor_geom,
                                                  pair.ring_geom);
                       });
  }

  void look_at_constraints() {
    mjData* d = run_.get();
    const int rows = plugin::count(d->nefc);
    std::map<Source, VectorXd> forces;
    for (int i = 0; i < rows; ++i) {
      const Source source = source_of(d, i);
      if (d->efc_force[i] == 0.0 || is_ours(source)) continue;
      forces.try_emplace(source, VectorXd::Zero(rows)).first->second[i] = d->efc_force[i];
    }
    for (const auto& [source, of_rows] : forces) {
      VectorXd force(nv_);
      mj_mulJacTVec(m_, d, force.data(), of_rows.data());
      double& peak = constraints_[source];
      peak = std::max(peak, effect_of(model_, accelerations(force)).force);
    }
  }

  void look_at_contact(std::size_t k) {
    const plugin::ContactPair& pair = setup_.config->pairs[k];
    const plugin::ContactPlace place = plugin::contact_place(pair, begin_.get());
    Matrix3d turned = Matrix3d::Identity();  // from the axes of this ring to the twin's axes
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        turned(i, j) = 0.0;
        for (int row = 0; row < 3; ++row)
          turned(i, j) += axes_[static_cast<std::size_t>(3 * row + i)] * place.axes[3 * row + j];
      }
    }
    const Vector2d moved =
        turned.topLeftCorner<2, 2>() * place.d - separation(model_, q_.data(), k);
    place_ = std::max(place_, moved.norm() / pair.contact.clearance);
    if (!(plugin::contact_forces(pair, m_, run_.get()).normal > 0.0)) return;
    look_at_mass(k, turned);
    if (pair.axial) look_at_axial_friction(pair);
  }

  void look_at_mass(std::size_t k, const Matrix3d& turned) {
    plugin::ContactSpaces spaces(*setup_.config, m_, begin_.get());
    const plugin::ContactPair& pair = setup_.config->pairs[k];
    const plugin::ContactPlace place = plugin::contact_place(pair, begin_.get());
    const Matrix3d mujoco =
        turned * spaces.add(pair, place).plane->admittance() * turned.transpose();
    const Matrix3d native = contact_admittance(model_, begin_->time, q_.data(), k);
    const Matrix3d change = mujoco - native;
    mass_ =
        std::max(mass_, change.topLeftCorner<2, 2>().norm() / native.topLeftCorner<2, 2>().norm());
    if (native(2, 2) > 0.0) mass_ = std::max(mass_, std::abs(change(2, 2)) / native(2, 2));
  }

  void look_at_axial_friction(const plugin::ContactPair& pair) {
    for (int i = 0; i < run_->ncon; ++i) {
      const mjContact& c = run_->contact[i];
      if (!plugin::are_geoms(c.geom1, c.geom2, pair.rotor_geom, pair.ring_geom)) continue;
      mjtNum force[6];  // normal, round the ring, along its axis
      plugin::contact_force(m_, run_.get(), i, force);
      if (!(force[0] > 0.0)) continue;
      const double lost = std::hypot(force[1], force[2]) - std::abs(force[1]);
      axial_ = std::max(axial_, lost / force[0]);
    }
  }

  // The nonlinear part at the peak of the smooth force of one tendon or actuator:
  //
  //   c(1) - c(0) - (c(e) - c(-e)) / 2e
  //
  // c(s) is the force with the element minus the force without it, with deflections and their rates
  // scaled by s, at the angles and speeds of the peak. The activations are those of the peak in
  // c(1) and those of the start otherwise.
  VectorXd bent_force(mjModel* without) {
    const VectorXd rest = VectorXd::Zero(nv_);
    VectorXd moved(nv_), v(nv_), turning(nv_);
    mj_differentiatePos(m_, moved.data(), 1.0, m_->qpos0, peak_->qpos);
    std::copy_n(peak_->qvel, nv_, v.data());
    for (int i = 0; i < nv_; ++i) {
      const VectorXd rates = native_rates(VectorXd::Unit(nv_, i));
      const Layout& l = model_.layout;
      turning[i] =
          rates.segment(l.phi(), l.spin).any() || rates.segment(l.ring_angle(), l.ring_spin).any();
    }
    const MujocoData start = make_start(m_), other(mj_makeData(without));
    const auto at = [&](double s, const mjData* activations) -> VectorXd {
      const VectorXd scale = (s + (1.0 - s) * turning.array()).matrix();
      VectorXd change(nv_);
      for (const auto& [m, d] : {std::pair{m_, begin_.get()}, std::pair{without, other.get()}}) {
        std::copy_n(m->qpos0, m->nq, d->qpos);
        mj_integratePos(m, d->qpos, VectorXd(scale.cwiseProduct(moved)).data(), 1.0);
        VectorXd::Map(d->qvel, nv_) = scale.cwiseProduct(v);
        std::copy_n(activations->act, m->na, d->act);
        std::copy_n(start->ctrl, m->nu, d->ctrl);
        const VectorXd force = smooth_force(m, d);
        change = m == m_ ? force : change - force;
      }
      return change;
    };
    constexpr double kSmall = 1e-3;
    const VectorXd linear = at(0.0, start.get()) +
                            (at(kSmall, start.get()) - at(-kSmall, start.get())) / (2.0 * kSmall);
    return at(1.0, peak_.get()) - linear;  // last, because it uses M at the peak
  }

  // ", mainly of actuator "servo",": the element that causes most of the peak of the smooth forces.
  std::string cause_of_peak() {
    std::string cause;
    double largest = 0.5 * smooth_.force;
    const auto try_without = [&](const std::string& name, auto mute) {
      const MujocoModel without(mj_copyModel(nullptr, m_));
      mute(without.get());
      const double force = effect_of(model_, accelerations(bent_force(without.get()))).force;
      if (force <= largest) return;
      largest = force;
      cause = fmt::format(", mainly of {},", name);
    };
    for (int i = 0; i < plugin::count(m_->ntendon); ++i) {
      try_without(element(m_, "tendon", mjOBJ_TENDON, i),
                  [i](mjModel* m) { m->tendon_stiffness[i] = m->tendon_damping[i] = 0.0; });
    }
    for (int i = 0; i < plugin::actuator_count(m_); ++i) {
      try_without(element(m_, "actuator", mjOBJ_ACTUATOR, i),
                  [i](mjModel* m) { std::fill_n(m->actuator_gear + 6 * i, 6, 0.0); });
    }
    return cause;
  }

  const MujocoSetup& setup_;
  mjModel* m_;
  const Model& model_;
  int nv_;
  // The run; the state at the start of the step, without the plugin's forces; the state where the
  // smooth forces differ most; the state for mapping rates.
  MujocoData run_, begin_, peak_, rates_;
  std::array<double, 9>
      axes_{};  // columns: the twin's axes, which are the first ring's axes in qpos0
  VectorXd q_;  // at the start of the step

  std::map<Source, double> constraints_;  // N
  Effect smooth_;
  double place_ = 0.0, mass_ = 0.0, axial_ = 0.0;  // shares
};

}  // namespace

std::string Omission::sentence(double contact_force) const {
  const std::string size = share_text(share(contact_force));
  if (!share_of) return fmt::format("{} {:.3g} N, {} of the mean contact force", what, peak, size);
  return fmt::format("{} {}{}", what, size, *share_of);
}

std::vector<Omission> measure_omissions(const MujocoSetup& setup, double end,
                                        const std::atomic<bool>* interrupt) {
  const MujocoInPlace mujoco;
  OmissionMeter meter(setup);
  const std::int64_t steps = scene::step_count(end, setup.m->opt.timestep);
  for (std::int64_t k = 0; k < steps; ++k) {
    if (interrupt && interrupt->load(std::memory_order_relaxed)) break;
    meter.step();
  }
  return meter.found();
}

}  // namespace rotorub
