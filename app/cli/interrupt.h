// Ctrl-C and termination, noticed between two steps so that nothing is left half done.
#pragma once

namespace trisect {

// From now on the first SIGINT or SIGTERM is remembered; the second ends the program at once.
void catch_interrupts();

// Throws Interrupted if a signal has come.
void stop_if_interrupted();

}  // namespace trisect
