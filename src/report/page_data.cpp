#include "report/page_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "report/paints.h"
#include "report/poses.h"
#include "report/still.h"

namespace pintle {
namespace {

using Json = nlohmann::ordered_json;

bool ends_with(std::string_view text, std::string_view end) { return text.ends_with(end); }

/// Reactions on a joint's first body are the negatives of those on the second, and those in joint axes are rotated from world axes.
bool is_derived(const std::string& name, const std::vector<std::string>& first_prefixes) {
  if (ends_with(name, ".f1[joint]") || ends_with(name, ".f2[joint]")) return true;
  return std::binary_search(first_prefixes.begin(), first_prefixes.end(), name.substr(0, name.rfind('.') + 1));
}

Json rounded(double x, double step) { return step > 0 ? Json(std::round(x / step) * step + 0.0) : Json(x); }

/// The rows on both sides of the peaks of the largest joints, at most `most` rows.
std::vector<std::size_t> peak_rows(const Trajectory& trajectory, std::size_t most) {
  std::vector<std::pair<double, double>> peaks;  // force, time
  for (const LoadSummary& joint : trajectory.joints) peaks.emplace_back(joint.peak, joint.peak_time);
  std::sort(peaks.rbegin(), peaks.rend());
  peaks.resize(std::min(peaks.size(), most));
  std::vector<double> times;
  for (const auto& [peak, time] : peaks) times.push_back(time);
  std::sort(times.begin(), times.end());
  std::vector<std::size_t> rows;
  if (trajectory.n_rows() == 0) return rows;
  const std::size_t last = trajectory.n_rows() - 1;
  const double first = trajectory.at(0, 0);
  const auto peak_between = [&](double from, double to) {
    const auto next = std::lower_bound(times.begin(), times.end(), from);
    return next != times.end() && *next <= to;
  };
  for (std::size_t row = 0; row < trajectory.n_rows(); ++row)
    if (peak_between(row == 0 ? first : trajectory.at(row - 1, 0), trajectory.at(std::min(row + 1, last), 0))) rows.push_back(row);
  return rows;
}

class PageData {
 public:
  PageData(const Scene& scene, const RunRecord& run, const PageContent& content)
      : scene_(scene), run_(run), trajectory_(run.trajectory), content_(content), all_(trajectory_.columns) {
    for (std::size_t i = 0; i < content.columns.size(); ++i) place_.emplace_back(content.columns[i], static_cast<int>(i));
    std::sort(place_.begin(), place_.end());
    for (const PinMarkers& pin : scene.pins) pins_.emplace(pin.joint, &pin);
  }

  std::string text() const {
    Json json = {{"name", run_.stamp.model_name}, {"outcome", to_text(trajectory_.outcome)}, {"rows", content_.rows.size()}};
    json["columns"] = columns();
    json["groups"] = groups();
    json["joints"] = joints();
    json["scene"] = scene();
    json["paints"] = paints();
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) text.replace(at, 1, "\\u003c");
    return text;
  }

 private:
  /// Index among the page's columns; -1: not on the page.
  int kept(int column) const {
    if (column < 0) return -1;
    const auto found = std::lower_bound(place_.begin(), place_.end(), std::pair(static_cast<std::size_t>(column), 0));
    return found != place_.end() && found->first == static_cast<std::size_t>(column) ? found->second : -1;
  }
  int kept(const std::string& name) const { return kept(all_.find(name)); }

  Json columns() const {
    Json list = Json::array();
    for (const std::size_t column : content_.columns) {
      std::vector<double> values;
      for (const std::size_t row : content_.rows) values.push_back(trajectory_.at(row, column));
      list.push_back({{"name", trajectory_.columns[column].name}, {"unit", trajectory_.columns[column].unit}, {"data", base64(values)}});
    }
    return list;
  }

  struct Entry {
    std::string column;
    const char *label, *subscript;
  };

