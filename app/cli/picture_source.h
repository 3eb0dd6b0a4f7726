// What a picture was made from and by whom, as its file says it and `render --from` reads it.
#pragma once

#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/trace_settings.h"
#include "app/picture/image_file.h"

namespace trisect {

// What the options do not say.
struct PictureSource {
  TraceSettings settings;  // that were chosen
  Accel accel = Accel::list;
  std::string model_sha256;
  std::string device;
  std::string driver;
};

// What a file says of its picture: what makes it again, and who made it.
std::vector<ImageAttribute> attributes_of(const RenderOptions& options,
                                          const PictureSource& source);

// What the file of a picture says of it.
struct SavedPicture {
  std::vector<std::string> words;  // the options with which `trisect render` makes it again
  std::string model;
  std::string model_sha256;
  std::string aovs;     // as --aov has them; empty if it was not given
  std::string program;  // its version
  std::string commit;
  std::string device;
  std::string driver;
};

// Reads what attributes_of() wrote. Throws InputError if the file does not say it, and what
// read_attributes() throws.
SavedPicture saved_picture(const std::string& file);

}  // namespace trisect
