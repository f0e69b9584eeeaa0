#include "base/expression/expression_parser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/expression/expression_code.h"
#include "base/expression/expression_dimensions.h"
#include "base/expression/expression_problems.h"
#include "base/text/text_scanner.h"
#include "base/unit_scanner.h"
#include "base/units.h"

namespace pintle {
namespace {

// How strongly an operator binds its left and right operand.
struct Grip {
  int left;
  int right;
};

constexpr int kNegationGrip = 5;
constexpr int kComparisonGrip = 1;

Grip grip_of(char symbol) {
  switch (symbol) {
    case '+':
    case '-':
      return {2, 3};
    case '*':
    case '/':
      return {3, 4};
    case '^':
      return {7, 6};  // right-associative: 2^3^2 is 2^9
    default:
      return {kComparisonGrip, 2};
  }
}

Op op_of(char symbol) {
  switch (symbol) {
    case '+':
      return Op::kAdd;
    case '-':
      return Op::kSubtract;
    case '*':
      return Op::kMultiply;
    case '/':
      return Op::kDivide;
    case '^':
      return Op::kPower;
    case '<':
      return Op::kLess;
    case '>':
      return Op::kGreater;
    case 'l':
      return Op::kLessEqual;
    default:
      return Op::kGreaterEqual;
  }
}

std::optional<double> built_in_constant(std::string_view word) {
  if (word == "pi") return std::numbers::pi;
  if (word == "e") return std::numbers::e;
  return std::nullopt;
}

}  // namespace

// Precedence climbing over the text; writes the program as it goes. Problems are thrown as ParseProblem, which `parse` catches.
class ExpressionParser {
 public:
  ExpressionParser(std::string_view text, const ParseScope& scope) : text_(text), scope_(scope) {}

  std::variant<ParsedExpression, ParseProblem> parse() {
    try {
      const Operand whole = parse_whole();
      return ParsedExpression{finished(), whole.dimension};
    } catch (const ParseProblem& problem) {
      return problem;
    }
  }

 private:
  Operand parse_whole() {
    if (text_.size() > kLongestExpression)
      throw ParseProblem{0, "", "the expression is longer than 4096 bytes", "parts of it as [parameters]"};
    skip();
    if (at_ == text_.size())
      throw ParseProblem{0, "an empty text", "a number or an expression is expected", "0, or delete the key"};
    const Operand whole = parse_sum(0);
    if (at_ != text_.size()) throw unexpected_after_operand(text_, at_, scope_);
    if (code_.overflows_stack())
      throw ParseProblem{0, "", "the expression is nested too deeply",
                         "fewer parentheses, or parts of it as [parameters]"};
    return whole;
  }

  Expression finished() const {
    Expression result;
    result.text_ = std::string(text_);
    result.variables_ = variables_;
    result.program_ = std::make_shared<const Expression::Program>(code_.program());
    return result;
  }

  // Operands joined by operators that bind at least as strongly as `least`.
  Operand parse_sum(int least) {
    if (++depth_ > kDeepestExpression)
      throw ParseProblem{at_, "", "the expression is nested too deeply",
                         "fewer parentheses, or parts of it as [parameters]"};
    Operand left = parse_operand();
    bool is_comparison = false;
    for (skip();; skip()) {
      const std::optional<OperatorAt> found = operator_at(text_, at_);
      if (!found || grip_of(found->symbol).left < least) break;
      const std::size_t at = at_;
      if (grip_of(found->symbol).left == kComparisonGrip && std::exchange(is_comparison, true))
        throw ParseProblem{at, "", "two comparisons cannot be chained", "multiply them: (a < b)*(b < c)"};
      at_ += found->length;
      const Operand right = parse_sum(grip_of(found->symbol).right);
      left = joined(*found, at, left, right);
    }
    --depth_;
    return left;
  }

  Operand joined(const OperatorAt& found, std::size_t at, const Operand& left, const Operand& right) {
    const std::string between(text_.substr(at, found.length));
    CombinedOperand result;
    switch (found.symbol) {
      case '+':
      case '-':
        result = alike(left, right, between);
        break;
      case '*':
        result = product_of(left, right);
        break;
      case '/':
        result = quotient_of(left, right);
        break;
      case '^':
        result = power_of(left, right);
        break;
      default:
        result = alike(left, right, between);
        result.operand.dimension = kBareNumber;
        result.operand.is_number = true;
    }
    return emit(op_of(found.symbol), checked(result, at), at);
  }

