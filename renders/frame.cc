#include "renders/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "native_model/rotor/modal_rotor.h"
#include "renders/framing.h"
#include "renders/machine_view.h"
#include "renders/mujoco_errors.h"
#include "renders/overlay.h"
#include "renders/palette.h"
#include "renders/section_view.h"

namespace rotorub::renders {

// Where each part of the picture lies, OpenGL's pixels (from the bottom).
struct FrameLayout {
  mjrRect machine, section, left_chart, right_chart;
};

// A second run with its own view of time.
struct FrameGhost {
  Playback playback;
  std::string label;
};

namespace {

constexpr double kArrowShare = 0.85;    // of the rotor's radius: arrow of a large force
constexpr double kLargeForce = 0.95;    // quantile of the normal force in contact
constexpr double kLeastGap = 0.01;      // of the clearance: height of the gap's chart
constexpr double kTrailFilmTime = 0.9;  // s of film that the path reaches back
constexpr double kSparkFilmTime = 0.3;  // s of film that an impact glows

std::optional<ModeLines> lines_of(const scene::Scene& scene) {
  if (!scene.rotor.geometry) return std::nullopt;
  return modal_rotor(scene).lines;
}

FrameLayout make_layout(int width, int height, bool contact) {
  const int gap = 6;
  const int charts = contact ? static_cast<int>(0.24 * height) : 0;
  const int upper = height - charts;
  const int section = contact ? std::min(upper, static_cast<int>(0.46 * width)) : 0;
  FrameLayout layout;
  layout.machine = {0, charts, width - section, upper};
  layout.section = {width - section, charts, section, upper};
  const int half = (width - 3 * gap) / 2;
  layout.left_chart = {gap, gap, half, charts - gap};
  layout.right_chart = {2 * gap + half, gap, width - 3 * gap - half, charts - gap};
  return layout;
}

std::string length_text(double metres) {
  return metres >= 1e-4 ? fmt::format("{:.4g} mm", metres * 1e3)
                        : fmt::format("{:.4g} um", metres * 1e6);
}

std::string magnified_text(const Machine& machine) {
  return fmt::format("displacements x{:.4g}", machine.magnification);
}

}  // namespace

struct FramePainter::Parts {
  Playback playback;
  std::optional<FrameGhost> ghost;
  Framing framing;
  Machine machine, section;  // the same machine, each magnified for its view
  InstantOptions instant;
  double force_length = 0.0;   // drawn length of one newton
  bool impulses_only = false;  // the force chart shows impacts
  std::string title, label;

  std::vector<Mesh> meshes;
  std::optional<MachineView> machine_view;
  std::optional<SectionView> section_view;
  std::optional<Chart> gap_chart, force_chart;
  std::optional<Stage> stage;
  std::optional<SceneBuffer> machine_scene, section_scene;
  FrameLayout layout;

