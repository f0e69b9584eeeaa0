// pintle compare: the effect of joint compliance, compared with ideal joints or relative coordinates; models and laws side by side.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/model_options.h"
#include "cli/progress.h"
#include "cli/verbs.h"
#include "pintle/compare.h"
#include "results/disk.h"
#include "results/studies/compare_report.h"

namespace pintle::cli {
namespace {

constexpr const char* kCompareFooter =
    "Examples:\n"
    "  pintle compare four_bar.toml\n"
    "  pintle compare four_bar.toml --set defaults.joint.stiffness=1e6 --plot softer.svg\n"
    "  pintle compare four_bar.toml --against relative --set joint.A.ideal=true --set joint.B.ideal=true\n"
    "  pintle compare four_bar.toml lighter.toml --json\n"
    "  pintle compare four_bar.toml --law 'joint.B=maxwell,stiffness=2e6,branch_ratio=[1],branch_time=[0.01]' --against ideal\n"
    "\n"
    "One model is compared with ideal joints, point by point. Several models, or a model with --law, are run side by side: peak, mean\n"
    "and RMS of each joint's force, with the change from the first; --against then adds the first model with other equations.\n"
    "Digits are the significant figures in which both agree. A difference within the error estimates of both runs is\n"
    "called numerical, a larger one physical: the joints' own compliance.\n\n";

struct CompareOptions : ModelOptions {
  std::vector<std::string> models;
  std::string against = "ideal", plot;
  bool against_chosen = false, json = false, quiet = false;

