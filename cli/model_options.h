// Options of every verb that runs a model: the file, changes to it, duration, tolerance.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/results.h"
#include "pintle/simulate.h"

namespace CLI {
class App;
}

namespace pintle::cli {

struct ModelOptions {
  std::string model;
  std::vector<std::string> overrides, laws;
  std::string duration, tolerance, tolerance_of, method, equations, max_step;
};

/// MODEL, and changes to it.
void add_model_options(CLI::App& verb, ModelOptions& options, bool tolerance = true);

inline constexpr const char* kLawMeaning = "choose the law or friction of a joint, e.g. joint.A=linear,stiffness=1e7 (repeatable)";

/// --set and --law.
void add_set_and_law(CLI::App& verb, std::vector<std::string>& overrides, std::vector<std::string>& laws, const char* law_meaning = kLawMeaning);

/// --set, --law, --duration and, if the verb has a single tolerance, --tolerance.
void add_changes(CLI::App& verb, ModelOptions& options, bool tolerance = true, const char* law_meaning = kLawMeaning);

/// The words for equations, each with its word in the model file.
const std::map<std::string, std::string>& equations_words();
/// The words for methods.
std::vector<std::string> method_names();
/// All words for equations, or all except newtonian.
std::vector<std::string> equations_names(bool newtonian);

/// Empty for a file that an SVG can be written to; else what is wrong with it. For CLI11's check().
std::string svg_problem(const std::string& file);
/// The same, but "none" is also accepted.
std::string svg_or_none_problem(const std::string& file);

/// In the order for parse_model(): the laws first, so that --set may change their keys.
std::vector<std::string> laws_and_overrides(const std::vector<std::string>& laws, const std::vector<std::string>& overrides);

/// The same, with --duration and similar options as --set simulate.duration and so on.
std::vector<std::string> all_overrides(const ModelOptions& options);

/// The file's text and the model in it, ready to run. Throws InputError, FileError.
struct ReadModel {
  std::string text;
  Model model;
  std::vector<ModelFile> files;  ///< that the model names
};
ReadModel read_model_to_run(const ModelOptions& options);

/// Calls `run`, and prefixes the file name to the message of an assembly error.
template <class F>
auto with_file_name(const std::string& file, F&& run) {
  try {
    return run();
  } catch (const AssemblyError& error) {
    throw AssemblyError(file + ": " + error.what());
  }
}

}  // namespace pintle::cli