  Operand checked(const CombinedOperand& result, std::size_t at) const {
    const DimensionProblem& problem = result.problem;
    if (!problem.because.empty()) throw ParseProblem{at, problem.found, problem.because, problem.suggestion};
    return result.operand;
  }

  // Appends `op` to the program; `at` is the place to blame if constants do not give a finite number.
  Operand emit(Op op, Operand operand, std::size_t at) {
    code_.apply_op(op, operand.varies);
    if (code_.went_out_of_range())
      throw ParseProblem{at, "", "this does not give a finite number",
                         "check for a division by 0, or a root or logarithm outside its range"};
    operand.constant = operand.varies ? 0 : code_.top_constant();
    return operand;
  }

  Operand parse_operand() {
    skip();
    const std::size_t start = at_;
    if (start == text_.size()) throw no_operand(text_, start);
    if (const std::size_t length = dotted_variable_length(); length > 0) return variable(length);
    if (is_digit(text_[start]) || text_[start] == '.') return parse_number();
    if (is_word_start(text_[start])) return parse_name();
    if (text_[start] == '(') return parse_group();
    const std::optional<OperatorAt> sign = operator_at(text_, start);
    if (!sign || (sign->symbol != '-' && sign->symbol != '+')) throw no_operand(text_, start);
    at_ += sign->length;
    Operand operand = parse_sum(kNegationGrip);
    operand.offset = start;
    return sign->symbol == '-' ? emit(Op::kNegate, operand, start) : operand;
  }

  Operand parse_group() {
    const std::size_t start = at_++;
    Operand inner = parse_sum(0);
    close_parenthesis(start);
    inner.offset = start;
    return with_unit(inner);
  }

  void close_parenthesis(std::size_t opened) {
    skip();
    if (at_ == text_.size()) throw ParseProblem{opened, "an opening parenthesis", "it is never closed", "add )"};
    if (text_[at_] != ')') throw unexpected_after_operand(text_, at_, scope_);
    ++at_;
  }

  Operand parse_number() {
    const std::size_t start = at_;
    const std::string_view number = number_at(text_, start);
    if (number.empty()) throw no_operand(text_, start);
    at_ += number.size();
    const double value = to_number(number);
    if (!std::isfinite(value))
      throw ParseProblem{start, std::string(number), "the number is too large", "a number below 1e308"};
    const Operand operand = with_unit(constant({value, kBareNumber}, true, start));
    refuse_unknown_unit();
    return operand;
  }

  // The operand times the unit that follows it, if there is one.
  Operand with_unit(const Operand& operand) {
    skip();
    if (symbol_at(text_, at_).empty()) return operand;
    const UnitScan scan = scan_unit(
        text_, at_, [this](std::string_view word) { return find_variable(word) != nullptr; }, [this](std::string_view word, const Unit& unit) { return could_be_meant(word, unit); });
    if (!scan.problem.empty()) {
      const std::string_view symbol = symbol_at(text_, scan.problem_offset);
      throw faulty_unit(scan, is_parameter(symbol) ? symbol : std::string_view());
    }
    if (!scan.found) return operand;
    const std::size_t at = std::exchange(at_, scan.end);
    const Operand unit = constant({scan.unit.factor, scan.unit.dimension}, false, at);
    return emit(Op::kMultiply, checked(product_of(operand, unit), at), at);
  }

  bool is_parameter(std::string_view word) const {
    return std::find(scope_.constant_names.begin(), scope_.constant_names.end(), word) != scope_.constant_names.end();
  }

  // For a word that is a unit of this factor after another unit: in N*m it is not a force times a mass m, but kg*h^2 may be a mass times a height.
  bool could_be_meant(std::string_view word, const Unit& unit) const {
    if (!is_parameter(word)) return false;
    const std::optional<Quantity> parameter = scope_.constant ? scope_.constant(word) : std::nullopt;
    if (!parameter) return true;
    return !std::isnan(parameter->si) && (unit.factor != 1 || fits(parameter->dimension, unit.dimension));
  }

