#include "plugin/contact/contact_memory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "native_model/contact/contact_list.h"
#include "native_model/scene/mujoco.h"
#include "plugin/contact/relative_motion.h"

namespace rotorub::plugin {
namespace {

// The results that a thread noted last for each of its contacts. If there are more than kMostNoted,
// a new contact replaces the one that was noted least recently. A step allocates no memory.
class NotedContacts {
 public:
  const NotedContact* find(const mjData* d, int userdata) {
    const auto at = place(d, userdata);
    return at == all_.end() ? nullptr : &at->contact;
  }
  void put(const mjData* d, int userdata, const NotedContact& contact) {
    auto at = place(d, userdata);
    if (at == all_.end()) {
      at = std::min_element(all_.begin(), all_.end(),
                            [](const Noted& a, const Noted& b) { return a.order < b.order; });
    }
    *at = {d, userdata, ++calls_, contact};
  }

 private:
  struct Noted {
    const mjData* d = nullptr;
    int userdata = -1;
    std::uint64_t order = 0;  // number of the call that noted it, 0: empty
    NotedContact contact{};
  };
  static constexpr std::size_t kMostNoted = 4 * kMaxContacts;
  using All = std::array<Noted, kMostNoted>;
  All::iterator place(const mjData* d, int userdata) {
    return std::find_if(all_.begin(), all_.end(), [&](const Noted& noted) {
      return noted.d == d && noted.userdata == userdata;
    });
  }
  All all_;
  std::uint64_t calls_ = 0;
};

NotedContacts& noted_contacts() {
  static thread_local NotedContacts all;
  return all;
}

// The forces that the plugin computed itself.
ContactForces recorded_forces(const ContactEntries& entry) {
  ContactForces out;
  out.normal = entry.normal_force;
  out.friction = entry.friction_force;
  out.mode = static_cast<ContactMode>(static_cast<int>(entry.mode));
  return out;
}

ContactForces rigid_forces(const ContactEntries& entry) {
  ContactForces out = recorded_forces(entry);
  out.status = ContactStatus::status_in(entry.status);
  out.impact = entry.impact != 0.0;
  if (!out.impact) return out;
  out.impact_time = entry.impact_time;
  out.gap_rate_before = entry.gap_rate_before;
  out.gap_rate_after = entry.gap_rate_after;
  out.slip_before = entry.slip_before;
  out.slip_after = entry.slip_after;
  return out;
}

// True if the force lies inside the cone. Because of MuJoCo's regularisation nothing sticks
// completely; in sticking all edges of the two tangents of a pyramid carry load, or |T| < mu N
// holds for the ellipse. force: along the contact's frame.
bool within_cone(const mjModel* m, const mjData* d, const mjContact& contact, const mjtNum* force) {
  const mjtNum* edges = d->efc_force + contact.efc_address;
  if (mj_isPyramidal(m)) return *std::min_element(edges, edges + 4) > 0.0;
  return std::hypot(force[1], force[2]) < (1.0 - 1e-6) * contact.friction[0] * force[0];
}

// States of a compliant contact, in CompliantEntries::touches.
constexpr double kUnknown = 0.0, kInWall = 1.0, kOpen = 2.0;

// True if the motion since the previous pass does not lead to the present state.
bool is_written(const ContactPair& pair, const ContactPoint& point, const mjModel* m,
                const mjData* d) {
  constexpr double kMoved = 0.01;  // share of the clearance, beyond the motion by the speed
  const auto& entry = entries<CompliantEntries>(d, pair.userdata);
  if (entry.touches == kUnknown) return true;
  const double h = m->opt.timestep, passed = std::abs(d->time - entry.time);
  if (passed > h + time_tolerance(h, d->time)) return true;
  const double speed = std::hypot(point.gap_rate, point.whirl_speed());
  return std::abs(point.gap - entry.gap) > 2.0 * h * speed + kMoved * pair.contact.clearance;
}

ContactForces cone_forces(const mjModel* m, const mjData* d, const mjContact& contact) {
  // Along the contact's frame, for pyramids and ellipses alike.
  mjtNum force[6];
  mj_contactForce(m, d, static_cast<int>(&contact - d->contact), force);
  ContactForces out;
  if (!(force[0] > 0.0)) return out;
  out.normal = force[0];
  // MuJoCo's force acts on geom 2, along the frame. If the geoms change places, e_t and the body
  // that the force acts on both turn round.
  out.friction = -force[1];
  out.mode = contact.dim >= 3 && within_cone(m, d, contact, force) ? ContactMode::kStick
                                                                   : ContactMode::kSlide;
  return out;
}

}  // namespace

const NotedContact* noted_contact(const mjData* d, int userdata) {
  return noted_contacts().find(d, userdata);
}

void note_contact(const mjData* d, int userdata, const Eigen::Vector2d& e_r, double axial) {
  const double normal = entries<ContactEntries>(d, userdata).normal_force;
  noted_contacts().put(d, userdata, {d->time, e_r, axial, normal});
}

void watch_escape(const ContactPair& pair, mjData* d, double delta) {
  if (pair.contact.impact_time() > 0.0) return;  // such an impact penetrates the ring
  const double clearance = pair.contact.clearance;
  ContactStatus(contact_entries(pair, d).status)
      .watch_escape(clearance - delta, clearance, d->time);
}

const mjContact* find_contact(const ContactPair& pair, const mjData* d) {
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& c = d->contact[i];
    if (are_geoms(pair.rotor_geom, pair.ring_geom, c.geom1, c.geom2)) {
      return c.efc_address >= 0 ? &c : nullptr;
    }
  }
  return nullptr;
}

