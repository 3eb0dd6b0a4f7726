// What a report's measurements were made with.
#pragma once

#include <string>

namespace trisect::bench {

// The program's version, commit and compiler, and today's date in UTC, in a line.
std::string program_and_date();

}  // namespace trisect::bench
