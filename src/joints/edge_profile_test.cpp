// The point of a curved edge nearest to a point above it, compared with the nearest of very many points.
#include "joints/edge_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/expression/expression_parser.h"
#include "base/random_for_tests.h"
#include "base/units.h"

namespace pintle {
namespace {

EdgeProfile edge_of(const std::string& height, double from, double to) {
  ParseScope scope;
  scope.variables = {{"x", kLength}};
  Edge edge;
  edge.height = std::get<ParsedExpression>(parse_expression(height, scope)).expression;
  edge.from = from;
  edge.to = to;
  return EdgeProfile(edge);
}

double distance_by_many_points(const EdgeProfile& edge, const Planar::Point& c) {
  constexpr int kMany = 4000;
  const double reach = 1.01 * std::abs(c[1] - edge.at(c[0]).p[1]);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kMany; ++i) least = std::min(least, (c - edge.at(c[0] + reach * (2.0 * i / kMany - 1)).p).norm());
  return least;
}

// Teeth of a rack, a road with one narrow bump, and a groove: near them, above a concave part, and far away.
TEST(EdgeProfile, HasItsNearestPoint) {
  const EdgeProfile edges[] = {edge_of("2 mm*(sin(2*pi*x/12 mm) + 0.25*sin(4*pi*x/12 mm))", -0.1, 0.1), edge_of("5 mm*exp(-(x/20 mm)^2)", -0.1, 0.1),
                               edge_of("-1 mm*exp(-(x/2 mm)^2)", -0.1, 0.1)};
  sample::Random random(5);
  for (const EdgeProfile& edge : edges)
    for (int i = 0; i < 1500; ++i) {
      const double x = random.uniform(-0.02, 0.02);
      const Planar::Point c(x, edge.at(x).p[1] + std::abs(random.of_any_size(1e-4, 0.05)));
      const double found = (c - edge.at(edge.nearest(c)).p).norm(), least = distance_by_many_points(edge, c);
      EXPECT_NEAR(found, least, 1e-5 * least) << c.transpose();
    }
}

}  // namespace
}  // namespace pintle