  Parts(const scene::Scene& scene, const Trajectory& trajectory, const RenderOptions& options);
  double ring_motion() const;  // m
  void make_machines(const scene::Scene& scene, const RenderOptions& options);
  void make_views(const Trajectory& trajectory);
  void make_charts(const Trajectory& trajectory, bool lasting_contact);
  void make_stage(const RenderOptions& options);
  void write_machine_text(const Pose& pose) const;
  void write_section_text(const Pose& pose) const;
  void draw_charts(const Pose& pose) const;
};

FramePainter::Parts::Parts(const scene::Scene& scene, const Trajectory& trajectory,
                           const RenderOptions& options)
    : playback(trajectory) {
  check_options(options);
  framing = make_framing(playback, options);
  title = options.title.empty() ? scene.name : options.title;
  label = options.engine_label.empty() ? engine_label(trajectory) : options.engine_label;
  if (options.shadow != nullptr) {
    ghost.emplace(FrameGhost{Playback(*options.shadow), options.shadow_label.empty()
                                                       ? engine_label(*options.shadow)
                                                       : options.shadow_label});
    if (ghost->playback.modes() != playback.modes()) {
      throw std::runtime_error("render: the shadow's series has another number of bending modes");
    }
  }
  make_machines(scene, options);
  instant.trail_time = kTrailFilmTime / framing.slow_motion;
  instant.spark_time = kSparkFilmTime / framing.slow_motion;
  instant.impulse_scale = 0.0;
  for (const Strike& strike : playback.strikes()) {
    instant.impulse_scale = std::max(instant.impulse_scale, strike.impulse);
  }
  make_views(trajectory);
  make_stage(options);
}

double FramePainter::Parts::ring_motion() const {
  const double motion = playback.largest_stator(framing.from, framing.to);
  if (!ghost) return motion;
  return std::max(motion, ghost->playback.largest_stator(framing.from, framing.to));
}

void FramePainter::Parts::make_machines(const scene::Scene& scene, const RenderOptions& options) {
  const std::optional<ModeLines> lines = lines_of(scene);
  const auto make = [&](std::optional<double> magnification) {
    return make_machine(scene, lines, playback, framing.from, framing.to, magnification);
  };
  machine = make(options.machine_magnification);
  section = make(options.magnification.value_or(section_magnification(scene, ring_motion())));
  framing.magnification = section.magnification;
  framing.machine_magnification = machine.magnification;
}

void FramePainter::Parts::make_views(const Trajectory& trajectory) {
  machine_view.emplace(machine, meshes);
  if (!machine.contact) return;
  section_view.emplace(section, ring_motion(), meshes);
  const double large = playback.force_quantile(kLargeForce, framing.from, framing.to);
  if (large > 0.0) force_length = kArrowShare * section.contact->rotor_radius / large;

  make_charts(trajectory, large > 0.0);
}

void FramePainter::Parts::make_charts(const Trajectory& trajectory, bool lasting_contact) {
  Chart::Options options;
  options.from = framing.from;
  options.to = framing.to;
  options.scale_from = std::clamp(playback.first_touch(), framing.from, framing.to);
  options.color = palette::kTrail;
  options.unit = "um";
  std::vector<double> gap = trajectory.column("gap");
  for (double& value : gap) value *= 1e6;
  options.least_height = kLeastGap * section.clearance * 1e6;
  gap_chart.emplace(trajectory.column("t"), gap, options);
  options.least_height = 0.0;

  // Where contact never lasts, the impulses of the impacts say more than a force of zero.
  options.color = palette::kNormal;
  options.unit = "N";
  if (lasting_contact || playback.strikes().empty()) {
    force_chart.emplace(trajectory.column("t"), trajectory.column("normal_force"), options);
    return;
  }
  std::vector<double> times, impulses;
  for (const Strike& strike : playback.strikes()) {
    times.push_back(strike.t);
    impulses.push_back(strike.impulse);
  }
  options.unit = "N s";
  options.stems = true;
  impulses_only = true;
  force_chart.emplace(times, impulses, options);
}

void FramePainter::Parts::make_stage(const RenderOptions& options) {
  const MujocoErrors errors;
  stage.emplace(StageOptions{options.width, options.height, options.samples, palette::kBackground},
                meshes);
  layout = make_layout(options.width, options.height, section_view.has_value());
  machine_scene.emplace(stage->model());
  machine_view->set_up(**machine_scene,
                       static_cast<double>(layout.machine.width) / layout.machine.height);
  if (!section_view) return;
  section_scene.emplace(stage->model());
  section_view->set_up(**section_scene);
}

void FramePainter::Parts::write_machine_text(const Pose& pose) const {
  const Pen pen(stage->context(), layout.machine);
  const int step = pen.line_height() + 3;
  const int left = 14;
  int y = 10;
  pen.write(left, y, title, palette::kInk);
  pen.write(left, y += step, label, palette::kFaintInk);
  if (ghost) pen.write(left, y + step, "translucent: " + ghost->label, palette::kGhost);

  const auto right = [&](int row, const std::string& text, const Color& color) {
    pen.write(layout.machine.width - 14 - pen.width(text), row, text, color);
  };
  right(10, fmt::format("t = {:.5f} s", pose.t), palette::kInk);
  right(10 + step, fmt::format("slow motion 1:{:.3g}", framing.slow_motion), palette::kFaintInk);

  const int bottom = layout.machine.height - step - 6;
  pen.write(left, bottom, magnified_text(machine), palette::kInk);
}

void FramePainter::Parts::write_section_text(const Pose& pose) const {
  const Pen pen(stage->context(), layout.section);
  const int step = pen.line_height() + 3;
  const int left = 10;
  const bool touching = pose.mode != Mode::kFree;
  pen.write(left, 10, fmt::format("mode: {}", to_string(pose.mode)),
            touching ? palette::kNormal : palette::kInk);

  // The clearance as a scale of displacements, as long as it is drawn.
  const double pixels = layout.section.height / (2.0 * section_view->half_size());
  const int bar = static_cast<int>(std::lround(section.contact->clearance * pixels));
  const int y = layout.section.height - 12;
  pen.bar(left, y, bar, 3, palette::kInk);
  pen.write(left, y - step, "clearance " + length_text(section.clearance), palette::kInk);
  const std::string magnified = magnified_text(section);
  pen.write(layout.section.width - 10 - pen.width(magnified), y - 10, magnified, palette::kInk);
}

void FramePainter::Parts::draw_charts(const Pose& pose) const {
  gap_chart->draw(stage->context(), layout.left_chart, pose.t, "gap",
                  fmt::format("{:.1f} um", 1e6 * pose.gap));
  if (impulses_only) {
    double last = 0.0;
    for (const Strike& strike : playback.strikes()) {
      if (strike.t <= pose.t) last = strike.impulse;
    }
    force_chart->draw(stage->context(), layout.right_chart, pose.t, "normal impulse, last",
                      fmt::format("{:.4f} N s", last));
    return;
  }
  const int x = force_chart->draw(stage->context(), layout.right_chart, pose.t, "normal force",
                                  fmt::format("{:.1f} N", pose.normal_force));
  const Pen pen(stage->context(), layout.right_chart);
  const int after = pen.write(x, 3, "friction", palette::kInk);
  pen.write(after + 10, 3, fmt::format("{:.1f} N", pose.friction_force), palette::kFriction);
}

FramePainter::FramePainter(const scene::Scene& scene, const Trajectory& trajectory,
                           const RenderOptions& options)
    : parts_(std::make_unique<Parts>(scene, trajectory, options)) {}

FramePainter::~FramePainter() = default;

const Framing& FramePainter::framing() const { return parts_->framing; }

Image FramePainter::paint(double t) {
  Parts& p = *parts_;
  const MujocoErrors errors;
  const Instant instant = instant_at(p.playback, t, p.instant);
  std::optional<Pose> ghost;
  if (p.ghost) ghost = p.ghost->playback.at(t);
  const Pose* other = ghost ? &*ghost : nullptr;

  p.stage->begin_picture();
  const mjrContext& context = p.stage->context();
  const Color& paper = palette::kBackground;
  mjr_rectangle({0, 0, p.stage->width(), p.stage->height()}, paper.red, paper.green, paper.blue,
                1.0F);
  p.machine_view->draw(*p.stage, **p.machine_scene, instant, other, p.force_length);
  mjr_render(p.layout.machine, &**p.machine_scene, &context);
  p.write_machine_text(instant.pose);
  if (p.section_view) {
    p.section_view->draw(*p.stage, **p.section_scene, instant, other, p.force_length);
    mjr_render(p.layout.section, &**p.section_scene, &context);
    p.write_section_text(instant.pose);
    p.draw_charts(instant.pose);
  }
  Image picture;
  p.stage->end_picture(picture);
  return picture;
}

}  // namespace rotorub::renders
