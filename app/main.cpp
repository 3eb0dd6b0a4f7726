// The program: turns errors into sentences and exit codes.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "app/base/error.h"
#include "app/base/message.h"
#include "app/cli/interrupt.h"
#include "app/cli/standard_output.h"
#include "app/cli/threads_setting.h"
#include "app/program/command_line.h"

namespace trisect {
namespace {

int fail(int code, const std::string& message) {
  ends_in_order();
  const std::string line = message_line("trisect: " + message) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
  return code;
}

}  // namespace
}  // namespace trisect

int main(int argc, char** argv) {
  using namespace trisect;  // NOLINT(google-build-using-namespace): main's own
  try {
    keep_standard_files();
    catch_interrupts();
    tell_what_nothing_catches();
    take_threads_setting();
    return CommandLine().run(argc, argv);
  } catch (const UsageError& error) {
    return fail(exit_usage, error.what());
  } catch (const InputError& error) {
    return fail(exit_bad_input, error.what());
  } catch (const DeviceLost& error) {
    return fail(exit_device_lost, error.what());
  } catch (const OutOfMemory& error) {
    return fail(exit_out_of_memory, error.what());
  } catch (const DeviceError& error) {
    return fail(exit_no_device, error.what());
  } catch (const Interrupted& error) {
    // Who has interrupted it does not wait for what drivers do when a process ends.
    std::_Exit(fail(exit_interrupted, error.what()));
  } catch (const std::bad_alloc&) {
    return fail(exit_out_of_memory, kNoMemory);
  } catch (const std::length_error&) {
    return fail(exit_out_of_memory, kNoMemory);  // more than there can be of memory
  } catch (const std::system_error& error) {
    return fail(exit_bad_input, reason_of(error.what()) + ".");  // the system's, not the program's
  } catch (const std::exception& error) {
    return fail(exit_internal, std::string("internal error: ") + error.what());
  }
}
