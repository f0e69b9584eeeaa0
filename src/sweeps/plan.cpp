#include "sweeps/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/expression/expression_parser.h"
#include "base/text/text_scanner.h"
#include "base/units.h"
#include "io/text.h"
#include "sweeps/philox.h"
#include "sweeps/quantile.h"

namespace pintle {
namespace {

constexpr std::uint64_t kMostSamples = 1'000'000'000;
constexpr const char* kExample = "joint.A.stiffness=1e6..1e9:log:16, or =1e6,1e7,1e8";

// Reads the text of one --vary piece by piece; offsets into it locate complaints.
class AxisReader {
 public:
  AxisReader(ModelReading& reading, const std::string& text, int source) : reading_(reading), text_(text), source_(source) {}

  SweepAxis read() {
    SweepAxis axis;
    const std::size_t equals = text_.find('=');
    if (equals == std::string::npos) {
      complain(0, "a varying value is PATH=FROM..TO:lin|log:COUNT, or PATH=A,B,C", kExample);
      return axis;
    }
    axis.path = text_.substr(0, equals);
    const auto key = varied_key(reading_, axis.path, spot(0));
    if (!key) return axis;
    key_ = *key;
    axis.unit = key_.unit;
    const std::size_t dots = text_.find("..", equals), colon = text_.find(':', equals);
    if (dots == std::string::npos && colon != std::string::npos) {
      complain(colon, "a range has two dots between its ends", kExample);
      return axis;
    }
    axis.values = dots == std::string::npos ? list(equals + 1) : range(equals + 1, dots);
    return axis;
  }

 private:
  Spot spot(std::size_t offset) const { return {source_, 1, static_cast<int>(offset) + 1}; }

  void complain(std::size_t offset, std::string because, std::string suggestion) {
    reading_.complaints.add(spot(offset), text_.substr(0, text_.find('=')), in_quotes(text_), std::move(because), std::move(suggestion));
  }

  // A piece of the text, given by its ends.
  struct Piece {
    std::size_t from, to;
  };

  std::vector<double> list(std::size_t from) {
    std::vector<Piece> pieces;
    for (std::size_t at = from; at <= text_.size();) {
      const std::size_t comma = std::min(text_.find(',', at), text_.size());
      pieces.push_back({at, comma});
      at = comma + 1;
    }
    return numbers(pieces);
  }

  std::vector<double> range(std::size_t from, std::size_t dots) {
    const std::size_t last = text_.rfind(':'), middle = last == std::string::npos || last == 0 ? last : text_.rfind(':', last - 1);
    if (last == std::string::npos || middle == std::string::npos || middle < dots) {
      complain(dots, "a range needs a spacing and a number of values", kExample);
      return {};
    }
    const std::string spacing = text_.substr(middle + 1, last - middle - 1);
    const std::vector<double> ends = numbers({{from, dots}, {dots + 2, middle}});
    long count = 0;
    const char* const end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(text_.data() + last + 1, end, count);
    if (error != std::errc() || stop != end || count < 2 || static_cast<std::uint64_t>(count) > kMostSamples) complain(last + 1, "the number of values is a whole number, 2 or more", "16");
    else if (spacing != "lin" && spacing != "log") complain(middle + 1, "the spacing is lin or log", kExample);
    else if (ends.size() != 2) return {};
    else if (spacing == "log" && !(ends[0] * ends[1] > 0)) complain(from, "both ends of a logarithmic range must have the same sign", text_.substr(0, middle) + ":lin" + text_.substr(last));
    else return spaced(ends[0], ends[1], spacing == "log", static_cast<std::size_t>(count));
    return {};
  }

  static std::vector<double> spaced(double from, double to, bool logarithmic, std::size_t count) {
    std::vector<double> out(count, to);
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(count - 1);
      out[i] = logarithmic ? from * std::pow(to / from, s) : from + (to - from) * s;
    }
    return out;
  }

  // A bare number takes the unit of the last piece, if it has one.
  std::vector<double> numbers(const std::vector<Piece>& pieces) {
    std::string unit;
    const std::string last = text_.substr(pieces.back().from, pieces.back().to - pieces.back().from);
    if (!is_bare(last)) {
      const std::size_t sign = last.find_first_not_of(" +-");
      if (sign != std::string::npos) unit = last.substr(sign + number_at(last, sign).size());
    }
    std::vector<double> out;
    for (const Piece& piece : pieces) {
      std::string word = text_.substr(piece.from, piece.to - piece.from);
      if (is_bare(word)) word += unit;
      if (const auto number = read_number(word, piece.from)) out.push_back(*number);
    }
    return out.size() == pieces.size() ? out : std::vector<double>();
  }

  static bool is_bare(const std::string& word) {
    const std::size_t sign = word.find_first_not_of(" +-");
    if (sign == std::string::npos) return false;
    const std::size_t size = number_at(word, sign).size();
    return size > 0 && skip_blanks(word, sign + size) == word.size();
  }

  std::optional<double> read_number(const std::string& word, std::size_t offset) {
    const auto parsed = parse_quantity(word, reading_.records.scope);
    if (const auto* problem = std::get_if<ParseProblem>(&parsed)) {
      complain(offset + problem->offset, problem->because, problem->suggestion.empty() ? kExample : problem->suggestion);
      return std::nullopt;
    }
    const Quantity& quantity = std::get<Quantity>(parsed);
    if (const auto problem = reading_.records.frequency_for_speed_error(word, key_.dimension)) {
      complain(offset, *problem, kSpeedExample);
      return std::nullopt;
    }
    if (const auto problem = check_dimension(quantity.dimension, key_.dimension)) {
      complain(offset, *problem, key_.unit.empty() ? "a plain number" : "numbers in SI, or with a unit such as " + key_.unit);
      return std::nullopt;
    }
    if (!key_.allows(quantity.si)) {
      complain(offset, fmt::format("{:g} is outside the range of this key", quantity.si), "pintle schema --reference has the ranges");
      return std::nullopt;
    }
    return quantity.si;
  }

