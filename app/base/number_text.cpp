#include "app/base/number_text.h"

#include <fmt/format.h>

#include <cstdlib>

namespace trisect {

// CLI11 reads a long double and rounds it to double: for about one shortest text in ten thousand
// these two roundings give another double. 17 digits are so close to the value that this cannot
// happen.
std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (static_cast<double>(std::strtold(text.c_str(), nullptr)) == value) return text;
  return fmt::format("{:.17g}", value);
}

}  // namespace trisect
