// The numbers on which a device's arithmetic is tried.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>

#include "app/accuracy/float_operations.h"
#include "app/buffers/float_operations.h"

namespace trisect {
namespace {

using Limits = std::numeric_limits<float>;

constexpr int kLeastExponent = -126;  // of normal numbers 1.xxx times 2^exponent
constexpr int kMostExponent = 127;

uint32_t bits_of(float x) {
  return std::bit_cast<uint32_t>(x);
}

uint32_t bits_of(double x) {
  return bits_of(static_cast<float>(x));
}

class Numbers {
 public:
  // A whole number from low to high.
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }

  double sign() { return whole(0, 1) == 0 ? 1.0 : -1.0; }

  // A positive float with an exponent from low to high.
  double positive(int low, int high) {
    const double mantissa = 1.0 + std::ldexp(whole(0, (1 << 23) - 1), -23);
    return std::ldexp(mantissa, whole(low, high));
  }

  double any(int low, int high) { return sign() * positive(low, high); }

  // The middle between a positive float with such an exponent and the next one.
  double middle(int low, int high) {
    const double mantissa = 1.0 + std::ldexp(whole(0, (1 << 23) - 1) + 0.5, -23);
    return std::ldexp(mantissa, whole(low, high));
  }

  double denormal() { return sign() * std::ldexp(whole(1, (1 << 23) - 1), -149); }

 private:
  // Of a fixed seed: the same numbers each time.
  std::mt19937_64 engine_{20};
};

// A float that is so many floats from x, which is positive, toward infinity.
double moved(double x, int floats) {
  return std::bit_cast<float>(bits_of(x) + static_cast<uint32_t>(floats));
}

constexpr std::array kSpecial{0.0F,
                              -0.0F,
                              1.0F,
                              -1.0F,
                              3.0F,
                              Limits::infinity(),
                              -Limits::infinity(),
                              Limits::max(),
                              Limits::lowest(),
                              Limits::min(),
                              -Limits::min(),
                              Limits::denorm_min(),
                              -Limits::denorm_min(),
                              0x1.fffffcp-127F};
// Quiet NaNs, one of them negative with bits of its own, and a signalling one.
constexpr std::array kNans{0x7FC00000U, 0xFFC12345U, 0x7F812345U};

std::vector<uint32_t> special_bits() {
  std::vector<uint32_t> bits;
  std::transform(kSpecial.begin(), kSpecial.end(), std::back_inserter(bits),
                 [](float x) { return bits_of(x); });
  bits.insert(bits.end(), kNans.begin(), kNans.end());
  return bits;
}

}  // namespace

std::vector<FloatItem> float_items() {
  Numbers numbers;
  std::vector<FloatItem> items;
  const auto add = [&](int count, auto&& item) {
    for (int i = 0; i < count; ++i) items.push_back(item());
  };
  const auto of = [](double a, double b, double c) {
    return FloatItem{bits_of(a), bits_of(b), bits_of(c)};
  };
  // Numbers of like sizes, and of any size.
  add(1536, [&] { return of(numbers.any(-3, 3), numbers.any(-3, 3), numbers.any(-3, 3)); });
  add(1024, [&] {
    return of(numbers.any(kLeastExponent, kMostExponent), numbers.any(-60, 60),
              numbers.any(kLeastExponent, kMostExponent));
  });
  // Near powers of two.
  add(1024, [&] {
    const auto near_power = [&] {
      return numbers.sign() * moved(std::ldexp(1.0, numbers.whole(-60, 60)), numbers.whole(-2, 2));
    };
    return of(near_power(), near_power(), near_power());
  });
  // Sums that lie in the middle of two floats, or next to it.
  add(512, [&] {
    const int exponent = numbers.whole(-30, 30);
    const double a = numbers.any(exponent, exponent);
    const double half = std::ldexp(numbers.whole(0, 1000) + 0.5, exponent - 23);
    return of(a, numbers.sign() * moved(half, numbers.whole(-1, 1)), -a);
  });
  // Products that do: of odd numbers of 12 and 13 bits. And with c the roundings of their products.
  add(1024, [&] {
    const double a = 2.0 * numbers.whole(1 << 10, (1 << 11) - 1) + 1.0;
    const double b = 2.0 * numbers.whole(1 << 11, (1 << 12) - 1) + 1.0;
    const double x = moved(std::ldexp(a, numbers.whole(-40, 20)), numbers.whole(-1, 1));
    const double y = std::ldexp(b, numbers.whole(-40, 20));
    const auto product = static_cast<float>(x * y);
    return of(x, -y, numbers.whole(0, 1) == 0 ? product : moved(product, numbers.whole(-3, 3)));
  });
  // Quotients and roots near the middle of two floats.
  add(1024, [&] {
    const double b = numbers.positive(-30, 30);
    const double a = static_cast<float>(numbers.middle(-30, 30) * b);
    return of(numbers.sign() * a, b, numbers.any(-3, 3));
  });
  add(512, [&] {
    const double root = numbers.middle(-60, 60);
    return of(static_cast<float>(root * root), numbers.any(-3, 3), numbers.any(-3, 3));
  });
  add(512, [&] {
    const double root = numbers.middle(-60, 60);
    return of(static_cast<float>(1.0 / (root * root)), numbers.any(-3, 3), numbers.any(-3, 3));
  });
  // Quotients of 1, and of what the other number is near.
  add(256, [&] { return of(1.0, numbers.any(-125, 125), numbers.any(-3, 3)); });
  add(256, [&] {
    const double b = numbers.positive(-60, 60);
    return of(moved(b, numbers.whole(-2, 2)), b, numbers.any(-3, 3));
  });
  // Products and differences that are denormal.
  add(256, [&] {
    const double a = numbers.any(-80, -50);
    const int least = -145 - std::ilogb(a);
    const int most = -128 - std::ilogb(a);
    return of(a, numbers.any(least, most), numbers.denormal());
  });
  add(256, [&] {
    return of(numbers.positive(kLeastExponent, kLeastExponent),
              -numbers.positive(kLeastExponent, kLeastExponent), numbers.denormal());
  });
  // Denormal operands of sums and products that are normal numbers.
  add(256, [&] { return of(numbers.denormal(), numbers.any(60, 100), numbers.denormal()); });
  add(256, [&] {
    const double a = numbers.denormal();
    return of(a, std::copysign(Limits::min(), a), numbers.any(-3, 3));
  });
  // Products and sums that are too large.
  add(256, [&] { return of(numbers.any(65, 120), numbers.any(65, 120), numbers.any(-3, 3)); });
  for (const uint32_t a : special_bits()) {
    for (const uint32_t b : special_bits()) items.push_back({a, b, bits_of(1.0)});
  }
  while (items.size() % FLOATS_SIZE != 0) {
    items.push_back(of(numbers.any(-3, 3), numbers.any(-3, 3), numbers.any(-3, 3)));
  }
  return items;
}

std::vector<uint32_t> denormals_to_send() {
  Numbers numbers;
  // Small integers among them.
  std::vector<uint32_t> bits;
  for (uint32_t i = 1; i <= 64; ++i) bits.push_back(i);
  while (bits.size() < 256) bits.push_back(bits_of(numbers.denormal()));
  return bits;
}

}  // namespace trisect
