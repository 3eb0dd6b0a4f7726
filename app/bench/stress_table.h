// The table of the hard cases, for a report.
#pragma once

#include <string>

#include "app/report/document.h"

namespace trisect::bench {

struct StressTable {
  std::string device;  // and its driver
  report::Table table;
};

// Reads a file that `trisect hardcases --json` wrote. Throws InputError, naming the file, if it
// cannot be read or is no such file.
StressTable read_stress_table(const std::string& file);

}  // namespace trisect::bench