  ModelReading& reading_;
  const std::string& text_;
  int source_;
  VariedKey key_;
};

// FNV-1a of the path: a variable draws the same numbers whatever else varies.
std::uint64_t stream_of(const std::string& path) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : path) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return hash;
}

}  // namespace

SweepAxis read_axis(ModelReading& reading, const std::string& text, int source) { return AxisReader(reading, text, source).read(); }

SweepPlan::SweepPlan(const SweepRequest& request, ModelReading& reading, int first_source) : zip_(request.zip), samples_(request.samples), seed_(request.seed) {
  for (std::size_t i = 0; i < request.vary.size(); ++i) axes_.push_back(read_axis(reading, request.vary[i], first_source + static_cast<int>(i)));
  std::vector<Variation> variations = read_variations(reading, samples_ > 0);
  if (samples_ > 0) variations_ = std::move(variations);
  const auto complain = [&](std::string path, std::string found, std::string because, std::string suggestion) {
    reading.complaints.add({0, 1, 1}, std::move(path), std::move(found), std::move(because), std::move(suggestion));
  };
  if (samples_ > 0 && section(reading, "variation").empty())
    complain("variation", "no variation", "--sample draws from the distributions in the model, and it has none",
             "[variation.\"joint.NAME.stiffness\"] with distribution = \"normal\", mean and deviation");
  if (samples_ == 0 && axes_.empty()) complain("", "nothing to vary", "a sweep needs --vary or --sample", std::string("--vary ") + kExample);
  std::vector<std::string> seen;
  for (const std::string& path : paths()) {
    if (std::find(seen.begin(), seen.end(), path) != seen.end()) complain(path, "twice", "this varies in two ways", "one of them");
    seen.push_back(path);
  }
  for (const Variation& v : variations_) streams_.push_back(stream_of(v.path));
  count_points(request, reading, first_source);
  if (request.latin && samples_ > 0 && reading.complaints.empty()) shuffle_strata();
}

void SweepPlan::count_points(const SweepRequest& request, ModelReading& reading, int first_source) {
  double points = 1;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const std::size_t count = std::max<std::size_t>(1, axes_[i].values.size());
    if (zip_ && i > 0 && count != axes_[0].values.size() && !axes_[0].values.empty() && !axes_[i].values.empty())
      reading.complaints.add({first_source + static_cast<int>(i), 1, 1}, axes_[i].path, in_quotes(request.vary[i]),
                             fmt::format("with --zip all need the same number of values: {} here, {} before", count, axes_[0].values.size()), "equal numbers");
    points = zip_ ? static_cast<double>(count) : points * static_cast<double>(count);
  }
  if (points * static_cast<double>(draws()) > static_cast<double>(kMostSamples)) {
    reading.complaints.add({0, 1, 1}, "", fmt::format("{:.3g} samples", points * static_cast<double>(draws())), "the limit is 1e9", "fewer values");
    return;
  }
  grid_points_ = static_cast<std::uint64_t>(points);
}

// Latin hypercube: each variable's draws occupy strata of equal probability, one draw per stratum, in an order of the variable's own.
void SweepPlan::shuffle_strata() {
  constexpr std::uint64_t kOtherStream = 0x5851F42D4C957F2DULL;  // different from the stream of the values
  for (const std::uint64_t stream : streams_) {
    std::vector<std::uint32_t> order(samples_);
    std::iota(order.begin(), order.end(), 0U);
    for (std::uint64_t i = samples_; i > 1; --i)
      std::swap(order[i - 1], order[static_cast<std::uint64_t>(uniform_number(seed_, stream ^ kOtherStream, i) * static_cast<double>(i))]);
    strata_.push_back(std::move(order));
  }
}

double SweepPlan::share(std::size_t variable, std::uint64_t draw) const {
  const double u = uniform_number(seed_, streams_[variable], draw);
  return strata_.empty() ? u : (strata_[variable][draw] + u) / static_cast<double>(samples_);
}

std::vector<std::string> SweepPlan::paths() const {
  std::vector<std::string> out;
  for (const SweepAxis& axis : axes_) out.push_back(axis.path);
  for (const Variation& v : variations_) out.push_back(v.path);
  return out;
}

std::vector<std::string> SweepPlan::units() const {
  std::vector<std::string> out;
  for (const SweepAxis& axis : axes_) out.push_back(axis.unit);
  for (const Variation& v : variations_) out.push_back(v.unit);
  return out;
}

std::vector<double> SweepPlan::values(std::uint64_t i) const {
  std::vector<double> out(axes_.size());
  const std::uint64_t draw = i % draws();
  std::uint64_t point = i / draws();
  for (std::size_t k = axes_.size(); k-- > 0;) {
    const std::size_t count = axes_[k].values.size();
    out[k] = axes_[k].values[zip_ ? point : point % count];
    if (!zip_) point /= count;
  }
  for (std::size_t v = 0; v < variations_.size(); ++v) out.push_back(quantile(variations_[v], share(v, draw)));
  return out;
}

}  // namespace pintle