  bool several() const { return models.size() > 1 || !laws.empty(); }
};

/// One of the models to be run side by side.
struct Variant {
  std::string name, path;
  Model model;
};

Equations equations_of(const CompareOptions& options) { return to_equations(equations_words().at(options.against)); }

/// The stem of a model's file name if that distinguishes the models, else its path.
std::string name_of(const std::string& path, const std::vector<std::string>& paths) {
  const auto stem = [](const std::string& file) { return std::filesystem::path(file).stem().string(); };
  const auto alike = std::count_if(paths.begin(), paths.end(), [&](const std::string& other) { return stem(other) == stem(path); });
  return alike > 1 ? path : stem(path);
}

/// "B=maxwell" if that distinguishes the laws, else with its keys.
std::string name_of_law(const std::string& law, const std::vector<std::string>& laws) {
  constexpr std::string_view kJoint = "joint.";
  const auto head = [](const std::string& text) { return text.substr(0, text.find(',')); };
  const auto alike = std::count_if(laws.begin(), laws.end(), [&](const std::string& other) { return head(other) == head(law); });
  const std::string name = alike > 1 ? law : head(law);
  return name.starts_with(kJoint) ? name.substr(kJoint.size()) : name;
}

Variant read_variant(const CompareOptions& options, const std::string& path, const std::string& law) {
  ModelOptions one = options;
  one.model = path;
  one.laws.clear();
  if (!law.empty()) one.laws.push_back(law);
  Variant out{name_of(path, options.models), path, read_model_to_run(one).model};
  if (!law.empty()) out.name += ", " + name_of_law(law, options.laws);
  return out;
}

/// Relative coordinates without an ideal joint would be compared with themselves.
void demand_difference(const Model& model, const std::string& path, Equations against) {
  if (against != Equations::kRelative || std::any_of(model.joints.begin(), model.joints.end(), [](const Joint& joint) { return joint.ideal; })) return;
  const std::string name = model.joints.empty() ? "NAME" : model.joints.front().name;
  throw CLI::ValidationError("--against relative", fmt::format("no joint of {} is marked ideal, so that all would stay force laws and nothing would be compared. Mark some: --set joint.{}.ideal=true", path, name));
}

/// Each model unchanged and with each law; with --against also the first one with other equations.
std::vector<Variant> read_variants(const CompareOptions& options) {
  std::vector<Variant> variants;
  for (const std::string& path : options.models) {
    variants.push_back(read_variant(options, path, ""));
    for (const std::string& law : options.laws) variants.push_back(read_variant(options, path, law));
  }
  if (options.against_chosen) {
    demand_difference(variants.front().model, variants.front().path, equations_of(options));
    variants.push_back(variants.front());
    variants.back().name += ", " + to_text(equations_of(options));
    variants.back().model.simulate.equations = equations_of(options);
    variants.back().model.simulate.method = "auto";
  }
  for (Variant& variant : variants) variant.model.simulate.record = {"all"};
  return variants;
}

std::string plot_file(const CompareOptions& options) {
  return options.plot.empty() ? std::filesystem::path(options.models.front()).stem().string() + "-compare.svg" : options.plot;
}

/// Output common to both kinds of comparison.
template <class Text, class JsonText>
void show(const CompareOptions& options, const Plot& picture, const Text& text, const JsonText& json) {
  const std::string plot = plot_file(options);
  if (plot != "none") write_file(plot, to_svg(picture));
  if (options.json) print_out(json());
  else if (!options.quiet) print_out(text() + (plot == "none" ? "" : "\nPlot: " + plot + "\n"));
}

ExitCode compare_variants(const CompareOptions& options) {
  const std::vector<Variant> variants = read_variants(options);
  catch_interrupts();
  ProgressReport report(progress_style(options.quiet));
  std::vector<NamedRun> runs;
  std::vector<std::string> paths;
  std::vector<Outcome> outcomes;
  for (const Variant& variant : variants) {
    runs.push_back({variant.name, with_file_name(variant.path, [&] { return simulate(variant.model, report.observer()); })});
    paths.push_back(variant.path);
    outcomes.push_back(runs.back().run.outcome);
    if (interrupted()) break;
  }
  report.clear();
  const Variants compared = compare(std::move(runs));
  const std::string& name = variants.front().model.name;
  show(options, variants_plot(compared, name.empty() ? variants.front().path : name), [&] { return variants_text(compared, wants_colour(STDOUT_FILENO)); }, [&] { return variants_json(compared, paths); });
  return exit_code_of(outcomes);
}

ExitCode compare_equations(CompareOptions options) {
  options.model = options.models.front();
  const Model model = read_model_to_run(options).model;
  demand_difference(model, options.model, equations_of(options));
  catch_interrupts();
  ProgressReport report(progress_style(options.quiet));
  const Comparison comparison = with_file_name(options.model, [&] { return compare(model, equations_of(options), report.observer()); });
  report.clear();
  const std::string title = model.name.empty() ? options.model : model.name;
  show(options, compare_plot(comparison, title), [&] { return compare_text(comparison, title, wants_colour(STDOUT_FILENO)); }, [&] { return compare_json(comparison, model.name, options.model); });
  return exit_code_of(std::vector<Outcome>{comparison.first.outcome, comparison.second.outcome});
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("compare", "Compare compliant joints with ideal ones, or models and joint laws side by side");
  const auto options = std::make_shared<CompareOptions>();
  verb->add_option("MODEL", options->models, "model file (.toml or .json); several: side by side")->required();
  add_changes(*verb, *options, true, "run each model also with this law of a joint, e.g. joint.A=linear,stiffness=1e7 (repeatable)");
  CLI::Option* against = verb->add_option("--against", options->against, "ideal: every joint ideal; relative: relative coordinates for the joints marked ideal; penalty, augmented_lagrangian, relative_augmented_lagrangian: every joint ideal, by these methods")
      ->check(CLI::IsMember(equations_names(false)))
      ->type_name("NAME")
      ->capture_default_str();
  verb->add_option("--plot", options->plot, "picture to write (default: <name of the model file>-compare.svg; none: no picture)")->type_name("FILE.svg")->check(svg_or_none_problem, "", "");
  verb->add_flag("--json", options->json, "print the comparison as JSON");
  verb->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  verb->footer(std::string(kCompareFooter) + kExitCodeHelp);
  verb->callback([options, against, &exit_code] {
    options->against_chosen = against->count() > 0;
    exit_code = options->several() ? compare_variants(*options) : compare_equations(*options);
  });
}

}  // namespace pintle::cli
