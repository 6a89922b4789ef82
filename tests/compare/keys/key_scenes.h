// Scenes in which, together, every key of the schema matters: the bases of pair_parts.h, each of
// its parts, and scenes for keys that no pair needs.
#pragma once

#include <string>
#include <vector>

#include "tests/support/pair_parts.h"

namespace rotorub::test {

struct KeyScene {
  std::string name;
  const char* base;
  std::vector<std::string> overrides;
};

inline std::vector<KeyScene> key_scenes() {
  std::vector<KeyScene> all{{"modal", kBaseModal, {}}, {"shaft", kBaseGeometry, {}}};
  for (const Part& part : pair_parts()) {
    if (!part.modal.empty()) all.push_back({"modal: " + part.name, kBaseModal, part.modal});
    if (!part.geometry.empty())
      all.push_back({"shaft: " + part.name, kBaseGeometry, part.geometry});
  }
  const auto modal = [&](const char* name, std::vector<std::string> overrides) {
    all.push_back({std::string("modal: ") + name, kBaseModal, std::move(overrides)});
  };
  const auto shaft = [&](const char* name, std::vector<std::string> overrides) {
    all.push_back({std::string("shaft: ") + name, kBaseGeometry, std::move(overrides)});
  };

  modal("given damping", {"contact.compliance={stiffness=5e6,damping=900.0}"});
  modal("given Hunt and Crossley", {"contact.compliance={stiffness=5e6,hunt_crossley=0.7}"});

  // Controllers, their measurements and their commands.
  const std::string sampled = "sample_time=2.5e-4";
  modal("pd", {"controller={kind='pd',on=0.5e-3,gap_time=4e-3,stiffness=5e4,damping=200.0,"
               "preload=15.0}"});
  modal("sampled sliding",
        {"controller={kind='sliding',layer='adaptive',on=0.5e-3,gap_time=4e-3,bandwidth=400.0,"
         "boundary_layer=0.1,switching_gain=60.0," +
         sampled + "}"});
  modal("sampled support",
        {"controller={kind='passive',stiffness=4e4,damping=120.0," + sampled + "}"});
  modal("noise", {"controller={kind='passive',stiffness=4e4,damping=120.0," + sampled +
                  ",sensors={position_noise=1e-6}}"});
  modal("cross-coupled", {"controller={kind='cross_coupled',feedback=[300.0,500.0],"
                          "feedback_speed=[100.0,400.0],damping=50.0}"});
  modal("two-phase",
        {"controller={kind='two_phase',gap_time=3e-3,handover_time=2e-3,feedback=[300.0],"
         "bandwidth=400.0,boundary_layer=0.1," +
         sampled + "}"});
  modal("lqr", {"controller={kind='lqr'," + sampled + "}"});
  modal("lqg", {"controller={kind='lqg'," + sampled + "}"});
  // A rotor in magnetic bearings whose feedbacks have a memory.
  modal("lqr, amplifier",
        {"controller={kind='lqr'," + sampled + "}",
         "magnetic_bearing={negative_stiffness=3e4,amplifier={bandwidth=8000.0},control={force_per_"
         "current=60.0,proportional=2000.0,integral=2e4,derivative=1.0,derivative_lag=2e-4}}"});
  for (const char* kind : {"lqr", "lqg"}) {
    modal((std::string(kind) + ", sampled magnets").c_str(),
          {std::string("controller={kind='") + kind + "'," + sampled + "}",
           "magnetic_bearing={negative_stiffness=3e4,control={force_per_current=60.0,"
           "proportional=2000.0,derivative=1.0,delay=2.5e-4," +
               sampled + "}}"});
  }
  modal("limited force",
        {"actuator={kind='ideal',force_limit=5.0}", "controller={kind='passive',stiffness=4e4}"});
  const std::string magnets =
      "actuator={kind='electromagnet',force_constant=3e-4,bias_current=3.0,air_gap=5e-3,"
      "coil_lag=3e-4";
  const std::string support = "controller={kind='passive',stiffness=4e4,damping=120.0}";
  modal("limited rate", {magnets + ",current_rate_limit=500.0}", support});
  modal("limited voltage",
        {magnets + ",voltage_limit=1.0,inductance=5e-3,resistance=1.0}", support});
  modal("actuator by a table",
        {"actuator={kind='table',coil_lag=3e-4,table_position=[-2e-3,-1e-3,1e-3,2e-3],"
         "table_current=[-3.0,-1.0,1.0,3.0],table_force=[-70.0,-22.0,24.0,80.0,-72.0,-21.0,23.0,"
         "74.0,-74.0,-23.0,21.0,72.0,-80.0,-24.0,22.0,70.0]}",
         support});

  modal("magnets without control",
        {"magnetic_bearing={kind='electromagnet',force_constant=1e-5,bias_current=1.0,"
         "air_gap=1e-3}"});

  // Sampled controls of magnetic bearings.
  const auto magnetic = [&](const char* name, const std::string& control,
                            const std::string& shared = {}) {
    std::vector<std::string> overrides{
        "magnetic_bearing={negative_stiffness=3e4,control={force_per_current=60.0,"
        "proportional=2000.0," +
        control + "}}"};
    if (!shared.empty()) overrides.push_back("magnetic_control={" + sampled + "," + shared + "}");
    modal(name, std::move(overrides));
  };
  magnetic("magnets by a transfer function",
           "kind='transfer_function',numerator=[3000.0,-1000.0],denominator=[1.0,-0.2]," + sampled);
  magnetic("magnets by matrices",
           "kind='state_space',state_matrix=[0.5],input_matrix=[1.0],output_matrix=[500.0],"
           "feedthrough=[2000.0]," +
               sampled);
  magnetic("magnets under one law", "kind='shared'",
           "delay=2.5e-4,state_matrix=[0.5],input_matrix=[1.0,0.6],output_matrix=[500.0,300.0],"
           "feedthrough=[2000.0,100.0,-100.0,2000.0]");

  magnetic("magnets under one law at once", "kind='shared'",
           "state_matrix=[0.5],input_matrix=[1.0,0.6],output_matrix=[500.0,300.0],"
           "feedthrough=[2000.0,100.0,-100.0,2000.0]");

  // Starts.
  modal("steady", {"initial={steady=true}", "force[0].amplitude=12.0"});
  modal("on a rub", {"initial={rub='synchronous'}"});
  modal("sticking impacts", {"rotor.speed=0.5", "contact.friction=0.9"});
  modal("driven torsion",
        {"rotor.torsion={inertia=[4e-4],stiffness=[60.0],damping=[0.01],drive_shape=[-0.5]}",
         "drive={kind='linear',gain=2.0,speed=400.0}"});
  modal("random base", {"base={frequency=[200.0,510.0],amplitude=[60.0,40.0],seed=3}"});
  modal("gravity and spin", {"gravity={acceleration=[0.5,-9.81]}", "drive={kind='free'}"});

  // Several contacts.
  const std::string contact = "radius=0.03,clearance=0.5e-3,friction=0.2,restitution=0.4";
  const std::string ring = "stator={mass=1.0,damping=200.0,stiffness=1e5}";
  modal("two contacts",
        {"stator=none", "rotor.torsion={inertia=[4e-4],stiffness=[60.0]}", "drive={kind='free'}",
         "contact=[{" + contact + "," + ring + "},{shape=[0.9]," + contact + "," + ring + "}]"});

  // Shafts.
  shaft("disc by its dimensions",
        {"rotor.disc[0]={z=0.30,diameter=0.2,inner_diameter=0.02,thickness=8e-3,rho=7800.0,"
         "unbalance=1e-3,phase=0.3}"});
  shaft("balance grade",
        {"rotor.disc[0].balance_grade='G 400'", "rotor.disc[0].balance_speed=300.0"});
  shaft("cone", {"rotor.section[0].inner_diameter=4e-3", "rotor.section[0].end_diameter=0.02",
                 "rotor.section[0].end_inner_diameter=5e-3"});
  shaft("shear modulus",
        {"rotor.nu=none", "rotor.G=8e10", "rotor.torsion={modes=1,damping_ratio=0.01}",
         "drive={kind='linear',gain=2.0,speed=400.0,inertia=2e-3,station=0.1}"});
  shaft("Poisson's ratio", {"rotor.torsion={modes=1,damping_ratio=0.01}",
                            "drive={kind='linear',gain=2.0,speed=400.0,inertia=2e-3}"});
  shaft("shear", {"rotor.theory='timoshenko'", "rotor.nu=0.3", "rotor.shear_coefficient=0.8"});
  shaft("shear by Cowper", {"rotor.theory='timoshenko'", "rotor.nu=0.3"});
  shaft(
      "journal bearing",
      {"rotor.bearing[2]={z=0.45,journal={diameter=0.02,length=0.01,clearance=5e-5,viscosity=0.02,"
       "load=30.0,load_angle=-1.2,theory='short'}}"});
  shaft("pedestal",
        {"rotor.bearing[0].pedestal={mass=3.0,stiffness=[2e7,3e7],damping=[400.0,300.0]}"});
  // With a sleeve, because without one no number of modes is enough.
  shaft("modes by themselves", {"initial=none", "rotor.modes='auto'", "rotor.modes_tolerance=0.5",
                                "rotor.disc[1]={z=0.28,mass=1.0,Jt=1e-4,Jp=2e-4}"});
  shaft("modes by number", {"initial=none"});
  shaft("modes by frequency", {"initial=none", "rotor.modes=none", "rotor.max_frequency=900.0"});
  shaft("segments", {"mujoco={rotor='segments',segments=12}"});
  return all;
}

}  // namespace rotorub::test
