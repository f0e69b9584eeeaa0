#include "cli/model_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "io/document.h"
#include "io/model_files.h"
#include "io/schema/schema.h"
#include "pintle/read_model.h"
#include "results/disk.h"
#include "results/sha256.h"

namespace pintle::cli {
namespace {

/// A model may leave its duration to the command line; a run must have one.
void check_duration(const Model& model, const std::string& text, const std::string& file) {
  if (model.simulate.duration > 0) return;
  const Document document = parse_document(text, file);
  const Entry* simulate = document.root.table()->find_entry("simulate");
  throw InputError({document.complaint(simulate == nullptr ? Spot{0, 1, 1} : simulate->key_spot, "simulate.duration",
                                       "no duration", "a run needs a duration",
                                       "duration = \"1 s\" under [simulate], or --duration '1 s'")});
}

}  // namespace

void add_model_options(CLI::App& verb, ModelOptions& options, bool tolerance) {
  verb.add_option("MODEL", options.model, "model file (.toml or .json)")->required();
  add_changes(verb, options, tolerance);
}

void add_set_and_law(CLI::App& verb, std::vector<std::string>& overrides, std::vector<std::string>& laws, const char* law_meaning) {
  verb.add_option("--set", overrides, "change one value of the model, e.g. joint.A.stiffness=2e8 (repeatable)")->type_name("PATH=VALUE")->allow_extra_args(false);
  verb.add_option("--law", laws, law_meaning)->type_name("joint.NAME=LAW,...")->allow_extra_args(false);
}

void add_changes(CLI::App& verb, ModelOptions& options, bool tolerance, const char* law_meaning) {
  add_set_and_law(verb, options.overrides, options.laws, law_meaning);
  verb.add_option("--duration", options.duration, "model time to run, e.g. 2 or '500 ms'")->type_name("TIME");
  if (!tolerance) return;
  verb.add_option("--tolerance", options.tolerance, "allowed error of each joint force, relative to its peak")
      ->type_name("NUMBER");
}

namespace {

// The words of a key of [simulate] and their synonyms, each with the word it stands for.
std::map<std::string, std::string> words_of(const char* key) {
  const KeySpec spec = *Schema::model().assemble("simulate").find(key);
  std::map<std::string, std::string> all(spec.synonyms.begin(), spec.synonyms.end());
  for (const std::string& word : spec.words) all.emplace(word, word);
  return all;
}

}  // namespace

const std::map<std::string, std::string>& equations_words() {
  static const std::map<std::string, std::string> words = words_of("equations");
  return words;
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const auto& [name, word] : words_of("method")) names.push_back(name);
  return names;
}

std::vector<std::string> equations_names(bool newtonian) {
  std::vector<std::string> names;
  for (const auto& [name, word] : equations_words())
    if (newtonian || word != to_word(Equations::kNewtonian)) names.push_back(name);
  return names;
}

std::string svg_problem(const std::string& file) {
  return file.ends_with(".svg") ? "" : fmt::format("found \"{}\": it must end in .svg", file);
}

std::string svg_or_none_problem(const std::string& file) { return file == "none" ? "" : svg_problem(file); }

std::vector<std::string> laws_and_overrides(const std::vector<std::string>& laws, const std::vector<std::string>& overrides) {
  std::vector<std::string> all;
  for (const std::string& law : laws) all.push_back("--law " + law);
  all.insert(all.end(), overrides.begin(), overrides.end());
  return all;
}

std::vector<std::string> all_overrides(const ModelOptions& options) {
  std::vector<std::string> overrides = laws_and_overrides(options.laws, options.overrides);
  const auto add = [&overrides](const char* key, const std::string& value) {
    if (!value.empty()) overrides.push_back(fmt::format("simulate.{}={}", key, value));
  };
  add("duration", options.duration);
  add("tolerance", options.tolerance);
  add("tolerance_of", options.tolerance_of);
  add("method", options.method);
  add("equations", options.equations);
  add("max_step", options.max_step);
  return overrides;
}

ReadModel read_model_to_run(const ModelOptions& options) {
  ReadModel read;
  read.text = read_file(options.model, kMaxFileBytes + 1);
  ModelFiles files(options.model);
  read.model = parse_model(read.text, options.model, all_overrides(options), files.reader());
  for (const auto& [name, text] : files.texts()) read.files.push_back({name, "sha256:" + sha256(text), text});
  check_duration(read.model, read.text, options.model);
  return read;
}

}  // namespace pintle::cli
