#include "results/plots/polar_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "results/plots/markup.h"
#include "results/plots/plot_style.h"
#include "results/plots/plot_ticks.h"
#include "results/plots/thin_line.h"
#include "results/text_table.h"

namespace pintle {
namespace {

constexpr double kMargin = 18, kAround = 26, kHead = 40, kRow = 19, kSample = 22, kDot = 3.4;  // [px]
constexpr int kRings = 4, kSpokes = 12;
constexpr double kCircle = 2 * std::numbers::pi;

/// The row of the longest vector. Of several equal ones, the middle if they form an arc about the centre, otherwise the first.
std::size_t longest(const PolarCurve& curve) {
  constexpr double kArc = 1e-12;  // relative to the length: roundoff between points of one arc
  const auto length = [&curve](std::size_t i) { return std::hypot(curve.x[i], curve.y[i]); };
  std::size_t best = 0;
  for (std::size_t i = 1; i < curve.x.size(); ++i)
    if (length(i) > (1 + kArc) * length(best)) best = i;
  std::size_t end = best;
  while (end + 1 < curve.x.size() && std::abs(length(end + 1) - length(best)) <= kArc * length(best)) ++end;
  return best + (end - best) / 2;
}

double largest(const PolarPlot& plot) {
  double most = 0;
  for (const PolarPanel& panel : plot.panels) most = std::max(most, panel.limit);
  for (const PolarPanel& panel : plot.panels)
    for (const PolarCurve& curve : panel.curves)
      if (!curve.x.empty()) most = std::max(most, std::hypot(curve.x[longest(curve)], curve.y[longest(curve)]));
  return most;
}

class PolarPicture {
 public:
  explicit PolarPicture(const PolarPlot& plot) : plot_(plot), scale_(scale_for(largest(plot), plot.unit)), rings_(make_axis(0, largest(plot) / scale_.factor, kRings, true)) {
    const auto n = static_cast<double>(std::max<std::size_t>(1, plot.panels.size()));
    side_ = (plot.width - kMargin * (n + 1)) / n;
    top_ = (plot.subtitle.empty() ? 36 : 54) + kHead;
    std::size_t rows = 0;
    for (const PolarPanel& panel : plot.panels) rows = std::max(rows, panel.curves.size());
    height_ = top_ + side_ + 14 + kRow * static_cast<double>(rows) + 10;
  }

  std::string text() {
    put("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\" font-family=\"{2}\" fill=\"#222\">\n<title>{3}</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        plot_.width, height_, kPlotFont, escaped_markup(plot_.title));
    put("<text x=\"{}\" y=\"26\" font-size=\"{}\" font-weight=\"bold\">{}</text>\n", kMargin, kTitleSize, escaped_markup(plot_.title));
    if (!plot_.subtitle.empty()) put("<text x=\"{}\" y=\"45\" font-size=\"{}\" fill=\"#555\">{}</text>\n", kMargin, kTextSize, escaped_markup(plot_.subtitle));
    for (std::size_t i = 0; i < plot_.panels.size(); ++i) {
      left_ = kMargin + static_cast<double>(i) * (side_ + kMargin);
      draw_panel(plot_.panels[i]);
    }
    put("</svg>\n");
    return std::move(out_);
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  double middle_x() const { return left_ + 0.5 * side_; }
  double middle_y() const { return top_ + 0.5 * side_; }
  /// A length on the scale of the rings [px].
  double pixels(double length) const { return (0.5 * side_ - kAround) * length / rings_.high; }
  Point place(double x, double y) const { return {middle_x() + pixels(x / scale_.factor), middle_y() - pixels(y / scale_.factor)}; }
  static std::string colour(std::size_t i) { return kPlotColours[i % kPlotColours.size()]; }
  static std::string stroke(std::size_t i) {
    const std::string dash = kPlotDashes[i / kPlotColours.size() % kPlotDashes.size()];
    return fmt::format("stroke=\"{}\"", colour(i)) + (dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dash));
  }

  void draw_panel(const PolarPanel& panel) {
    put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" font-weight=\"bold\" text-anchor=\"middle\">{}</text>\n", middle_x(), top_ - 24, kTextSize, escaped_markup(panel.title));
    put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" fill=\"#555\" text-anchor=\"middle\">{}</text>\n", middle_x(), top_ - 8, kTickSize, escaped_markup(panel.axes));
    draw_rings();
    if (panel.limit > 0) put("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"none\" stroke=\"#444\" stroke-width=\"1.4\"/>\n", middle_x(), middle_y(), pixels(panel.limit / scale_.factor));
    for (std::size_t i = panel.curves.size(); i-- > 0;) draw_curve(panel.curves[i], i);
    for (std::size_t i = 0; i < panel.curves.size(); ++i) describe(panel.curves[i], i);
  }

