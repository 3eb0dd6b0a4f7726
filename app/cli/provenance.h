// Which program made something.
#pragma once

#include <string>

namespace trisect {

// The commit that the program was built from.
std::string commit();

// The program's version, commit and compiler, and today's date in UTC, in a line.
std::string program_and_date();

}  // namespace trisect
