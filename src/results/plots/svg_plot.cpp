#include "results/plots/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

#include "results/plots/markup.h"
#include "results/plots/plot_style.h"
#include "results/plots/plot_ticks.h"
#include "results/plots/thin_line.h"

namespace pintle {
namespace {

constexpr double kRight = 22, kLegendRow = 20, kLineSample = 26, kDotRadius = 2.8, kNarrowestBand = 1.2;  // [px]

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void cover(const std::vector<double>& values, bool positive) {
    for (const double value : values) {
      if (!std::isfinite(value) || (positive && value <= 0)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  /// Includes the curve's band, so that variations hidden by the band are not magnified.
  void cover(const Curve& curve, bool positive) {
    Range own;
    own.cover(curve.y, positive);
    if (curve.mark) own.cover(std::vector{curve.mark->y}, positive);
    const double band = std::isfinite(curve.band) && !positive ? curve.band : 0;
    low = std::min(low, own.low - band);
    high = std::max(high, own.high + band);
  }
  bool empty() const { return low > high; }
  double largest() const { return empty() ? 1 : std::max(std::abs(low), std::abs(high)); }
  Axis log_axis(int n_ticks) const { return empty() ? make_log_axis(1, 10, n_ticks) : make_log_axis(low, high, n_ticks); }
  Axis axis(double factor, int n_ticks, bool tight) const {
    return empty() ? make_axis(0, 1, n_ticks, tight) : make_axis(low / factor, high / factor, n_ticks, tight);
  }
};

AxisScale plain_scale(const std::string& unit) {
  return {1, printed_unit(unit)};
}

std::string axis_title(const std::string& quantity, const std::string& unit) {
  if (unit.empty()) return quantity;
  return fmt::format("{} [{}]", quantity, unit);
}

/// Position of a legend entry, relative to the panel's left edge and the legend's first row.
struct LegendEntry {
  double x = 0;
  int row = 0;
};

std::vector<LegendEntry> lay_out_legend(const Panel& panel, double width) {
  std::vector<LegendEntry> entries;
  LegendEntry next;
  for (const Curve& curve : panel.curves) {
    const double entry_width = kLineSample + 26 + text_width(curve.label, kTextSize) + text_width(curve.subscript, 9);
    if (next.x > 0 && next.x + entry_width > width) next = {0, next.row + 1};
    entries.push_back(next);
    next.x += entry_width;
  }
  return entries;
}

bool needs_legend(const Panel& panel) {
  return panel.curves.size() > 1 || (panel.curves.size() == 1 && panel.curves[0].style >= 0);
}

/// One panel with everything needed to draw it.
struct Frame {
  explicit Frame(const Panel& whose) : panel(whose) {}

  const Panel& panel;
  double left = 0, top = 0, width = 0, height = 0;  // of the axes [px]
  Axis x, y;
  AxisScale x_scale, y_scale;
  std::vector<LegendEntry> legend;

  bool own_x() const { return !panel.x_quantity.empty(); }
  // px and py are for values, tick_px and tick_py for ticks.
  double px(double value) const { return left + width * x.share(value); }
  double py(double value) const { return top + height * (1 - y.share(value)); }
  double tick_px(double tick) const { return left + width * (tick - x.low) / (x.high - x.low); }
  double tick_py(double tick) const { return top + height * (y.high - tick) / (y.high - y.low); }
};

std::size_t style_of(const Panel& panel, std::size_t place) {
  const int style = panel.curves[place].style;
  return style < 0 ? place : static_cast<std::size_t>(style);
}

std::string colour(const Frame& frame, std::size_t place) {
  return fmt::format("stroke=\"{}\"", kPlotColours[style_of(frame.panel, place) % kPlotColours.size()]);
}

std::string stroke(const Frame& frame, std::size_t place) {
  const std::string dash = kPlotDashes[style_of(frame.panel, place) / kPlotColours.size() % kPlotDashes.size()];
  return colour(frame, place) + (dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dash));
}

class Picture {
 public:
  explicit Picture(const Plot& plot) : plot_(plot) { lay_out(); }
  std::string text();

 private:
  void lay_out();
  void scale_x(Frame& frame) const;
  void draw_titles();
  void draw_grid(const Frame& frame);
  void draw_y_axis(const Frame& frame);
  void draw_x_axis(const Frame& frame);
  void draw_legend(const Frame& frame);
  void draw_curve(const Frame& frame, std::size_t index);
  void draw_band(const Frame& frame, std::size_t index);
  void draw_mark(const Frame& frame, std::size_t index);
  std::vector<Point> points_of(const Frame& frame, const Curve& curve, double shift = 0) const;
  void draw_dots(const Frame& frame, const std::vector<Point>& points, std::size_t index);

  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  const Plot& plot_;
  std::vector<Frame> frames_;
  double left_ = 0, height_ = 0;
  std::string out_;
};

void Picture::scale_x(Frame& frame) const {
  const bool own = frame.own_x(), log = own ? frame.panel.log_x : plot_.log_x;
  const std::string& unit = own ? frame.panel.x_unit : plot_.x_unit;
  Range range;
  if (!own) range.cover(plot_.x, log);
  for (const Curve& curve : frame.panel.curves) range.cover(curve.x, log);
  const auto is_line = [](const Curve& curve) { return !curve.dots && std::is_sorted(curve.x.begin(), curve.x.end()); };
  const bool rising = own ? std::all_of(frame.panel.curves.begin(), frame.panel.curves.end(), is_line) : std::is_sorted(plot_.x.begin(), plot_.x.end());
  frame.x_scale = log ? plain_scale(unit) : scale_for(range.largest(), unit);
  frame.x = log ? range.log_axis(10) : range.axis(frame.x_scale.factor, 8, rising);
}

void Picture::lay_out() {
  double label_width = 0;
  for (const Panel& panel : plot_.panels) {
    Range range;
    for (const Curve& curve : panel.curves) range.cover(curve, panel.log_y);
    Frame frame(panel);
    scale_x(frame);
    frame.y_scale = panel.log_y ? plain_scale(panel.unit) : scale_for(range.largest(), panel.unit);
    frame.y = panel.log_y ? range.log_axis(8) : range.axis(frame.y_scale.factor, 6, false);
    for (const double tick : frame.y.ticks())
      label_width = std::max(label_width, text_width(frame.y.label(tick), kTickSize));
    frames_.push_back(std::move(frame));
  }
  left_ = 46 + label_width;
  double top = !plot_.subtitle.empty() ? 56 : plot_.title.empty() ? 8 : 38;
  for (Frame& frame : frames_) {
    frame.left = left_;
    frame.width = plot_.width - left_ - kRight;
    frame.height = plot_.panel_height;
    if (needs_legend(frame.panel)) frame.legend = lay_out_legend(frame.panel, frame.width);
    top += frame.legend.empty() ? 8 : kLegendRow * (frame.legend.back().row + 1) + 6;
    frame.top = top;
    top += frame.height + 14 + (frame.own_x() && &frame != &frames_.back() ? 38 : 0);
  }
  height_ = top + 38;
}

void Picture::draw_titles() {
  if (!plot_.title.empty())
    put("<text x=\"{:.1f}\" y=\"26\" font-size=\"{}\" font-weight=\"bold\">{}</text>\n", left_, kTitleSize,
        escaped_markup(plot_.title));
  if (!plot_.subtitle.empty())
    put("<text x=\"{:.1f}\" y=\"45\" font-size=\"{}\" fill=\"#555\">{}</text>\n", left_, kTextSize,
        escaped_markup(plot_.subtitle));
}

void Picture::draw_grid(const Frame& frame) {
  put("<g stroke=\"#e2e2e2\" stroke-width=\"1\">\n");
  for (const double tick : frame.x.ticks())
    put("<path d=\"M{0:.2f} {1:.2f}V{2:.2f}\"/>\n", frame.tick_px(tick), frame.top, frame.top + frame.height);
  for (const double tick : frame.y.ticks())
    put("<path d=\"M{0:.2f} {1:.2f}H{2:.2f}\"/>\n", frame.left, frame.tick_py(tick), frame.left + frame.width);
  put("</g>\n");
  if (!frame.y.log && frame.y.low < 0 && frame.y.high > 0)
    put("<path d=\"M{:.2f} {:.2f}H{:.2f}\" stroke=\"#999\"/>\n", frame.left, frame.py(0), frame.left + frame.width);
}

void Picture::draw_y_axis(const Frame& frame) {
  put("<g text-anchor=\"end\" font-size=\"{}\">\n", kTickSize);
  for (const double tick : frame.y.ticks())
    put("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", frame.left - 8, frame.tick_py(tick) + 0.35 * kTickSize,
        frame.y.label(tick));
  put("</g>\n");
  const double middle = frame.top + frame.height / 2;
  put("<text x=\"18\" y=\"{0:.1f}\" font-size=\"{1}\" text-anchor=\"middle\" transform=\"rotate(-90 18 "
      "{0:.1f})\">{2}</text>\n",
      middle, kTextSize, escaped_markup(axis_title(frame.panel.quantity, frame.y_scale.unit)));
}

void Picture::draw_x_axis(const Frame& frame) {
  const double bottom = frame.top + frame.height;
  put("<path d=\"M{0:.2f} {1:.2f}V{2:.2f}H{3:.2f}\" fill=\"none\" stroke=\"#333\"/>\n", frame.left, frame.top, bottom,
      frame.left + frame.width);
  put("<g stroke=\"#333\">\n");
  for (const double tick : frame.x.ticks()) put("<path d=\"M{:.2f} {:.2f}v4\"/>\n", frame.tick_px(tick), bottom);
  put("</g>\n");
  if (&frame != &frames_.back() && !frame.own_x()) return;
  put("<g text-anchor=\"middle\" font-size=\"{}\">\n", kTickSize);
  for (const double tick : frame.x.ticks())
    put("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", frame.tick_px(tick), bottom + 18, frame.x.label(tick));
  put("</g>\n<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"middle\">{}</text>\n",
      frame.left + frame.width / 2, bottom + 40, kTextSize, escaped_markup(axis_title(frame.own_x() ? frame.panel.x_quantity : plot_.x_quantity, frame.x_scale.unit)));
}

void Picture::draw_legend(const Frame& frame) {
  const double first_row = frame.top - 12 - kLegendRow * (frame.legend.empty() ? 0 : frame.legend.back().row);
  for (std::size_t i = 0; i < frame.legend.size(); ++i) {
    const Curve& curve = frame.panel.curves[i];
    const double x = frame.left + frame.legend[i].x, y = first_row + kLegendRow * frame.legend[i].row;
    if (curve.dots && !curve.joined)
      draw_dots(frame, {{x + kLineSample / 2, y - 4}}, i);
    else
      put("<path d=\"M{:.1f} {:.1f}h{}\" {} stroke-width=\"2.2\"/>\n", x, y - 4, kLineSample, stroke(frame, i));
    put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\">{}", x + kLineSample + 6, y, kTextSize, escaped_markup(curve.label));
    if (!curve.subscript.empty()) put("<tspan dy=\"3\" font-size=\"9.5\">{}</tspan>", escaped_markup(curve.subscript));
    put("</text>\n");
  }
}

// Open circles, so that a line underneath remains visible.
void Picture::draw_dots(const Frame& frame, const std::vector<Point>& points, std::size_t index) {
  put("<g fill=\"none\" {} stroke-width=\"1.2\">\n", colour(frame, index));
  for (const Point& point : points)
    if (std::isfinite(point.x) && std::isfinite(point.y))
      put("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\"/>\n", point.x, point.y, kDotRadius);
  put("</g>\n");
}

std::vector<Point> Picture::points_of(const Frame& frame, const Curve& curve, double shift) const {
  const std::vector<double>&x = frame.own_x() || !curve.x.empty() ? curve.x : plot_.x, &y = curve.y;
  std::vector<Point> points;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
    points.push_back({frame.px(x[i] / frame.x_scale.factor), frame.py((y[i] + shift) / frame.y_scale.factor)});
  return points;
}

// Only if the band is wider than the line that it surrounds.
void Picture::draw_band(const Frame& frame, std::size_t index) {
  const Curve& curve = frame.panel.curves[index];
  if (frame.y.log || !(curve.band > 0) || !std::isfinite(curve.band)) return;
  if (frame.height * curve.band / frame.y_scale.factor / (frame.y.high - frame.y.low) < kNarrowestBand) return;
  put("<path fill=\"{}\" fill-opacity=\"0.2\" d=\"", kPlotColours[style_of(frame.panel, index) % kPlotColours.size()]);
  const std::vector<Point> upper = points_of(frame, curve, curve.band), lower = points_of(frame, curve, -curve.band);
  const auto there = [&](std::size_t i) { return std::isfinite(upper[i].x) && std::isfinite(upper[i].y); };
  for (std::size_t first = 0; first < upper.size();) {  // one area for each part of the curve between gaps
    std::size_t end = first;
    while (end < upper.size() && there(end)) ++end;
    std::vector<Point> edge = thin_line({upper.begin() + first, upper.begin() + end}, kColumnWidth);
    const std::vector<Point> back = thin_line({lower.begin() + first, lower.begin() + end}, kColumnWidth);
    edge.insert(edge.end(), back.rbegin(), back.rend());
    for (std::size_t i = 0; i < edge.size(); ++i) put("{}{:.2f} {:.2f}", i == 0 ? "M" : "L", edge[i].x, edge[i].y);
    if (!edge.empty()) put("Z");
    first = end + 1;
  }
  put("\"/>\n");
}

void Picture::draw_curve(const Frame& frame, std::size_t index) {
  const Curve& curve = frame.panel.curves[index];
  const std::vector<Point> points = points_of(frame, curve);
  if (curve.dots) draw_dots(frame, points, index);
  if (curve.dots && !curve.joined) return;
  put("<path fill=\"none\" {} stroke-width=\"1.6\" stroke-linejoin=\"round\" stroke-linecap=\"round\" d=\"",
      stroke(frame, index));
  bool pen_up = true;
  for (const Point& point : thin_line(points, kColumnWidth)) {
    const bool there = std::isfinite(point.x) && std::isfinite(point.y);
    if (there) put("{}{:.2f} {:.2f}", pen_up ? "M" : "L", point.x, point.y);
    pen_up = !there;
  }
  put("\"/>\n");
}

void Picture::draw_mark(const Frame& frame, std::size_t index) {
  const std::optional<Mark>& mark = frame.panel.curves[index].mark;
  if (!mark) return;
  put("<circle class=\"mark\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"{}\"><title>{}</title></circle>\n", frame.px(mark->x / frame.x_scale.factor),
      frame.py(mark->y / frame.y_scale.factor), kDotRadius, kPlotColours[style_of(frame.panel, index) % kPlotColours.size()], escaped_markup(mark->title));
}

std::string Picture::text() {
  put("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "role=\"img\" font-family=\"{2}\" fill=\"#222\">\n",
      plot_.width, height_, kPlotFont);
  put("<title>{}</title>\n", escaped_markup(plot_.title));
  put("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
  draw_titles();
  for (const Frame& frame : frames_) {
    draw_grid(frame);
    draw_x_axis(frame);
    draw_y_axis(frame);
    draw_legend(frame);
    for (std::size_t i = frame.panel.curves.size(); i-- > 0;) draw_band(frame, i);
    for (std::size_t i = frame.panel.curves.size(); i-- > 0;) draw_curve(frame, i);
    for (std::size_t i = 0; i < frame.panel.curves.size(); ++i) draw_mark(frame, i);
  }
  put("</svg>\n");
  return std::move(out_);
}

}  // namespace

std::string to_svg(const Plot& plot) {
  return Picture(plot).text();
}

}  // namespace pintle
