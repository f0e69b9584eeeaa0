// The program as seen from a shell, except for running models: options, exit codes, files.
#include <gtest/gtest.h>

#include "cli/sandbox_for_tests.h"

namespace pintle::sample {
namespace {

TEST(CommandLine, HelpHasAnExampleForEveryVerb) {
  Sandbox sandbox;
  for (const char* verb : {"", "run", "check", "plot", "convert", "fmt", "schema", "version"}) {
    const Answer answer = sandbox.pintle(std::string(verb) + " --help");
    EXPECT_EQ(answer.exit_code, 0) << verb;
    EXPECT_TRUE(holds(answer.out, "Example")) << verb << "\n" << answer.out;
    EXPECT_EQ(answer.error, "") << verb;
  }
  EXPECT_TRUE(holds(sandbox.pintle("run --help").out, "130  stopped by Ctrl-C"));
}

TEST(CommandLine, VersionIsThatOfTheBuild) {
  Sandbox sandbox;
  EXPECT_TRUE(holds(sandbox.pintle("version").out, "pintle " PINTLE_VERSION "\n"));
  EXPECT_TRUE(holds(sandbox.pintle("--version").out, PINTLE_VERSION));
}

TEST(CommandLine, MistakesGiveCode2AndAWayOut) {
  Sandbox sandbox;
  const std::pair<const char*, const char*> mistakes[] = {
      {"", "pintle --help"},
      {"rum model.toml", "Did you mean run?"},
      {"run", "MODEL"},
      {"run model.toml --durtion 2", "Did you mean --duration?"},
      {"run model.toml --method euler", "euler"},
      {"run model.toml --progress loud", "loud"},
      {"run model.toml other.toml", "other.toml"},
      {"run model.toml --set", "--set"},
      {"convert model.toml --to xml", "xml"},
      {"fmt --check --stdout model.toml", "--check"},
      {"plot", "RUN"},
  };
  for (const auto& [words, expected] : mistakes) {
    const Answer answer = sandbox.pintle(words);
    EXPECT_EQ(answer.exit_code, 2) << words;
    EXPECT_TRUE(holds(answer.error, expected)) << words << "\n" << answer.error;
    EXPECT_TRUE(holds(answer.error, "--help")) << words << "\n" << answer.error;
    EXPECT_EQ(answer.out, "") << words;
  }
}

TEST(CommandLine, MissingFilesGiveCode6) {
  Sandbox sandbox;
  for (const char* words : {"run absent.toml", "check absent.toml", "convert absent.toml", "fmt absent.toml",
                            "plot absent-run", "run .", "check /", "schema --out no/where.json"}) {
    const Answer answer = sandbox.pintle(words);
    EXPECT_EQ(answer.exit_code, 6) << words << "\n" << answer.error;
    EXPECT_NE(answer.error, "") << words;
  }
  EXPECT_TRUE(holds(sandbox.pintle("run absent.toml").error, "absent.toml: cannot read it: No such file"));
}

TEST(CommandLine, FullOutputGivesCode6) {
  Sandbox sandbox;
  for (const char* words : {"version > /dev/full", "schema > /dev/full", "schema --out /dev/full"}) {
    const Answer answer = sandbox.pintle(words);
    EXPECT_EQ(answer.exit_code, 6) << words;
    EXPECT_TRUE(holds(answer.error, "No space left")) << words << "\n" << answer.error;
  }
}

TEST(CommandLine, BrokenModelGivesCode3AndItsPlace) {
  Sandbox sandbox;
  sandbox.write("broken.toml", "format = 1\nname = \"no end\n");
  for (const char* verb : {"run", "check", "convert", "fmt"}) {
    const Answer answer = sandbox.pintle(std::string(verb) + " broken.toml");
    EXPECT_EQ(answer.exit_code, 3) << verb;
    EXPECT_TRUE(holds(answer.error, "broken.toml:2:")) << verb << "\n" << answer.error;
  }
  EXPECT_FALSE(sandbox.has("broken-run"));
}

TEST(CommandLine, ConvertsThereAndBack) {
  Sandbox sandbox;
  sandbox.write("a.toml", "format = 1\nname = \"A\"\n[parameters]\nx = \"25 mm\"\n");
  EXPECT_EQ(sandbox.pintle("convert a.toml --out a.json").exit_code, 0);
  EXPECT_TRUE(holds(sandbox.read("a.json"), "\"25 mm\""));
  EXPECT_EQ(sandbox.pintle("convert a.json > b.toml && \"$PINTLE\" convert b.toml > b.json").exit_code, 0);
  EXPECT_EQ(sandbox.read("a.json"), sandbox.read("b.json"));
}

TEST(CommandLine, NoVerbReplacesAModelByAnotherFile) {
  Sandbox sandbox;
  const std::string model = "format = 1 # precious\nname = \"A\"\n";
  for (const char* words : {"convert other.toml --to toml --out a.toml", "convert a.toml --to toml --out a.toml", "schema --out a.toml", "schema --reference --out a.toml"}) {
    sandbox.write("other.toml", "format = 1\nname = \"B\"\n");
    sandbox.write("a.toml", model);
    const auto refused = sandbox.pintle(words);
    EXPECT_EQ(refused.exit_code, 6) << words;
    EXPECT_TRUE(holds(refused.error, "a.toml: this file exists")) << refused.error;
    EXPECT_EQ(sandbox.read("a.toml"), model) << words;
    EXPECT_EQ(sandbox.pintle(std::string(words) + " --force").exit_code, 0) << words;
    EXPECT_NE(sandbox.read("a.toml"), model) << words;
  }
  for (int time = 0; time < 2; ++time) EXPECT_EQ(sandbox.pintle("schema --out pintle.schema.json").exit_code, 0) << time;
}

TEST(CommandLine, FormatsInPlaceAndChecks) {
  Sandbox sandbox;
  sandbox.write("a.toml", "format=1 # first\n\n\n\n   name =   \"A\"\n");
  EXPECT_EQ(sandbox.pintle("fmt --check a.toml").exit_code, 3);
  EXPECT_TRUE(holds(sandbox.read("a.toml"), "format=1"));
  EXPECT_EQ(sandbox.pintle("fmt a.toml").exit_code, 0);
  EXPECT_TRUE(holds(sandbox.read("a.toml"), "# first"));
  EXPECT_EQ(sandbox.pintle("fmt --check a.toml").exit_code, 0);
  EXPECT_EQ(sandbox.pintle("fmt --stdout a.toml").out, sandbox.read("a.toml"));
}

}  // namespace
}  // namespace pintle::sample
