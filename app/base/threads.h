// How many threads work on the CPU.
#pragma once

namespace trisect {

// As many as set_worker_threads() says; before that as many as there are cores that this process
// may use. A Vulkan or OpenGL driver that runs on the CPU has threads of its own.
unsigned worker_threads();

// count: 1 at least, 0 for that of the cores.
void set_worker_threads(unsigned count);

}  // namespace trisect
