// OPB is read by hand, character by character, so that every complaint has a
// line and a column. A constraint is gathered as a map from variable to
// coefficient, with negated literals turned: a not x = a - a x.

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ilp/formats.h"

namespace ilp {
namespace {

/// The sum of its terms and `constant`.
struct Sum {
  std::map<VarId, std::int64_t> terms;
  std::int64_t constant = 0;
};

class OpbReader {
 public:
  OpbReader(std::string_view text, const std::string& name)
      : text_(text), name_(name) {}

  Program run() {
    skip();
    while (at_ < text_.size()) {
      token_ = at_;
      if (text_.substr(at_).starts_with("min:")) {
        read_objective();
      } else {
        read_constraint();
      }
      skip();
    }
    token_ = text_.size();
    if (n_constraints_ != header_constraints_.value_or(n_constraints_))
      fail("the header says " + std::to_string(*header_constraints_) +
           " constraints, there are " + std::to_string(n_constraints_));
    return std::move(program_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const std::string_view before = text_.substr(0, token_);
    const auto line = std::ranges::count(before, '\n') + 1;
    const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
    throw std::invalid_argument(name_ + ":" + std::to_string(line) + ":" +
                                std::to_string(token_ - start + 1) + ": " +
                                what);
  }

  // The start of what is read next, as it stands in messages.
  std::string shown() const {
    if (token_ >= text_.size()) return "the end of the file";
    std::string word;
    for (const char c : text_.substr(token_, 30)) {
      if (c == ' ' || c == ';' || c < 0x21 || c > 0x7e) break;
      word += c;
    }
    return word.empty() ? "what stands here" : "'" + word + "'";
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  // White space, and lines that begin with a star.
  void skip() {
    while (at_ < text_.size()) {
      const bool starts_line = at_ == 0 || text_[at_ - 1] == '\n';
      if (text_[at_] == '*' && starts_line) {
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        read_header(text_.substr(at_, end - at_));
        at_ = end;
      } else if (std::string_view(" \t\r\n").find(text_[at_]) !=
                 std::string_view::npos) {
        ++at_;
      } else {
        return;
      }
    }
  }

  // * #variable= 5 #constraint= 2
  void read_header(std::string_view line) {
    const auto number = [&](std::string_view key) {
      const std::size_t found = line.find(key);
      std::optional<std::uint64_t> value;
      if (found == std::string_view::npos) return value;
      token_ = at_ + found;
      std::string_view rest = line.substr(found + key.size());
      rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
      std::uint64_t n = 0;
      if (std::from_chars(rest.data(), rest.data() + rest.size(), n).ec !=
          std::errc())
        fail("no number after " + std::string(key));
      value = n;
      return value;
    };
    if (const auto n = number("#variable=")) {
      if (*n > kMaxVariables) fail("more than 2^29 variables");
      n_allowed_ = *n;
      require_variables(*n);
    }
    if (const auto n = number("#constraint=")) header_constraints_ = n;
  }

  void require_variables(std::size_t n) {
    const std::size_t present = program_.problem.n_variables();
    if (n > present) program_.problem.add_variables(n - present);
  }

  void next() {
    skip();
    token_ = at_;
  }

  std::int64_t read_number() {
    const std::int64_t sign = read_sign();
    const std::size_t begin = at_;
    while (is_digit(peek())) ++at_;
    if (at_ == begin) fail("expected a number, not " + shown());
    std::int64_t value = 0;
    const auto end = text_.data() + at_;
    if (std::from_chars(text_.data() + begin, end, value).ec != std::errc() ||
        value > kMaxLinearSum)
      fail("number out of range: " + shown());
    return sign * value;
  }

  std::int64_t read_sign() {
    next();
    const bool minus = peek() == '-';
    if (minus || peek() == '+') ++at_;
    skip();
    return minus ? -1 : 1;
  }

  // A number; a sign alone, and nothing, mean 1.
  std::int64_t read_coefficient() {
    next();
    const std::size_t begin = at_;
    const std::int64_t sign = read_sign();
    if (peek() == 'x' || peek() == '~') return sign;
    at_ = begin;
    return read_number();
  }

  // x7 or ~x7
  Literal read_literal() {
    next();
    const bool value = peek() != '~';
    if (!value) ++at_;
    if (peek() != 'x') fail("expected a variable, not " + shown());
    const std::size_t begin = ++at_;
    while (is_digit(peek())) ++at_;
    std::uint64_t number = 0;
    const auto end = text_.data() + at_;
    if (std::from_chars(text_.data() + begin, end, number).ec != std::errc() ||
        number == 0 || number > n_allowed_)
      fail("no such variable: " + shown());
    require_variables(number);
    return Literal(VarId{static_cast<std::uint32_t>(number - 1)}, value);
  }

  void add(std::int64_t& sum, std::int64_t a) const {
    if (std::max(sum, a) > kMaxLinearSum / 2 ||
        std::min(sum, a) < -kMaxLinearSum / 2)
      fail("number out of range: " + std::to_string(a));
    sum += a;
  }

  Sum read_sum() {
    Sum sum;
    while (next(), peek() != ';' && peek() != '>' && peek() != '<' &&
                       peek() != '=' && at_ < text_.size()) {
      const std::int64_t a = read_coefficient();
      const Literal l = read_literal();
      next();
      if (peek() == 'x' || peek() == '~')
        fail("products of variables are not read: " + shown());
      add(sum.terms[l.var()], l.value() ? a : -a);
      if (!l.value()) add(sum.constant, a);
    }
    return sum;
  }

  void expect_semicolon() {
    next();
    if (peek() != ';') fail("expected ';', not " + shown());
    ++at_;
  }

  void read_objective() {
    if (program_.has_objective || n_constraints_ > 0)
      fail("an objective must come first, and once");
    at_ += 4;
    const Sum sum = read_sum();
    expect_semicolon();
    program_.has_objective = true;
    program_.offset = sum.constant;
    program_.objective = terms_of(sum, 1);
    check(program_.objective, sum.constant);
  }

  void read_constraint() {
    const std::size_t begin = at_;
    const Sum sum = read_sum();
    const bool at_least = text_.substr(at_).starts_with(">=");
    const bool at_most = text_.substr(at_).starts_with("<=");
    if (!at_least && !at_most && peek() != '=')
      fail("expected '>=', '<=' or '=', not " + shown());
    at_ += peek() == '=' ? 1 : 2;
    std::int64_t bound = read_number();
    add(bound, -sum.constant);
    expect_semicolon();
    token_ = begin;
    ++n_constraints_;
    if (!at_least) add_at_most(terms_of(sum, 1), bound);
    if (!at_most) add_at_most(terms_of(sum, -1), -bound);
  }

  static std::vector<Term> terms_of(const Sum& sum, std::int64_t sign) {
    std::vector<Term> terms;
    for (const auto& [var, a] : sum.terms)
      if (a != 0) terms.push_back({var, sign * a});
    return terms;
  }

  void check(const std::vector<Term>& terms, std::int64_t bound) const {
    if (!is_in_range(terms, bound)) fail("the sum is out of range");
  }

  void add_at_most(const std::vector<Term>& terms, std::int64_t bound) {
    check(terms, bound);
    if (const auto clause = as_clause(terms, bound)) {
      program_.problem.add_clause(*clause);
    } else {
      program_.problem.add_linear(terms, bound);
    }
  }

  // The opposites of the literals that the terms weigh, if not all of them may
  // hold but all without any one.
  static std::optional<std::vector<Literal>> as_clause(
      const std::vector<Term>& terms, std::int64_t bound) {
    std::vector<Literal> clause;
    std::int64_t largest = 0;
    for (const auto& [var, a] : terms) {
      clause.emplace_back(var, a < 0);
      if (a > 0) largest += a;
    }
    const auto without = [largest](const Term& t) {
      return largest - std::abs(t.coefficient);
    };
    const bool is_clause =
        largest > bound && std::ranges::all_of(terms, [&](const Term& t) {
          return without(t) <= bound;
        });
    return is_clause ? std::optional(clause) : std::nullopt;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::size_t token_ = 0;  // where the present word begins
  Program program_;
  std::uint64_t n_allowed_ = kMaxVariables;
  std::optional<std::uint64_t> header_constraints_;
  std::uint64_t n_constraints_ = 0;
};

}  // namespace

Program read_opb(std::string_view text, const std::string& name) {
  return OpbReader(text, name).run();
}

}  // namespace ilp
