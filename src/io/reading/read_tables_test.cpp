// Tables of models: from lists and files, with their units, in expressions and laws; every mistake is located.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "base/expression/expression_parser.h"
#include "io/writers.h"
#include "pintle/read_model.h"
#include "pintle/results.h"

namespace pintle {
namespace {

constexpr const char* kRest = R"(
[body.crank]
mass = 1
inertia = 1
markers.A = [0, 0]
[ground.markers]
O = [0, 0]
[joint.O]
type = "revolute"
between = ["ground.O", "crank.A"]
[motor.M]
joint = "O"
)";

using Files = std::map<std::string, std::string>;

FileText text_in(const Files& files) {
  return [files](const std::string& name) {
    if (const auto it = files.find(name); it != files.end()) return it->second;
    throw FileError(name + ": cannot read it: No such file or directory.");
  };
}

std::string with_table(const std::string& table, const std::string& torque = "1 N*m") { return "format = 1\n" + table + kRest + "torque = \"" + torque + "\"\n"; }

// The motor's torque at an angle.
double torque_at(const std::string& text, double angle, const Files& files = {}) {
  const Model model = parse_model(text, "m.toml", {}, text_in(files));
  return model.motors[0].law.value(std::vector{angle});
}

std::vector<Complaint> complaints_with_files(const std::string& text, const FileText& files) {
  try {
    parse_model(text, "m.toml", {}, files);
  } catch (const InputError& error) {
    return error.complaints();
  }
  return {};
}

TEST(Tables, MayHaveQuantitiesOrBareNumbersWithAUnit) {
  const double angle = std::numbers::pi / 8;
  for (const char* table : {"[table.f]\nx = [0, \"90 deg\"]\ny = [\"1 N*m\", \"5 N*m\"]\n", "[table.f]\nx = [0, 90]\ny = [1, 5]\nx_unit = \"deg\"\ny_unit = \"N*m\"\n",
                            "[table.f]\nx = [0, \"pi/2\"]\ny = [1000, \"5 N*m\"]\ny_unit = \"N*mm\"\nx_unit = \"rad\"\n", "[table.f]\nx = [0, \"pi/2\"]\ny = [1, 5]\n"})
    EXPECT_NEAR(torque_at(with_table(table, "f(angle)"), angle), 2, 1e-12) << table;
  EXPECT_NEAR(torque_at(with_table("[parameters]\na = \"2 N*m\"\n[table.f]\nx = [0, \"1 rad\"]\ny = [\"a\", \"3*a\"]\n", "f(angle)"), 0.5), 4, 1e-12);
}

TEST(Tables, MayStandInAFile) {
  const std::string table = "[table.f]\nfile = \"data/f.csv\"\n", call = "f(angle)";
  const auto at = [&](const std::string& keys, const std::string& file) { return torque_at(with_table(table + keys, call), 1.5, {{"data/f.csv", file}}); };
  const std::string units = "x_unit = \"rad\"\ny_unit = \"N*m\"\n";
  EXPECT_DOUBLE_EQ(at(units, "1,10\n2,20\n"), 15);
  EXPECT_DOUBLE_EQ(at(units, "\xEF\xBB\xBF# measured\r\n\r\n 1 ; 10 \r\n2;2e1\r\n"), 15);
  EXPECT_DOUBLE_EQ(at(units, "1\t10\n2\t20"), 15);
  EXPECT_DOUBLE_EQ(at(units + "x_column = 3\ny_column = 1\n", "10,x,1\n20,x,2\n"), 10 + 5);
  EXPECT_DOUBLE_EQ(at(units + "x_column = \"angle\"\ny_column = \"M\"\n", "M,\"angle\"\n10,1\n20,2\n"), 15);
  EXPECT_DOUBLE_EQ(at(units + "x_column = \"1000\"\ny_column = \"2000\"\n", "2000,1000\n10,1\n20,2\n"), 15);
  EXPECT_DOUBLE_EQ(at("", "angle [rad],M [N*m]\n1,10\n2,20\n"), 15);
  EXPECT_DOUBLE_EQ(at("x_column = \"angle\"\ny_column = \"M\"\n", "M [N*mm],angle [rad]\n10000,1\n20000,2\n"), 15);
  EXPECT_DOUBLE_EQ(at("y_column = \"joint.O.m\"\n", "t,joint.O.m\r\nrad,N*m\r\n1,10\r\n2,20\r\n"), 15);  // as in series.csv
  EXPECT_DOUBLE_EQ(at("y_unit = \"kN*m\"\n", "angle,M\nrad,N*m\n1,10\n2,20\n"), 15e3);
}

// 10 sin(angle) as it is computed: its last value is a rounding error.
TEST(Tables, APeriodClosesToRoundingOfItsLargestValue) {
  EXPECT_NEAR(torque_at(with_table("[table.f]\nx = [0, 90, 180, 270, 360]\nx_unit = \"deg\"\ny = [0, 10, 1.2e-15, -10, -2.4e-15]\ny_unit = \"N*m\"\nperiod = 360\n", "f(angle)"), std::numbers::pi / 4), 5, 1e-12);
}

TEST(Tables, RepeatAndGoOnAsTheModelSays) {
  const std::string points = "[table.f]\nx = [0, 90, 180]\nx_unit = \"deg\"\ny = [0, 10, 0]\ny_unit = \"N*m\"\n";
  const double quarter = std::numbers::pi / 2;
  EXPECT_NEAR(torque_at(with_table(points, "f(angle)"), 3 * quarter), 0, 1e-12);
  EXPECT_NEAR(torque_at(with_table(points + "outside = \"extend\"\n", "f(angle)"), 3 * quarter), -10, 1e-12);
  EXPECT_NEAR(torque_at(with_table(points + "period = 180\n", "f(angle)"), 3 * quarter), 10, 1e-12);
  EXPECT_NEAR(torque_at(with_table(points + "period = \"1 rev\"\n", "f(angle)"), 3 * quarter), 0, 1e-12);
}

TEST(Tables, GiveTheCurveOfALaw) {
  const std::string text = "format = 1\n[table.foot]\nx = [0, 1, 2]\nx_unit = \"mm\"\ny = [0, \"100 N\", \"1 kN\"]\n" + std::string(kRest) +
                           "torque = 0\n[joint.J]\ntype = \"slot\"\nbetween = [\"ground.O\", \"crank.A\"]\nlaw = \"table\"\ncurve = \"foot\"\n";
  const Model model = parse_model(text, "m.toml");
  const auto& values = model.joints[1].law.values;
  EXPECT_EQ(values.at("displacement"), (std::vector{0.0, 1e-3, 2e-3}));
  EXPECT_EQ(values.at("force"), (std::vector{0.0, 100.0, 1000.0}));
}

TEST(Tables, SurviveConversion) {
  const std::string text = with_table("[table.f]\nx = [0, \"90 deg\"]\ny = [\"1 N*m\", 5]\ninterpolation = \"spline\"\noutside = \"extend\"\n", "f(angle)");
  const std::string json = to_json(parse_document(text, "m.toml"));
  const Model a = parse_model(text, "m.toml"), b = parse_model(json, "m.json"), c = parse_model(to_toml(parse_document(json, "m.json")), "m.toml");
  for (const double angle : {-1.0, 0.3, 2.0}) {
    EXPECT_EQ(a.motors[0].law.value(std::vector{angle}), b.motors[0].law.value(std::vector{angle}));
    EXPECT_EQ(a.motors[0].law.value(std::vector{angle}), c.motors[0].law.value(std::vector{angle}));
  }
}

// @ precedes the character that the complaint should point at.
struct TableMistake {
  const char* table;
  const char* path;
  const char* because;
  const char* suggestion = "";
  const char* found = "";
};

const std::vector<TableMistake> kTableMistakes{
    {"[table.@a-b]\nx = [0, 1]\ny = [0, 1]\n", "table.a-b", "letters, digits and _"},
    {"[table.@sin]\nx = [0, 1]\ny = [0, 1]\n", "table.sin", "name of a function"},
    {"[table.@rate]\nx = [0, 1]\ny = [0, 1]\n", "table.rate", "a variable", "rate_table"},
    {"[parameters]\np = 1\n[table.@p]\nx = [0, 1]\ny = [0, 1]\n", "table.p", "a parameter has this name"},
    {"[table.@f]\nx = [0, 1]\n", "table.f.y", "x and y, or a file"},
    {"[table.f]\nx = [0, 1]\ny = @3\n", "table.f.y", "a list of numbers is expected"},
    {"[table.f]\nx = @[0]\ny = [1]\n", "table.f.x", "two points at least", "", "1 point"},
    {"[table.f]\nx = [0, 1]\ny = @[0, 1, 2]\n", "table.f.y", "x has 2", "one y for each x", "3 numbers"},
    {"[table.f]\nx = [0, 1, @1]\ny = [0, 1, 2]\n", "table.f.x", "x must rise"},
    {"[table.f]\nx = [0, \"1 rad\", \"@3 m\"]\ny = [0, 1, 2]\n", "table.f.x", "an angle [rad] is expected"},
    {"[table.f]\nx = [0, \"@1 m\"]\nx_unit = \"deg\"\ny = [0, 1]\n", "table.f.x", "an angle [rad] is expected"},
    {"[table.f]\nx = [0, 1]\nx_unit = \"@degs\"\ny = [0, 1]\n", "table.f.x_unit", "not a unit", "deg"},
    {"[table.f]\nx = [0, 1]\ny = [0, 1]\nperiod = \"@2 m\"\nx_unit = \"rad\"\n", "table.f.period", "an angle [rad] is expected"},
    {"[table.f]\nx = [0, 1]\ny = [0, 1]\nperiod = @0.5\n", "table.f.period", "the table spans more, 1"},
    {"[table.f]\nx = [0, 1]\ny = [0, 1]\nperiod = @-1\n", "table.f.period", "greater than 0"},
    {"[table.f]\nx = [0, 1, 2]\ny = [5, 1, @4]\nperiod = 2\n", "table.f.y", "would jump", "no point at the end"},
    {"[table.f]\nx = [0, 1]\ny = [0, 1]\nperiod = 2\noutside = \"@hold\"\n", "table.f.outside", "no outside"},
    {"[table.f]\nx = [0, 1]\ny = [0, 1]\ninterpolation = \"@cubic\"\n", "table.f.interpolation", "none of linear"},
    {"[table.f]\nx = [0, 1]\ny = [0, 1]\nx_column = @2\n", "table.f.x_column", "columns are of a file"},
    {"[table.f]\nx = @[0, 1]\nfile = \"f.csv\"\n", "table.f.x", "in the file"},
    {"[table.f]\nfile = \"@g.csv\"\n", "table.f.file", "No such file"},
    {"[table.f]\nfile = \"@/f.csv\"\n", "table.f.file", "its own folder", "a copy"},
    {"[table.f]\nfile = \"@../f.csv\"\n", "table.f.file", "its own folder"},
    {"[table.f]\nfile = \"@data\\\\f.csv\"\n", "table.f.file", "separated by /"},
    {"[table.f]\nfile = \"@summary.json\"\n", "table.f.file", "a run folder"},
    {"[table.f]\nfile = \"@empty.csv\"\n", "table.f.file", "no numbers"},
    {"[table.f]\nfile = \"@f.csv\"\n", "table.f.x_unit", "in which unit", "x_unit"},
    {"[table.f]\nfile = \"f.csv\"\nx_column = @3\n", "table.f.x_column", "f.csv has 2 columns", "1 to 2"},
    {"[table.f]\nfile = \"f.csv\"\nx_column = \"@angel\"\n", "table.f.x_column", "no such column", "did you mean \"angle\"?"},
    {"[table.f]\nfile = \"f.csv\"\nx_column = @true\n", "table.f.x_column", ""},
    {"[table.f]\nfile = \"plain.csv\"\ny_column = \"@M\"\n", "table.f.y_column", "has no names"},
    {"[table.f]\nfile = \"@words.csv\"\n", "table.f.file", "not a number", "", "words.csv:3: \"abc\""},
    {"[table.f]\nfile = \"@comma.csv\"\n", "table.f.file", "not a number", "point", "comma.csv:2: \"0,5\""},
    {"[table.f]\nfile = \"@infinite.csv\"\n", "table.f.file", "not a number", "", "infinite.csv:2: \"inf\""},
    {"[table.f]\nx = [0, @inf]\ny = [0, 1]\n", "table.f.x", "finite"},
    {"[table.f]\nfile = \"@short.csv\"\n", "table.f.file", "no column 2", "", "short.csv:2"},
    {"[table.f]\nfile = \"@quote.csv\"\n", "table.f.file", "never closed", "", "quote.csv:1"},
    {"[table.f]\nfile = \"@falls.csv\"\nx_unit = \"rad\"\ny_unit = \"\"\n", "table.f.file", "x must rise", "", "falls.csv:3: 0.5 rad"},
};

const Files kFiles{{"f.csv", "angle,M\n0,1\n1,2\n"}, {"plain.csv", "0,1\n1,2\n"}, {"words.csv", "angle,M\n0,1\n1,abc\n"}, {"comma.csv", "0;1\n0,5;2\n"}, {"short.csv", "0,1\n1\n"},
                   {"quote.csv", "0,\"1\n"}, {"falls.csv", "0,1\n1,2\n0.5,3\n"}, {"empty.csv", "# nothing\n\n"}, {"infinite.csv", "0,1\ninf,2\n"}};

TEST(Tables, MistakesAreLocatedAndExplained) {
  for (const TableMistake& mistake : kTableMistakes) {
    std::string text = with_table(mistake.table);
    const std::size_t mark = text.find('@');
    ASSERT_NE(mark, std::string::npos) << mistake.table;
    text.erase(mark, 1);
    const int line = 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(mark), '\n'));
    const int column = static_cast<int>(mark - text.rfind('\n', mark - 1));
    const auto complaints = complaints_with_files(text, text_in(kFiles));
    std::string all;
    for (const Complaint& complaint : complaints) all += to_text(complaint) + "\n";
    const bool found = std::any_of(complaints.begin(), complaints.end(), [&](const Complaint& c) {
      return c.place.line == line && c.place.column == column && c.path == mistake.path && c.because.find(mistake.because) != std::string::npos && c.suggestion.find(mistake.suggestion) != std::string::npos &&
             c.found.find(mistake.found) != std::string::npos;
    });
    EXPECT_TRUE(found) << "wanted " << line << ":" << column << " " << mistake.path << ": " << mistake.because << "\ngot\n" << all;
    EXPECT_LE(complaints.size(), 2U) << all;
  }
}

