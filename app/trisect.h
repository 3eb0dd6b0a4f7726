// The library in one header: a model in, a frame out, and what compares and judges frames.
//
//   #include <trisect/trisect.h>
//   using namespace trisect;
//   const BuiltMesh built = build_mesh(read_model("teapot.obj"), "teapot.obj");
//   const BakedScene scene = bake_with_subpatches(built.mesh, {});
//   const TraceSettings settings = framed_settings(built.mesh, scene, 800, 600);
//   const TraceParams params = make_params(scene, settings);
//   const auto result = trace_scene({}, scene, params, {.accel = Accel::tiles});
//   save_image(result->frame, "teapot.png");
//
// Lengths are in the units of the model, images are rows from top to bottom. The library prints
// nothing, reads no environment variable and catches no signal: what it has to say comes back or is
// thrown (app/base/error.h), long steps ask their caller whether to go on (app/base/keep_going.h).
// Functions may be called from several threads at a time unless their header says otherwise;
// objects belong to one thread at a time.
#pragma once

#include "app/accuracy/accuracy.h"
#include "app/bake/bake.h"
#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/base/keep_going.h"
#include "app/crosscheck/comparison_picture.h"
#include "app/crosscheck/frame_comparison.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/camera.h"
#include "app/dispatch/trace_settings.h"
#include "app/frame/frame.h"
#include "app/frame/supersampling.h"
#include "app/judge/hard_rays.h"
#include "app/judge/judged_ray.h"
#include "app/judge/ray_file.h"
#include "app/mesh/mesh.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/oracle/oracle.h"
#include "app/oracle/oracle_tracer.h"
#include "app/picture/image_file.h"
#include "app/picture/image_reader.h"
#include "app/surface/surface_choice.h"
#include "app/tessellation/flat_mesh.h"
#include "app/tessellation/flat_mesh_file.h"
#include "app/trace/trace_scene.h"
