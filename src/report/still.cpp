#include "report/still.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "base/text/did_you_mean.h"
#include "base/text/utf8.h"
#include "report/outline.h"
#include "report/paints.h"
#include "results/plots/markup.h"
#include "results/plots/plot_ticks.h"
#include "results/plots/thin_line.h"

namespace pintle {
namespace {

constexpr const char* kFont = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";
constexpr double kHead = 10, kHeadHalf = 4, kArrowWidth = 2.2;  // [px]

class Drawing {
 public:
  Drawing(const Scene& scene, const Instant& instant, const StillOptions& options)
      : scene_(scene), instant_(instant), options_(options), frame_(frame_for(scene, options)) {}

  std::string text(const std::vector<Trace>& traces) {
    put("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "role=\"img\" font-family=\"{2}\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
        frame_.width, frame_.height, kFont);
    put("<title>The mechanism at t = {:.5g} s</title>\n", instant_.t);
    put("<rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n", kPaperShades[options_.dark]);
    for (const Trace& trace : traces) draw_trace(trace);
    for (const Shape& shape : scene_.shapes) draw_shape(shape);
    for (const Connector& connector : scene_.connectors) draw_connector(connector);
    if (options_.forces) draw_forces();
    if (options_.names) draw_labels();
    if (options_.clock) draw_clock();
    put("</svg>\n");
    return std::move(out_);
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  Vec2 px(const Vec2& world) const {
    return {(world[0] - frame_.corner[0]) * frame_.scale, frame_.height - (world[1] - frame_.corner[1]) * frame_.scale};
  }

  std::string path_text(const std::vector<Vec2>& points, bool closed) const {
    std::string d;
    for (const Vec2& p : points) fmt::format_to(std::back_inserter(d), "{}{:.2f} {:.2f}", d.empty() ? "M" : "L", p[0], p[1]);
    return closed ? d + "Z" : d;
  }

  std::string outline(const Shape& shape, bool closed) const {
    std::string d;
    for (const std::vector<Vec2>& path : shape.paths) {
      std::vector<Vec2> points;
      for (const Vec2& p : path) points.push_back(px(instant_.place(Anchor{shape.body, p})));
      d += path_text(points, closed);
    }
    return d;
  }

  std::string pen(const PaintStyle& style, int body) const {
    const std::string line = colour_of(style.line[options_.dark], body, options_.dark);
    std::string text = line.empty() ? "stroke=\"none\"" : fmt::format("stroke=\"{}\" stroke-width=\"{}\"", line, style.line_width);
    if (*style.dash) text += fmt::format(" stroke-dasharray=\"{}\"", style.dash);
    return text;
  }

  void draw_shape(const Shape& shape) {
    if (!options_.masses && (shape.paint == Paint::kMass || shape.paint == Paint::kMassLight)) return;
    const PaintStyle& style = style_of(shape.paint);
    const std::string fill = colour_of(style.fill[options_.dark], shape.body, options_.dark);
    const std::string filled = fill.empty() ? "" : fmt::format(" fill=\"{}\"", fill);
    const double size = shape.size * frame_.scale;
    switch (shape.form) {
      case Form::kBar: {
        const std::string d = outline(shape, shape.closed), line = colour_of(style.line[options_.dark], shape.body, options_.dark);
        put("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{:.2f}\"/>\n", d, line, size + 2 * style.line_width);
        put("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{:.2f}\"{}/>\n", d, fill, size, shape.closed ? filled : "");
        break;
      }
      case Form::kLine:
        put("<path d=\"{}\" {}/>\n", outline(shape, false), pen(style, shape.body));
        break;
      case Form::kArea:
        put("<path d=\"{}\" {}{}/>\n", outline(shape, true), pen(style, shape.body), filled);
        break;
      case Form::kCircle:
        for (const std::vector<Vec2>& path : shape.paths) {
          const Vec2 c = px(instant_.place(Anchor{shape.body, path.front()}));
          put("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" {}{}/>\n", c[0], c[1], size, pen(style, shape.body), filled);
        }
    }
  }

  // The barrel from its end forwards, and from the other end back the rod with its piston, as long as the barrel; if there are several stages, the last one.
  void draw_cylinder(const Connector& connector) {
    const Vec2 a = instant_.place(connector.from), b = instant_.place(connector.to), along = unit(b - a);
    const Vec2 across = Connector::kHalfBarrel * scene_.unit * normal(along), barrel = connector.length * along;
    const Vec2 piston = b - std::max(connector.length, length(b - a) - connector.length) * along;
    const PaintStyle& style = style_of(connector.paint);
    put("<path d=\"{}\" {} fill=\"{}\"/>\n", path_text({px(a - across), px(a + barrel - across), px(a + barrel + across), px(a + across)}, true), pen(style, kWorld), style.fill[options_.dark]);
    put("<path d=\"{}{}\" {}/>\n", path_text({px(piston), px(b)}, false), path_text({px(piston - across), px(piston + across)}, false), pen(style_of(Paint::kRod), kWorld));
  }

  void draw_connector(const Connector& connector) {
    if (connector.paint == Paint::kBarrel) return draw_cylinder(connector);
    const Vec2 a = instant_.place(connector.from), b = instant_.place(connector.to), d = b - a;
    const std::array<Vec2, 2> run = belt_run(a, b, connector.radii);
    std::vector<Vec2> points{px(run[0]), px(run[1])};
    if (connector.paint == Paint::kSpring) {
      points.clear();
      const Vec2 across = scene_.unit * normal(unit(d));
      for (const Vec2& p : spring_zigzag(connector.teeth)) points.push_back(px(a + p[0] * d + p[1] * across));
    }
    if (connector.paint == Paint::kBlade) {
      points = cubic_curve(a, connector.length * instant_.along(connector.from), b, connector.length * instant_.along(connector.to));
      for (Vec2& p : points) p = px(p);
    }
    put("<path d=\"{}\" {}/>\n", path_text(points, false), pen(style_of(connector.paint), kWorld));
  }

  void draw_trace(const Trace& trace) {
    std::vector<Point> points;
    for (const Vec2& p : trace.points) points.push_back({px(p)[0], px(p)[1]});
    std::vector<Vec2> kept;
    for (const Point& p : thin_line(points, 0.4)) kept.push_back({p.x, p.y});
    put("<path d=\"{}\" stroke=\"{}\" stroke-width=\"1.4\" stroke-opacity=\"0.75\"/>\n", path_text(kept, false), kTraceShades[options_.dark]);
  }

  void draw_arrow(const Vec2& tail, const Vec2& tip, bool cut, const char* colour) {
    const Vec2 d = tip - tail, along = unit(d), across = normal(along);
    const double size = std::min(1.0, length(d) / (1.6 * kHead));
    const Vec2 neck = tip - kHead * size * along;
    put("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{:.2f}\"/>", path_text({tail, neck}, false), colour, kArrowWidth * std::max(size, 0.5));
    const auto head = [&](const Vec2& at) {
      const Vec2 back = at - kHead * size * along;
      put("<path d=\"{}\" stroke=\"none\" fill=\"{}\"/>\n", path_text({at, back + kHeadHalf * size * across, back - kHeadHalf * size * across}, true),
          colour);
    };
    head(tip);
    if (cut) head(neck);
  }

  void draw_forces() {
    if (!(scene_.arrow_force > 0)) return;
    put("<g stroke-linecap=\"butt\">\n");
    const double full = options_.whole_arrows ? std::max(scene_.arrow_force, largest_force() / Scene::kLongestArrow) : scene_.arrow_force;
    const double per_newton = scene_.arrow_length / full;
    bool any_cut = false;
    const auto draw = [&](const Vec2& at, const Vec2& force, const char* colour) {
      const double size = length(force) * per_newton, most = Scene::kLongestArrow * scene_.arrow_length;
      if (!std::isfinite(size) || size * frame_.scale < 1) return;
      const bool cut = !options_.whole_arrows && size > most;
      any_cut = any_cut || cut;
      draw_arrow(px(at), px(at + std::min(size, most) * unit(force)), cut, colour);
    };
    for (std::size_t i = 0; i < scene_.loads.size(); ++i) draw(instant_.place(scene_.loads[i].at), instant_.loads[i], kLoadShades[options_.dark]);
    for (std::size_t i = 0; i < scene_.arrows.size(); ++i) draw(instant_.place(scene_.arrows[i].at), instant_.forces[i], kForceShades[options_.dark]);
    const double nice = scale_force(full), bar = nice * per_newton * frame_.scale;
    draw_arrow({14, frame_.height - 16}, {14 + bar, frame_.height - 16}, false, kForceShades[options_.dark]);
    put("</g>\n<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"12\" fill=\"{}\">{}</text>\n", 22 + bar, frame_.height - 12, kInkShades[options_.dark], scale_text(nice) + (any_cut ? ", two heads: more than drawn" : ""));
  }

  double largest_force() const {
    double largest = 0;
    for (const auto* all : {&instant_.loads, &instant_.forces})
      for (const Vec2& force : *all)
        if (std::isfinite(length(force))) largest = std::max(largest, length(force));
    return largest;
  }

  void draw_labels() {
    const Vec2 middle{frame_.width / 2, frame_.height / 2};
    for (const NamedPoint& label : scene_.labels) {
      const Vec2 at = px(instant_.place(label.at));
      const double off = std::max(0.9 * scene_.unit * frame_.scale, 5.0);
      const double wide = 6.6 * static_cast<double>(count_characters(label.name)) + off + 4;  // estimate
      const bool left = at[0] < middle[0] ? at[0] > wide : at[0] + wide > frame_.width;
      put("<text x=\"{0:.1f}\" y=\"{1:.1f}\" font-size=\"12.5\" font-style=\"italic\" text-anchor=\"{2}\" fill=\"{3}\" stroke=\"{4}\" "
          "stroke-width=\"3\" paint-order=\"stroke\">{5}</text>\n",
          at[0] + (left ? -off : off), at[1] - off, left ? "end" : "start", kInkShades[options_.dark], kPaperShades[options_.dark], escaped_markup(label.name));
    }
  }

  void draw_clock() {
    put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"12.5\" text-anchor=\"end\" fill=\"{}\">t = {:.{}f} s</text>\n", frame_.width - 12,
        frame_.height - 12, kNoteShades[options_.dark], instant_.t, scene_.time_decimals);
  }

  /// The largest value of 1, 2 or 5 times a power of ten that does not exceed the force.
  static double scale_force(double force) {
    const double power = std::pow(10, std::floor(std::log10(force))), digit = force / power;
    return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
  }

  static std::string scale_text(double force) {
    const AxisScale scale = scale_for(force, "N");
    return fmt::format("{:g} {}", force / scale.factor, scale.unit);
  }

  const Scene& scene_;
  const Instant& instant_;
  const StillOptions& options_;
  StillFrame frame_;
  std::string out_;
};

}  // namespace

StillFrame frame_for(const Scene& scene, const StillOptions& options) {
  constexpr double kFoot = 24;  // space for scale and clock
  const double foot = options.clock || options.forces ? kFoot : 0;
  const double w = scene.box.width(), h = scene.box.height();
  StillFrame frame;
  frame.scale = std::min(options.width / w, std::max(options.most_height - foot, 40.0) / h);
  const auto even = [](double x) { return 2 * std::max(std::round(x / 2), 16.0); };
  const bool narrow = options.width / w > frame.scale;
  frame.width = even(narrow ? std::min(std::max(w * frame.scale, 260.0), options.width) : options.width);
  frame.height = even(h * frame.scale + foot);
  const double spare = std::max(0.0, frame.width / frame.scale - w) / 2;
  frame.corner = {scene.box.low[0] - spare, scene.box.low[1] - foot / frame.scale};
  return frame;
}

std::string still_svg(const Scene& scene, const Instant& instant, const StillOptions& options, const std::vector<Trace>& traces) {
  return Drawing(scene, instant, options).text(traces);
}

Trace make_trace(const Scene& scene, const Trajectory& trajectory, const std::string& point) {
  std::vector<std::string> names;
  for (const NamedPoint& known : scene.points) {
    names.push_back(known.name);
    if (known.name != point) continue;
    Trace trace{point, {}};
    for (std::size_t row = 0; row < trajectory.n_rows(); ++row)
      trace.points.push_back(pose_of(scene.bodies[static_cast<std::size_t>(known.at.at.body)], trajectory, row).world(known.at.at.point));
    return trace;
  }
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  const auto meant = did_you_mean(point, names);
  throw std::invalid_argument(fmt::format("found point \"{}\": no moving body has it.\n    {}", point,
                                          meant ? fmt::format("Did you mean \"{}\"?", *meant) : "Points: " + (list.empty() ? "none" : list) + "."));
}

std::array<Vec2, 2> belt_run(const Vec2& a, const Vec2& b, const std::array<double, 2>& radii) {
  const Vec2 d = b - a;
  const double w = radii[1] - radii[0], far = std::max(length(d), std::abs(w)), t = std::sqrt((far - w) * (far + w));
  const Vec2 left = far > 0 ? 1 / (far * far) * (t * normal(d) - w * d) : Vec2{0, 0};
  return {a + radii[0] * left, b + radii[1] * left};
}

std::vector<Vec2> spring_zigzag(int teeth) {
  std::vector<Vec2> points{{0, 0}, {0.1, 0}};
  for (int i = 0; i < teeth; ++i) points.push_back({0.1 + 0.8 * (i + 0.5) / teeth, i % 2 ? -0.75 : 0.75});
  points.push_back({0.9, 0});
  points.push_back({1, 0});
  return points;
}

}  // namespace pintle