TEST(Tables, InFilesNeedFiles) {
  const auto complaints = complaints_with_files(with_table("[table.f]\nfile = \"f.csv\"\n", "f(angle)"), {});
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_EQ(complaints[0].path, "table.f.file");
  EXPECT_NE(complaints[0].because.find("only the text of the model is known"), std::string::npos);
}

// A caller of a faulty table is not blamed.
TEST(Tables, AreBlamedOnce) {
  EXPECT_EQ(complaints_with_files(with_table("[table.f]\nx = [0, 0]\ny = [1, 2]\n", "f(angle)"), {}).size(), 1U);
  EXPECT_EQ(complaints_with_files(with_table("[table.f]\nx = [0, \"1 m\"]\ny = [1, 2]\n", "f(angle)"), {}).at(0).path, "motor.M.torque");
}

TEST(Tables, OfLawsAreOfTheirKind) {
  const auto about = [](const std::string& tables, const std::string& keys) {
    const auto complaints = complaints_with_files("format = 1\n" + tables + kRest + "torque = 0\n[joint.J]\ntype = \"slot\"\nbetween = [\"ground.O\", \"crank.A\"]\nlaw = \"table\"\n" + keys, {});
    return complaints.size() == 1 ? complaints[0].path + ": " + complaints[0].because : std::to_string(complaints.size()) + " complaints";
  };
  const std::string good = "[table.f]\nx = [0, \"1 m\"]\ny = [0, \"1 N\"]\n";
  EXPECT_EQ(about(good, "curve = \"g\"\n"), "joint.J.curve: the model has no such table");
  EXPECT_EQ(about(good, "curve = \"f\"\nforce = [0, 1]\n"), "joint.J.curve: force states the points too");
  EXPECT_EQ(about("[table.f]\nx = [0, \"1 s\"]\ny = [0, \"1 N\"]\n", "curve = \"f\"\n"), "joint.J.curve: its x: a length [m] is expected here, not a time [s]");
  EXPECT_EQ(about("[table.f]\nx = [0, \"1 m\"]\ny = [0, \"-1 N\"]\n", "curve = \"f\"\n"), "joint.J.curve: its y: entry 2, -1 N, is below the one before it, 0 N: such a joint is not stable there");
  EXPECT_EQ(about("[table.f]\nx = [0, \"1 m\"]\ny = [\"1 N\", \"2 N\"]\n", "curve = \"f\"\n"), "joint.J.curve: its y: a table that begins at 0 is completed to both sides, and its force there is 0");
  EXPECT_EQ(about(good, "displacement = [0, 1]\nforce = [0, \"-1 N\"]\n").substr(0, 14), "joint.J.force:");  // at the joint's own list
  EXPECT_EQ(about(good, ""), "2 complaints");  // neither the curve nor the two lists
}

}  // namespace
}  // namespace pintle
