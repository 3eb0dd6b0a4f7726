// The table and the JSON of `trisect hardcases`.
#pragma once

#include <string>

#include "app/report/columns.h"
#include "app/stress/stress_judge.h"

namespace trisect {

// The table for reports lacks the note, which with_note() adds to the verdict.
const report::Columns<StressRow>& hardcases_columns();

// "FAIL (a note)", or the verdict alone if there is no note.
std::string with_note(const std::string& verdict, const std::string& note);

}  // namespace trisect
