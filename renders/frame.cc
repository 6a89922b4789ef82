#include "renders/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "renders/framing.h"
#include "renders/machine_view.h"
#include "renders/palette.h"
#include "renders/panel.h"
#include "renders/stage.h"

namespace rotorub::renders {

namespace {

constexpr double kTrailFilmTime = 0.9;  // s of film that the path reaches back
constexpr double kSparkFilmTime = 0.3;  // s of film that an impact glows

ShownRun shown(const Trajectory& trajectory) {
  return {Playback(trajectory), engine_label(trajectory)};
}

void check_view(const scene::Scene& scene, const RenderOptions& options) {
  if (scene.first().contact || options.view == FilmView::kRig) return;
  throw std::invalid_argument(
      fmt::format("render: view = {}: rig is accepted, as {} has no [contact]",
                  to_string(options.view), scene.name));
}

}  // namespace

struct FramePainter::Parts {
  std::vector<ShownRun> runs;  // shown, from the left; then those that share the scales alone
  std::size_t shown_runs = 1;
  std::optional<ShownRun> ghost;  // of the first
  Framing framing;
  FilmParts film;
  Layout layout;
  std::string title;
  InstantOptions instant;
  int width, height;

  std::vector<Panel> panels;
  std::vector<Mesh> meshes;
  std::optional<MachineView> machine_view;
  std::optional<Stage> stage;  // none where no panel shows the machine

