// Scripts by which shells complete the program's command line.
#pragma once

#include <string>

#include "app/program/command_page.h"

namespace trisect {

std::string bash_completions(const CommandPage& program);
std::string zsh_completions(const CommandPage& program);
std::string fish_completions(const CommandPage& program);

}  // namespace trisect
