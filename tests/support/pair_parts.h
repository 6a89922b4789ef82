// The parts that a machine may have, each as overrides of a small base scene: in geometry form (a
// shaft with two modes) and in modal form (one mode).
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace rotorub::test {

enum class Form { kGeometry, kModal };

// Parts of one group exclude each other: for example, a machine has only one drive.
struct Part {
  std::string name, group;
  std::vector<std::string> geometry, modal;  // overrides; empty if the form lacks the part
  const std::vector<std::string>& overrides(Form form) const {
    return form == Form::kGeometry ? geometry : modal;
  }
};

// The base of every scene: a rotor that moves towards an elastic ring under a rotating load. Within
// 10 ms it bounces, and begins to slide if the restitution is low enough. All numbers differ.
inline constexpr const char* kBaseGeometry = R"(
[run]
end = 0.010
step = 1e-5
output_step = 1e-3
[rotor]
speed = 310.0
length = 0.60
E = 2.1e11
nu = 0.3
rho = 7850.0
modes = 2
damping_ratio = 0.03
[[rotor.section]]
from = 0.0
to = 0.60
diameter = 0.018
[[rotor.disc]]
z = 0.30
mass = 2.0
Jt = 1.8e-3
Jp = 3.6e-3
[[rotor.bearing]]
z = 0.03
stiffness = 2e7
[[rotor.bearing]]
z = 0.57
stiffness = 2e7
[contact]
station = 0.28
radius = 0.02
clearance = 0.5e-3
friction = 0.2
restitution = 0.4
[stator]
mass = 1.5
damping = 300.0
stiffness = 2e5
[[force]]
kind = "rotating"
amplitude = 180.0
frequency = 290.0
phase = 0.4
station = 0.42
[initial]
x = [0.2e-3, 0.01e-3]
y = [-0.1e-3, -0.02e-3]
vx = [0.25, 0.02]
vy = [0.05, -0.03]
)";

inline constexpr const char* kBaseModal = R"(
[run]
end = 0.010
step = 1e-5
output_step = 1e-3
[rotor]
speed = 310.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
inertia = 2e-3
[contact]
radius = 0.03
clearance = 0.5e-3
friction = 0.2
restitution = 0.4
[stator]
mass = 1.0
damping = 200.0
stiffness = 1e5
[[force]]
kind = "rotating"
amplitude = 180.0
frequency = 290.0
phase = 0.4
[initial]
x = [0.2e-3]
y = [-0.1e-3]
vx = [0.25]
vy = [0.05]
)";

// The sample time; a whole multiple of every step in the tests.
inline constexpr const char* kSampleTime = "1e-3";

