#include "ilp/proof.h"

#include <cstdint>
#include <ostream>

namespace ilp {
namespace {

std::int64_t number(Literal l) {
  const auto n = static_cast<std::int64_t>(index(l.var())) + 1;
  return l.value() ? n : -n;
}

}  // namespace

void ProofLog::line(char kind, std::span<const Literal> literals) {
  out_ << kind;
  for (const Literal l : literals) out_ << ' ' << number(l);
  out_ << " 0\n";
}

void ProofLog::join(std::span<const Term> terms, std::int64_t bound) {
  out_ << "b " << bound;
  for (const auto& [var, a] : terms)
    if (a != 0) out_ << ' ' << a << ' ' << number(Literal(var, true));
  out_ << " 0\n";
}

void ProofLog::improve(const Model& model) {
  out_ << 'm';
  for (std::uint32_t v = 0; v < model.size(); ++v)
    out_ << ' ' << number(Literal(VarId{v}, model[v]));
  out_ << " 0\n";
}

}  // namespace ilp
