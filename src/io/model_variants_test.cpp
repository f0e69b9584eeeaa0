// Reading again only what depends on a number gives the same as reading everything, for every number of every mechanism.
#include "io/model_variants.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "io/model_files.h"
#include "io/variations.h"
#include "pintle/read_model.h"
#include "results/disk.h"

namespace pintle {
namespace {

std::vector<double> values_of(const Expression& e) {
  std::vector<double> out;
  for (const double x : {0.0, 0.37, -1.2}) out.push_back(e.value(std::vector<double>(e.variables().size(), x)));
  return out;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void expect_same_law(const Expression& a, const Expression& b) {
  const std::vector<double> x = values_of(a), y = values_of(b);
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_TRUE(same(x[i], y[i])) << a.text();
}

void expect_same_model(const Model& a, const Model& b) {
  EXPECT_EQ(a.gravity, b.gravity);
  EXPECT_EQ(a.simulate.duration, b.simulate.duration);
  EXPECT_EQ(a.simulate.output_step, b.simulate.output_step);
  EXPECT_EQ(a.simulate.tolerance, b.simulate.tolerance);
  EXPECT_TRUE(a.ground == b.ground);
  EXPECT_TRUE(a.bodies == b.bodies);
  EXPECT_TRUE(a.joints == b.joints);
  EXPECT_TRUE(a.springs == b.springs);
  ASSERT_EQ(a.forces.size(), b.forces.size());
  for (std::size_t i = 0; i < a.forces.size(); ++i) {
    EXPECT_EQ(a.forces[i].name, b.forces[i].name);
    for (const int k : {0, 1}) expect_same_law(a.forces[i].force[k], b.forces[i].force[k]);
    expect_same_law(a.forces[i].torque, b.forces[i].torque);
  }
  ASSERT_EQ(a.motors.size(), b.motors.size());
  for (std::size_t i = 0; i < a.motors.size(); ++i) {
    EXPECT_EQ(a.motors[i].name, b.motors[i].name);
    EXPECT_EQ(a.motors[i].stiffness, b.motors[i].stiffness);
    expect_same_law(a.motors[i].law, b.motors[i].law);
  }
}

// The paths of all numbers that a sweep may vary in a document, with their values.
std::vector<std::pair<std::string, double>> numbers_of(const Document& document, const FileText& files) {
  ModelReading reading(document, files);
  read_all(reading);
  std::vector<std::pair<std::string, double>> out;
  for (const Entry& section : document.root.table()->entries()) {
    if (section.value.table() == nullptr) continue;
    for (const Entry& thing : section.value.table()->entries()) {
      const std::string path = section.key + "." + thing.key;
      if (section.key == "parameters") out.emplace_back(path, reading.records.scope.constant(thing.key)->si);
      if (thing.value.table() == nullptr) continue;
      for (const Entry& key : thing.value.table()->entries()) {
        ModelReading trial(document, files);
        read_all(trial);
        if (!varied_key(trial, path + "." + key.key, {0, 1, 1}) || key.key == "balls") continue;  // a whole number
        const auto number = trial.records.read_quantity(key.value, "");
        out.emplace_back(path + "." + key.key, number ? number->si : 0.5);
      }
    }
  }
  return out;
}

TEST(ModelVariants, AreTheModelsWithOverrides) {
  int compared = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::string(PINTLE_SOURCE_DIR) + "/mechanisms")) {
    if (file.path().extension() != ".toml" || file.path().stem() == "n_four_bar_40" || file.path().stem() == "n_four_bar_10") continue;
    const std::string name = file.path().filename().string(), text = read_file(file.path());
    const Document document = parse_document(text, name);
    ModelFiles files(file.path());
    for (const auto& [path, value] : numbers_of(document, files.reader())) {
      SCOPED_TRACE(name + " " + path);
      ModelVariants variants(document, {path}, files.reader());
      for (const double factor : {1.0, 1.01}) {
        const std::vector<double> numbers{factor * value};
        expect_same_model(variants.at(numbers), parse_model(text, name, {fmt::format("{}={}", path, numbers[0])}, files.reader()));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 400);
}

// Tables that depend on a number are read again, and so is everything that calls them or uses their points.
TEST(ModelVariants, ReadTablesAgain) {
  const std::string text = R"(format = 1
[parameters]
stroke = "1 mm"
force = "100 N"
[table.given]
x = [0, "stroke"]
y = [0, "force"]
[table.other]
x = [0, 1]
y = [0, 1]
[body.a]
mass = 1
inertia = 1
markers.A = [0, 0]
[ground.markers]
O = [0, 0]
[joint.J]
type = "slot"
between = ["ground.O", "a.A"]
law = "table"
curve = "given"
[motor.M]
joint = "J"
force = "-given(slide) + other(t/1 s)*1 N"
)";
  const Document document = parse_document(text, "m.toml");
  for (const std::string path : {"parameters.stroke", "parameters.force"}) {
    ModelVariants variants(document, {path});
    for (const double value : {2e-4, 3.0}) {
      const Model read = variants.at(std::vector{value}), whole = parse_model(text, "m.toml", {fmt::format("{}={}", path, value)});
      expect_same_model(read, whole);
      EXPECT_EQ(read.joints[0].law.values.at(path == "parameters.stroke" ? "displacement" : "force")[1], value);
    }
  }
}

TEST(ModelVariants, GoOnAfterAFaultyOne) {
  const std::string file = std::string(PINTLE_SOURCE_DIR) + "/mechanisms/pendulum.toml", text = read_file(file);
  const Document document = parse_document(text, file);
  const std::string body = document.root.table()->find("body")->table()->entries()[0].key;
  ModelVariants variants(document, {"body." + body + ".mass"}), copy(variants);
  const std::vector<double> good{3}, bad{-1};
  for (ModelVariants* one : {&variants, &copy}) {
    EXPECT_EQ(one->at(good).bodies[0].mass, 3);
    EXPECT_THROW(one->at(bad), InputError);
    EXPECT_EQ(one->at(good).bodies[0].mass, 3);
  }
}

// A bare number would not do for a parameter that has the name of a unit.
TEST(ModelVariants, ParametersKeepTheirUnits) {
  const std::string text = R"(format = 1
[parameters]
m = "1 kg"
[body.a]
mass = "m"
inertia = "0.1*m*(1 m)^2"
)";
  ModelVariants variants(parse_document(text, "m.toml"), {"parameters.m"});
  for (const double value : {1.0, 0.1, 2.5e-7}) {
    const Model read = variants.at(std::vector{value});
    EXPECT_EQ(read.bodies[0].mass, value);
    EXPECT_EQ(read.bodies[0].inertia, 0.1 * value);
  }
}

TEST(ModelVariants, ParametersMayBeInverseUnits) {
  const std::string text = R"T(format = 1
[parameters]
f = "10 Hz"
r = "3/(1 m)/(1 s)"
[body.a]
mass = "(1 kg)*(f*(1 s))*(r*(1 m)*(1 s))"
inertia = "1 kg*m^2"
)T";
  ModelVariants variants(parse_document(text, "f.toml"), {"parameters.f", "parameters.r"});
  for (const double value : {12.0, 0.1}) EXPECT_NEAR(variants.at(std::vector{value, 2.0}).bodies[0].mass, 2 * value, 1e-15 * value);
}

// Bodies that do not change are not read again, but expressions may read where they are.
TEST(ModelVariants, ExpressionsReadBodiesThatStay) {
  const std::string text = R"T(format = 1
[parameters]
W = "20 N"
[body.a]
mass = "1 kg"
inertia = "1 kg*m^2"
markers.tip = [1, 0]
[force.push]
on = "a.tip"
force = ["-W*a.vx/(1 m/s)", "W*a.tip.y/(1 m)"]
)T";
  ModelVariants variants(parse_document(text, "b.toml"), {"parameters.W"});
  const Model read = variants.at(std::vector{30.0});
  ASSERT_EQ(read.forces.size(), 1u);
  EXPECT_EQ(read.bodies.size(), 1u);
}

}  // namespace
}  // namespace pintle
