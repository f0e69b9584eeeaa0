// pintle film: a run as a film, or one instant of it as a picture.
#include "cli/pictures/film.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "cli/companions.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/pictures/encoder.h"
#include "cli/pictures/raster.h"
#include "cli/progress.h"
#include "cli/run_sources.h"
#include "report/still.h"
#include "results/disk.h"
#include "results/force_quality.h"
#include "results/plots/plot_ticks.h"
#include "results/plots/run_columns.h"

namespace pintle::cli {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  pintle film four_bar-run\n"
    "  pintle film four_bar-run --out four_bar.webm --fps 50 --speed 0.1 --trace coupler.B\n"
    "  pintle film four_bar-run --still peak --out four_bar.svg\n"
    "\n"
    "Films are encoded by ffmpeg. Without --speed, the film runs in real time if that takes 3 to 20 seconds, otherwise\n"
    "it lasts about 8 seconds.\n";

struct Options {
  std::string run, out, still;
  double width = 760, dots_per_inch = 96, frames_per_second = 25, speed = 0;
  bool forces = true, names = false, masses = false, dark = false, quiet = false;
  std::vector<std::string> traces;
};

class Usage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

double peak_time(const Trajectory& trajectory) {
  const LoadSummary* joint = largest_joint(trajectory);
  return joint ? joint->peak_time : trajectory.at(0, 0);
}

/// Model seconds per second of film.
double usual_speed(double span) {
  return span >= 3 && span <= 20 ? 1 : round_step(span / 8);
}

constexpr int kColourSamples = 12;    // number of frames that the palette of a GIF is made from
constexpr double kMostGifRate = 50;   // a GIF's frames last whole hundredths of a second, and browsers take 1 for 10

class FilmMaker {
 public:
  explicit FilmMaker(const Options& options) : options_(options), drawn_(read_drawn_run(options.run)), trajectory_(drawn_.run.trajectory) {
    if (trajectory_.n_rows() == 0) throw FileError(options.run + ": the run has no rows to film.");
    scene_ = make_scene(drawn_.model, trajectory_);
    if (scene_.n_unseen == scene_.bodies.size())
      throw FileError(options.run + ": the run did not record any body.\n    Run it again with record = [\"all\"] in [simulate].");
    look_.width = options.width;
    look_.most_height = 1.1 * options.width;
    look_.forces = options.forces;
    look_.names = options.names;
    look_.masses = options.masses;
    look_.dark = options.dark;
    try {
      for (const std::string& point : options.traces) traces_.push_back(make_trace(scene_, trajectory_, point));
    } catch (const std::invalid_argument& error) {
      throw Usage(error.what());
    }
  }

  void draw_still(const std::filesystem::path& file) const {
    double t = peak_time(trajectory_);
    if (options_.still != "peak" && !CLI::detail::lexical_cast(options_.still, t))
      throw Usage(fmt::format("found --still \"{}\": a time in seconds, or peak, is expected here.", options_.still));
    const double begin = trajectory_.at(0, 0), end = trajectory_.at(trajectory_.n_rows() - 1, 0);
    if (const double slack = 1e-9 * (end - begin); !(t >= begin - slack && t <= end + slack))
      throw Usage(fmt::format("found --still \"{}\": the run goes from {:.6g} s to {:.6g} s.", options_.still, begin, end));
    const std::string svg = frame(t, true);
    const LoadSummary* largest = largest_joint(trajectory_);
    if (const std::string more = largest && options_.still == "peak" ? peak_between_rows(trajectory_, *largest) : ""; !more.empty() && !options_.quiet)
      fmt::print(stderr, "{}, and the picture is drawn from them: run it again with a smaller output_step to see all of it\n", more);
    write_file(file, file.extension() == ".png" ? png_of(svg, options_.dots_per_inch) : svg);
  }

  ExitCode film(const std::filesystem::path& file, FilmForm form) const {
    const double first = trajectory_.at(0, 0), span = trajectory_.at(trajectory_.n_rows() - 1, 0) - first;
    const double speed = options_.speed > 0 ? options_.speed : span > 0 ? usual_speed(span) : 1;
    const double per_frame = speed / options_.frames_per_second;
    if (!(span / per_frame < 1e6)) throw Usage("this would be more than a million frames.\n    A larger --speed or a smaller --fps gives fewer.");
    const int n = std::max(1, static_cast<int>(std::lround(span / per_frame)));
    const double scale = options_.dots_per_inch / 96;
    const Pixels start = even(pixels_of(frame(first), scale));
    catch_interrupts();
    const int n_samples = form == FilmForm::kGif ? kColourSamples : 0;
    FilmEncoder encoder(file, form, start.width, start.height, options_.frames_per_second, n_samples);
    for (int i = 0; i < n_samples; ++i) {
      const double t = i == 0 ? peak_time(trajectory_) : first + span * i / (n_samples - 1);
      encoder.add(even(pixels_of(frame(t), scale)));
    }
    const Stopwatch watch;
    StatusLine line;
    for (int i = 0; i < n; ++i) {
      if (interrupted()) return kStoppedBySignal;
      encoder.add(i == 0 ? start : even(pixels_of(frame(first + i * per_frame), scale)));
      if (watched_ && (i % 5 == 4 || i + 1 == n)) line.show(how_far(i + 1, n, watch.seconds()));
    }
    if (watched_) line.show("encoding");
    return encoder.finish() ? kOk : kStoppedBySignal;
  }

