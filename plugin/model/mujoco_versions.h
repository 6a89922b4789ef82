// Differences between MuJoCo 2.2 and the newest supported version, 3.12. The differences in the
// dynamics are in mujoco_dynamics.h, those of actuators and engine plugins in mujoco_actuators.h.
// Where the headers allow it, a difference is detected from the types themselves; flags and
// meanings depend on mjVERSION_HEADER (222, 237, 316, 337; from 3.5 on 3005000).
#pragma once

#include <mujoco/mujoco.h>

#include <cstddef>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>

namespace rotorub::plugin {

// Sizes in mjModel are int, and 64 bit since 3.4. Those that occur here always fit an int.
template <typename Size>
constexpr int count(Size n) {
  return static_cast<int>(n);
}

template <typename Function>
struct ArgumentsOf;
template <typename Result, typename... Arguments>
struct ArgumentsOf<Result (*)(Arguments...)> {
  template <std::size_t kPlace>
  using At = std::tuple_element_t<kPlace, std::tuple<Arguments...>>;
};
// The type of a function's argument, counted from 0.
template <typename Function, std::size_t kPlace>
using Argument = typename ArgumentsOf<std::decay_t<Function>>::template At<kPlace>;

// --- Messages: the text is not a format; in 2.3 the first argument became one ---

template <typename Text>
void raise_error(const Text* text) {
  if constexpr (requires { mju_error("%s", text); }) {
    mju_error("%s", text);
  } else {
    mju_error(text);
  }
}
template <typename Text>
void warn(const Text* text) {
  if constexpr (requires { mju_warning("%s", text); }) {
    mju_warning("%s", text);
  } else {
    mju_warning(text);
  }
}

// --- The stack of mjData ---

// Memory that is taken from the stack is returned at the end of the scope. Scopes nest.
template <typename Data>
class StackFrameOf {
 public:
  explicit StackFrameOf(Data* d) : d_(d), mark_(d->pstack) {
    if constexpr (requires { mj_markStack(d); }) mj_markStack(d);
  }
  ~StackFrameOf() {
    if constexpr (requires(Data * d) { mj_freeStack(d); }) {
      mj_freeStack(d_);
    } else {
      d_->pstack = mark_;
    }
  }
  StackFrameOf(const StackFrameOf&) = delete;
  StackFrameOf& operator=(const StackFrameOf&) = delete;

  mjtNum* numbers(int n) {
    if constexpr (requires(Data * d) { mj_stackAllocNum(d, 1); }) {
      return mj_stackAllocNum(d_, static_cast<std::size_t>(n));
    } else {
      return mj_stackAlloc(d_, n);
    }
  }