ContactForces contact_forces(const Config& config, const mjModel* m, const mjData* d) {
  return config.pairs.empty() ? ContactForces{} : contact_forces(config.pairs.front(), m, d);
}

ContactForces contact_forces(const ContactPair& pair, const mjModel* m, const mjData* d) {
  const ContactEntries& entry = contact_entries(pair, d);
  if (pair.contact_model == scene::ContactModel::kRigid || pair.further) return rigid_forces(entry);
  const mjContact* contact = find_contact(pair, d);
  if (!contact) return {};
  if (pair.contact_model != scene::ContactModel::kCoulomb) return cone_forces(m, d, *contact);
  return entry.normal_force > 0.0 ? recorded_forces(entry) : ContactForces{};
}

double compliant_force(const ContactPair& pair, const ContactPoint& point, const mjModel* m,
                       mjData* d) {
  const CompliantLaw& law = pair.contact.compliance;
  auto& entry = entries<CompliantEntries>(d, pair.userdata);
  const double clearance = pair.contact.clearance;
  if (is_written(pair, point, m, d)) {
    const bool closed = CompliantLaw::begins_closed(point.gap, point.gap_rate, clearance);
    entry.touches = closed ? kInWall : kOpen;
    entry.damping = law.a_of_start();
  } else if (!is_on_circle(point.gap, clearance)) {
    entry.touches = kOpen;
  } else if (point.gap < 0.0 && entry.touches == kOpen) {
    entry.touches = kInWall;
    entry.damping = law.a_of_touch(-point.gap_rate);
  }
  entry.time = d->time;
  entry.gap = point.gap;
  if (point.gap >= 0.0) return 0.0;
  return std::max(0.0, law.force(-point.gap, -point.gap_rate, entry.damping));
}

void pass_without_contact(const ContactPair& pair, const mjModel* m, mjData* d) {
  auto& entry = entries<CompliantEntries>(d, pair.userdata);
  const double clearance = pair.contact.clearance,
               gap = clearance - contact_place(pair, d).d.norm();
  if (std::abs(gap) <= kOnCircle * clearance) {
    compliant_force(pair, contact_point_of(pair, m, d), m, d);
    return;
  }
  // The rotor is in the wall without a contact, for example because contacts are disabled. The
  // contact begins closed as soon as there is one.
  entry.touches = gap > 0.0 ? kOpen : kUnknown;
  entry.time = d->time;
  entry.gap = gap;
}

}  // namespace rotorub::plugin
