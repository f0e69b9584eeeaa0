#include "sweeps/sweep_job.h"

#include <fmt/format.h>

#include <stdexcept>

#include "io/reading/overrides.h"
#include "pintle/results.h"
#include "results/sha256.h"

namespace pintle {
namespace {

std::string hash_of(const SweepRequest& r) {
  std::string text = fmt::format("{} {} {} {} {} {}", PINTLE_VERSION, r.zip, r.samples, r.seed, r.latin, r.check_every);
  const auto add = [&text](const std::string& part) { text += fmt::format("\n{} {}", part.size(), part); };
  add(r.model_text);
  for (const auto& [name, file] : r.model_files) {
    add(name);
    add(file);
  }
  for (const auto* list : {&r.overrides, &r.vary, &r.series}) {
    add(fmt::format("{}", list->size()));
    for (const std::string& part : *list) add(part);
  }
  return sha256(text);
}

FileText files_of(const SweepRequest& request) {
  return [files = request.model_files](const std::string& name) {
    const auto it = files.find(name);
    if (it == files.end()) throw FileError(name + ": this file was not given with the model.");
    return it->second;
  };
}

[[noreturn]] void refuse(const Document& document, std::string path, std::string found, std::string because, std::string suggestion) {
  throw InputError({document.complaint({0, 1, 1}, std::move(path), std::move(found), std::move(because), std::move(suggestion))});
}

// Series need the same output times in every sample. Checked at both ends of what varies.
void check_times(const Document& document, const SweepPlan& plan, const Model& base, ModelVariants variants) {
  if (!variants.settings_vary()) return;
  for (std::uint64_t sample = 0; sample < plan.size(); ++sample) {
    SimulateSettings other;
    try {
      other = variants.at(plan.values(sample)).simulate;
    } catch (const InputError&) {
      continue;  // will be a result in its own right
    }
    if (other.duration != base.simulate.duration || other.output_step != base.simulate.output_step)
      refuse(document, "simulate", fmt::format("sample {} lasts {:g} s with rows every {:g} s, the model as it is {:g} s with rows every {:g} s", sample, other.duration, other.output_step, base.simulate.duration, base.simulate.output_step),
             "duration and output times depend on the varying values, but series need the same ones in every sample", "--set both simulate.duration=... and simulate.output_step=..., or leave out --series");
  }
}

}  // namespace

SweepJob::SweepJob(const SweepRequest& request) {
  Document document = parse_document(request.model_text, request.model_name);
  apply_overrides(document, request.overrides);
  const int first_source = static_cast<int>(document.sources.size());
  for (const std::string& text : request.vary) document.sources.emplace_back("--vary", text);
  const FileText files = files_of(request);
  ModelReading reading(document, files);
  read_all(reading);
  reading.complaints.throw_if_any();
  plan_ = SweepPlan(request, reading, first_source);
  reading.complaints.throw_if_any();
  const Model& base = reading.model;
  if (base.simulate.duration <= 0) refuse(document, "simulate.duration", "no duration", "a run needs a duration", "duration = \"1 s\" under [simulate], or --duration '1 s'");
  try {
    engine_ = std::make_unique<EnvelopeEngine>(base, EnvelopeRequest{request.series, request.check_every > 1});
  } catch (const std::invalid_argument& error) {
    refuse(document, "--series", "an unknown column", error.what(), "");
  }
  variants_ = std::make_unique<ModelVariants>(document, plan_.paths(), files);
  if (!request.series.empty()) check_times(document, plan_, base, *variants_);
  origin_ = {request.model_files, request.model_text, request.model_name, base.name.empty() ? request.model_name : base.name, "", hash_of(request), PINTLE_VERSION, request.seed, std::max<std::uint64_t>(1, request.check_every),
             base.simulate.tolerance, engine_->output_step(), engine_->n_times(),
             engine_->joints(), request.series, engine_->series_units()};
}

SweepOrigin SweepJob::origin(const std::string& command) const {
  SweepOrigin out = origin_;
  out.command = command;
  return out;
}

}  // namespace pintle
