// The search for events on given functions: crossings, touches between samples, directions, several owners, and its cost.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "integrators/radau/event_location.h"

namespace pintle {
namespace {

using Function = std::function<double(double)>;

struct Found {
  SwitchingEvent event;
  int evaluations = 0;  // beyond those at the nodes and half-way between them
};

Found search(const std::vector<Function>& functions, const std::vector<int>& directions = {}, int stages = 3) {
  std::vector<SwitchingFunction> owners(functions.size());
  for (std::size_t f = 0; f < directions.size(); ++f) owners[f].direction = directions[f];
  EventSearch search(owners);
  for (std::size_t f = 0; f < functions.size(); ++f) search.start()[f] = functions[f](0);
  const RadauTable& table = RadauTable::of(stages);
  Found found;
  found.event = search.first(table, [&](double x, double* value) {
    ++found.evaluations;
    for (std::size_t f = 0; f < functions.size(); ++f) value[f] = functions[f](x);
  });
  found.evaluations -= 2 * table.n;
  return found;
}

void expect_at(const Found& found, double x, int function, bool rising) {
  EXPECT_LE(found.event.before, x + 1e-15);
  EXPECT_GE(found.event.after, x - 1e-15);
  EXPECT_LT(found.event.after - found.event.before, 1e-14);
  EXPECT_EQ(found.event.function, function);
  EXPECT_EQ(found.event.rising, rising);
}

// Bisection needs 46 for any of them.
TEST(EventSearch, FindsACrossingWithAFewEvaluations) {
  const struct {
    Function f;
    double x;
  } crossings[] = {{[](double x) { return x - 0.3; }, 0.3},
                   {[](double x) { return std::cos(5 * x); }, 0.1 * std::numbers::pi},
                   {[](double x) { return std::expm1(20 * (0.62 - x)); }, 0.62},
                   {[](double x) { return x * x * x - 0.125; }, 0.5},
                   {[](double x) { return std::min(x - 0.4, 5 * x - 1.9); }, 0.4},
                   {[](double x) { return 1e-9 * (0.9999 - x); }, 0.9999}};
  int all = 0;
  for (const auto& [f, x] : crossings)
    for (const int stages : {3, 5}) {
      const Found found = search({f}, {}, stages);
      expect_at(found, x, 0, f(x + 1e-3) > 0);
      EXPECT_LE(found.evaluations, 20) << x;
      all += found.evaluations;
    }
  EXPECT_LE(all, 12 * 11);
}

// Where the secant does not help, the search is never much worse than bisection: a jump, a root of high order, a function that is
// not a number.
TEST(EventSearch, IsNeverMuchWorseThanHalvings) {
  const Function bad[] = {[](double x) { return x < 0.37 ? -1.0 : 1e12; }, [](double x) { return std::pow(x - 0.37, 9); },
                          [](double x) { return x < 0.37 ? std::nan("") : 1.0; }, [](double x) { return x < 0.37 ? -1e-300 : 1.0; }};
  for (const Function& f : bad) {
    const Found found = search({f});
    EXPECT_NEAR(found.event.after, 0.37, 1e-14);
    EXPECT_LE(found.evaluations, 16 + 50);
  }
}

TEST(EventSearch, FindsNothingWhereNothingIs) {
  for (const int stages : {3, 5}) {
    const Found found = search({[](double x) { return 1 + x; }, [](double x) { return -1 - std::sin(x); }, [](double) { return 0.0; }}, {}, stages);
    EXPECT_EQ(found.event.function, -1);
    EXPECT_GT(found.event.after, 1);
    EXPECT_EQ(found.evaluations, 0);
  }
}

// The magnitude of a force that nearly vanishes has a corner. Parabolas do not reach down to it: a joint went on sticking although nothing pressed it any more.
TEST(EventSearch, FindsACornerBetweenTwoSamples) {
  int inside = 0, missed = 0;
  for (const int stages : {3, 5}) {
    const RadauTable& table = RadauTable::of(stages);
    for (double at = 0.5 * (table.nodes[1] + table.nodes[2]); at < 0.5 * (table.nodes[table.n - 1] + 1); at += 0.0137) {
      const double half = 4e-3;  // where the magnitude of (x - at, 2e-3) is less than 4.5e-3
      bool sampled = false;
      for (int i = 0; i <= table.n; ++i) {
        const double node = table.nodes[i], middle = i < table.n ? 0.5 * (node + table.nodes[i + 1]) : node;
        sampled = sampled || std::abs(node - at) < 2 * half || std::abs(middle - at) < 2 * half;
      }
      if (sampled) continue;
      ++inside;
      const Found found = search({[at](double x) { return std::hypot((x - at) * (1 + 0.1 * (x - at)), 2e-3) - std::hypot(2e-3, 4e-3); }}, {}, stages);
      if (found.event.function < 0) ++missed;
      EXPECT_LE(found.evaluations, 24) << at;
    }
  }
  EXPECT_GT(inside, 50);
  EXPECT_LE(10 * missed, inside);  // parabolas find none
}

// A function that is negative only between two samples, anywhere in the step: all samples have the same sign.
TEST(EventSearch, FindsAFunctionThatIsLeftAndEnteredAgainBetweenTwoSamples) {
  for (const int stages : {3, 5}) {
    const RadauTable& table = RadauTable::of(stages);
    int missed = 0, inside = 0;
    for (double at = 0.03; at < 0.97; at += 0.0137) {
      const double depth = 3e-5, half = std::sqrt(depth);  // (x - at)^2 = depth
      bool sampled = false;
      for (int i = 0; i <= table.n; ++i) {
        const double node = table.nodes[i], middle = i < table.n ? 0.5 * (node + table.nodes[i + 1]) : node;
        sampled = sampled || std::abs(node - at) < half || std::abs(middle - at) < half;
      }
      if (sampled) continue;
      ++inside;
      const Found found = search({[at](double x) { return ((x - at) * (x - at) - 3e-5) * (1 + 0.1 * std::sin(3 * x)); }}, {}, stages);
      if (found.event.function < 0) ++missed;
      else expect_at(found, at - half, 0, false);
      EXPECT_LE(found.evaluations, 20) << at;
    }
    EXPECT_GT(inside, 30);
    EXPECT_EQ(missed, 0);
  }
}

TEST(EventSearch, LooksAtATouchThatIsNoneAndGoesOn) {
  const Found found = search({[](double x) { return (x - 0.41) * (x - 0.41) + 1e-9; }, [](double x) { return 0.8 - x; }});
  expect_at(found, 0.8, 1, false);
}

TEST(EventSearch, GoesByTheDirection) {
  const Function falls = [](double x) { return 0.3 - x; }, rises = [](double x) { return x - 0.6; };
  expect_at(search({falls, rises}, {0, 0}), 0.3, 0, false);
  expect_at(search({falls, rises}, {-1, 0}), 0.3, 0, false);
  expect_at(search({falls, rises}, {1, 0}), 0.6, 1, true);
  EXPECT_EQ(search({falls, rises}, {1, -1}).event.function, -1);
  // Down at 0.2, which does not count, and up at 0.7; then the same between two samples.
  expect_at(search({[](double x) { return (x - 0.2) * (x - 0.7); }}, {1}), 0.7, 0, true);
  expect_at(search({[](double x) { return (x - 0.49) * (x - 0.5); }}, {1}), 0.5, 0, true);
  expect_at(search({[](double x) { return (x - 0.49) * (x - 0.5); }}, {-1}), 0.49, 0, false);
}

// Four owners in one interval between two samples, in every order.
TEST(EventSearch, TheEarliestOfSeveralWins) {
  for (int first = 0; first < 4; ++first) {
    std::vector<Function> functions;
    for (int f = 0; f < 4; ++f) {
      const double x = 0.52 + 0.003 * ((f + first) % 4), steepness = std::pow(100, f);
      functions.push_back([=](double y) { return steepness * (x - y) * (1 + y * y); });
    }
    const Found found = search(functions);
    expect_at(found, 0.52, (4 - first) % 4, false);
    EXPECT_LE(found.evaluations, 20);
  }
}

// More owners than a word has bits.
TEST(EventSearch, AHundredOwners) {
  std::vector<Function> functions;
  for (int f = 0; f < 100; ++f) functions.push_back([f](double x) { return f == 77 ? x - 0.81 : 1.0 + f; });
  expect_at(search(functions), 0.81, 77, true);
}

// From just before an event to just after it; if the first move falls short, the next one has the length that is missing.
TEST(EventSearch, StepsOverAsFarAsTheSignSays) {
  const std::vector<SwitchingFunction> owner(1);
  EventSearch search(owner);
  for (const double missing : {0.0, 1e-8, 5e-8}) {  // how far the event lies beyond the stated distance
    const double zero = 1e-6 + missing;
    search.start()[0] = zero;
    double t = 0;
    int moves = 0;
    EXPECT_TRUE(search.step_over({0, 0, 0, false, 0}, 1e-6, 1e-8, [&](double d, double* value) {
      t += d;
      ++moves;
      value[0] = zero - t;
    }));
    EXPECT_LE(t, zero + 2.1e-8);
    EXPECT_LE(moves, 2);
  }
  search.start()[0] = 1;
  EXPECT_FALSE(search.step_over({0, 0, 0, false, 0}, 1e-6, 1e-8, [](double, double* value) { value[0] = 1; }));
}

}  // namespace
}  // namespace pintle