  // A word directly after a number is a unit or a mistake.
  void refuse_unknown_unit() {
    skip();
    const std::string_view word = symbol_at(text_, at_);
    if (word.empty() || is_unit_symbol(word) || is_known_name(word, scope_)) return;
    throw unknown_unit(word, at_);
  }

  Operand parse_name() {
    const std::size_t start = at_;
    const std::string_view word = word_at(text_, start);
    const std::size_t behind = skip_blanks(text_, start + word.size());
    const bool is_called = behind < text_.size() && text_[behind] == '(';
    if (const FunctionInfo* function = find_function(word)) {
      if (!is_called)
        throw ParseProblem{start, std::string(word), "a function needs arguments", std::string(function->usage)};
      at_ = behind;
      return parse_call(*function, start);
    }
    if (const ParseScope::Table* table = is_called ? find_table(word, scope_) : nullptr) {
      at_ = behind;
      return parse_call(*table, start);
    }
    if (find_variable(word) && !has_member(start + word.size())) return variable(word.size());
    if (const std::optional<double> value = built_in_constant(word)) {
      at_ += word.size();
      return with_unit(constant({*value, kBareNumber}, true, start));
    }
    return named_constant(word, start);
  }

  Operand named_constant(std::string_view word, std::size_t start) {
    const std::size_t end = start + word.size();
    const std::size_t member = has_member(end) ? 1 + word_at(text_, end + 1).size() : 0;
    if (member > 0) throw unknown_name(text_.substr(start, word.size() + member), start, scope_);
    const std::optional<Quantity> quantity = scope_.constant ? scope_.constant(word) : std::nullopt;
    if (!quantity) throw unknown_name(word, start, scope_);
    at_ = end;
    const Dimension dimension = std::isnan(quantity->si) ? kBareNumber : quantity->dimension;
    return constant({quantity->si, dimension}, false, start);
  }

  bool has_member(std::size_t end) const {
    return end + 1 < text_.size() && text_[end] == '.' && is_word_start(text_[end + 1]);
  }

  Operand constant(const Quantity& quantity, bool is_number, std::size_t start) {
    code_.push_constant(quantity.si);
    return {quantity.dimension, is_number, false, quantity.si, start};
  }

  const std::pair<std::string, Dimension>* find_variable(std::string_view name) const {
    const auto& all = scope_.variables;
    const auto it = std::find_if(all.begin(), all.end(), [&](const auto& variable) { return variable.first == name; });
    return it == all.end() ? nullptr : &*it;
  }

  // Length of the longest variable with a dot in its name at this place; 0 if there is none.
  std::size_t dotted_variable_length() const {
    std::size_t longest = 0;
    if (!is_word_part(text_[at_])) return 0;
    for (const auto& [name, dimension] : scope_.variables) {
      const std::size_t end = at_ + name.size();
      if (name.size() <= longest || name.find('.') == std::string::npos) continue;
      if (text_.substr(at_, name.size()) == name && (end >= text_.size() || !is_word_part(text_[end])))
        longest = name.size();
    }
    return longest;
  }

  Operand variable(std::size_t length) {
    const std::size_t start = std::exchange(at_, at_ + length);
    const auto* found = find_variable(text_.substr(start, length));
    const auto it = std::find(variables_.begin(), variables_.end(), found->first);
    code_.push_variable(static_cast<std::size_t>(it - variables_.begin()));
    if (it == variables_.end()) variables_.push_back(found->first);
    return {found->second, false, true, 0, start};
  }

  Operand parse_call(const FunctionInfo& function, std::size_t start) {
    const std::size_t opened = at_++;
    std::array<Operand, 3> arguments;
    const auto wanted = static_cast<std::size_t>(arity(function.op));
    for (std::size_t i = 0; i < wanted; ++i) {
      if (i > 0) expect_comma(function, opened);
      skip();
      if (at_ < text_.size() && text_[at_] == ')') throw wrong_count(function, at_);
      arguments[i] = parse_sum(0);
    }
    skip();
    if (at_ < text_.size() && text_[at_] == ',') throw wrong_count(function, at_);
    close_parenthesis(opened);
    Operand result = result_of(function, arguments, start);
    result.offset = start;
    return emit(function.op, result, start);
  }

