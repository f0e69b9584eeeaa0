#include "studio/kernel/calls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "results/disk.h"

namespace pintle::studio {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string four_bar_text() { return read_file(PINTLE_SOURCE_DIR "/mechanisms/four_bar.toml"); }

struct Called {
  OrderedJson value, fault;
  std::vector<std::vector<double>> arrays;
  const std::vector<double>& array(const OrderedJson& marked) const { return arrays.at(marked.at("f64").get<std::size_t>()); }
};

Called call(Kernel& kernel, const char* name, const OrderedJson& arguments, const OnProgress& on_progress = {}) {
  Answer answer = kernel.call(name, arguments.dump(), on_progress);
  const OrderedJson json = OrderedJson::parse(answer.text);
  return {json.value("value", OrderedJson()), json.value("fault", OrderedJson()), std::move(answer.arrays)};
}

TEST(StudioCalls, ReadsAModelAndWritesItAgain) {
  Kernel kernel;
  const Called read = call(kernel, "read", {{"text", four_bar_text()}});
  ASSERT_TRUE(read.value["ok"].get<bool>());
  EXPECT_EQ(read.value["model"]["body"]["crank"]["mass"], "1 kg");
  EXPECT_EQ(read.value["resolved"]["bodies"].size(), 3U);
  EXPECT_NEAR(read.value["resolved"]["bodies"][0]["angle"].get<double>(), std::acos(0.5), 1e-15);
  const Called written = call(kernel, "write", {{"model", read.value["model"]}});
  ASSERT_TRUE(written.value["ok"].get<bool>());
  const Called again = call(kernel, "read", {{"text", written.value["text"]}});
  EXPECT_EQ(again.value["model"], read.value["model"]);
  EXPECT_EQ(again.value["resolved"], read.value["resolved"]);
}

TEST(StudioCalls, ComplaintsHaveAPlaceAndALength) {
  Kernel kernel;
  std::string text = four_bar_text();
  text.replace(text.find("1e8 N/m"), 7, "1e8 kg!");
  const Called read = call(kernel, "read", {{"text", text}});
  EXPECT_FALSE(read.value["ok"].get<bool>());
  EXPECT_TRUE(read.value.contains("model"));
  const OrderedJson& complaint = read.value["complaints"].at(0);
  EXPECT_EQ(complaint["line"], 26);
  EXPECT_GE(complaint["length"].get<int>(), 1);
  EXPECT_EQ(complaint["key"], "defaults.joint.stiffness");
  const Called refused = call(kernel, "run", {{"text", text}});
  EXPECT_EQ(refused.fault["where"]["line"], 26);
}

TEST(StudioCalls, EditsOneValueAndLeavesTheRest) {
  Kernel kernel;
  const Called edited = call(kernel, "edit", {{"text", four_bar_text()}, {"path", {"body", "crank", "mass"}}, {"value", "2 kg"}});
  std::string expected = four_bar_text();
  expected.replace(expected.find("\"1 kg\""), 6, "\"2 kg\"");
  EXPECT_EQ(edited.value["text"], expected);
}

TEST(StudioCalls, ARunHasColumnsPeaksAndProgress) {
  Kernel kernel;
  double last = 0;
  const Called run = call(kernel, "run", {{"text", four_bar_text()}}, [&last](std::string_view text) {
    const double fraction = OrderedJson::parse(text)["fraction"].get<double>();
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    return true;
  });
  EXPECT_EQ(run.value["outcome"], "completed");
  EXPECT_NEAR(run.value["joints"][3]["peak"].get<double>(), 180.7, 0.05);
  ASSERT_EQ(run.value["columns"].size(), run.value["values"].size());
  for (std::size_t c = 0; c < run.value["columns"].size(); ++c) {
    const OrderedJson& column = run.value["columns"][c];
    EXPECT_EQ(run.array(run.value["values"][c]).size(), 361U);
    if (column["name"] != "joint.O4.on_follower.fx[world]") continue;
    EXPECT_EQ(column["kind"], "joint");
    EXPECT_EQ(column["of"], "O4");
    EXPECT_EQ(column["feels"], "follower");
    EXPECT_EQ(column["quantity"], "fx");
    EXPECT_EQ(column["frame"], "world");
  }
}

TEST(StudioCalls, AReportIsThatOfTheRun) {
  Kernel kernel;
  const std::string html = call(kernel, "report", {{"text", four_bar_text()}}).value["html"].get<std::string>();
  EXPECT_EQ(html.find("<!doctype html>"), 0U) << html.substr(0, 100);
  EXPECT_NE(html.find("180.7"), std::string::npos);
  EXPECT_EQ(html.find("https://"), std::string::npos);
}

TEST(StudioCalls, ACancelledRunKeepsWhatItHas) {
  Kernel kernel;
  const Called run = call(kernel, "run", {{"text", read_file(PINTLE_SOURCE_DIR "/mechanisms/andrews.toml")}, {"set", {{"simulate.duration", "1000 s"}, {"simulate.output_step", "1 s"}}}},
                          [](std::string_view) { return false; });
  EXPECT_EQ(run.value["outcome"], "interrupted");
  EXPECT_GT(run.arrays.at(0).size(), 0U);
  EXPECT_GT(run.value["stopped"]["time"].get<double>(), 0);
}

TEST(StudioCalls, ChecksAndNamesWhatHoldsAMechanism) {
  Kernel kernel;
  std::string text = four_bar_text();
  const Called moving = call(kernel, "check", {{"text", text}});
  EXPECT_EQ(moving.value["mobility"]["mobility"], 1);
  EXPECT_TRUE(moving.value["warnings"].empty());
  const Called held = call(kernel, "check", {{"text", R"(
format = 1
[ground.markers]
a = [0, 0]
b = [1, 0]
[body.bar]
mass = 1
inertia = 1
position = [0.5, 0]
angle = 0
markers.a = [-0.5, 0]
markers.b = [0.5, 0]
[joint.left]
type = "revolute"
between = ["ground.a", "bar.a"]
stiffness = 1e8
damping = 1000
[joint.right]
type = "revolute"
between = ["ground.b", "bar.b"]
stiffness = 1e8
damping = 1000
)"}});
  ASSERT_TRUE(held.fault.is_null()) << held.fault;
  ASSERT_FALSE(held.value["warnings"].empty());
  EXPECT_EQ(held.value["warnings"][0]["kind"], "immobile");
  EXPECT_FALSE(held.value["warnings"][0]["hint"].get<std::string>().empty());
}

TEST(StudioCalls, DragsAndPlays) {
  Kernel kernel;
  const Called opened = call(kernel, "open_drag", {{"text", four_bar_text()}});
  const OrderedJson hold = {{"body", "crank"}, {"point", {0.5, 0}}, {"target", {0, 1}}};
  const Called dragged = call(kernel, "drag", {{"id", opened.value["id"]}, {"hold", hold}});
  ASSERT_TRUE(dragged.value["ok"].get<bool>());
  EXPECT_NEAR(dragged.array(dragged.value["poses"]).at(1), 0.5, 1e-3);
  const Called live = call(kernel, "open_live", {{"text", four_bar_text()}});
  const Called frame = call(kernel, "advance", {{"id", live.value["id"]}, {"dt", 0.02}, {"pull", hold}});
  EXPECT_TRUE(frame.value["error"].is_null());
  EXPECT_NEAR(frame.value["t"].get<double>(), 0.02, 1e-12);
  EXPECT_EQ(frame.array(frame.value["joint_forces"]).size(), 12U);
  const Called free = call(kernel, "advance", {{"id", live.value["id"]}, {"dt", 0.02}, {"pull", nullptr}});
  const Called alike = call(kernel, "open_live", {{"text", four_bar_text()}, {"like", live.value["id"]}});
  EXPECT_NEAR(alike.array(alike.value["poses"]).at(2), free.array(free.value["poses"]).at(2), 1e-4);
  call(kernel, "close_live", {{"id", live.value["id"]}});
  EXPECT_FALSE(call(kernel, "advance", {{"id", live.value["id"]}, {"dt", 0.02}}).fault.is_null());
}

TEST(StudioCalls, EveryMistakeIsAFault) {
  Kernel kernel;
  for (const auto& [name, arguments] : {std::pair<const char*, const char*>{"nothing", "{}"}, {"read", "{}"}, {"read", "["}, {"read", ""}, {"read", "[]"},
                                        {"run", R"({"text": 7})"}, {"run", R"({"text": ""})"}, {"drag", R"({"id": 9})"}, {"drag", R"({"id": 1e400})"},
                                        {"advance", R"({"id": "x"})"}, {"open_live", R"({"text": "format = 1"})"}, {"edit", R"({"text": "a = 1", "path": 3})"},
                                        {"write", R"({"model": [1]})"}, {"check", R"({"text": "format = 1\n[body.a]\nmass = 1\n"})"}}) {
    const OrderedJson json = OrderedJson::parse(kernel.call(name, arguments).text);
    ASSERT_TRUE(json.contains("fault")) << name << " " << arguments;
    EXPECT_FALSE(json["fault"]["message"].get<std::string>().empty());
  }
}

TEST(StudioCalls, AnAnswerIsPackedInOnePiece) {
  const std::string bytes = packed({R"({"value": {"f64": 1}})", {{1.5}, {2.5, -3}}});
  std::uint32_t head[4];
  std::memcpy(head, bytes.data(), sizeof head);
  EXPECT_EQ(head[0], 21U);
  EXPECT_EQ(head[1], 2U);
  EXPECT_EQ(head[2], 1U);
  EXPECT_EQ(head[3], 2U);
  double numbers[3];
  std::memcpy(numbers, bytes.data() + 16, sizeof numbers);
  EXPECT_EQ(numbers[2], -3);
  EXPECT_EQ(bytes.substr(16 + 24), R"({"value": {"f64": 1}})");
}

}  // namespace
}  // namespace pintle::studio
