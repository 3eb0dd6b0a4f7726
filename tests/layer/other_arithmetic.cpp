#include "tests/layer/other_arithmetic.h"

#include <spirv/unified1/GLSL.std.450.h>
#include <initializer_list>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <spirv/unified1/spirv.hpp>
#include <stdexcept>
#include <utility>

namespace trisect::layer {
namespace {

using spv::Op;
using Words = std::vector<uint32_t>;

constexpr std::size_t kHeaderWords = 5;
constexpr std::size_t kBoundWord = 3;

Op opcode(const Words& instruction) {
  return static_cast<Op>(instruction[0] & 0xFFFFU);
}

Words make(Op op, std::initializer_list<uint32_t> operands) {
  Words words{static_cast<uint32_t>(op) | static_cast<uint32_t>(operands.size() + 1) << 16U};
  words.insert(words.end(), operands);
  return words;
}

// A module that is being rewritten: what is before the functions can be added to.
class Rewriter {
 public:
  Rewriter(std::span<const uint32_t> spirv, const OtherArithmetic& arithmetic)
      : arithmetic_(arithmetic),
        header_(spirv.begin(), spirv.begin() + kHeaderWords),
        random_(static_cast<uint32_t>(spirv.size())) {
    bool in_functions = false;
    for (std::size_t at = kHeaderWords; at < spirv.size();) {
      const std::size_t count = spirv[at] >> 16U;
      if (count == 0 || at + count > spirv.size()) throw std::logic_error("a module is cut off");
      const auto words = spirv.subspan(at, count);
      Words instruction(words.begin(), words.end());
      in_functions = in_functions || opcode(instruction) == Op::OpFunction;
      (in_functions ? functions_ : declarations_).push_back(std::move(instruction));
      at += count;
    }
    read_declarations();
  }

  Words rewritten() {
    std::vector<Words> rest = std::move(functions_);
    functions_.clear();
    for (const Words& instruction : rest) rewrite(instruction);
    Words out = header_;
    for (const auto& part : {declarations_, functions_}) {
      for (const Words& instruction : part) {
        out.insert(out.end(), instruction.begin(), instruction.end());
      }
    }
    out[kBoundWord] = header_[kBoundWord];
    return out;
  }

 private:
  void read_declarations() {
    for (const Words& words : declarations_) {
      switch (opcode(words)) {
        case Op::OpTypeFloat:
          components_[words[1]] = 1;
          break;
        case Op::OpTypeVector:
          if (components_.count(words[2]) != 0) components_[words[1]] = words[3];
          [[fallthrough]];
        case Op::OpTypeInt:
        case Op::OpTypeBool:
          types_[Words(words.begin() + 2, words.end())].emplace(opcode(words), words[1]);
          break;
        case Op::OpDecorate:
          if (static_cast<spv::Decoration>(words[2]) == spv::DecorationBuiltIn &&
              static_cast<spv::BuiltIn>(words[3]) == spv::BuiltInSubgroupSize) {
            sizes_.insert(words[1]);
          }
          break;
        default:
          break;
      }
    }
  }

  uint32_t new_id() { return header_[kBoundWord]++; }

  // The id of a type, which is declared if it is not yet.
  uint32_t type(Op op, const Words& operands) {
    auto& known = types_[operands];
    const auto found = known.find(op);
    if (found != known.end()) return found->second;
    const uint32_t id = new_id();
    Words words = make(op, {id});
    words.insert(words.end(), operands.begin(), operands.end());
    words[0] += static_cast<uint32_t>(operands.size()) << 16U;
    declarations_.push_back(words);
    known[op] = id;
    return id;
  }
  uint32_t vector_or(uint32_t scalar, uint32_t components) {
    return components == 1 ? scalar : type(Op::OpTypeVector, {scalar, components});
  }
  uint32_t uints(uint32_t components) {
    return vector_or(type(Op::OpTypeInt, {32U, 0U}), components);
  }
  uint32_t bools(uint32_t components) { return vector_or(type(Op::OpTypeBool, {}), components); }

  uint32_t doubles(uint32_t components) {
    if (!has_doubles_) {
      declarations_.insert(declarations_.begin(),
                           make(Op::OpCapability, {static_cast<uint32_t>(spv::CapabilityFloat64)}));
    }
    has_doubles_ = true;
    return vector_or(type(Op::OpTypeFloat, {64U}), components);
  }
  uint32_t widened(uint32_t value, uint32_t components) {
    const uint32_t wide = doubles(components);
    return compute(Op::OpFConvert, wide, {value});
  }

  // A constant with this value in every component.
  uint32_t constant(uint32_t value, uint32_t components) {
    const auto key = std::pair(value, components);
    const auto found = constants_.find(key);
    if (found != constants_.end()) return found->second;
    uint32_t id = 0;
    if (components == 1) {
      const uint32_t of = uints(1);
      id = new_id();
      declarations_.push_back(make(Op::OpConstant, {of, id, value}));
    } else {
      const uint32_t part = constant(value, 1);
      const uint32_t of = uints(components);
      id = new_id();
      Words words = make(Op::OpConstantComposite, {of, id});
      for (uint32_t i = 0; i < components; ++i) words.push_back(part);
      words[0] += components << 16U;
      declarations_.push_back(words);
    }
    constants_[key] = id;
    return id;
  }

