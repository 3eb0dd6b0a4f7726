#include "app/accuracy/float_operations.h"

#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "app/base/ulp.h"
#include "app/buffers/float_operations.h"
#include "app/buffers/kernels.h"
#include "vk/commands.h"

namespace trisect {
namespace {

using Limits = std::numeric_limits<float>;

bool is_denormal(float x) {
  return std::fpclassify(x) == FP_SUBNORMAL;
}

bool is_zero_or_normal(float x) {
  return x == 0.0F || std::fpclassify(x) == FP_NORMAL;
}

bool is_normal_result(double exact) {
  return std::fabs(exact) >= Limits::min() && std::fabs(exact) <= Limits::max();
}

bool equal_bits(float a, float b) {
  return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

// An item's numbers, and what the device made of them.
class Judged {
 public:
  Judged(const FloatItem& item, std::span<const uint32_t> results)
      : item_(item), results_(results) {}

  [[nodiscard]] const FloatItem& item() const { return item_; }
  [[nodiscard]] float a() const { return std::bit_cast<float>(item_.a); }
  [[nodiscard]] float b() const { return std::bit_cast<float>(item_.b); }
  [[nodiscard]] float c() const { return std::bit_cast<float>(item_.c); }
  [[nodiscard]] float operator[](uint32_t result) const {
    return std::bit_cast<float>(results_[result]);
  }
  [[nodiscard]] uint32_t bits(uint32_t result) const { return results_[result]; }

  [[nodiscard]] bool has_nan() const { return std::isnan(a()) || std::isnan(b()); }

 private:
  FloatItem item_;
  std::span<const uint32_t> results_;
};

// exact: in double precision, whose own rounding is 2^-29 of an ulp.
void add_error(LargestError& largest, const Judged& judged, uint32_t result, double exact) {
  if (!is_normal_result(exact)) return;
  ++largest.items;
  const double ulp = ulp_error(judged[result], exact);
  if (ulp <= largest.ulp) return;
  largest.ulp = ulp;
  largest.at = judged.item();
}

void judge_errors(const Judged& judged, FloatReport& report) {
  const double a = judged.a();
  const double b = judged.b();
  if (!is_zero_or_normal(judged.a())) return;
  if (a > 0.0) {
    add_error(report.sqrt, judged, FLOAT_SQRT, std::sqrt(a));
    add_error(report.inversesqrt, judged, FLOAT_INVERSESQRT, 1.0 / std::sqrt(a));
  }
  if (!is_zero_or_normal(judged.b())) return;
  add_error(report.add, judged, FLOAT_ADD, a + b);
  add_error(report.subtract, judged, FLOAT_SUBTRACT, a - b);
  add_error(report.multiply, judged, FLOAT_MULTIPLY, a * b);
  const double size = std::fabs(b);
  if (size >= 0x1p-126 && size <= 0x1p126) {
    add_error(report.divide, judged, FLOAT_DIVIDE, a / b);
    if (is_normal_result(a / b) && is_normal_result(1.0 / b)) {
      const float quotient = judged[FLOAT_DIVIDE];
      report.division_repeats.add(
          equal_bits(quotient, judged[FLOAT_DIVIDE_AGAIN]) &&
          equal_bits(quotient, judged[FLOAT_DIVIDE_VECTOR]) &&
          equal_bits(judged[FLOAT_RECIPROCAL], judged[FLOAT_RECIPROCAL_VECTOR]));
    }
  }
  const auto nearest = [&](uint32_t result, float even, double exact) {
    if (is_normal_result(exact)) report.nearest_even.add(equal_bits(judged[result], even));
  };
  nearest(FLOAT_ADD, judged.a() + judged.b(), a + b);
  nearest(FLOAT_SUBTRACT, judged.a() - judged.b(), a - b);
  nearest(FLOAT_MULTIPLY, judged.a() * judged.b(), a * b);
}

// plain: a * b + c, contracted or not.
void judge_contraction(const Judged& judged, float plain, FloatReport& report) {
  const double product = static_cast<double>(judged.a()) * judged.b();
  const bool known = is_zero_or_normal(judged.a()) && is_zero_or_normal(judged.b()) &&
                     is_zero_or_normal(judged.c()) && is_normal_result(product);
  if (!known) return;
  const double exact = product + judged.c();
  add_error(report.fma, judged, FLOAT_FMA, exact);
  const float one_rounding = std::fma(judged.a(), judged.b(), judged.c());
  // This program is compiled without contraction.
  const float two_roundings = judged.a() * judged.b() + judged.c();
  // A difference that is denormal may be flushed.
  if (one_rounding == two_roundings || is_denormal(one_rounding)) return;
  report.fma_fused.add(judged[FLOAT_FMA] == one_rounding);
  report.precise_contracted.add(judged[FLOAT_MULTIPLY_ADD] == one_rounding);
  report.plain_contracted.add(plain == one_rounding);
}

void judge_denormals(const Judged& judged, FloatReport& report) {
  const float a = judged.a();
  const float b = judged.b();
  const auto flushed = [](float x) { return is_denormal(x) ? 0.0F : x; };
  const auto judge = [&](uint32_t result, auto&& operation) {
    const float right = operation(a, b);
    if (is_denormal(a) || is_denormal(b)) {
      const float of_flushed = operation(flushed(a), flushed(b));
      if (std::fpclassify(right) == FP_NORMAL && right != of_flushed) {
        report.denormal_operands.add(judged[result] != of_flushed);
      }
    } else if (is_denormal(right)) {
      report.denormal_results.add(judged[result] != 0.0F);
    }
  };
  judge(FLOAT_ADD, [](float x, float y) { return x + y; });
  judge(FLOAT_MULTIPLY, [](float x, float y) { return x * y; });
}

uint32_t tests_of(float a, float b) {
  uint32_t tests = 0;
  const auto set_if = [&](bool is_so, uint32_t bit) { tests |= is_so ? bit : 0U; };
  set_if(std::isnan(a), FLOAT_IS_NAN);
  set_if(std::isinf(a), FLOAT_IS_INF);
  set_if(std::isnan(a), FLOAT_DIFFERS);
  set_if(a == b, FLOAT_EQUAL);
  set_if(a < b, FLOAT_LESS);
  set_if(a >= b, FLOAT_AT_LEAST);
  set_if(!(a < b), FLOAT_NOT_LESS);
  set_if(!(a >= b), FLOAT_NOT_AT_LEAST);
  return tests;
}

void judge_special(const Judged& judged, FloatReport& report) {
  const float a = judged.a();
  const float b = judged.b();
  report.bits.add(judged.bits(FLOAT_BITS) == judged.item().a);
  const bool tests_are_right = judged.bits(FLOAT_TESTS) == tests_of(a, b);
  if (judged.has_nan()) report.nan_tests.add(tests_are_right);
  if (!judged.has_nan() && (std::isinf(a) || std::isinf(b))) {
    report.infinities.add(tests_are_right);
  }
  if (std::isnan(a) != std::isnan(b)) {
    const float number = std::isnan(a) ? b : a;
    // A denormal may be flushed.
    if (!is_denormal(number)) {
      report.nan_lost_by_min_max.add(judged[FLOAT_MIN] == number && judged[FLOAT_MAX] == number);
    }
  }
  if (is_denormal(a) || is_denormal(b)) return;
  const auto judge = [&](uint32_t result, float right) {
    const float is = judged[result];
    if (std::isnan(right)) report.nan_results.add(std::isnan(is));
    if (std::isinf(right)) report.infinities.add(is == right);
    if (right == 0.0F) {
      // Not of a product that is too small, which may be a denormal.
      const bool is_zero =
          result == FLOAT_ADD || result == FLOAT_SUBTRACT || a == 0.0F || b == 0.0F;
      if (is_zero) report.signed_zeros.add(equal_bits(is, right));
    }
  };
  judge(FLOAT_ADD, a + b);
  judge(FLOAT_SUBTRACT, a - b);
  judge(FLOAT_MULTIPLY, a * b);
  // A compiler that does not care about NaN and the sign of 0 takes these for 0, 0 and a.
  if (std::isnan(a) || std::isinf(a)) {
    report.not_folded.add(std::isnan(judged[FLOAT_MINUS_ITSELF]));
    report.not_folded.add(std::isnan(judged[FLOAT_TIMES_ZERO]));
  } else if (std::signbit(a)) {
    report.not_folded.add(equal_bits(judged[FLOAT_TIMES_ZERO], -0.0F));
    if (a == 0.0F) report.not_folded.add(equal_bits(judged[FLOAT_PLUS_ZERO], 0.0F));
  }
  if (b == 0.0F && a != 0.0F && !std::isnan(a)) {
    const bool negative = std::signbit(a) != std::signbit(b);
    const float right = negative ? -Limits::infinity() : Limits::infinity();
    report.division_by_zero.add(judged[FLOAT_DIVIDE] == right);
  }
}

template <typename T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

// Runs a kernel of the interface `floats` on items. Returns its results, so many for each item;
// copies: gets its copies of the items, if it is not null.
std::vector<uint32_t> run(const gpu::Device& device, const char* kernel_name,
                          const std::vector<FloatItem>& items, std::size_t results_of_item,
                          std::vector<uint32_t>* copies, gpu::Floats floats = gpu::Floats::exact) {
  const gpu::Kernel kernel(device, spirv_of(kernel_name), interface_of(kernel_name), {},
                           kernel_name, floats);
  const std::size_t input_bytes = items.size() * sizeof(FloatItem);
  std::vector<uint32_t> results(items.size() * results_of_item);
  const gpu::Buffer given(device, input_bytes, gpu::Memory::device, "float inputs");
  const gpu::Buffer written(device, bytes_of(results).size(), gpu::Memory::device, "float results");
  const gpu::Buffer copied(device, input_bytes, gpu::Memory::device, "float copies");
  const gpu::DescriptorSet bound(device, kernel, {&given, &given, &written, &copied});
  gpu::Commands commands(device);
  gpu::Staging staging(device, std::size_t{1} << 20U);
  staging.upload(commands, bytes_of(items), given);
  commands.begin();
  const FloatsPush push{0};
  commands.dispatch(kernel, bound, std::as_bytes(std::span(&push, 1)),
                    static_cast<uint32_t>(items.size() / FLOATS_SIZE));
  commands.submit_and_wait();
  staging.download(commands, written, std::as_writable_bytes(std::span(results)));
  if (copies != nullptr) {
    copies->resize(input_bytes / sizeof(uint32_t));
    staging.download(commands, copied, std::as_writable_bytes(std::span(*copies)));
  }
  return results;
}

}  // namespace

FloatReport judge_floats(const std::vector<FloatItem>& items, const FloatResults& results) {
  FloatReport report;
  report.items = items.size();
  const std::span<const uint32_t> operations(results.operations);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Judged judged(items[i], operations.subspan(i * FLOAT_RESULTS, FLOAT_RESULTS));
    judge_errors(judged, report);
    judge_contraction(judged, std::bit_cast<float>(results.plain[i]), report);
    judge_denormals(judged, report);
    judge_special(judged, report);
    const uint32_t bits[] = {items[i].a, items[i].b, items[i].c};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!is_denormal(std::bit_cast<float>(bits[k]))) continue;
      report.denormal_copies.add(results.copies[3 * i + k] == bits[k]);
    }
  }
  if (results.broadcast.empty()) return report;
  const std::vector<uint32_t> sent = denormals_to_send();
  report.denormal_broadcast.emplace();
  for (std::size_t i = 0; i < results.broadcast.size(); ++i) {
    report.denormal_broadcast->add(results.broadcast[i] == sent[i / FLOATS_SIZE]);
  }
  return report;
}

FloatReport measure_floats(const gpu::Device& device) {
  const std::vector<FloatItem> items = float_items();
  FloatResults results;
  results.operations = run(device, "float_operations", items, FLOAT_RESULTS, &results.copies);
  results.plain = run(device, "float_contraction", items, 1, nullptr, gpu::Floats::contract);
  if (device.subgroup_size() != 0) {
    std::vector<FloatItem> sent;
    for (const uint32_t bits : denormals_to_send()) {
      sent.insert(sent.end(), FLOATS_SIZE, FloatItem{bits, bits, bits});
    }
    results.broadcast = run(device, "float_broadcast", sent, 1, nullptr);
  }
  return judge_floats(items, results);
}

}  // namespace trisect
