// Reading Wavefront OBJ files as programs write them: this reader checks and puts in order what
// tinyobjloader then parses.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/mesh/polygon_model.h"

namespace trisect {

// What a model is called: "teapot" of "assets/teapot.obj".
std::string model_name(const std::filesystem::path& path);

// Reads a file, which may be compressed by gzip. Throws InputError with the file's name and, where
// there is one, the line at fault, if the file cannot be read or has no faces, if a vertex or
// normal is not three finite numbers, or if a face has a corner that names nothing.
//
// Faces may name vertices that come later. Points, lines, curves, surfaces and faces of one or two
// corners are left out; so are fourth coordinates of vertices, and normals that faces name in a
// file that has none. The notes say what, and how often. Smoothing groups are read; without any all
// faces are in one.
//
// The colours of materials are read from the files that the file names, in its folder and below.
PolygonModel read_obj(const std::filesystem::path& path);

// The same for the text of a file, in ASCII, UTF-8 or UTF-16; `name` stands for the file in
// messages. folder: where materials are; without one they are not looked for.
PolygonModel parse_obj(std::string_view file_text, const std::string& name,
                       const std::filesystem::path& folder = {});

}  // namespace trisect
