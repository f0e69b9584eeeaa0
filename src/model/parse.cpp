#include "pintle/parse.h"

#include <fmt/format.h>

#include <stdexcept>
#include <variant>

#include "base/expression/expression_parser.h"

namespace pintle {

Expression parse(std::string_view text, const std::vector<std::string>& variables) {
  ParseScope scope;
  for (const std::string& name : variables) scope.variables.emplace_back(name, Dimension{.exponents = {}, .any = true});
  const auto result = parse_expression(text, scope);
  if (const auto* parsed = std::get_if<ParsedExpression>(&result)) return parsed->expression;
  const ParseProblem& problem = std::get<ParseProblem>(result);
  throw std::invalid_argument(fmt::format("\"{}\", at character {}: {}{}", text, problem.offset + 1, problem.because, problem.suggestion.empty() ? std::string() : "; " + problem.suggestion));
}

}  // namespace pintle