  void draw_rings() {
    put("<g fill=\"none\" stroke=\"#e2e2e2\">\n");
    for (int i = 0; i < kSpokes; ++i) {
      const double angle = kCircle * i / kSpokes;
      put("<path d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}\"/>\n", middle_x(), middle_y(), middle_x() + pixels(rings_.high) * std::cos(angle), middle_y() - pixels(rings_.high) * std::sin(angle));
    }
    for (const double ring : rings_.ticks())
      if (ring > 0) put("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", middle_x(), middle_y(), pixels(ring));
    put("</g>\n");
    const double end = pixels(rings_.high) + 6;
    put("<g stroke=\"#777\"><path d=\"M{:.2f} {:.2f}h{:.2f}\"/><path d=\"M{:.2f} {:.2f}v{:.2f}\"/></g>\n", middle_x(), middle_y(), end, middle_x(), middle_y(), -end);
    put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\">x</text>\n", middle_x() + end + 3, middle_y() + 4, kTickSize);
    put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"middle\">y</text>\n", middle_x(), middle_y() - end - 4, kTickSize);
    put("<g font-size=\"10.5\" fill=\"#555\" text-anchor=\"middle\">\n");
    const double slant = -0.125 * kCircle, cosine = std::cos(slant), sine = std::sin(slant);
    const std::vector<double> ticks = rings_.ticks();
    for (const double ring : ticks)
      if (ring > 0)
        put("<text x=\"{:.1f}\" y=\"{:.1f}\">{}{}</text>\n", middle_x() + pixels(ring) * cosine, middle_y() - pixels(ring) * sine + 3, rings_.label(ring), ring == ticks.back() ? " " + escaped_markup(scale_.unit) : "");
    put("</g>\n");
  }

  void draw_curve(const PolarCurve& curve, std::size_t index) {
    if (curve.x.empty()) return;
    std::vector<Point> points;
    for (std::size_t i = 0; i < curve.x.size(); ++i) points.push_back(place(curve.x[i], curve.y[i]));
    put("<path fill=\"none\" {} stroke-width=\"1.6\" stroke-linejoin=\"round\" d=\"", stroke(index));
    bool pen_up = true;
    for (const Point& point : thin_line(points, kColumnWidth)) {
      const bool there = std::isfinite(point.x) && std::isfinite(point.y);
      if (there) put("{}{:.2f} {:.2f}", pen_up ? "M" : "L", point.x, point.y);
      pen_up = !there;
    }
    put("\"/>\n<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"#fff\" stroke=\"{}\"/>\n", points.front().x, points.front().y, kDot, colour(index));
    const Point& peak = points[longest(curve)];
    put("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"{}\"/>\n", peak.x, peak.y, kDot, colour(index));
  }

  /// "label: peak 674.05 N at 38.2 deg".
  void describe(const PolarCurve& curve, std::size_t index) {
    if (curve.x.empty()) return;
    const std::size_t peak = longest(curve);
    const bool small = scale_.factor < 1;  // micrometres are easier to read than powers of metres
    const double x = curve.x[peak], y = curve.y[peak], line = top_ + side_ + 14 + kRow * static_cast<double>(index);
    put("<path d=\"M{:.1f} {:.1f}h{}\" {} stroke-width=\"2.2\"/>\n", left_, line - 4, kSample, stroke(index));
    put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\">{}peak {} {} at {:.1f}°</text>\n", left_ + kSample + 6, line, kTickSize, curve.label.empty() ? "" : escaped_markup(curve.label) + ": ",
        engineering(std::hypot(x, y) / (small ? scale_.factor : 1)), escaped_markup(small ? scale_.unit : printed_unit(plot_.unit)), std::atan2(y, x) * 360 / kCircle);
  }

  const PolarPlot& plot_;
  AxisScale scale_;
  Axis rings_;
  double side_ = 0, top_ = 0, height_ = 0, left_ = 0;  // [px]
  std::string out_;
};

}  // namespace

std::string to_svg(const PolarPlot& plot) { return PolarPicture(plot).text(); }

}  // namespace pintle
