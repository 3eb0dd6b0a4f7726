// The table of the hard cases, for a report.
#pragma once

#include <string>

#include "app/report/document.h"

namespace trisect::bench {

struct StressTable {
  std::string device;  // and its driver
  report::Table table;
};

// Of what `trisect hardcases --json` wrote into the file. Throws InputError, naming it, if that
// cannot be read.
StressTable read_stress_table(const std::string& file);

}  // namespace trisect::bench