  /// A plot of columns with one unit; with `magnitude` also the length of the first two. Adds nothing if a column is missing.
  void add_quantity(Json& group, const std::string& title, const std::vector<Entry>& entries, const char* magnitude = nullptr) const {
    Json curves = Json::array();
    std::string unit;
    for (const Entry& entry : entries) {
      const int column = kept(entry.column);
      if (column < 0) return;
      unit = trajectory_.columns[content_.columns[static_cast<std::size_t>(column)]].unit;
      curves.push_back({{"label", entry.label}, {"sub", entry.subscript}, {"of", {column}}});
    }
    if (magnitude) curves.push_back({{"label", magnitude}, {"sub", ""}, {"of", {curves[0]["of"][0], curves[1]["of"][0]}}});
    group["quantities"].push_back({{"title", title}, {"unit", unit}, {"curves", curves}});
  }

  static void add_group(Json& list, Json group) {
    if (!group["quantities"].empty()) list.push_back(std::move(group));
  }
  static Json group(const std::string& kind, const std::string& name) { return {{"kind", kind}, {"name", name}, {"quantities", Json::array()}}; }

  Json groups() const {
    Json list = Json::array();
    for (const LoadSummary& joint : trajectory_.joints) {
      Json one = group("Joint", joint.name);
      const std::string p = "joint." + joint.name + ".", on = p + "on_" + joint.second_body + ".";
      add_quantity(one, "Force on " + joint.second_body, {{on + "fx[world]", "F", "x"}, {on + "fy[world]", "F", "y"}}, "|F|");
      add_quantity(one, "Couple on " + joint.second_body, {{on + "m[world]", "M", ""}});
      add_quantity(one, "Slide", {{p + "slide", "s", ""}});
      add_quantity(one, "Angle", {{p + "angle", "φ", ""}});
      add_quantity(one, "Rate of the slide", {{p + "slide_rate", "rate", ""}});
      add_quantity(one, "Rate of the angle", {{p + "angle_rate", "rate", ""}});
      add_group(list, std::move(one));
    }
    for (const BodyTrack& body : scene_.bodies) {
      Json one = group("Body", body.name);
      const std::string p = "body." + body.name + ".";
      add_quantity(one, "Position of the centre of mass", {{p + "x", "x", ""}, {p + "y", "y", ""}});
      add_quantity(one, "Angle", {{p + "angle", "φ", ""}});
      add_quantity(one, "Velocity of the centre of mass", {{p + "vx", "v", "x"}, {p + "vy", "v", "y"}}, "|v|");
      add_quantity(one, "Spin", {{p + "spin", "ω", ""}});
      add_group(list, std::move(one));
    }
    for (const LoadSummary& spring : trajectory_.springs) {
      Json one = group("Spring", spring.name);
      add_quantity(one, "Tension", {{"spring." + spring.name + ".force", "F", ""}});
      add_quantity(one, "Moment", {{"spring." + spring.name + ".moment", "M", ""}});
      add_group(list, std::move(one));
    }
    for (const MotorSummary& motor : trajectory_.motors) {
      Json one = group("Motor", motor.name);
      add_quantity(one, motor.unit == "N" ? "Force" : "Torque", {{"motor." + motor.name + ".effort", motor.unit == "N" ? "F" : "M", ""}});
      add_quantity(one, "Power", {{"motor." + motor.name + ".power", "P", ""}});
      add_group(list, std::move(one));
    }
    for (const Column& column : trajectory_.columns) {
      constexpr std::string_view kFirst = "force.", kLast = ".fx[world]";
      if (!column.name.starts_with(kFirst) || !column.name.ends_with(kLast)) continue;
      const std::string name = column.name.substr(kFirst.size(), column.name.size() - kFirst.size() - kLast.size()), p = "force." + name + ".";
      Json one = group("Force", name);
      add_quantity(one, "Force", {{p + "fx[world]", "F", "x"}, {p + "fy[world]", "F", "y"}}, "|F|");
      add_quantity(one, "Torque", {{p + "torque", "M", ""}});
      add_quantity(one, "Power", {{p + "power", "P", ""}});
      add_group(list, std::move(one));
    }
    Json energy = group("Energy", "");
    add_quantity(energy, "Energy account", {{"energy.kinetic", "kinetic", ""}, {"energy.potential", "potential", ""},
                                    {"energy.dissipated", "dissipated", ""}, {"energy.supplied", "supplied", ""}});
    add_group(list, std::move(energy));
    return list;
  }

