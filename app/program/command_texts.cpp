#include "app/program/command_texts.h"

#include <map>

#include "app/base/error.h"

namespace trisect {
namespace {

const std::map<std::string, CommandTexts>& texts() {
  static const std::map<std::string, CommandTexts> all{
      {"trisect",
       {{"Each triangle of a model, with its three vertex normals, is a curved patch, which rays "
         "meet directly: nothing is tessellated. It runs on any Vulkan device with compute, Mesa's "
         "driver for the CPU among them.",
         "An image or a JSON file that is named - is standard output; what a person reads goes to "
         "standard error then. Files appear whole or not at all, and the folders that they need "
         "are made. An option may be given as --name value or as --name=value; of a repeated one "
         "the last counts. Every error is one sentence on standard error."},
        {{"Render a model", "trisect render teapot.obj -o teapot.png"},
         {"Show it in a window", "trisect view teapot.obj"},
         {"See which devices there are", "trisect devices"}}}},
      {"trisect render",
       {{"Renders one picture, a part of it, or the frames of a camera path. Without --eye the "
         "camera frames the model. A PNG holds the colours "
         "as they are shown; an EXR holds them as linear light, with depth, normals, the triangle "
         "and the place in it for every pixel, and says in its header what makes the picture "
         "again."},
        {{"The teapot, with the camera where it frames the model",
          "trisect render teapot.obj -o teapot.png"},
         {"Larger, smoother at its edges, with shadows, on no background",
          "trisect render model.glb -o model.png --size 1920x1080 --spp 16 --shadows --background "
          "transparent"},
         {"As the thesis drew it, with the figures as JSON",
          "trisect render teapot.obj -o thesis.exr --preset thesis --rank 20 --stats "
          "thesis.json"},
         {"Once around the model, and on where it was stopped",
          "trisect render model.glb --turntable 90 -o 'frames/{frame}.png' --resume"}}}},
      {"trisect view",
       {{"While something moves the resolution gives way to keep to the time of a frame; when all "
         "is still the picture comes to full resolution, and then nothing is computed. H shows the "
         "list of keys, Tab the panel; Ctrl+C copies the view as options of trisect render. A "
         "model that is dropped on the window is opened."},
        {{"Walk around a model", "trisect view model.glb"},
         {"The teapot with four rays a pixel once it is still, and shadows",
          "trisect view --spp 4 --shadows"},
         {"Save a picture after ten frames and end",
          "trisect view teapot.obj --frames 10 --screenshot view.png"}}}},
      {"trisect stitch",
       {{"The parts may come from several machines. On like devices the image is that of one "
         "render, bit for bit."},
        {{"Two halves", "trisect stitch left.png right.png -o whole.png"},
         {"An image with all its outputs",
          "trisect stitch part-0.exr part-1.exr part-2.exr -o whole.exr"}}}},
      {"trisect info",
       {{"Tells the format, meshes, bounds, how far normals lean, edges, memory of the curved "
         "surface, patches that fold over, and what of it deserves a look. Needs no device."},
        {{"What a model is like", "trisect info model.glb"},
         {"The same after the normals are made anew", "trisect info part.stl --crease 30"},
         {"For a program", "trisect info model.glb --json -"}}}},
      {"trisect export",
       {{"Vertices are shared, so what is closed stays closed. With --error the bound is proven; "
         "where it cannot be, the file has as many triangles as there may be and the exit code is "
         "1."},
        {{"Off the curved surface by a hundredth of a unit at most",
          "trisect export teapot.obj -o teapot.glb --error 0.01"},
         {"Eight by eight triangles for each",
          "trisect export teapot.obj -o teapot.ply --subdivide 8"}}}},
      {"trisect devices",
       {{"The numbers and names that it prints are what --device takes."},
        {{"Which devices there are", "trisect devices"},
         {"What the arithmetic of one of them does", "trisect devices --floats --device llvmpipe"},
         {"For a program", "trisect devices --json devices.json"}}}},
      {"trisect compare",
       {{"Of EXR files hits, triangles and depths are compared too. The exit code is 1 if the "
         "images are farther apart than the thresholds allow."},
        {{"Two pictures, with one that shows where they differ",
          "trisect compare before.png after.png --diff difference.png"},
         {"Allow two of 255 steps of a colour",
          "trisect compare before.exr after.exr --threshold color_max=2"},
         {"Whether all channels are the same, bit for bit",
          "trisect compare before.exr after.exr --exact"}}}},
      {"trisect crosscheck",
       {{"Prints for every pair of back ends the hits and triangles that differ, how many depths "
         "have the same bits, and how far normals and colours are apart. The exit code is 1 if "
         "that is more than promised."},
        {{"Vulkan beside OpenGL", "trisect crosscheck torus.obj"},
         {"All of them, in a small image",
          "trisect crosscheck torus.obj --backends vulkan,opengl,cpu,oracle --size 160x120"}}}},
      {"trisect accuracy",
       {{"Every pixel of every solver is compared with an independent search in double precision "
         "for all roots. The exit code is 1 if the robust solver is wrong anywhere."},
        {{"A model in a small image", "trisect accuracy sphere-20.obj --size 160x120"},
         {"One surface of two models, as JSON",
          "trisect accuracy teapot.obj torus.obj --surface sphere --json accuracy.json"}}}},
      {"trisect certify",
       {{"A proof holds for every ray within a rounding of single precision of the pixel's, in "
         "interval arithmetic: hulls that are off the ray prove a miss, a contraction a single "
         "root. What is not proven is open, and told why. The exit code is 1 if an answer is "
         "proven wrong."},
        {{"With a picture of the reasons", "trisect certify teapot.obj -o reasons.png"},
         {"What bisection gets wrong",
          "trisect certify torus.obj --solver bisect --shell height --size 160x120"},
         {"On the CPU, as JSON",
          "trisect certify sphere-20.obj --backend cpu --size 160x120 --json proofs.json"}}}},
      {"trisect hardcases",
       {{"Rays and patches on which solvers fail: silhouettes, grazing rays, needles, double "
         "roots. The exit code is 1 if the robust solver breaks its promise in one of them."},
        {{"On the fastest device", "trisect hardcases"},
         {"On the CPU, as JSON", "trisect hardcases --backend cpu --json hardcases.json"}}}},
      {"trisect rays",
       {{"The model's numbers are taken in single precision, as other programs hold them, and the "
         "rays are in its coordinates. docs/formats.md describes the files."},
        {{"A thousand of each kind", "trisect rays teapot.obj -o teapot.rays"},
         {"Ten thousand at edges of the flat triangles, as text",
          "trisect rays torus.obj --surface flat --kind edge --count 10000 -o edges.csv"}}}},
      {"trisect cast",
       {{"By the robust solver, or by the oracle, an independent search in double precision for "
         "all roots."},
        {{"On the fastest device", "trisect cast teapot.rays teapot.obj -o teapot.hits"},
         {"By the oracle",
          "trisect cast edges.csv torus.obj --surface flat --backend oracle -o "
          "edges.hits.csv"}}}},
      {"trisect judge",
       {{"Every hit is compared with the oracle's, an independent search in double precision for "
         "all roots: of flat triangles or of curved ones. Rays whose answer the last digits of "
         "single precision decide are set apart. The exit code is 1 if a hit is wrong."},
        {{"The program's own hits", "trisect judge teapot.rays teapot.hits teapot.obj"},
         {"Those of a ray tracer of flat triangles, with a list of the wrong ones",
          "trisect judge edges.csv edges.hits.csv torus.obj --surface flat --wrong wrong.csv"}}}},
      {"trisect bench",
       {{"All contenders take turns, so that a machine that becomes slower meanwhile is as slow "
         "for each of them."},
        {{"Times beside each other", "trisect bench speed teapot.obj"},
         {"Time against error, as a report with plots",
          "trisect bench pareto teapot.obj -o report"}}}},
      {"trisect bench speed",
       {{},
        {{"Both surfaces of a model", "trisect bench speed teapot.obj"},
         {"One of them, on a given device, as JSON",
          "trisect bench speed sphere-20.obj --surface phong --device 0 --json speed.json"}}}},
      {"trisect bench pareto",
       {{"The report is written as Markdown, HTML, CSV and JSON, with plots that gnuplot draws."},
        {{"A first look", "trisect bench pareto sphere-20.obj --quick -o report"},
         {"One surface of two models, without plots",
          "trisect bench pareto teapot.obj torus.obj --surface phong --no-plots -o report"}}}},
      {"trisect bench shape",
       {{"Distances are measured both ways between the surfaces, and none is larger than the bound "
         "that stands beside it. The shape is what the triangles of the reference are: take it "
         "much finer than the models."},
        {{"Three spheres against one of a million triangles",
          "trisect bench shape sphere-20.obj sphere-80.obj sphere-320.obj --reference fine.obj -o "
          "shape"},
         {"A scan decimated to three numbers of triangles",
          "trisect bench shape --reference scan.ply --decimate 500,2000,8000 -o shape"},
         {"Without plots, with distances down to a millionth of the radius",
          "trisect bench shape coarse.glb --reference fine.glb --error 1e-6 --no-plots -o "
          "shape"}}}},
      {"trisect bench terminator",
       {{"A pixel is wrong if the light reaches it in truth and not in the picture, or the other "
         "way round. The truth is the curved surface's, by the oracle, an independent search in "
         "double precision; pixels that it cannot decide are left out."},
        {{"A coarse sphere in four lights", "trisect bench terminator sphere-80.obj -o terminator"},
         {"Two models in two lights, without plots",
          "trisect bench terminator teapot.obj torus.obj --lights 60,100 --no-plots -o "
          "terminator"}}}},
      {"trisect bench ablation",
       {{},
        {{"What each step is worth", "trisect bench ablation sphere-320.obj -o steps"},
         {"On one surface, in a larger image",
          "trisect bench ablation teapot.obj --surface phong --size 800x600 -o steps"}}}},
      {"trisect bench stability",
       {{"Needs no device: the solvers run as C++."},
        {{"The report of the documentation", "trisect bench stability -o stability"},
         {"A first look", "trisect bench stability --rays 10 -o stability"}}}}};
  return all;
}

}  // namespace

CommandTexts command_texts(const std::string& path) {
  const auto found = texts().find(path);
  return found == texts().end() ? CommandTexts{} : found->second;
}

std::vector<Term> exit_codes() {
  const auto code = [](ExitCode number) { return std::to_string(number); };
  return {{code(exit_done), "done"},
          {code(exit_different), "farther apart than promised or asked for, or a wrong hit"},
          {code(exit_usage), "usage: no such command or option, or a value that it cannot have"},
          {code(exit_bad_input), "a file that cannot be read or written, or holds nonsense"},
          {code(exit_no_device), "no usable device"},
          {code(exit_device_lost), "the device was lost"},
          {code(exit_out_of_memory), "out of memory, the device's or the machine's"},
          {code(exit_internal), "internal error, a message of the validation layer among them"},
          {code(exit_interrupted), "interrupted"}};
}

std::vector<Term> environment() {
  return {{"COLUMNS", "How wide help is, in characters; as wide as the terminal without it."},
          {"TRISECT_THREADS",
           "How many threads work on the CPU; as many as there are cores that the program may use "
           "without it. A driver that runs on the CPU has its own (LP_NUM_THREADS of Mesa)."},
          {"XDG_CACHE_HOME", "The folder that holds the program's cache, ~/.cache without it."},
          {"VK_ICD_FILENAMES",
           "The Vulkan loader's: the drivers to take, by their manifests, rather than all that are "
           "installed."},
          {"DISPLAY", "The X server that trisect view opens its window on."}};
}

std::vector<Term> files() {
  return {{"~/.cache/trisect",
           "Compiled pipelines, for the next run on the same device and driver, and the models "
           "that were opened last. It may be removed."},
          {"/usr/share/trisect/assets", "Models that come with the program."},
          {"/usr/share/trisect/shaders", "The sources that F5 compiles in trisect view."}};
}

}  // namespace trisect
