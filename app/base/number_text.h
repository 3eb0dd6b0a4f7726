// Numbers as texts that read back the same.
#pragma once

#include <string>

namespace trisect {

// The shortest text from which strtod() and strtold(), rounded to double, both read this value.
std::string number_text(double value);

}  // namespace trisect
