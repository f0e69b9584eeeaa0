// Arguments and answers of a call.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pintle/complaint.h"
#include "pintle/model.h"
#include "pintle/read_model.h"
#include "studio/kernel/calls.h"

namespace pintle::studio {

using Json = nlohmann::ordered_json;

/// An error for the user.
class CallFault : public std::runtime_error {
 public:
  CallFault(const std::string& message, std::string what_to_try, std::vector<std::string> with_joints = {})
      : std::runtime_error(message), hint(std::move(what_to_try)), joints(std::move(with_joints)) {}
  std::string hint;
  std::vector<std::string> joints;
};

/// One call under way.
struct Exchange {
  const Json& arguments;
  const OnProgress& on_progress;
  std::vector<std::vector<double>> arrays;

  /// Puts an array beside the answer and gives what stands for it.
  Json array(std::vector<double> numbers) {
    arrays.push_back(std::move(numbers));
    return {{"f64", arrays.size() - 1}};
  }
};

/// What the page must have given; otherwise the call is malformed.
std::string text_argument(const Exchange& call, const char* key);
double number_argument(const Json& arguments, const char* key);
std::array<double, 2> point_argument(const Json& arguments, const char* key);

/// The files that the page has of those that the model may name: "files", an object of texts by name. It may be absent.
FileText files_argument(const Exchange& call);

/// "model.json" for text that begins with a brace, else "model.toml".
std::string name_for(std::string_view text);

Json to_json(const Complaint& complaint);
Json to_json(const std::vector<Complaint>& complaints);
Json fault(const std::string& message, const std::string& hint, const std::vector<std::string>& joints = {});
/// The exception under way, as a fault.
Json current_fault();
/// A message's lines but for those that say what to try, and these.
std::pair<std::string, std::string> message_and_hint(const std::string& text);
/// The joints that a message names; of `known`, when given.
std::vector<std::string> joints_named_in(const std::string& text, const std::vector<std::string>* known = nullptr);

/// JSON text; NaN and infinity become null, broken UTF-8 a replacement character.
std::string dump(const Json& json);

// texts.cpp
Json schema(Exchange& call);
Json catalog(Exchange& call);
Json read(Exchange& call);
Json write(Exchange& call);
Json edit(Exchange& call);
Json format(Exchange& call);
Json check(Exchange& call);
// resolved.cpp
Json resolved(const Model& model);
// runs.cpp
Json run(Exchange& call);
Json report(Exchange& call);

}  // namespace pintle::studio
