// The manual: a page in roff, of the macros that man(7) describes, for every command.
#pragma once

#include <string>

#include "app/program/command_page.h"

namespace trisect {

// "trisect-bench-speed" of "trisect bench speed".
std::string manual_name(const CommandPage& page);

// The page of a command of `program`, which it may be itself. date: as 2026-01-31.
std::string manual_page(const CommandPage& program, const CommandPage& page,
                        const std::string& version, const std::string& date);

}  // namespace trisect
