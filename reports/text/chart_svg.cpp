// The chart's excerpt as one picture: time across, error upwards, a panel for each question.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "reports/text/record_text.h"
#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

using fuzz::ChartRow;

struct Panel {
  const char *question, *title;
};
constexpr std::array panels = {Panel{"overlap", "Overlap"}, Panel{"distance", "Distance"},
                               Panel{"contact", "Contact"}, Panel{"time_of_impact", "Time of impact"}};

// In pixels; in powers of ten of nanoseconds and of the scale L.
constexpr double panel_width = 440, panel_height = 340, left = 64, right = 20, top = 34, bottom = 34;
constexpr double least_time = 2, most_time = 5.5, least_error = -16, most_error = 2, error_step = 3;
constexpr double character_width = 6.6, line_height = 13, label_gap = 9, ring_radius = 7;
constexpr std::size_t panels_per_row = 2;
// Three lines of a legend below the panels.
constexpr double legend_height = 62;

struct Colours {
  const char *text, *faint, *grid, *core, *other, *wrong, *background;
};
constexpr Colours light{"#1f2328", "#59636e", "#d1d9e0", "#0969da", "#59636e", "#bc4c00", "#ffffff"};
constexpr Colours dark{"#f0f6fc", "#9198a1", "#3d444d", "#4493f8", "#9198a1", "#f0883e", "#0d1117"};

struct Point {
  double x = 0, y = 0;
};
struct Area {
  double x = 0, y = 0, width = 0, height = 0;
  bool overlaps(const Area& o) const {
    return x < o.x + o.width && o.x < x + width && y < o.y + o.height && o.y < y + height;
  }
};

Point place(double ns, double error) {
  const double across = std::clamp(std::log10(ns), least_time, most_time);
  const double up = error > 0 ? std::clamp(std::log10(error), least_error, most_error) : least_error;
  return {left + (across - least_time) / (most_time - least_time) * (panel_width - left - right),
          panel_height - bottom -
              (up - least_error) / (most_error - least_error) * (panel_height - top - bottom)};
}

std::string text_at(Point p, const char* anchor, const char* colour, const std::string& words,
                    const char* more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n", p.x, p.y,
                     anchor, colour, more, words);
}

std::string time_words(int power) {
  constexpr std::array words = {"100 ns", "1 µs", "10 µs", "100 µs"};
  return words[static_cast<std::size_t>(power - static_cast<int>(least_time))];
}

std::string error_words(int power) {
  return power == static_cast<int>(least_error) ? "≤ 1e-16" : fmt::format("1e{}", power);
}

std::string axes(const Colours& c, const char* title) {
  std::string s = text_at({left, top - line_height}, "start", c.text, title, " font-weight=\"600\"");
  const auto line = [&](Point a, Point b) {
    s +=
        fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\"/>\n", a.x, a.y, b.x, b.y, c.grid);
  };
  for (int t = static_cast<int>(least_time); t <= static_cast<int>(most_time); ++t) {
    const Point p = place(std::pow(10, t), 0);
    line({p.x, top}, {p.x, panel_height - bottom});
    s += text_at({p.x, panel_height - bottom + line_height + 3}, "middle", c.faint, time_words(t));
  }
  for (double e = least_error; e <= most_error; e += error_step) {
    const Point p = place(1, std::pow(10, e));
    line({left, p.y}, {panel_width - right, p.y});
    s += text_at({left - label_gap, p.y + 4}, "end", c.faint, error_words(static_cast<int>(e)));
  }
  return s;
}

// Beside the point, on the first side where it covers no other label or point and stays in the panel.
Area label_area(Point p, std::size_t characters, const std::vector<Area>& taken) {
  const double width = character_width * static_cast<double>(characters), half = line_height / 2;
  std::vector<Area> choices;
  for (const double lines : {0.0, -1.0, 1.0, -2.0, 2.0, -3.0, 3.0, -4.0, 4.0, -5.0, 5.0}) {
    const double shift = lines * line_height;
    choices.push_back({p.x + label_gap, p.y - half + shift, width, line_height});
    choices.push_back({p.x - label_gap - width, p.y - half + shift, width, line_height});
  }
  for (const Area& a : choices) {
    const bool inside = a.x >= left && a.x + a.width <= panel_width && a.y >= top - half &&
                        a.y + a.height <= panel_height - bottom;
    if (inside && std::none_of(taken.begin(), taken.end(), [&](const Area& t) { return a.overlaps(t); }))
      return a;
  }
  return choices.front();
}