  uint32_t compute(Op op, uint32_t of, std::initializer_list<uint32_t> operands) {
    const uint32_t id = new_id();
    Words words = make(op, {of, id});
    words.insert(words.end(), operands);
    words[0] += static_cast<uint32_t>(operands.size()) << 16U;
    functions_.push_back(words);
    return id;
  }

  static bool is_inexact(const Words& words) {
    if (opcode(words) == Op::OpFDiv) return true;
    return opcode(words) == Op::OpExtInst &&
           (words[4] == GLSLstd450Sqrt || words[4] == GLSLstd450InverseSqrt);
  }

  void rewrite(const Words& words) {
    const Op op = opcode(words);
    if (op == Op::OpFMul || op == Op::OpVectorTimesScalar) products_[words[2]] = words;
    if (op == Op::OpFunction) products_.clear();
    if (arithmetic_.off_by_ulps && is_inexact(words)) {
      push_off_by_ulps(words);
    } else if (op == Op::OpLoad && arithmetic_.subgroup_size != 0 && sizes_.count(words[3]) != 0) {
      functions_.push_back(
          make(Op::OpCopyObject, {words[1], words[2], constant(arithmetic_.subgroup_size, 1)}));
    } else if ((op == Op::OpFAdd || op == Op::OpFSub) && push_fused(words)) {
      return;
    } else {
      functions_.push_back(words);
    }
  }

  // The operation with its result r replaced by the float whose bits are r's plus h, with h from -2
  // to 2 by a multiplicative hash of the bits (Knuth, The Art of Computer Programming 3, 6.4).
  void push_off_by_ulps(Words words) {
    const uint32_t of = words[1];
    const uint32_t result = words[2];
    const uint32_t n = components_.at(of);
    words[2] = new_id();
    functions_.push_back(words);
    const uint32_t bits = compute(Op::OpBitcast, uints(n), {words[2]});
    const uint32_t mixed = compute(Op::OpIMul, uints(n), {bits, constant(2654435769U, n)});
    const uint32_t high = compute(Op::OpShiftRightLogical, uints(n), {mixed, constant(20, n)});
    const uint32_t rest = compute(Op::OpUMod, uints(n), {high, constant(5, n)});
    const uint32_t sum = compute(Op::OpIAdd, uints(n), {bits, rest});
    const uint32_t moved = compute(Op::OpISub, uints(n), {sum, constant(2, n)});
    // Only floats with an exponent that no step of two can leave.
    const uint32_t shifted = compute(Op::OpShiftRightLogical, uints(n), {bits, constant(23, n)});
    const uint32_t exponent = compute(Op::OpBitwiseAnd, uints(n), {shifted, constant(255, n)});
    const uint32_t above = compute(Op::OpISub, uints(n), {exponent, constant(2, n)});
    const uint32_t normal = compute(Op::OpULessThan, bools(n), {above, constant(252, n)});
    const uint32_t chosen = compute(Op::OpSelect, uints(n), {normal, moved, bits});
    functions_.push_back(make(Op::OpBitcast, {of, result, chosen}));
  }

  // A sum or difference with a product as one fused operation, if there is one and chance wants it.
  bool push_fused(const Words& words) {
    for (const std::size_t place : {std::size_t{3}, std::size_t{4}}) {
      const auto found = products_.find(words[place]);
      if (found == products_.end()) continue;
      if (random_() % 100 >= arithmetic_.fused_percent) return false;
      const uint32_t of = words[1];
      const uint32_t n = components_.at(of);
      const uint32_t a = found->second[3];
      uint32_t b = found->second[4];
      const uint32_t c = words[7 - place];
      if (opcode(found->second) == Op::OpVectorTimesScalar) {
        Words splat = make(Op::OpCompositeConstruct, {of, new_id()});
        for (uint32_t i = 0; i < n; ++i) splat.push_back(b);
        splat[0] += n << 16U;
        functions_.push_back(splat);
        b = splat[2];
      }
      // In double precision the product is exact. GLSL's fma() is no help: drivers without such an
      // instruction take it apart.
      const uint32_t wide = doubles(n);
      const uint32_t product = compute(Op::OpFMul, wide, {widened(a, n), widened(b, n)});
      const uint32_t left = place == 3 ? product : widened(c, n);
      const uint32_t right = place == 3 ? widened(c, n) : product;
      const uint32_t sum = compute(opcode(words), wide, {left, right});
      functions_.push_back(make(Op::OpFConvert, {of, words[2], sum}));
      return true;
    }
    return false;
  }

  OtherArithmetic arithmetic_;
  Words header_;
  std::vector<Words> declarations_;
  std::vector<Words> functions_;
  bool has_doubles_ = false;
  std::map<uint32_t, uint32_t> components_;        // of the types of floats and their vectors
  std::map<Words, std::map<Op, uint32_t>> types_;  // by operands and opcode
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> constants_;
  std::set<uint32_t> sizes_;            // variables that are gl_SubgroupSize
  std::map<uint32_t, Words> products_;  // of the present function, by result
  std::minstd_rand random_;             // the same for the same kernel
};

}  // namespace

std::vector<uint32_t> with_other_arithmetic(std::span<const uint32_t> spirv,
                                            const OtherArithmetic& arithmetic) {
  return Rewriter(spirv, arithmetic).rewritten();
}

}  // namespace trisect::layer