  Parts(const scene::Scene& scene, const Trajectory& trajectory, const RenderOptions& options);
  void take_runs(const Trajectory& trajectory, const RenderOptions& options);
  std::vector<const Playback*> playbacks(bool all) const;
  void make_machines(const scene::Scene& scene, const RenderOptions& options);
  void make_panels(const scene::Scene& scene, const Trajectory& trajectory,
                   const RenderOptions& options);
  void make_stage(const RenderOptions& options);
  void write_header(Sheet sheet, double t) const;
};

FramePainter::Parts::Parts(const scene::Scene& scene, const Trajectory& trajectory,
                           const RenderOptions& options)
    : width(options.width), height(options.height) {
  check_options(options);
  check_view(scene, options);
  title = options.title.empty() ? scene.name : options.title;
  take_runs(trajectory, options);
  framing = make_framing(playbacks(false), options);
  make_machines(scene, options);
  make_panels(scene, trajectory, options);
  make_stage(options);
}

void FramePainter::Parts::take_runs(const Trajectory& trajectory, const RenderOptions& options) {
  runs.push_back(shown(trajectory));
  if (options.beside != nullptr) runs.push_back(shown(*options.beside));
  shown_runs = runs.size();
  for (const Trajectory* other : options.scaled_with) runs.push_back(shown(*other));
  if (options.shadow != nullptr) ghost = shown(*options.shadow);
  if (ghost && ghost->playback.modes() != runs[0].playback.modes()) {
    throw std::runtime_error("render: the shadow's series has another number of bending modes");
  }
}

// Those that are shown, ghost included; or all.
std::vector<const Playback*> FramePainter::Parts::playbacks(bool all) const {
  std::vector<const Playback*> chosen;
  for (std::size_t k = 0; k < (all ? runs.size() : shown_runs); ++k) {
    chosen.push_back(&runs[k].playback);
  }
  if (ghost) chosen.push_back(&ghost->playback);
  return chosen;
}

void FramePainter::Parts::make_machines(const scene::Scene& scene, const RenderOptions& options) {
  const auto chosen = playbacks(false);
  double ring_motion = 0.0;
  for (const Playback* run : chosen) {
    ring_motion = std::max(ring_motion, run->largest_stator(framing.from, framing.to));
  }
  const auto make = [&](std::optional<double> magnification) {
    return make_machine(scene, chosen, framing.from, framing.to, magnification);
  };
  film.machine = make(options.machine_magnification);
  film.section = make(options.magnification.value_or(section_magnification(scene, ring_motion)));
  framing.magnification = film.section.magnification;
  framing.machine_magnification = film.machine.magnification;
  film.clearance = film.section.clearance;
  if (film.section.contact) film.section_view.emplace(film.section, ring_motion);
}

void FramePainter::Parts::make_panels(const scene::Scene& scene, const Trajectory& trajectory,
                                      const RenderOptions& options) {
  film.from = framing.from;
  film.to = framing.to;
  film.scales = make_scales(playbacks(true), framing.from, framing.to, film.clearance);
  if (scene.first().contact) {
    double penetration = 0.0;
    for (const Playback* run : playbacks(false)) {
      penetration = std::max(penetration, -run->gap_quantile(0.0, framing.from, framing.to));
    }
    film.unrolled_view.emplace(film.clearance, penetration);
  }
  layout = make_layout(width, height, options.view, static_cast<int>(shown_runs), film.charts(),
                       scene.first().contact.has_value());
  film.text_size = layout.text_size;
  const Trajectory* const trajectories[] = {&trajectory, options.beside};
  for (std::size_t k = 0; k < shown_runs; ++k) {
    panels.emplace_back(film, layout.panels[k], *trajectories[k], runs[k],
                        k == 0 && ghost ? &*ghost : nullptr);
  }
  instant.trail_time = kTrailFilmTime / framing.slow_motion;
}

void FramePainter::Parts::make_stage(const RenderOptions& options) {
  const Area& area = layout.panels.front().machine;
  if (area.width == 0) return;
  const MujocoErrors errors;
  machine_view.emplace(film.machine, meshes);
  stage.emplace(StageOptions{area.width, area.height, options.samples, palette::kBackground},
                meshes);
  machine_view->set_up(stage->scene(), area.aspect(), options.view == FilmView::kCloseUp);
}

void FramePainter::Parts::write_header(Sheet sheet, double t) const {
  const int size = layout.text_size;
  const double y = 0.5 * size;
  sheet.text(size, y, title, size, palette::kInk, Weight::kBold);
  const FilmClock& clock = framing.clock;
  const double slow = clock.slow(t);
  const bool stretched = slow > 1.5 * clock.base();
  const std::string text = (slow < 10.0 ? fmt::format("slow motion 1:{:.2g}", slow)
                                        : fmt::format("slow motion 1:{:.0f}", slow)) +
                           (stretched ? ", impact" : "");
  // Right-aligned columns of their own, so that digits stay where they are.
  const double column = sheet.text_width("slow motion 1:10000, impact", size);
  const double right = sheet.area().width - size;
  sheet.text(right - column, y, text, size, stretched ? palette::kNormal : palette::kFaintInk);
  sheet.text_to(right - column - 1.5 * size, y, fmt::format("t = {:.6f} s", t), size,
                palette::kInk);
}

FramePainter::FramePainter(const scene::Scene& scene, const Trajectory& trajectory,
                           const RenderOptions& options)
    : parts_(std::make_unique<Parts>(scene, trajectory, options)) {}

FramePainter::~FramePainter() = default;

const Framing& FramePainter::framing() const { return parts_->framing; }

Picture FramePainter::paint(double t) {
  Parts& p = *parts_;
  Picture picture(p.width, p.height);
  Sheet sheet(picture, {0, 0, p.width, p.height});
  sheet.fill(0.0, 0.0, p.width, p.height, palette::kBackground);

  p.instant.spark_time = kSparkFilmTime / p.framing.clock.slow(t);
  for (std::size_t k = 0; k < p.panels.size(); ++k) {
    const Instant instant = instant_at(p.runs[k].playback, t, p.film.scales, p.instant);
    std::optional<Pose> ghost;
    if (k == 0 && p.ghost) ghost = p.ghost->playback.at(t);
    const Pose* other = ghost ? &*ghost : nullptr;
    if (p.stage) {
      const MujocoErrors errors;
      p.machine_view->draw(p.stage->canvas(), instant, other);
      p.stage->render(picture, p.panels[k].machine_area());
    }
    p.panels[k].draw(sheet, instant, other, p.instant.trail_time);
  }
  p.write_header(sheet.part(p.layout.header), t);
  return picture;
}

}  // namespace rotorub::renders
