// pintle film, on runs made for these tests. Films need ffmpeg and librsvg: without them only the message is tested.
#include <gtest/gtest.h>

#include "cli/sandbox_for_tests.h"

namespace pintle::sample {
namespace {

class FilmVerb : public testing::Test {
 protected:
  FilmVerb() {
    sandbox_.write("bob.toml", pendulum_toml("0.4 s", "0.02 s"));
    EXPECT_EQ(sandbox_.pintle("run bob.toml --quiet").exit_code, 0);
  }

  /// True if something that films need is missing; checks that the answer says what to install.
  static bool unavailable(const Answer& answer) {
    if (answer.exit_code != 6) return false;
    return holds(answer.error, "without librsvg") || holds(answer.error, "apt-get install ffmpeg");
  }

  Sandbox sandbox_;
};

struct Gif {
  int width = 0, height = 0, n_frames = 0, centiseconds = 0;
};

/// Reads through the blocks of a GIF file.
Gif gif_of(const std::string& file) {
  const auto byte = [&file](std::size_t i) { return static_cast<unsigned char>(file.at(i)); };
  const auto colours = [&byte](std::size_t flags) { return byte(flags) & 0x80 ? std::size_t{3} << ((byte(flags) & 7) + 1) : 0; };
  Gif gif{byte(6) | byte(7) << 8, byte(8) | byte(9) << 8, 0, 0};
  std::size_t at = 13 + colours(10);
  const auto skip_blocks = [&] {
    for (; byte(at) != 0; at += byte(at) + 1u) continue;
    ++at;
  };
  while (byte(at) != 0x3b) {
    if (byte(at) == 0x21) {
      if (byte(at + 1) == 0xf9) gif.centiseconds += byte(at + 4) | byte(at + 5) << 8;
      at += 2;
    } else {
      EXPECT_EQ(byte(at), 0x2c);
      ++gif.n_frames;
      at += 10 + colours(at + 9) + 1;
    }
    skip_blocks();
  }
  return gif;
}

TEST_F(FilmVerb, GifHasTheFramesAskedFor) {
  const Answer answer = sandbox_.pintle("film bob-run --fps 20 --speed 0.2 --width 200 --trace bob.O");
  if (unavailable(answer)) GTEST_SKIP() << answer.error;
  ASSERT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.out, "bob-run.gif\n");
  const Gif gif = gif_of(sandbox_.read("bob-run.gif"));
  EXPECT_EQ(gif.width, 200);
  EXPECT_EQ(gif.n_frames, 40);  // 0.4 s at a fifth of real time, 20 frames per second
  EXPECT_EQ(gif.centiseconds, 200);
}

TEST_F(FilmVerb, WebmIsWebm) {
  const Answer answer = sandbox_.pintle("film bob-run --speed 1 --width 160 --dark --no-forces --out bob.webm");
  if (unavailable(answer)) GTEST_SKIP() << answer.error;
  ASSERT_EQ(answer.exit_code, 0) << answer.error;
  const std::string film = sandbox_.read("bob.webm");
  EXPECT_EQ(film.substr(0, 4), "\x1a\x45\xdf\xa3");
  EXPECT_TRUE(holds(film.substr(0, 64), "webm"));
}

TEST_F(FilmVerb, StillNeedsNoEncoder) {
  const Answer answer = sandbox_.shell("cp -r bob-run r && PATH=/usr/nowhere \"$PINTLE\" film r --still 0.1 --names");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.out, "r.svg\n");
  EXPECT_TRUE(holds(sandbox_.read("r.svg"), "<title>The mechanism at t = 0.1 s</title>"));
  EXPECT_TRUE(holds(sandbox_.read("r.svg"), ">pin</text>"));
}

TEST_F(FilmVerb, WithoutFfmpegItSaysWhatToInstall) {
  sandbox_.write("bob-run.gif", "old");
  const Answer answer = sandbox_.shell("PATH=/usr/nowhere \"$PINTLE\" film bob-run");
  EXPECT_EQ(answer.exit_code, 6);
  EXPECT_TRUE(holds(answer.error, "apt-get install ffmpeg") || holds(answer.error, "without librsvg")) << answer.error;
  EXPECT_EQ(sandbox_.read("bob-run.gif"), "old");
}

// An encoder that fails half-way produces no film, and leaves the existing one.
TEST_F(FilmVerb, FailedEncoderLeavesNoHalfFilm) {
  sandbox_.write("bob-run.gif", "old");
  const Answer answer = sandbox_.shell(
      "mkdir bin && printf '#!/bin/sh\\necho disk on fire >&2\\nexit 1\\n' > bin/ffmpeg && chmod +x bin/ffmpeg && PATH=\"$PWD/bin:$PATH\" \"$PINTLE\" film bob-run");
  EXPECT_EQ(answer.exit_code, 6);
  if (!holds(answer.error, "without librsvg")) {
    EXPECT_TRUE(holds(answer.error, "disk on fire")) << answer.error;
  }
  EXPECT_EQ(sandbox_.read("bob-run.gif"), "old");
  EXPECT_EQ(sandbox_.shell("ls -A | grep -c '^[.]bob-run'").out, "0\n");
}

TEST_F(FilmVerb, WrongWordsGiveCode2) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"--out film.mp4", ".gif or .webm"},
      {"--trace bob.P", "found point \"bob.P\""},
      {"--still soon", "found --still \"soon\""},
      {"--still 0.1 --out still.gif", ".svg or .png"},
      {"--fps 0", "--fps"},
      {"--fps 60", "at most 50"},
      {"--still 0.5", "the run goes from 0 s to 0.4 s"},
      {"--still nan", "found --still \"nan\""},
  };
  for (const auto& [words, expected] : mistakes) {
    const Answer answer = sandbox_.pintle(std::string("film bob-run ") + words);
    EXPECT_EQ(answer.exit_code, 2) << words;
    EXPECT_TRUE(holds(answer.error, expected)) << words << "\n" << answer.error;
  }
}

TEST_F(FilmVerb, DamagedRunGivesCode6AndItsPlace) {
  sandbox_.write("bob-run/series.csv", sandbox_.read("bob-run/series.csv") + "0,zero\r\n");
  const Answer answer = sandbox_.pintle("film bob-run");
  EXPECT_EQ(answer.exit_code, 6);
  EXPECT_TRUE(holds(answer.error, "series.csv:24:")) << answer.error;
}

}  // namespace
}  // namespace pintle::sample
