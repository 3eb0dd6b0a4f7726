// EXR files, opened for reading.
#pragma once

#include <ImfInputFile.h>

#include <exception>
#include <filesystem>
#include <ios>
#include <string>

#include "app/base/error.h"

namespace trisect {

// Opens a file whose pixels are at most kLargestSide a side: a few bytes may claim more than the
// machine has memory for, and OpenEXR takes memory for a row at once. The limit is OpenEXR's own
// and from then on the process's. Throws what OpenEXR throws.
Imf::InputFile open_exr(const std::filesystem::path& path);

// Where in the file its headers end; its end if they are cut off. Throws std::runtime_error if an
// attribute is larger than the file, or not as large as its type, for which OpenEXR would take
// memory. Other mistakes are left to OpenEXR.
std::streamoff end_of_headers(const std::filesystem::path& path);

// "FILE: could not be read: WHY." why: as OpenEXR has it, which may name the file again: 'Cannot
// read image file "a.exr". '
InputError unreadable(const std::filesystem::path& path, std::string why);

// use(file) of an opened file, with what OpenEXR throws as InputError.
template <typename Use>
auto with_exr(const std::filesystem::path& path, const Use& use) {
  try {
    Imf::InputFile file = open_exr(path);
    return use(file);
  } catch (const std::exception& error) {
    if (is_told_as_it_is(error)) throw;
    throw unreadable(path, error.what());
  }
}

}  // namespace trisect
