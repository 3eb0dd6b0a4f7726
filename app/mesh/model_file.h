// Reading a model of any format.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/mesh/polygon_model.h"

namespace trisect {

enum class ModelFormat { obj, gltf, ply, stl, fbx };

// "OBJ", "glTF", "PLY", "STL" or "FBX".
const char* format_name(ModelFormat format);

// Whether a file's name ends as one of .obj .gltf .glb .ply .stl .fbx, before .gz too.
bool is_model_name(const std::filesystem::path& path);

// Told by the content, or, where that says nothing, by the ending of the file's name, if it is one
// of .obj .gltf .glb .ply .stl .fbx, before .gz too. What says nothing in either way is taken for
// OBJ.
ModelFormat format_of(std::string_view bytes, const std::filesystem::path& path);

// Reads a file, which may be compressed by gzip. format: set to its format, unless null. Throws
// InputError with the file's name.
PolygonModel read_model(const std::filesystem::path& path, ModelFormat* format = nullptr);

}  // namespace trisect
