// The number of threads, from the environment.
#pragma once

namespace trisect {

// Has the program work on as many threads as TRISECT_THREADS says, if it is there. Throws
// UsageError unless that is a whole number from 1 to 1024.
void take_threads_setting();

}  // namespace trisect