 private:
  Data* d_;
  decltype(Data::pstack) mark_;
};
using StackFrame = StackFrameOf<mjData>;

// --- Collision ---

// The type that a function of mjCOLLISIONFUNC fills: mjContact, or mjPreContact since 3.9.
using CollisionContact = std::remove_pointer_t<Argument<mjfCollision, 2>>;

template <typename Contact>
void set_frame(Contact* con, const double (&normal)[3], const double (&tangent)[3],
               const double (&third)[3]) {
  for (int i = 0; i < 3; ++i) {
    if constexpr (requires { con->frame; }) {
      con->frame[i] = normal[i];
      con->frame[3 + i] = tangent[i];
      con->frame[6 + i] = third[i];
    } else {
      con->normal[i] = normal[i];
      con->tangent[i] = tangent[i];
    }
  }
}

// True if the gap of a pair can keep a contact from the solver. Before 3.9 a contact is detected
// below margin and solved below margin - gap. Since then it is detected below margin + gap and
// solved below margin, so that a gap keeps nothing from the solver unless the margin is negative.
inline constexpr bool kGapKeepsOut = mjVERSION_HEADER < 3009000;

// Distance below which the contact is detected and viewers show it, m. Pairs that were written for
// MuJoCo before 3.9 keep their distance.
inline double detected_below(const mjModel* m, int pair) {
  const double margin = m->pair_margin[pair];
  return kGapKeepsOut || margin >= 0.0 ? margin : margin + m->pair_gap[pair];
}

// Distance below which MuJoCo's solver includes the contact, m.
inline double solved_below(const mjModel* m, int pair) {
  const bool overridden = m->opt.enableflags & mjENBL_OVERRIDE;
  const double margin = overridden ? m->opt.o_margin : m->pair_margin[pair];
  return kGapKeepsOut ? margin - m->pair_gap[pair] : margin;
}

// collides_freely: true if MuJoCo looks for contacts other than the <pair>s. collides_pairs: true
// if it looks for those of the <pair>s. <option collision>, which decides this, was removed in 3.0;
// since then the geoms' contype and conaffinity alone decide about other contacts.
template <typename Model>
bool collides_freely(const Model* m) {
  if constexpr (requires { m->opt.collision; }) return m->opt.collision != 1;  // mjCOL_PAIR
  return true;
}
template <typename Model>
bool collides_pairs(const Model* m) {
  if constexpr (requires { m->opt.collision; }) return m->opt.collision != 2;  // mjCOL_DYNAMIC
  return true;
}

// The type of both ends of each equality, mjtObj; before 3.3 it follows from the equality's type.
template <typename Model>
const int* equality_end_types(const Model* m) {
  if constexpr (requires { m->eq_objtype; })
    return m->eq_objtype;
  else
    return m->eq_type;
}

// The body of an end of a <connect> or <weld>. Since 3.3 both ends may be sites.
template <typename Model>
int equality_body(const Model* m, int equality, int end) {
  if constexpr (requires { m->eq_objtype; }) {
    if (m->eq_objtype[equality] == mjOBJ_SITE) return m->site_bodyid[end];
  }
  return end;
}

// --- Flags ---

// True if mj_passive does nothing, so that mjcb_passive is not called either.
inline bool passive_disabled(const mjModel* m) {
#if mjVERSION_HEADER >= 336
  constexpr int kBoth = mjDSBL_SPRING | mjDSBL_DAMPER;
#else
  constexpr int kBoth = mjDSBL_PASSIVE;
#endif
  return (m->opt.disableflags & kBoth) == kBoth;
}

// True if mj_forward does not call mjcb_control; mj_step1 still does.
inline bool control_skipped(const mjModel* m) {
  return mjVERSION_HEADER >= 231 && (m->opt.disableflags & mjDSBL_ACTUATION);
}

// Sleeping trees, available since 3.4. tree_may_sleep: true if the tree with this body may fall
// asleep.
#if mjVERSION_HEADER >= 340
inline bool sleep_enabled(const mjModel* m) { return m->opt.enableflags & mjENBL_SLEEP; }
inline bool tree_may_sleep(const mjModel* m, int body) {
  const int tree = m->body_treeid[body];
  return tree >= 0 && m->tree_sleep_policy[tree] != mjSLEEP_NEVER &&
         m->tree_sleep_policy[tree] != mjSLEEP_AUTO_NEVER;
}
#else
inline bool sleep_enabled(const mjModel*) { return false; }
inline bool tree_may_sleep(const mjModel*, int) { return false; }
#endif

// The h of M + h D in MuJoCo's step, s; 0 if the dampers are explicit or disabled. (Before 3.3.6
// Euler's matrix includes the dampers even if mjDSBL_PASSIVE disables their forces.)
inline double damped_step(const mjModel* m) {
  if (m->opt.integrator == mjINT_RK4) return 0.0;
#if mjVERSION_HEADER >= 336
  if (m->opt.disableflags & mjDSBL_DAMPER) return 0.0;
#else
  if (m->opt.integrator != mjINT_EULER && passive_disabled(m)) return 0.0;
#endif
#if mjVERSION_HEADER >= 300
  if (m->opt.integrator == mjINT_EULER && (m->opt.disableflags & mjDSBL_EULERDAMP)) return 0.0;
#endif
  return m->opt.timestep;
}

// The number of coefficients of a stiffness or damping polynomial beyond the first.
#ifdef mjNPOLY
inline constexpr int kPolynomial = mjNPOLY;
#else
inline constexpr int kPolynomial = 0;
#endif

// --- The solver ---

// The improvement in the last iteration of the last solve, if <option iterations> stopped it above
// its tolerance; else 0. With several islands it is the largest of them.
template <typename Model, typename Data>
double unconverged(const Model* m, const Data* d) {
  const auto island = [&](const auto* iterations, int n) {
    if (n < m->opt.iterations || n < 1 || n > mjNSOLVER) return 0.0;
    const double change = iterations[n - 1].improvement;
    return m->opt.tolerance > 0.0 && change > m->opt.tolerance ? change : 0.0;
  };
  if constexpr (requires { d->solver_niter; }) {
    double most = 0.0;
    constexpr int kRoom = sizeof d->solver_niter / sizeof d->solver_niter[0];
    const int islands = count(d->nisland) < kRoom ? count(d->nisland) : kRoom;
    for (int k = 0; k == 0 || k < islands; ++k) {
      const double left = island(d->solver + k * mjNSOLVER, d->solver_niter[k]);
      most = left > most ? left : most;
    }
    return most;
  } else {
    return island(d->solver, d->solver_iter);
  }
}

// --- Documents in memory ---

// Like mj_loadXML for a file with this text.
template <typename Files = mjVFS>
mjModel* load_text(const std::string& document, char* error, int error_size) {
  constexpr const char* kFile = "document.xml";
  struct Delete {
    void operator()(Files* f) const {
      mj_deleteVFS(f);
      delete f;
    }
  };
  const std::unique_ptr<Files, Delete> owned(new Files);  // too large for the stack in 2.2
  Files* files = owned.get();
  mj_defaultVFS(files);
  const int size = static_cast<int>(document.size());
  if constexpr (requires { mj_addBufferVFS(files, kFile, document.data(), size); }) {
    mj_addBufferVFS(files, kFile, document.data(), size);
  } else if (mj_makeEmptyFileVFS(files, kFile, size) == 0) {
    document.copy(static_cast<char*>(files->filedata[mj_findFileVFS(files, kFile)]),
                  document.size());
  }
  return mj_loadXML(kFile, files, error, error_size);
}

// --- Drawing ---

template <typename Geom>
void connect(Geom* geom, int type, mjtNum width, const mjtNum* from, const mjtNum* to) {
  if constexpr (requires { mjv_connector(geom, type, width, from, to); }) {
    mjv_connector(geom, type, width, from, to);
  } else {
    mjv_makeConnector(geom, type, width, from[0], from[1], from[2], to[0], to[1], to[2]);
  }
}

template <typename Light>
void make_directional(Light& light) {
  if constexpr (requires { light.directional; }) {
    light.directional = 1;
  } else {
    light.type = 1;  // mjLIGHT_DIRECTIONAL
  }
}

// --- The version itself ---

// 222 becomes 2002002; 3012000 stays as it is.
constexpr int full_version(int number) {
  if (number >= 1000000) return number;
  return number / 100 * 1000000 + number / 10 % 10 * 1000 + number % 10;
}
inline std::string version_text(int number) {
  const int n = full_version(number);
  return std::to_string(n / 1000000) + "." + std::to_string(n / 1000 % 1000) + "." +
         std::to_string(n % 1000);
}

}  // namespace rotorub::plugin