inline std::vector<Part> pair_parts() {
  const std::string magnets =
      "actuator={kind='electromagnet',force_constant=3e-4,bias_current=3.0,air_gap=5e-3";
  const std::string support = "controller={kind='passive',stiffness=4e4,damping=120.0";
  const std::string sliding =
      "controller={kind='sliding',on=0.61234e-3,gap_time=4e-3,bandwidth=400.0,boundary_layer=0.1,"
      "switching_gain=60.0";
  const auto both = [](const std::vector<std::string>& o) { return std::pair{o, o}; };
  std::vector<Part> parts;
  const auto add = [&](const char* name, const char* group, std::vector<std::string> geometry,
                       std::vector<std::string> modal) {
    parts.push_back({name, group, std::move(geometry), std::move(modal)});
  };
  const auto add_both = [&](const char* name, const char* group,
                            const std::vector<std::string>& o) {
    auto [g, m] = both(o);
    add(name, group, std::move(g), std::move(m));
  };

  // Rotor.
  add("gyroscopics", "gyroscopics",
      {"rotor.disc[0].z=0.15", "rotor.disc[0].Jt=1e-2", "rotor.disc[0].Jp=2e-2"},
      {"rotor.modal.gyroscopic=[0.4]"});
  add("internal_damping", "internal_damping", {"rotor.internal_damping_ratio=0.03"},
      {"rotor.modal.internal_damping=[35.0]"});
  add("unbalance", "unbalance", {"rotor.disc[0].eccentricity=0.5e-3", "rotor.disc[0].phase=0.7"},
      {});
  add("torsion", "torsion", {"rotor.torsion={modes=1,damping_ratio=0.01}"},
      {"rotor.torsion={inertia=[4e-4],stiffness=[60.0],damping=[0.01],drive_shape=[-0.5]}"});
  add("anisotropic_rotor", "anisotropic_rotor",
      {"rotor.bearing[0].stiffness=[2e7,2e6]", "rotor.bearing[1].stiffness=[2e7,3e6]"},
      {"rotor.modal.mass_y=[2.4]", "rotor.modal.stiffness_y=[1.5e5]",
       "rotor.modal.damping_y=[55.0]"});
  add("bearing_dampers", "bearing_dampers",
      {"rotor.bearing[0].damping=[900.0,600.0]", "rotor.bearing[1].damping=500.0"}, {});
  add("bearing_offset", "bearing_offset", {"rotor.bearing[0].offset=[0.06e-3,-0.03e-3]"}, {});
  add("crossed_bearings", "film",
      {"rotor.bearing[0].cross_stiffness=[4e6,-3e6]",
       "rotor.bearing[1].cross_damping=[200.0,-150.0]"},
      {});
  // A bearing between the others whose coefficients change considerably over the run with a free
  // spin.
  add("film_tables", "film",
      {"rotor.bearing[2]={z=0.45,offset=[0.0,0.03e-3],table_speed=[295.0,305.0,320.0],table_kxx=["
       "2e5,3e5,2.5e5],"
       "table_kxy=[1e5,2e5,2.2e5],table_kyx=[-1.5e5,-2e5,-1e5],table_cxx=[90.0,60.0,70.0],table_"
       "cxy=[10.0,15.0,20.0]}"},
      {});

  // Drives.
  add("free_spin", "drive", {"drive={kind='free',inertia=2e-3}"}, {"drive={kind='free'}"});
  add("linear_drive", "drive", {"drive={kind='linear',gain=0.5,speed=330.0,inertia=2e-3}"},
      {"drive={kind='linear',gain=0.5,speed=330.0}"});
  add("kloss_drive", "drive",
      {"drive={kind='kloss',breakdown_torque=8.0,breakdown_slip=0.2,synchronous_speed=330.0,"
       "inertia=2e-3}"},
      {"drive={kind='kloss',breakdown_torque=8.0,breakdown_slip=0.2,synchronous_speed=330.0}"});
  add("table_drive", "drive",
      {"drive={kind='table',table_speed=[0.0,300.0,400.0],table_torque=[9.0,6.0,-12.0],"
       "inertia=2e-3}"},
      {"drive={kind='table',table_speed=[0.0,300.0,400.0],table_torque=[9.0,6.0,-12.0]}"});

  add("speed_controlled", "drive",
      {"drive={kind='speed_controlled',gain=0.6,integral_gain=12.0,speed=340.0,acceleration=4000.0,"
       "inertia=2e-3}"},
      {"drive={kind='speed_controlled',gain=0.6,integral_gain=12.0,speed=340.0,acceleration=4000."
       "0}"});

  // Ring and magnets.
  add_both(
      "anisotropic_ring", "ring",
      {"stator.mass=[1.3,0.9]", "stator.stiffness=[1.2e5,2.3e5]", "stator.damping=[250.0,150.0]"});
  add_both("ring_offset", "ring_offset", {"contact.offset=[0.09e-3,-0.06e-3]"});
  add_both("turning_ring", "turning_ring", {"stator.spin={inertia=2e-4,drag=8e-3,speed=-40.0}"});
  // Supports of the ring.
  add_both("ball_bearing", "ring_support",
           {"stator.ball_bearing={balls=9,stiffness=4e8,play=0.05e-3,phase=0.2}"});
  add_both("dry_spin", "turning_ring",
           {"stator.spin={inertia=3e-4,speed=-30.0,dry_drag=0.03,load_factor=2e-3,pitch_diameter="
            "0.08,presliding_angle=0.05}"});
  add_both("mounted_ring", "ring_support",
           {"stator.mount={mass=2.5,stiffness=[3e5,4e5],damping=[60.0,90.0]}",
            "stator.dry_friction={force=12.0,presliding=4e-5}",
            "stator.squeeze_film={radius=0.06,length=0.012,clearance=1.5e-3,viscosity=0.4,"
            "cavitation=false}"});
  add("magnetic_bearing", "magnetic_bearing",
      {"magnetic_bearing={station=0.42,negative_stiffness=4.5e4}"},
      {"magnetic_bearing={negative_stiffness=4.5e4}"});
  // At its limit at the start; fails during the run.
  add("magnetic_feedback", "magnetic_bearing",
      {"magnetic_bearing={station=0.42,negative_stiffness=4.5e4,control={force_per_current=60.0,"
       "proportional=2500.0,derivative=3.0,current_limit=0.9,fails_at=6.54321e-3}}"},
      {"magnetic_bearing={negative_stiffness=4.5e4,control={force_per_current=60.0,"
       "proportional=2500.0,derivative=3.0,current_limit=0.9,fails_at=6.54321e-3}}"});
  add("magnetic_integral", "magnetic_bearing",
      {"magnetic_bearing={station=0.42,negative_stiffness=4.5e4,control={force_per_current=60.0,"
       "proportional=2500.0,integral=3e5,derivative=3.0,current_limit=0.9}}"},
      {"magnetic_bearing={negative_stiffness=4.5e4,control={force_per_current=60.0,"
       "proportional=2500.0,integral=3e5,derivative=3.0,current_limit=0.9}}"});
  // Two magnets behind an amplifier that starts at its voltage limit; they are off twice.
  const std::string opposed =
      "kind='electromagnet',force_constant=1e-5,bias_current=1.5,air_gap=1e-3,control={"
      "proportional=3000.0,derivative=3.0,derivative_lag=2e-4,on=0.31416e-3,fails_at=5.4321e-3,"
      "returns_at=6.54321e-3},amplifier={bandwidth=6000.0,voltage_limit=12.0,inductance=0.02,"
      "resistance=0.5}}";
  add("opposed_magnets", "magnetic_bearing", {"magnetic_bearing={station=0.42," + opposed},
      {"magnetic_bearing={" + opposed});
  // Sampled with a delay; at its limit at the start.
  const std::string asked =
      "negative_stiffness=4.5e4,control={force_per_current=60.0,proportional=2500.0,integral=1e5,"
      "derivative=1.0,derivative_lag=5e-4,current_limit=0.9,sample_time=" +
      std::string(kSampleTime) + ",delay=" + kSampleTime + "}}";
  add("sampled_magnets", "magnetic_bearing", {"magnetic_bearing={station=0.42," + asked},
      {"magnetic_bearing={" + asked});
  // One at its limit; the other with its sensor elsewhere, failing during the run.
  const std::string limited =
                        "negative_stiffness=4.5e4,control={force_per_current=60.0,proportional="
                        "2500.0,integral=3e5,derivative=3.0,current_limit=0.9}}",
                    failing =
                        "negative_stiffness=3e4,control={force_per_current=50.0,proportional="
                        "1800.0,integral=2e5,derivative=2.0,fails_at=6.54321e-3}}";
  add("two_magnetic_bearings", "magnetic_bearing",
      {"magnetic_bearing=[{station=0.42," + limited + ",{station=0.12,sensor_station=0.16," +
       failing + "]"},
      {"magnetic_bearing=[{" + limited + ",{shape=[0.7],sensor_shape=[0.8]," + failing + "]"});
  add_both("magnets", "actuator", {magnets + "}"});
  add_both("coil_lag", "actuator", {support + "}", magnets + ",coil_lag=3e-4}"});

  // Control: an additional spring and damper, and sliding-mode control; sampled or continuous.
  add_both("sampled_support", "control", {support + ",sample_time=" + kSampleTime + "}"});
  add_both("continuous_support", "control", {support + "}"});
  add_both("continuous_sliding", "control", {sliding + "}"});

  // Loads, switched at times that are not multiples of any step.
  add_both("gravity", "gravity", {"gravity={acceleration=[0.5,-9.81]}"});
  add("switched_load", "switched_load",
      {"force[1]={kind='constant',vector=[60.0,40.0],on=1.2345678e-3,off=7.654321e-3,"
       "station=0.42}"},
      {"force[1]={kind='constant',vector=[60.0,40.0],on=1.2345678e-3,off=7.654321e-3}"});
  add("ramped_load", "ramped_load", {"force[0].on=0.3141593e-3", "force[0].ramp=5.4321e-3"},
      {"force[0].on=0.3141593e-3", "force[0].ramp=5.4321e-3"});
  // Loads that are synchronous, sweep or strike, and a lost blade; at most one of these or the
  // switched one.
  add("locked_load", "switched_load",
      {"force[1]={kind='synchronous',amplitude=70.0,phase=0.9,on=0.7654321e-3,station=0.36}"},
      {"force[1]={kind='synchronous',amplitude=70.0,phase=0.9,on=0.7654321e-3}"});
  add("passing_loads", "switched_load",
      {"force[1]={kind='chirp',amplitude=60.0,frequency=150.0,frequency_end=700.0,phase=0.2,"
       "on=0.4321e-3,off=8.7654e-3,station=0.36}",
       "force[2]={kind='pulse',vector=[-90.0,60.0],on=2.345678e-3,off=5.4321e-3,station=0.2}"},
      {"force[1]={kind='chirp',amplitude=60.0,frequency=150.0,frequency_end=700.0,phase=0.2,"
       "on=0.4321e-3,off=8.7654e-3}",
       "force[2]={kind='pulse',vector=[-90.0,60.0],on=2.345678e-3,off=5.4321e-3}"});
  add("lost_blade", "switched_load",
      {"force[1]={kind='unbalance',static_moment=1e-3,phase=0.5,on=1.357911e-3,station=0.30}"},
      {"force[1]={kind='unbalance',static_moment=1e-3,phase=0.5,on=1.357911e-3}"});

  // The base: a table whose times are not multiples of any step, and harmonic components.
  add_both("quake", "base",
           {"base={time=[0.4321e-3,1.7654e-3,4.321e-3,7.1234e-3],acceleration_x=[0.0,90.0,-60.0,"
            "20.0],acceleration_y=[5.0,-40.0,50.0,-30.0],off=6.789e-3}"});
  add_both("swell", "base",
           {"base={frequency=[200.0,510.0],amplitude=[60.0,40.0],phase=[0.3,1.9],direction=0.6,"
            "on=0.7654e-3,ramp=3.21e-3}"});
  // Friction that decreases and increases again over the slips of the run.
  add_both("falling_friction", "friction",
           {"contact.friction={static=0.25,kinetic=0.12,stribeck_speed=5.0,viscous=4e-3}"});

  // Impacts of finite duration.
  add_both("finite_impacts", "impacts",
           {"contact.compression_time=2.1e-4", "contact.expansion_time=1.3e-4"});
  // A compliant contact.
  add_both("giving_contact", "impacts", {"contact.compliance={stiffness=1e9,exponent=1.5}"});

  // The shaft and its bearings once more.
  add("shear_under_tension", "shear", {"rotor.theory='timoshenko'", "rotor.axial_force=5e3"}, {});
  // Refused beside internal damping.
  add("pedestal", "internal_damping",
      {"rotor.bearing[0].pedestal={mass=3.0,stiffness=[6e6,4e6],damping=[80.0,120.0]}"}, {});
  add("journal", "film",
      {"rotor.bearing[2]={z=0.45,offset=[0.0,0.03e-3],journal={diameter=0.018,length=0.009,"
       "clearance=0.1e-3,viscosity=0.02,load=20.0}}"},
      {});
  return parts;
}

}  // namespace rotorub::test
