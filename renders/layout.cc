#include "renders/layout.h"

#include <algorithm>
#include <cmath>

namespace rotorub::renders {

namespace {

constexpr int kGap = 6;  // pixels around charts

int share(double part, int whole) { return static_cast<int>(part * whole); }

// Charts stacked vertically.
std::vector<Area> stacked(const Area& area, int count) {
  std::vector<Area> charts;
  for (int k = 0; k < count; ++k) {
    const int top = area.top + k * area.height / count;
    const int bottom = area.top + (k + 1) * area.height / count;
    charts.push_back({area.left + kGap, top, area.width - 2 * kGap, bottom - top - kGap});
  }
  return charts;
}

// Charts side by side.
std::vector<Area> in_a_row(const Area& area, int count) {
  std::vector<Area> charts;
  const int width = area.width - kGap;
  for (int k = 0; k < count; ++k) {
    const int left = area.left + kGap + k * width / count;
    const int right = area.left + kGap + (k + 1) * width / count;
    charts.push_back({left, area.top, right - left - kGap, area.height - kGap});
  }
  return charts;
}

// Wide area: the machine, to its right the cross-section, charts below. Narrow area: the machine,
// below it the cross-section, and to its right the charts.
PanelLayout rig(const Area& area, int charts) {
  PanelLayout panel;
  if (area.aspect() > 1.2) {
    const int lower = share(0.24, area.height), upper = area.height - lower;
    const int section = std::min(upper, share(0.46, area.width));
    panel.machine = {area.left, area.top, area.width - section, upper};
    panel.section = {panel.machine.right(), area.top, section, upper};
    panel.charts = in_a_row({area.left, area.top + upper, area.width, lower}, charts);
  } else {
    const int lower = std::min(share(0.5, area.height), share(0.52, area.width));
    const int upper = area.height - lower;
    panel.machine = {area.left, area.top, area.width, upper};
    panel.section = {area.left, area.top + upper, lower, lower};
    panel.charts =
        stacked({area.left + lower, area.top + upper, area.width - lower, lower}, charts);
  }
  return panel;
}

// One large picture with the charts to its right or below.
PanelLayout single(const Area& area, int charts, Area PanelLayout::*what) {
  PanelLayout panel;
  if (area.aspect() > 1.2) {
    const int left = share(0.6, area.width);
    panel.*what = {area.left, area.top, left, area.height};
    panel.charts = stacked({area.left + left, area.top, area.width - left, area.height}, charts);
  } else {
    const int upper = share(0.66, area.height);
    panel.*what = {area.left, area.top, area.width, upper};
    panel.charts = stacked({area.left, area.top + upper, area.width, area.height - upper}, charts);
  }
  return panel;
}

PanelLayout panel_of(const Area& area, FilmView view, int charts, bool contact) {
  if (!contact) {
    PanelLayout machine;
    machine.machine = area;
    return machine;
  }
  switch (view) {
    case FilmView::kRig:
      return rig(area, charts);
    case FilmView::kAxis:
      return single(area, charts, &PanelLayout::section);
    case FilmView::kCloseUp:
      return single(area, charts, &PanelLayout::machine);
    case FilmView::kUnrolled:
      return single(area, charts, &PanelLayout::unrolled);
  }
  return {};
}

}  // namespace

Layout make_layout(int width, int height, FilmView view, int panels, int charts, bool contact) {
  Layout layout;
  layout.text_size = std::max(11, static_cast<int>(std::lround(height / 42.0)));
  const int header = 2 * layout.text_size;
  layout.header = {0, 0, width, header};
  const int each = width / panels;
  for (int k = 0; k < panels; ++k) {
    const Area area{k * each, header, each, height - header};
    PanelLayout panel = panel_of(area, view, charts, contact);
    panel.caption = area;
    layout.panels.push_back(panel);
  }
  return layout;
}

}  // namespace rotorub::renders