  Json joints() const {
    Json list = Json::array();
    for (const LoadSummary& joint : trajectory_.joints) {
      const std::string on = "joint." + joint.name + ".on_" + joint.second_body + ".";
      list.push_back({{"name", joint.name}, {"peak", joint.peak}, {"peak_time", joint.peak_time}, {"error", joint.error_estimate},
                      {"fx", kept(on + "fx[world]")}, {"fy", kept(on + "fy[world]")}});
      const auto pin = pins_.find(joint.name);
      if (pin == pins_.end()) continue;
      const PinMarkers& markers = *pin->second;
      list.back()["pin"] = {{"first", side(markers.first, markers.first_marker)}, {"second", side(markers.second, markers.second_marker)}};
    }
    return list;
  }

  static Json side(const Anchor& at, const MarkerRef& marker) {
    return {{"body", at.body}, {"axis", at.axis}, {"on", marker.body}, {"marker", marker.body + "." + marker.marker}};
  }

  Json point(const Vec2& p) const { return {rounded(p[0], grain_), rounded(p[1], grain_)}; }
  Json anchor(const Anchor& at) const { return {{"body", at.body}, {"point", point(at.point)}}; }
  Json end_of(const Anchor& at) const { return {{"body", at.body}, {"point", point(at.point)}, {"axis", at.axis}}; }
  Json spot(const MovingPoint& at) const {
    Json json = anchor(at.at);
    if (!at.is_anchor()) json.update({{"toward", anchor(at.toward)}, {"share", at.share}, {"off", point(at.off)}});
    return json;
  }
  Json named(const std::vector<NamedPoint>& points) const {
    Json list = Json::array();
    for (const NamedPoint& one : points) list.push_back({{"name", one.name}, {"at", spot(one.at)}});
    return list;
  }

  Json scene() const {
    static constexpr std::array<const char*, 4> kForms{"bar", "line", "area", "circle"};
    Json bodies = Json::array(), shapes = Json::array(), connectors = Json::array(), arrows = Json::array(), loads = Json::array();
    for (const BodyTrack& body : scene_.bodies)
      bodies.push_back({{"name", body.name}, {"x", kept(body.x)}, {"y", kept(body.y)}, {"angle", kept(body.angle)}});
    for (const Shape& shape : scene_.shapes) {
      Json paths = Json::array();
      for (const std::vector<Vec2>& path : shape.paths) {
        Json list = Json::array();
        for (const Vec2& p : path) list.push_back(point(p));
        paths.push_back(std::move(list));
      }
      shapes.push_back({{"form", kForms[static_cast<std::size_t>(shape.form)]}, {"paint", style_of(shape.paint).name}, {"body", shape.body},
                        {"size", shape.size}, {"closed", shape.closed}, {"paths", std::move(paths)}});
    }
    for (const Connector& connector : scene_.connectors) {
      Json line = {{0, 0}, {1, 0}};
      if (connector.paint == Paint::kSpring) line = spring_zigzag(connector.teeth);
      connectors.push_back({{"name", connector.name}, {"paint", style_of(connector.paint).name}, {"from", end_of(connector.from)},
                            {"to", end_of(connector.to)}, {"line", std::move(line)}, {"length", connector.length}});
      if (connector.radii[0] != 0 || connector.radii[1] != 0) connectors.back()["radii"] = connector.radii;
      if (connector.paint != Paint::kBarrel) continue;
      connectors.back()["barrel"] = connector.length;
      connectors.back()["half_width"] = Connector::kHalfBarrel * scene_.unit;
    }
    for (const ForceArrow& arrow : scene_.arrows)
      arrows.push_back({{"joint", arrow.joint}, {"on", arrow.on}, {"at", spot(arrow.at)}, {"fx", kept(arrow.fx)}, {"fy", kept(arrow.fy)}});
    for (const LoadArrow& load : scene_.loads) loads.push_back({{"name", load.name}, {"at", anchor(load.at)}, {"fx", kept(load.fx)}, {"fy", kept(load.fy)}});
    return {{"time_decimals", scene_.time_decimals}, {"box", {scene_.box.low[0], scene_.box.low[1], scene_.box.high[0], scene_.box.high[1]}},
            {"unit", scene_.unit}, {"arrow_length", scene_.arrow_length}, {"arrow_force", scene_.arrow_force}, {"arrow_most", Scene::kLongestArrow},
            {"bodies", bodies}, {"shapes", shapes}, {"connectors", connectors}, {"arrows", arrows}, {"loads", loads},
            {"points", named(scene_.points)}, {"labels", named(scene_.labels)}};
  }