 private:
  std::string frame(double t, bool whole_arrows = false) const {
    StillOptions look = look_;
    look.whole_arrows = whole_arrows;
    return still_svg(scene_, instant_at(scene_, trajectory_, t), look, traces_);
  }

  /// Removes an odd last row or column, which half-size colour planes cannot have.
  static Pixels even(Pixels pixels) {
    if (pixels.width % 2 == 0 && pixels.height % 2 == 0) return pixels;
    Pixels cut{pixels.width & ~1, pixels.height & ~1, {}};
    for (int y = 0; y < cut.height; ++y) {
      const auto row = pixels.bytes.begin() + 4L * y * pixels.width;
      cut.bytes.insert(cut.bytes.end(), row, row + 4L * cut.width);
    }
    return cut;
  }

  static std::string how_far(int done, int n, double seconds) {
    return fmt::format("frame {} of {}  {:3d} %   {} to go", done, n, 100 * done / n, clock_text(seconds / done * (n - done)));
  }

  const Options& options_;
  DrawnRun drawn_;
  const Trajectory& trajectory_;
  Scene scene_;
  StillOptions look_;
  std::vector<Trace> traces_;
  bool watched_ = !options_.quiet && is_terminal(STDERR_FILENO);
};

ExitCode make(const Options& options) {
  const bool still = !options.still.empty();
  const std::filesystem::path file = picture_file(options.out, options.run, still ? ".svg" : ".gif");
  const std::string ending = file.extension().string();
  const std::string wanted = still ? ".svg or .png" : ".gif or .webm";
  if (still ? ending != ".svg" && ending != ".png" : ending != ".gif" && ending != ".webm")
    throw Usage(fmt::format("found --out \"{}\": it must end in {}{}.", options.out, wanted, still ? "" : "; a picture of one instant needs --still"));
  if (ending == ".gif" && options.frames_per_second > kMostGifRate)
    throw Usage(fmt::format("found --fps {:g}: a GIF shows at most {:g} frames a second at its right speed.\n    --out film.webm has no such limit.", options.frames_per_second, kMostGifRate));
  const FilmMaker maker(options);
  ExitCode code = kOk;
  if (still) maker.draw_still(file);
  else code = maker.film(file, ending == ".gif" ? FilmForm::kGif : FilmForm::kWebm);
  if (code == kOk && !options.quiet) print_out(file.string() + "\n");
  return code;
}

}  // namespace

void add_film(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("film", kFilmDescription);
  const auto options = std::make_shared<Options>();
  verb->add_option("RUN", options->run, "run folder")->required();
  verb->add_option("-o,--out", options->out, "file to write: .gif or .webm; with --still .svg or .png (default: <run>.gif, <run>.svg)")->type_name("FILE");
  verb->add_option("--still", options->still, "one picture, at this time or at the largest joint force")->type_name("SECONDS|peak");
  verb->add_option("--fps", options->frames_per_second, "frames per second")->type_name("N")->check(CLI::Range(1.0, 120.0))->capture_default_str();
  verb->add_option("--speed", options->speed, "seconds of motion per second of film")->type_name("FACTOR")->check(CLI::PositiveNumber);
  verb->add_option("--width", options->width, "width of the picture, at 96 pixels per inch")->type_name("PIXELS")->check(CLI::Range(64.0, 10000.0))->capture_default_str();
  verb->add_option("--dpi", options->dots_per_inch, "dots per inch")->type_name("DOTS")->check(CLI::Range(36.0, 1200.0))->capture_default_str();
  verb->add_flag("--forces,!--no-forces", options->forces, "arrows for the force at every joint (default)");
  verb->add_flag("--names", options->names, "names of the joints");
  verb->add_flag("--masses", options->masses, "marks at the centres of mass");
  verb->add_flag("--dark", options->dark, "dark background");
  verb->add_option("--trace", options->traces, "path of this point, as body.marker (repeatable)")->type_name("POINT")->allow_extra_args(false);
  verb->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  verb->footer(kFooter);
  verb->callback([options, &exit_code] {
    try {
      exit_code = make(*options);
    } catch (const Usage& error) {
      print_error(fmt::format("pintle film: {}\n", error.what()));
      exit_code = kCommandLineError;
    }
  });
}

}  // namespace pintle::cli