std::string symbol(Point p, const ChartRow& r, const Colours& c) {
  const bool wrong = r.wrong > 0;
  const char* colour = wrong ? c.wrong : r.engine == "core" ? c.core : c.other;
  if (wrong)
    return fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}l8 8m0 -8l-8 8\" stroke=\"{2}\" stroke-width=\"2\" fill=\"none\"/>\n",
        p.x - 4, p.y - 4, colour);
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", p.x, p.y,
                     r.engine == "core" ? 6 : 4, colour);
}

// From the point to a label that is not beside it.
std::string leader(Point p, const Area& label, const Colours& c) {
  const bool above = label.y < p.y;
  const Point end{std::clamp(p.x, label.x, label.x + label.width), above ? label.y + line_height : label.y};
  if (std::abs(end.y - p.y) < ring_radius + 1) return "";
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\"/>\n", p.x,
                     p.y + (above ? -ring_radius : ring_radius), end.x, end.y, c.faint);
}

// Around the symbol of an engine that runs as WebAssembly.
std::string ring(Point p, const Colours& c) {
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"none\" stroke=\"{}\"/>\n", p.x, p.y,
                     ring_radius, c.faint);
}

std::string panel(const fuzz::Chart& chart, const Panel& which, const Colours& c) {
  std::vector<const ChartRow*> rows;
  for (const ChartRow& r : chart.rows)
    if (r.question == which.question && is_timed(r)) rows.push_back(&r);
  std::string s = axes(c, which.title);
  std::vector<Area> taken;
  for (const ChartRow* r : rows) {
    const Point p = place(r->ns_median, r->error_max);
    taken.push_back({p.x - ring_radius, p.y - ring_radius, 2 * ring_radius, 2 * ring_radius});
  }
  for (const ChartRow* r : rows) {
    const Point p = place(r->ns_median, r->error_max);
    const Area a = label_area(p, r->engine.size(), taken);
    taken.push_back(a);
    s += leader(p, a, c) + symbol(p, *r, c);
    if (is_wasm(chart, *r)) s += ring(p, c);
    s += text_at({a.x, a.y + line_height - 3}, "start", r->engine == "core" ? c.core : c.text, r->engine,
                 r->engine == "core" ? " font-weight=\"600\"" : "");
  }
  return s;
}

std::string legend(const fuzz::Chart& chart, const Colours& c, double y) {
  std::string s =
      text_at({left, y}, "start", c.faint,
              "Across: median time of a query. Upwards: worst error, divided by the scale of the scene.");
  ChartRow right_always, wrong_once;
  wrong_once.wrong = 1;
  const double below = y + line_height + 5;
  s += symbol({left + 4, below - 4}, right_always, c) +
       text_at({left + 2 * label_gap, below}, "start", c.faint, "never wrong");
  const double second = left + 100, third = second + 160;
  s += symbol({second + 4, below - 4}, wrong_once, c) +
       text_at({second + 2 * label_gap, below}, "start", c.faint, "wrong on some queries");
  const bool any_wasm =
      std::any_of(chart.rows.begin(), chart.rows.end(), [&](const ChartRow& r) { return is_wasm(chart, r); });
  if (any_wasm)
    s += ring({third + 4, below - 4}, c) +
         text_at({third + 2 * label_gap, below}, "start", c.faint,
                 "as WebAssembly: the time includes the calls from JavaScript");
  return s + text_at({left, below + line_height + 5}, "start", c.faint,
                     fmt::format("{}, {} cores, {}", chart.machine.processor, chart.machine.cores,
                                 chart.machine.date));
}

}  // namespace

std::string chart_svg(const fuzz::Chart& excerpt, bool for_dark) {
  const Colours& c = for_dark ? dark : light;
  const double width = panel_width * panels_per_row,
               panels_height = panel_height * (panels.size() / panels_per_row);
  const double height = panels_height + legend_height;
  std::string s = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"system-ui, sans-serif\" font-size=\"11.5\">\n"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"{2}\"/>\n",
      width, height, c.background);
  for (std::size_t i = 0; i < panels.size(); ++i)
    s += fmt::format("<g transform=\"translate({:.0f} {:.0f})\">\n{}</g>\n",
                     panel_width * static_cast<double>(i % panels_per_row),
                     panel_height * static_cast<double>(i / panels_per_row), panel(excerpt, panels[i], c));
  return s + legend(excerpt, c, panels_height + line_height) + "</svg>\n";
}

}  // namespace touchstone::reports