  Operand parse_call(const ParseScope::Table& table, std::size_t start) {
    const std::size_t opened = at_++;
    const Operand argument = parse_sum(0);
    skip();
    if (at_ < text_.size() && text_[at_] == ',') throw ParseProblem{at_, "", "table " + table.name + " takes 1 argument", table.name + "(x)"};
    close_parenthesis(opened);
    checked({argument, check_argument(argument, table)}, argument.offset);
    code_.apply_table(table.function, argument.varies);
    return {table.result, false, argument.varies, argument.varies ? 0 : code_.top_constant(), start};
  }

  void expect_comma(const FunctionInfo& function, std::size_t opened) {
    skip();
    if (at_ < text_.size() && text_[at_] == ')') throw wrong_count(function, at_);
    if (at_ < text_.size() && text_[at_] != ',') throw unexpected_after_operand(text_, at_, scope_);
    if (at_ == text_.size()) close_parenthesis(opened);
    ++at_;
  }

  static ParseProblem wrong_count(const FunctionInfo& function, std::size_t at) {
    const int n = arity(function.op);
    const std::string count = std::to_string(n) + (n == 1 ? " argument" : " arguments");
    return {at, "", std::string(function.name) + " takes " + count, std::string(function.usage)};
  }

  // The result of a function for these arguments; its rule determines which may be combined.
  Operand result_of(const FunctionInfo& function, const std::array<Operand, 3>& a, std::size_t start) const {
    const std::string name(function.name);
    Operand number{kBareNumber, true, a[0].varies || a[1].varies || a[2].varies, 0, start};
    Operand angle{kAngle, false, number.varies, 0, start};
    switch (function.rule) {
      case FunctionRule::kPureToPure:
        require_pure(a[0], name);
        return number;
      case FunctionRule::kPureToAngle:
        require_pure(a[0], name);
        return angle;
      case FunctionRule::kSignToPure:
        return number;
      case FunctionRule::kKeep:
        return a[0];
      case FunctionRule::kSquareRoot:
        return checked(square_root_of(a[0]), a[0].offset);
      case FunctionRule::kAlikeKeep:
        return checked(alike(a[0], a[1], "and"), a[1].offset);
      case FunctionRule::kAlikeToAngle:
        checked(alike(a[0], a[1], "and"), a[1].offset);
        return angle;
      case FunctionRule::kAlikeToPure: {
        const Operand ends = checked(alike(a[0], a[1], "and"), a[1].offset);
        checked(alike(ends, a[2], "and"), a[2].offset);
        if (!a[2].varies && (a[0].varies || a[1].varies))
          throw ParseProblem{a[2].offset, "a constant", "smoothstep(a, b, x) rises from 0 where x is a to 1 where it is b: what varies comes last", "smoothstep(from, to, t)"};
        return number;
      }
      case FunctionRule::kPower:
        return checked(power_of(a[0], a[1]), a[1].offset);
      case FunctionRule::kChoose:
        break;
    }
    require_pure(a[0], "a condition");
    Operand chosen = checked(alike(a[1], a[2], "and"), a[2].offset);
    chosen.varies = number.varies;
    return chosen;
  }

  void require_pure(const Operand& operand, const std::string& name) const {
    checked({operand, check_pure(operand, name)}, operand.offset);
  }

  void skip() { at_ = skip_blanks(text_, at_); }

  std::string_view text_;
  const ParseScope& scope_;
  std::size_t at_ = 0;
  int depth_ = 0;
  ExpressionCode code_;
  std::vector<std::string> variables_;
};

std::variant<ParsedExpression, ParseProblem> parse_expression(std::string_view text, const ParseScope& scope) {
  return ExpressionParser(text, scope).parse();
}

std::variant<Quantity, ParseProblem> parse_quantity(std::string_view text, const ParseScope& scope) {
  const auto parsed = scope.variables.empty()
                          ? parse_expression(text, scope)
                          : parse_expression(text, ParseScope{scope.constant, scope.constant_names, {}, scope.tables});
  if (const auto* problem = std::get_if<ParseProblem>(&parsed)) return *problem;
  const auto& found = std::get<ParsedExpression>(parsed);
  return Quantity{found.expression.value({}), found.dimension};
}

bool is_reserved_name(std::string_view word) {
  return find_function(word) || built_in_constant(word) || word == "t";
}

bool is_identifier(std::string_view word) {
  return !word.empty() && word_at(word, 0).size() == word.size();
}

}  // namespace pintle