  static Json paints() {
    Json styles = Json::object();
    for (const PaintStyle& style : all_paints())
      styles[style.name] = {{"fill", style.fill}, {"line", style.line}, {"width", style.line_width}, {"dash", style.dash}};
    return {{"styles", styles}, {"tints", kTints}, {"paper", kPaperShades}, {"ink", kInkShades}, {"force", kForceShades}, {"load", kLoadShades}, {"trace", kTraceShades}, {"note", kNoteShades}};
  }

  const Scene& scene_;
  const RunRecord& run_;
  const Trajectory& trajectory_;
  const PageContent& content_;
  ColumnIndex all_;
  std::vector<std::pair<std::size_t, int>> place_;  // column of the run, index on the page
  std::map<std::string, const PinMarkers*> pins_;
  double grain_ = 1e-5 * scene_.unit;               // smallest visible difference
};

}  // namespace

PageContent choose_content(const Trajectory& trajectory, std::size_t most_values) {
  constexpr std::size_t kFewestRows = 50;
  PageContent content;
  std::vector<std::string> firsts;
  for (const LoadSummary& joint : trajectory.joints)
    if (joint.first_body != joint.second_body) firsts.push_back("joint." + joint.name + ".on_" + joint.first_body + ".");
  std::sort(firsts.begin(), firsts.end());
  for (std::size_t i = 0; i < trajectory.columns.size(); ++i)
    if (!is_derived(trajectory.columns[i].name, firsts)) content.columns.push_back(i);
  const std::size_t n = trajectory.n_rows();
  const std::size_t most = std::max(kFewestRows, most_values / std::max<std::size_t>(1, content.columns.size()));
  const std::size_t step = n <= most ? 1 : (n + most - 1) / most;
  for (std::size_t i = 0; i < n; i += step) content.rows.push_back(i);
  if (step == 1) return content;
  content.rows.push_back(n - 1);
  for (const std::size_t row : peak_rows(trajectory, most / 2)) content.rows.push_back(row);
  std::sort(content.rows.begin(), content.rows.end());
  content.rows.erase(std::unique(content.rows.begin(), content.rows.end()), content.rows.end());
  return content;
}

std::string page_data(const Scene& scene, const RunRecord& run, const PageContent& content) {
  return PageData(scene, run, content).text();
}

std::string base64(const std::vector<double>& values) {
  static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  bytes.reserve(8 * values.size() + 2);
  for (const double value : values) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>((bits >> shift) & 0xff);
  }
  const std::size_t n_padding = (3 - bytes.size() % 3) % 3;
  bytes.append(n_padding, '\0');
  std::string text;
  text.reserve(bytes.size() / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | static_cast<unsigned char>(bytes[i + k]);
    for (int shift = 18; shift >= 0; shift -= 6) text += kDigits[(group >> shift) & 63];
  }
  std::fill(text.end() - static_cast<std::ptrdiff_t>(n_padding), text.end(), '=');
  return text;
}

}  // namespace pintle
