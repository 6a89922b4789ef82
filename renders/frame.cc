#include "renders/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "renders/palette.h"

namespace rotorub::renders {

namespace {

constexpr double kTrailFilmTime = 0.9;  // s of film that the path extends back
constexpr double kSparkFilmTime = 0.3;  // s of film that an impact glows

ShownRun shown(const scene::Scene& scene, const Trajectory& trajectory,
               const std::string& remark = "") {
  ShownRun run{Playback(trajectory), engine_label(trajectory), remark, {}};
  for (std::size_t k = 1; k < scene.auxiliary.size(); ++k) run.further.emplace_back(trajectory, k);
  return run;
}

std::string name_of(const scene::Scene& scene, std::size_t contact) {
  const std::string& name = scene.auxiliary[contact].name;
  return name.empty() ? "contact " + std::to_string(contact + 1) : name;
}

void check_view(const scene::Scene& scene, const RenderOptions& options) {
  if (scene.has_contact() || options.view == FilmView::kRig) return;
  throw std::invalid_argument(
      fmt::format("view = {}: expected rig, because the scene {} has no [contact]",
                  to_string(options.view), scene.name));
}

}  // namespace

FramePainter::FramePainter(const scene::Scene& scene, const Trajectory& trajectory,
                           const RenderOptions& options)
    : width_(options.width), height_(options.height) {
  check_options(options);
  check_view(scene, options);
  title_ = options.title.empty() ? scene.name : options.title;
  take_runs(scene, trajectory, options);
  framing_ = make_framing(playbacks(false), options);
  make_machines(scene, options);
  make_panels(scene, trajectory, options);
  make_stage(options);
}

void FramePainter::take_runs(const scene::Scene& scene, const Trajectory& trajectory,
                             const RenderOptions& options) {
  runs_.push_back(shown(scene, trajectory, options.remark));
  if (options.beside != nullptr) {
    runs_.push_back(shown(scene, *options.beside, options.beside_remark));
  }
  shown_runs_ = runs_.size();
  for (const Trajectory* other : options.scaled_with) runs_.push_back(shown(scene, *other));
  if (options.shadow != nullptr) ghost_ = shown(scene, *options.shadow);
  if (ghost_ && ghost_->playback.modes() != runs_[0].playback.modes()) {
    throw std::runtime_error("the series of the shadow has a different number of bending modes");
  }
}

std::vector<const Playback*> FramePainter::playbacks(bool all) const {
  std::vector<const Playback*> chosen;
  for (std::size_t k = 0; k < (all ? runs_.size() : shown_runs_); ++k) {
    chosen.push_back(&runs_[k].playback);
    for (const Playback& further : runs_[k].further) chosen.push_back(&further);
  }
  if (ghost_) chosen.push_back(&ghost_->playback);
  return chosen;
}

void FramePainter::make_machines(const scene::Scene& scene, const RenderOptions& options) {
  const auto chosen = playbacks(false);
  double ring_motion = 0.0;
  for (const Playback* run : chosen) {
    ring_motion = std::max(ring_motion, run->largest_stator(framing_.from, framing_.to));
  }
  const auto make = [&](std::optional<double> magnification) {
    return make_machine(scene, chosen, framing_.from, framing_.to, magnification);
  };
  film_.machine = make(options.machine_magnification);
  film_.section = make(options.magnification.value_or(section_magnification(scene, ring_motion)));
  framing_.magnification = film_.section.magnification;
  framing_.machine_magnification = film_.machine.magnification;
  film_.clearance = film_.section.clearance;
  if (film_.section.contact) film_.section_view.emplace(film_.section, ring_motion);
  if (scene.auxiliary.size() > 1) film_.contact_name = name_of(scene, 0);
  for (std::size_t k = 1; k < scene.auxiliary.size(); ++k) {
    const Machine section = make_machine(with_bearing_alone(scene, k), chosen, framing_.from,
                                         framing_.to, film_.section.magnification);
    film_.further.push_back({name_of(scene, k), section, SectionView(section, ring_motion)});
  }
}

void FramePainter::make_panels(const scene::Scene& scene, const Trajectory& trajectory,
                               const RenderOptions& options) {
  film_.from = framing_.from;
  film_.to = framing_.to;
  film_.scales = make_scales(playbacks(true), framing_.from, framing_.to, film_.clearance);
  if (scene.has_contact()) {
    double penetration = 0.0;
    for (const Playback* run : playbacks(false)) {
      penetration = std::max(penetration, -run->gap_quantile(0.0, framing_.from, framing_.to));
    }
    film_.unrolled_view.emplace(film_.clearance, penetration);
  }
  layout_ = make_layout(width_, height_, options.view, static_cast<int>(shown_runs_),
                        film_.charts(), scene.has_contact());
  film_.text_size = layout_.text_size;
  const Trajectory* const trajectories[] = {&trajectory, options.beside};
  for (std::size_t k = 0; k < shown_runs_; ++k) {
    panels_.emplace_back(film_, layout_.panels[k], *trajectories[k], runs_[k],
                         k == 0 && ghost_ ? &*ghost_ : nullptr);
  }
  // The default clock chooses where frames may be far apart; a warning is for the user's choice.
  if (options.slow_motion) frame_film_time_ = 1.0 / options.frames_per_second;
}

void FramePainter::make_stage(const RenderOptions& options) {
  const Area& area = layout_.panels.front().machine;
  if (area.width == 0) return;
  const MujocoErrors errors;
  machine_view_.emplace(film_.machine, meshes_);
  for (const FurtherSection& further : film_.further) {
    // A schematic shaft has no stations for further contacts.
    if (film_.machine.schematic) break;
    further_views_.emplace_back(film_.machine.with_contact_of(further.machine), meshes_);
  }
  stage_.emplace(StageOptions{area.width, area.height, options.samples, palette::kBackground},
                 meshes_);
  machine_view_->set_up(stage_->scene(), area.aspect(), options.view == FilmView::kCloseUp);
}

void FramePainter::write_header(Sheet sheet, double t) const {
  const int size = layout_.text_size;
  const double y = 0.5 * size;
  sheet.text(size, y, title_, size, palette::kInk, Weight::kBold);
  const FilmClock& clock = framing_.clock;
  const double slow = clock.slow(t);
  const bool stretched = slow > 1.5 * clock.base();
  const std::string text = (slow < 1.0    ? fmt::format("fast motion {:.2g}:1", 1.0 / slow)
                            : slow < 10.0 ? fmt::format("slow motion 1:{:.2g}", slow)
                                          : fmt::format("slow motion 1:{:.0f}", slow)) +
                           (stretched ? ", impact" : "");
  // Fixed columns, right-aligned, so that digits do not move.
  const double column = sheet.text_width("slow motion 1:10000, impact", size);
  const double right = sheet.area().width - size;
  sheet.text(right - column, y, text, size, stretched ? palette::kNormal : palette::kFaintInk);
  sheet.text_to(right - column - 1.5 * size, y, fmt::format("t = {:.6f} s", t), size,
                palette::kInk);
}

Picture FramePainter::paint(double t) {
  Picture picture(width_, height_);
  Sheet sheet(picture, {0, 0, width_, height_});
  sheet.fill(0.0, 0.0, width_, height_, palette::kBackground);

  instant_.trail_time = kTrailFilmTime / framing_.clock.slow(t);
  instant_.spark_time = kSparkFilmTime / framing_.clock.slow(t);
  instant_.frame_time = frame_film_time_ / framing_.clock.slow(t);
  for (std::size_t k = 0; k < panels_.size(); ++k) {
    const Instant instant = instant_at(runs_[k].playback, t, film_.scales, instant_);
    std::optional<Pose> ghost;
    if (k == 0 && ghost_) ghost = ghost_->playback.at(t);
    const Pose* other = ghost ? &*ghost : nullptr;
    std::vector<Instant> further;
    for (const Playback& at : runs_[k].further) {
      further.push_back(instant_at(at, t, film_.scales, instant_));
    }
    if (stage_) {
      const MujocoErrors errors;
      const Canvas canvas = stage_->canvas();
      machine_view_->draw(canvas, instant, other);
      for (std::size_t i = 0; i < further_views_.size(); ++i) {
        further_views_[i].draw_bearing(canvas, further[i], film_.machine.centre_line(instant.pose));
      }
      stage_->render(picture, panels_[k].machine_area());
    }
    panels_[k].draw(sheet, instant, further, other, instant_.trail_time);
  }
  write_header(sheet.part(layout_.header), t);
  return picture;
}

}  // namespace rotorub::renders
