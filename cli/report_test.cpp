// pintle report, on runs made for these tests.
#include "pintle/report.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "cli/run_sources.h"
#include "cli/sandbox_for_tests.h"
#include "pintle/complaint.h"

namespace pintle::sample {
namespace {

class ReportVerb : public testing::Test {
 protected:
  ReportVerb() {
    sandbox_.write("bob.toml", pendulum_toml("0.2 s", "0.02 s"));
    const Answer answer = sandbox_.pintle("run bob.toml --set body.bob.mass=2 --quiet");
    EXPECT_EQ(answer.exit_code, 0) << answer.error;
  }
  Sandbox sandbox_;
};

TEST_F(ReportVerb, WritesBesideTheRunFolder) {
  const Answer answer = sandbox_.pintle("report bob-run/");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.out, "bob-run.html\n");
  const std::string html = sandbox_.read("bob-run.html");
  EXPECT_TRUE(holds(html, "<title>Pendulum: Pintle report</title>"));
  EXPECT_TRUE(holds(html, "body.bob.mass=2"));                // changed on the command line ...
  EXPECT_TRUE(holds(html, "# its bearing"));                  // ... from this file
  EXPECT_EQ(sandbox_.pintle("report bob-run").exit_code, 0);  // its own page may be replaced
}

TEST_F(ReportVerb, WritesToStandardOutput) {
  const Answer answer = sandbox_.pintle("report bob-run --out -");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_TRUE(holds(answer.out, "</html>"));
}

TEST_F(ReportVerb, LeavesOtherFilesAlone) {
  sandbox_.write("mine.html", "<p>mine</p>");
  const Answer answer = sandbox_.pintle("report bob-run --out mine.html");
  EXPECT_EQ(answer.exit_code, 6);
  EXPECT_TRUE(holds(answer.error, "--force")) << answer.error;
  EXPECT_EQ(sandbox_.read("mine.html"), "<p>mine</p>");
  EXPECT_EQ(sandbox_.pintle("report bob-run --out mine.html --force").exit_code, 0);
  EXPECT_TRUE(holds(sandbox_.read("mine.html"), "Pintle report"));
}

TEST_F(ReportVerb, TheModelTravelsWithTheRun) {
  sandbox_.shell("mkdir elsewhere && mv bob-run elsewhere/ && rm bob.toml");
  EXPECT_EQ(sandbox_.pintle("report elsewhere/bob-run").exit_code, 0);
}

TEST_F(ReportVerb, DamagedRunsAreRefusedWithTheirPlace) {
  const std::string series = sandbox_.read("bob-run/series.csv"), model = sandbox_.read("bob-run/model-as-run.toml"),
                    summary = sandbox_.read("bob-run/summary.json");
  const auto answer_with = [&](const char* file, const std::string& text) {
    sandbox_.write(std::string("bob-run/") + file, text);
    const Answer answer = sandbox_.pintle("report bob-run");
    EXPECT_EQ(answer.exit_code, 6) << file;
    sandbox_.write("bob-run/series.csv", series);
    sandbox_.write("bob-run/model-as-run.toml", model);
    sandbox_.write("bob-run/summary.json", summary);
    return answer.error;
  };
  EXPECT_TRUE(holds(answer_with("series.csv", series.substr(0, series.size() / 2)), "series.csv:"));
  EXPECT_TRUE(holds(answer_with("series.csv", ""), "series.csv:1:1"));
  EXPECT_TRUE(holds(answer_with("model-as-run.toml", model + "# changed"), "not the model that was run"));
  EXPECT_TRUE(holds(answer_with("summary.json", summary.substr(0, 100)), "summary.json"));
  EXPECT_TRUE(holds(answer_with("summary.json", "{}"), "summary.json"));
  for (std::size_t cut = 7; cut + 2 < summary.size(); cut += summary.size() / 9)  // losing the last line feed does no harm
    EXPECT_TRUE(holds(answer_with("summary.json", summary.substr(0, cut)), "summary.json")) << cut;
  EXPECT_FALSE(sandbox_.has("bob-run.html"));
}

// Random bytes changed anywhere in the folder give a page, or an error that names the fault. Nothing else, and no crash.
TEST_F(ReportVerb, AnyDamageIsAnErrorOrAPage) {
  const std::array<const char*, 3> files{"summary.json", "series.csv", "model-as-run.toml"};
  const std::string folder = (sandbox_ / "bob-run").string();
  std::mt19937 random(20080803);
  std::size_t n_errors = 0;
  for (int i = 0; i < 150; ++i) {
    const std::string file = std::string("bob-run/") + files[random() % files.size()], whole = sandbox_.read(file);
    std::string damaged = whole;
    for (unsigned k = 0; k <= random() % 3; ++k) {
      const std::size_t at = random() % damaged.size();
      if (random() % 3 == 0) damaged.erase(at, 1 + random() % 20);
      else damaged[at] = "0129-.eE\"{}[],:nullx\n"[random() % 20];
    }
    sandbox_.write(file, damaged);
    try {
      const cli::DrawnRun drawn = cli::read_drawn_run(folder);
      EXPECT_TRUE(holds(report_html(drawn.model, drawn.run), "</html>"));
    } catch (const FileError&) {
      ++n_errors;
    } catch (const InputError&) {
      ++n_errors;
    }
    sandbox_.write(file, whole);
  }
  EXPECT_GT(n_errors, 75u);
}

// The page's script, run by a browser if one is available: it goes to the largest peak and shows the number of the table.
using ReportInBrowserSlow = ReportVerb;

TEST_F(ReportInBrowserSlow, ShowsThePeak) {
  ASSERT_EQ(sandbox_.pintle("report bob-run").exit_code, 0);
  if (sandbox_.shell("command -v chromium").exit_code != 0) GTEST_SKIP() << "there is no chromium";
  const Answer page = sandbox_.shell(
      "timeout 100 chromium --headless --no-sandbox --disable-gpu --user-data-dir=profile --virtual-time-budget=3000 --dump-dom \"file://$PWD/bob-run.html\"");
  ASSERT_EQ(page.exit_code, 0) << page.error;
  const RunRecord run = read_run(sandbox_ / "bob-run");
  const LoadSummary& pin = run.trajectory.joints.at(0);
  EXPECT_TRUE(holds(page.out, "<html lang=\"en\" class=\"js\">"));
  EXPECT_TRUE(holds(page.out, fmt::format("<b>{:.2f} N</b>", pin.peak))) << pin.peak;
  EXPECT_TRUE(holds(page.out, fmt::format("aria-valuetext=\"{:.3f} s\"", pin.peak_time))) << pin.peak_time;
}

TEST_F(ReportVerb, RunThatWasStoppedIsReported) {
  sandbox_.write("endless.toml", pendulum_toml("1e6 s", "10 s"));
  const Answer run = sandbox_.shell(signalled("INT", 2, "\"$PINTLE\" run endless.toml --quiet --out stopped"));
  ASSERT_TRUE(sandbox_.has("stopped/summary.json")) << run.error;
  const Answer answer = sandbox_.pintle("report stopped");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_TRUE(holds(sandbox_.read("stopped.html"), "Stopped by the user at t = "));
}

}  // namespace
}  // namespace pintle::sample
